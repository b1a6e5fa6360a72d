//! What the height steps of an instrument do to the summits of a map, filtered or not.

use crate::topography::{Filter, HeightMap, Quantisation, RoughnessParameters, Rows, Window};

/// Points along an axis of the part of a map that is examined.
const WINDOW: usize = 512;

/// The height step of `quantisation` over the median drop from a summit to its neighbours. After a `filter` the step is what
/// the filter leaves of it: the rounding errors of the steps on the `map` are filtered alike, and the root mean square
/// difference between neighbours is expressed as the step that has it without a filter (of independent errors, step/6^.5).
/// `None` without a step.
pub fn step_over_drop(map: &dyn Rows, quantisation: &Quantisation, filter: Option<&Filter>) -> Option<f64> {
    let step = quantisation.step?;
    let left = filter.and_then(|filter| {
        let window = HeightMap::from_rows(&Window::centre(map, WINDOW));
        let error = |z: &f64| (z / step).round() * step - z;
        let errors = window.heights().iter().map(error).collect();
        let errors = HeightMap::new(window.points(), window.pixel(), errors, 0.0).ok()?;
        let [x, y] = RoughnessParameters::new(&filter.apply(&errors).ok()?).drops.first;
        Some((6.0 * 0.5 * (x + y)).sqrt())
    });
    Some(left.unwrap_or(step) / quantisation.median_drop)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};
    use crate::topography::summits::five_point;

    /// The remedy clears the check, and the step without it is the one of the instrument.
    #[test]
    fn a_filter_takes_the_steps_out() {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 64.0, cut_off: 12.0 };
        let spectrum = Spectrum::new(shape, Lay::default()).unwrap().on_grid([256; 2], [1.0; 2]);
        let heights = gaussian(&spectrum, 1.0, [5; 32]);
        let over = |step: f64, filter: Option<f64>| {
            let stepped = heights.iter().map(|z| (z / step).round() * step).collect();
            let raw = HeightMap::new([256; 2], [1.0; 2], stepped, 0.0).unwrap();
            let filter = filter.map(|s| Filter::new(Some(s), None).unwrap());
            let map = filter.map_or(raw.clone(), |filter| filter.apply(&raw).unwrap());
            let quantisation = Quantisation::new(&raw, &five_point(&map), filter.is_some());
            assert!(filter.is_none() || quantisation.distinct_curvatures > 100);
            step_over_drop(&map, &quantisation, filter.as_ref()).unwrap()
        };
        let bare = over(0.05, None);
        assert!(bare > 0.5, "{bare}");
        let [little, more] = [6.0, 12.0].map(|s| over(0.05, Some(s)));
        assert!(more < little && little < bare && more < 0.2, "{bare} {little} {more}");
        assert!(over(1e-4, None) < 0.02);
    }
}
