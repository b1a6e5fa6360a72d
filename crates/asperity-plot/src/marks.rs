//! The layers on the page.

use std::collections::HashSet;

use super::axes::Frame;
use super::canvas::{Canvas, Rect, Spot, Stroke};
use super::clip::clip;
use super::layer::{Dash, Direction, Layer, Marker, Shape};
use super::place::{PITCH, Taken};
use super::style::{LINE, REFERENCE};
use super::thin::thin;
use super::{Raster, Spread};

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

/// A tile on the page.
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
    let x0 = super::scale::measure(frame.x.spread, through.0)?;
    let y0 = super::scale::measure(frame.y.spread, through.1)?;
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
