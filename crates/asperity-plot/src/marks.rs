//! The layers on the page: the parts of lines inside the frame, with no more points than are seen.

use std::collections::HashSet;

use crate::axes::Frame;
use crate::canvas::{Canvas, Rect, Spot, Stroke};
use crate::label::{PITCH, Taken};
use crate::layer::{Dash, Direction, Layer, Marker, Shape};
use crate::style::{LINE, REFERENCE};
use crate::{Raster, Spread};

/// Half the size of a marker.
const RADIUS: f64 = 3.2;
/// Radius of an open circle.
const RING: f64 = 7.0;
/// A sixth of a pixel: not to be seen.
const TOLERANCE: f64 = 0.16;
const MOST_MARKERS: usize = 1000;

/// Draws what lies below all data: shaded regions.
pub(super) fn draw_region(canvas: &mut Canvas, frame: &Frame, layer: &Layer) {
    if let Some(rect) = region(frame, layer) {
        canvas.rect(&rect, layer.colour.rgb(), layer.opacity);
    }
}

/// The part of the frame that a region shades.
pub(super) fn region(frame: &Frame, layer: &Layer) -> Option<Rect> {
    let Shape::Region(direction, from, to) = &layer.shape else {
        return None;
    };
    let r = frame.rect;
    let (scale, length) = match direction {
        Direction::X => (&frame.x, r.width()),
        Direction::Y => (&frame.y, r.height()),
    };
    // A bound that the axis cannot show lies beyond its lower or its upper end.
    let (low, high) = scale.bounds();
    let from =
        scale.place(*from).unwrap_or_else(|| scale.place_measured(if *from > 0.0 { high } else { low }));
    let to = scale.place(*to).unwrap_or_else(|| scale.place_measured(if *to > 0.0 { high } else { low }));
    let (from, to) = (from.min(to).clamp(0.0, 1.0) * length, from.max(to).clamp(0.0, 1.0) * length);
    (to > from).then_some(match direction {
        Direction::X => Rect { left: r.left + from, right: r.left + to, ..r },
        Direction::Y => Rect { top: r.bottom - to, bottom: r.bottom - from, ..r },
    })
}

pub(super) fn tile(frame: &Frame, layer: &Layer) -> Option<Rect> {
    let Shape::Tile(from, to) = &layer.shape else {
        return None;
    };
    let (from, to) = (frame.spot(*from)?, frame.spot(*to)?);
    Some(Rect {
        left: from.0.min(to.0),
        right: from.0.max(to.0),
        top: from.1.min(to.1),
        bottom: from.1.max(to.1),
    })
}

/// Draws a layer inside the clipped frame and notes what it covers.
pub(super) fn draw(canvas: &mut Canvas, frame: &Frame, layer: &Layer, taken: &mut Taken) {
    let colour = layer.colour.rgb();
    match &layer.shape {
        Shape::Line(points) => {
            let pieces = pieces(points.iter().map(|point| frame.spot(*point)));
            // A piece of one point would not show as a line.
            let (alone, pieces): (Vec<_>, Vec<_>) = pieces.into_iter().partition(|piece| piece.len() == 1);
            draw_lines(
                canvas,
                &pieces,
                Stroke { colour, width: LINE * layer.weight, dash: layer.dash },
                frame,
                taken,
            );
            let alone: Vec<Spot> = alone.into_iter().flatten().collect();
            alone.iter().for_each(|spot| taken.dot(*spot));
            canvas.circles(&alone, LINE * layer.weight, colour);
        }
        Shape::Band(points, along) => {
            let across = along.other();
            let edges = points.iter().map(|&(x, low, high)| {
                let (x, high) = (frame.on(*along, x)?, frame.on(across, high)?);
                let low = frame.on(across, low).or((low <= 0.0).then_some(frame.start(across)))?;
                Some((x, low, high))
            });
            let mut outlines: Vec<Vec<Spot>> = Vec::new();
            for piece in pieces(edges) {
                let lower: Vec<Spot> = piece.iter().map(|edge| along.turn((edge.0, edge.1))).collect();
                let upper: Vec<Spot> = piece.iter().map(|edge| along.turn((edge.0, edge.2))).collect();
                taken.area(&lower, &upper, &frame.rect);
                let back = thin(&lower, TOLERANCE).into_iter().rev();
                outlines.push(thin(&upper, TOLERANCE).into_iter().chain(back).collect());
            }
            canvas.polygons(outlines.iter().map(Vec::as_slice), colour, layer.opacity);
        }
        Shape::Bars(bins, along) => draw_bars(canvas, frame, layer, (bins, *along), taken),
        Shape::Level(..) | Shape::Slope { .. } => {
            let lines = reference(frame, layer);
            draw_lines(canvas, &lines, Stroke { colour, width: REFERENCE, dash: layer.dash }, frame, taken);
        }
        Shape::Raster(raster) if [frame.x.spread, frame.y.spread] == [Spread::Linear; 2] => {
            draw_raster(canvas, frame, raster, taken);
        }
        Shape::Frames(frames) if [frame.x.spread, frame.y.spread] == [Spread::Linear; 2] => {
            frames.draw(canvas, frame, layer);
        }
        Shape::Raster(_) | Shape::Frames(_) => {}
        Shape::Tile(..) => {
            if let Some(rect) = tile(frame, layer) {
                canvas.rect(&rect, colour, layer.opacity);
            }
        }
        // Markers may stand on the frame and regions lie below: both are drawn outside the clip.
        Shape::Points(..) | Shape::Region(..) | Shape::Note(_) => {}
    }
}

