//! The parts of a line inside a rectangle. Viewers cut off what is outside by themselves, but whole
//! units reach only so far.

use super::canvas::{Rect, Spot};

/// The parts of a line inside a rectangle, in their order (Liang and Barsky 1984).
pub(super) fn clip(line: &[Spot], rect: &Rect) -> Vec<Vec<Spot>> {
    let mut parts: Vec<Vec<Spot>> = Vec::new();
    for pair in line.windows(2) {
        let Some((from, to)) = clip_segment(pair[0], pair[1], rect) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

fn clip_segment(from: Spot, to: Spot, rect: &Rect) -> Option<(Spot, Spot)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let sides = [
        (-dx, from.0 - rect.left),
        (dx, rect.right - from.0),
        (-dy, from.1 - rect.top),
        (dy, rect.bottom - from.1),
    ];
    for (outwards, room) in sides {
        if outwards == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outwards < 0.0 {
            enter = enter.max(room / outwards);
        } else {
            leave = leave.min(room / outwards);
        }
    }
    let at = |part: f64| match part {
        // The ends themselves, so that the next segment begins where this one ends.
        0.0 => from,
        1.0 => to,
        part => (from.0 + part * dx, from.1 + part * dy),
    };
    (enter <= leave).then(|| (at(enter), at(leave)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_where_it_crosses() {
        let rect = Rect::new(0.0, 0.0, 10.0, 10.0);
        assert_eq!(clip(&[(-5.0, 5.0), (15.0, 5.0)], &rect), [[(0.0, 5.0), (10.0, 5.0)]]);
        assert_eq!(clip(&[(-16.0, -16.0), (16.0, 16.0)], &rect), [[(0.0, 0.0), (10.0, 10.0)]]);
        assert!(clip(&[(-5.0, 5.0), (5.0, 25.0)], &rect).is_empty());
        assert!(clip(&[(1.0, 1.0)], &rect).is_empty());
    }

    #[test]
    fn what_leaves_and_returns_is_two_parts() {
        let rect = Rect::new(0.0, 0.0, 10.0, 10.0);
        let parts = clip(&[(1.0, 1.0), (2.0, 2.0), (5.0, -4.0), (8.0, 2.0), (9.0, 1.0)], &rect);
        assert_eq!(parts.len(), 2);
        assert_eq!((parts[0].len(), parts[1].len()), (3, 3));
    }
}
