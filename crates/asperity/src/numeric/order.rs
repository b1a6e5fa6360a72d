//! Smallest, middle and largest values.

/// The upper median, for which values are reordered; `None` of none.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The smallest and the largest value; `None` of none.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let both = values.into_iter().map(|value| [value; 2]);
    both.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}

/// The width of a positive range on a logarithmic scale.
pub fn decades([from, to]: [f64; 2]) -> f64 {
    (to / from).log10()
}