/// Draws markers, which are shown whole also on the frame itself.
pub(super) fn draw_markers(canvas: &mut Canvas, frame: &Frame, layer: &Layer, taken: &mut Taken) {
    let Shape::Points(points, marker) = &layer.shape else {
        return;
    };
    let within = frame.rect.grown(0.5);
    let spots = points.iter().filter_map(|point| frame.spot(*point)).filter(|spot| within.holds(*spot));
    let spots = spread_out(spots.collect());
    spots.iter().for_each(|spot| taken.dot(*spot));
    markers(canvas, &spots, *marker, layer);
}

/// A sample of a layer for the legend.
pub(super) fn draw_key(canvas: &mut Canvas, layer: &Layer, key: &Rect) {
    let colour = layer.colour.rgb();
    let middle = ((key.left + key.right) / 2.0, (key.top + key.bottom) / 2.0);
    match &layer.shape {
        Shape::Line(_) | Shape::Level(..) | Shape::Slope { .. } => {
            let width = if matches!(layer.shape, Shape::Line(_)) { LINE * layer.weight } else { REFERENCE };
            let line = [(key.left, middle.1), (key.right, middle.1)];
            canvas.lines([line.as_slice()], Stroke { colour, width, dash: layer.dash });
        }
        Shape::Points(_, marker) => markers(canvas, &[middle], *marker, layer),
        Shape::Raster(raster) => canvas.rect(key, raster.map.rgb(0.75), layer.opacity),
        Shape::Band(..) | Shape::Bars(..) | Shape::Region(..) | Shape::Tile(..) | Shape::Frames(_) => {
            canvas.rect(key, colour, layer.opacity);
        }
        Shape::Note(_) => {}
    }
}

/// The line of a reference across the frame.
pub(super) fn reference(frame: &Frame, layer: &Layer) -> Vec<Vec<Spot>> {
    let r = frame.rect;
    let line = match &layer.shape {
        Shape::Level(Direction::X, x) => frame.x(*x).map(|x| vec![(x, r.top), (x, r.bottom)]),
        Shape::Level(Direction::Y, y) => frame.y(*y).map(|y| vec![(r.left, y), (r.right, y)]),
        Shape::Slope { through, slope } => slope_line(frame, *through, *slope),
        _ => None,
    };
    line.into_iter().collect()
}

/// Straight in the measures of both axes; where these differ from the values' own, so is the law.
fn slope_line(frame: &Frame, through: (f64, f64), slope: f64) -> Option<Vec<Spot>> {
    let x0 = crate::ticks::measure(frame.x.spread, through.0)?;
    let y0 = crate::ticks::measure(frame.y.spread, through.1)?;
    let at = |x: f64| frame.rect.bottom - frame.y.place_measured(y0 + slope * (x - x0)) * frame.rect.height();
    let ends = [(frame.rect.left, at(frame.x.from)), (frame.rect.right, at(frame.x.to))];
    ends.iter().all(|end| end.1.is_finite()).then(|| ends.to_vec())
}

fn draw_lines(canvas: &mut Canvas, lines: &[Vec<Spot>], stroke: Stroke, frame: &Frame, taken: &mut Taken) {
    // A line's own width reaches into the frame from outside.
    let near = frame.rect.grown(10.0);
    let parts: Vec<Vec<Spot>> = lines.iter().flat_map(|line| clip(line, &near)).collect();
    for part in &parts {
        taken.line(part, &frame.rect);
    }
    let thinned: Vec<Vec<Spot>> = parts.iter().map(|part| thin(part, TOLERANCE)).collect();
    canvas.lines(thinned.iter().map(Vec::as_slice), stroke);
}

