//! Positions of labels and legend away from the data.

use super::canvas::{Rect, Spot};

/// Distance between the dots that stand for a line, in CSS pixels.
pub(super) const PITCH: f64 = 5.0;

/// What is already on the page: data as dots, texts as boxes.
#[derive(Default)]
pub(super) struct Taken {
    dots: Vec<Spot>,
    boxes: Vec<Rect>,
}

impl Taken {
    pub(super) fn dot(&mut self, spot: Spot) {
        self.dots.push(spot);
    }

    pub(super) fn line(&mut self, line: &[Spot], page: &Rect) {
        for pair in line.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            // The count is bounded for lines that leave the page by far.
            let steps = (dx.hypot(dy) / PITCH).ceil().clamp(1.0, 2000.0) as usize;
            let dots = (0..=steps).map(|k| {
                let part = k as f64 / steps as f64;
                (pair[0].0 + part * dx, pair[0].1 + part * dy)
            });
            self.dots.extend(dots.filter(|dot| page.holds(*dot)));
        }
    }

    /// The whole area between two edges of as many spots, each pair one above the other.
    pub(super) fn area(&mut self, lower: &[Spot], upper: &[Spot], page: &Rect) {
        for (low, high) in lower.windows(2).zip(upper.windows(2)) {
            let steps = ((low[1].0 - low[0].0).abs() / PITCH).ceil().clamp(1.0, 500.0) as usize;
            for step in 0..=steps {
                let part = step as f64 / steps as f64;
                let at = |pair: &[Spot]| pair[0].1 + part * (pair[1].1 - pair[0].1);
                let x = low[0].0 + part * (low[1].0 - low[0].0);
                let (top, bottom) = (at(low).min(at(high)), at(low).max(at(high)));
                self.line(&[(x, top.max(page.top)), (x, bottom.min(page.bottom))], page);
            }
        }
    }

    pub(super) fn text(&mut self, rect: Rect) {
        self.boxes.push(rect);
    }

    /// How much a box would cover; nothing if 0.
    pub(super) fn under(&self, rect: &Rect) -> usize {
        let rect = rect.grown(3.0);
        let dots = self.dots.iter().filter(|dot| rect.holds(**dot)).count();
        let boxes = self.boxes.iter().filter(|other| other.meets(&rect)).count();
        dots + 30 * boxes
    }

    /// The first of the boxes that cover least.
    pub(super) fn clearest<T>(&self, places: impl IntoIterator<Item = (Rect, T)>) -> Option<(Rect, T)> {
        places.into_iter().min_by_key(|(rect, _)| self.under(rect))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_area_is_taken_between_its_corners_too() {
        let page = Rect::new(0.0, 0.0, 300.0, 100.0);
        let mut taken = Taken::default();
        taken.area(&[(0.0, 500.0), (300.0, 500.0)], &[(0.0, 50.0), (300.0, 50.0)], &page);
        assert!(taken.under(&Rect::new(140.0, 70.0, 20.0, 10.0)) > 0);
        assert_eq!(taken.under(&Rect::new(140.0, 20.0, 20.0, 10.0)), 0);
    }

    #[test]
    fn the_box_beside_the_line_is_chosen() {
        let page = Rect::new(0.0, 0.0, 100.0, 100.0);
        let mut taken = Taken::default();
        taken.line(&[(0.0, 0.0), (100.0, 100.0)], &page);
        let on = Rect::new(10.0, 10.0, 20.0, 20.0);
        let beside = Rect::new(70.0, 5.0, 20.0, 20.0);
        assert!(taken.under(&on) > 0);
        assert_eq!(taken.clearest([(on, 1), (beside, 2)]), Some((beside, 2)));
        taken.text(beside);
        assert_eq!(taken.clearest([(on, 1), (beside, 2)]), Some((on, 1)));
    }
}
