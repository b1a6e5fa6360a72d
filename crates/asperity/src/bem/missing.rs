//! Heights of missing points, for the solver alone.

/// Fills missing points (NaN) from the border of each gap inwards, with the mean of the neighbours that are known.
pub fn filled(heights: &[f64], [nx, ny]: [usize; 2]) -> Vec<f64> {
    let mut filled = heights.to_vec();
    let mut missing: Vec<usize> = (0..heights.len()).filter(|&k| heights[k].is_nan()).collect();
    while !missing.is_empty() {
        let mean = |k: usize| {
            let (i, j) = (k / ny, k % ny);
            let rows = i.saturating_sub(1)..(i + 2).min(nx);
            let around = rows.flat_map(|i| (j.saturating_sub(1)..(j + 2).min(ny)).map(move |j| i * ny + j));
            let known = around.map(|k| filled[k]).filter(|z| !z.is_nan());
            let (sum, count) = known.fold((0.0, 0), |(sum, count), z| (sum + z, count + 1));
            (count > 0).then(|| sum / f64::from(count))
        };
        let means: Vec<Option<f64>> = missing.iter().map(|&k| mean(k)).collect();
        let before = missing.len();
        let mut values = means.into_iter();
        missing.retain(|&k| match values.next().flatten() {
            Some(z) => {
                filled[k] = z;
                false
            }
            None => true,
        });
        if missing.len() == before {
            break;
        }
    }
    filled
}