fn draw_bars(
    canvas: &mut Canvas,
    frame: &Frame,
    layer: &Layer,
    (bins, along): (&[(f64, f64, f64)], Direction),
    taken: &mut Taken,
) {
    let across = along.other();
    let floor = frame.on(across, 0.0).unwrap_or(frame.start(across));
    let mut outlines = Vec::new();
    for &(from, to, height) in bins {
        let (Some(left), Some(right), Some(top)) =
            (frame.on(along, from), frame.on(along, to), frame.on(across, height))
        else {
            continue;
        };
        let [first, second, third, last] =
            [(left, floor), (left, top), (right, top), (right, floor)].map(|corner| along.turn(corner));
        // An area is taken between edges one above the other.
        match along {
            Direction::X => taken.area(&[first, last], &[second, third], &frame.rect),
            Direction::Y => taken.area(&[first, second], &[last, third], &frame.rect),
        }
        outlines.push([first, second, third, last]);
    }
    canvas.polygons(outlines.iter().map(|o| o.as_slice()), layer.colour.rgb(), layer.opacity);
    canvas.lines(outlines.iter().map(|o| o.as_slice()), Stroke::solid(layer.colour.rgb(), 0.7));
}

/// Draws a field with about as many cells as the page has pixels for it.
fn draw_raster(canvas: &mut Canvas, frame: &Frame, raster: &Raster, taken: &mut Taken) {
    let (Some(from), Some(to)) = (frame.spot((raster.x.0, raster.y.0)), frame.spot((raster.x.1, raster.y.1)))
    else {
        return;
    };
    let place = Rect {
        left: from.0.min(to.0),
        top: from.1.min(to.1),
        right: from.0.max(to.0),
        bottom: from.1.max(to.1),
    };
    if !(place.width() > 0.0 && place.height() > 0.0) {
        return;
    }
    let shown = raster.reduced_to(place.width().ceil() as usize, place.height().ceil() as usize);
    // Limits come from the values as they are, not from their means: the colour bar does too.
    let Some(scale) = raster.scale() else {
        return;
    };
    let size = (place.width(), place.height());
    if let Some(image) = shown.image(&scale, (to.0 < from.0, to.1 > from.1), size) {
        canvas.image(&place, &image);
    }
    let coarse = shown.reduced_to((place.width() / PITCH) as usize, (place.height() / PITCH) as usize);
    let (width, height) = ((to.0 - from.0) / coarse.columns as f64, (to.1 - from.1) / coarse.rows as f64);
    for (k, value) in coarse.values.iter().enumerate() {
        let (column, row) = ((k % coarse.columns) as f64 + 0.5, (k / coarse.columns) as f64 + 0.5);
        if scale.place(*value).is_some() {
            taken.dot((from.0 + column * width, from.1 + row * height));
        }
    }
}

/// Unbroken runs of what can be shown.
fn pieces<T>(items: impl Iterator<Item = Option<T>>) -> Vec<Vec<T>> {
    let mut pieces = vec![Vec::new()];
    for item in items {
        match (item, pieces.last_mut()) {
            (Some(item), Some(piece)) => piece.push(item),
            (None, Some(piece)) if !piece.is_empty() => pieces.push(Vec::new()),
            _ => {}
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// One marker a cell of the page, in cells just large enough that few are left.
fn spread_out(spots: Vec<Spot>) -> Vec<Spot> {
    let mut cell = 1.0;
    loop {
        let mut seen = HashSet::new();
        let kept: Vec<Spot> = spots
            .iter()
            .filter(|spot| seen.insert(((spot.0 / cell).round() as i64, (spot.1 / cell).round() as i64)))
            .copied()
            .collect();
        if kept.len() <= MOST_MARKERS {
            return kept;
        }
        cell *= 1.2;
    }
}

fn markers(canvas: &mut Canvas, spots: &[Spot], marker: Marker, layer: &Layer) {
    let colour = layer.colour.rgb();
    let outline = |spot: &Spot, corners: &[(f64, f64)]| -> Vec<Spot> {
        corners.iter().map(|corner| (spot.0 + RADIUS * corner.0, spot.1 + RADIUS * corner.1)).collect()
    };
    let outlines =
        |corners: &[(f64, f64)]| spots.iter().map(|spot| outline(spot, corners)).collect::<Vec<_>>();
    match marker {
        Marker::Circle => canvas.circles(spots, RADIUS, colour),
        Marker::Ring => canvas.rings(spots, RING, colour),
        Marker::Square => {
            let squares = outlines(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]);
            canvas.polygons(squares.iter().map(Vec::as_slice), colour, 1.0);
        }
        Marker::Triangle => {
            let triangles = outlines(&[(-1.1, 0.85), (1.1, 0.85), (0.0, -1.15)]);
            canvas.polygons(triangles.iter().map(Vec::as_slice), colour, 1.0);
        }
        Marker::Cross => {
            // In one go, through the middle once more.
            let crosses = outlines(&[(-0.9, -0.9), (0.9, 0.9), (0.0, 0.0), (-0.9, 0.9), (0.9, -0.9)]);
            canvas.lines(crosses.iter().map(Vec::as_slice), Stroke { colour, width: 1.6, dash: Dash::Solid });
        }
    }
}

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

/// No line needs more points than this.
const MOST: usize = 1500;

/// Leaves out points that lie within `tolerance` of the line through the rest, doubling the
/// tolerance until the line is short enough; first and last stay.
pub(super) fn thin(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let mut kept = simplify(&by_column(points, tolerance), tolerance);
    let mut tolerance = tolerance;
    while kept.len() > MOST && tolerance < 1e3 {
        tolerance *= 2.0;
        kept = simplify(&kept, tolerance);
    }
    kept
}

/// Of each run of points in one column keeps first, lowest, highest and last, in their order.
fn by_column(points: &[(f64, f64)], width: f64) -> Vec<(f64, f64)> {
    let mut kept = Vec::new();
    for run in points.chunk_by(|a, b| (a.0 / width).floor() == (b.0 / width).floor()) {
        let least = (0..run.len()).min_by(|a, b| run[*a].1.total_cmp(&run[*b].1)).unwrap_or(0);
        let most = (0..run.len()).max_by(|a, b| run[*a].1.total_cmp(&run[*b].1)).unwrap_or(0);
        let mut places = [0, least, most, run.len() - 1];
        places.sort_unstable();
        for (k, place) in places.iter().enumerate() {
            if k == 0 || places[k - 1] != *place {
                kept.push(run[*place]);
            }
        }
    }
    kept
}

/// Ramer, Douglas and Peucker: keep the point farthest from the chord while it is too far.
fn simplify(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let Some(last) = points.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[last] = true;
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let mut farthest = (tolerance, None);
        for place in from + 1..to {
            let distance = from_chord(points[place], points[from], points[to]);
            if distance > farthest.0 {
                farthest = (distance, Some(place));
            }
        }
        if let Some(place) = farthest.1 {
            keep[place] = true;
            spans.extend([(from, place), (place, to)]);
        }
    }
    points.iter().zip(keep).filter_map(|(point, keep)| keep.then_some(*point)).collect()
}

fn from_chord(point: (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let (along, across) = (to.0 - from.0, to.1 - from.1);
    let (dx, dy) = (point.0 - from.0, point.1 - from.1);
    let length2 = along * along + across * across;
    let part = if length2 > 0.0 { ((dx * along + dy * across) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (dx - part * along).hypot(dy - part * across)
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
        let twice = clip(&[(1.0, 1.0), (2.0, 2.0), (5.0, -4.0), (8.0, 2.0), (9.0, 1.0)], &rect);
        assert_eq!(twice.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    }

    #[test]
    fn a_straight_line_needs_its_ends() {
        let line: Vec<_> = (0..1000).map(|k| (k as f64, 2.0 * k as f64)).collect();
        assert_eq!(thin(&line, 0.1), [line[0], line[999]]);
        assert!(thin(&[], 0.1).is_empty());
        assert_eq!(thin(&[(1.0, 1.0)], 0.1).len(), 1);
    }

    #[test]
    fn every_point_stays_near_the_thinned_line() {
        let curve: Vec<_> = (0..5000).map(|k| (k as f64 * 0.1, 100.0 * (k as f64 * 0.01).sin())).collect();
        let thinned = thin(&curve, 0.2);
        assert!(thinned.len() < 500, "{}", thinned.len());
        for point in &curve {
            let near =
                thinned.windows(2).map(|w| from_chord(*point, w[0], w[1])).fold(f64::INFINITY, f64::min);
            assert!(near <= 0.5, "{near}");
        }
    }

    #[test]
    fn a_spike_survives_and_noise_is_bounded() {
        let mut line: Vec<_> = (0..100_000).map(|k| (k as f64 * 0.01, 0.0)).collect();
        line[50_000].1 = 80.0;
        assert!(thin(&line, 0.2).contains(&line[50_000]));
        let noise: Vec<_> =
            (0..100_000u64).map(|k| (k as f64 * 0.02, (k * 2_654_435_761 % 1000) as f64)).collect();
        assert!(thin(&noise, 0.2).len() <= 2 * MOST);
    }
}
