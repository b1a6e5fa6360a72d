//! Elements of SVG, written by plotters into text.
//!
//! Plotters rounds to whole units, so a unit here is a third of a CSS pixel. Each group of elements
//! is written by a backend of its own; what the elements have in common is then said once, for the
//! group, and so is what plotters has no word for: dashes, clipping, joints of lines.

use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle};

use super::layer::Dash;
use super::style::{Size, dark_rules_of};
use super::text;

const UNITS: f64 = 3.0;

/// A place on the page in CSS pixels, y downwards.
pub(super) type Spot = (f64, f64);

/// An upright rectangle in CSS pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Rect {
    pub(super) fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self { left, top, right: left + width, bottom: top + height }
    }

    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Round the rectangle and back to where it began.
    pub(super) fn outline(&self) -> [Spot; 5] {
        let Self { left, top, right, bottom } = *self;
        [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)]
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }

    pub(super) fn holds(&self, spot: Spot) -> bool {
        (self.left..=self.right).contains(&spot.0) && (self.top..=self.bottom).contains(&spot.1)
    }

    /// Moved as little as needed to lie inside another, if it is small enough.
    pub(super) fn moved_into(&self, other: &Self) -> Self {
        let left = self.left.min(other.right - self.width()).max(other.left);
        let top = self.top.min(other.bottom - self.height()).max(other.top);
        Self::new(left, top, self.width(), self.height())
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }
}

/// How lines are drawn; the width is in CSS pixels.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: RGBColor,
    pub(super) width: f64,
    pub(super) dash: Dash,
}

impl Stroke {
    pub(super) fn solid(colour: RGBColor, width: f64) -> Self {
        Self { colour, width, dash: Dash::Solid }
    }
}

/// Alignment of a text at its position.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

/// How a text is set.
#[derive(Clone, Copy)]
pub(super) struct Type {
    pub(super) size: f64,
    pub(super) colour: RGBColor,
    pub(super) align: Align,
    pub(super) bold: bool,
    /// Reads upwards.
    pub(super) upright: bool,
}

/// Collects the elements of one picture.
#[derive(Default)]
pub(super) struct Canvas {
    body: String,
    /// The tag that opened the last group, if another one may continue it.
    opening: String,
}

impl Canvas {
    pub(super) fn lines<'a>(&mut self, lines: impl IntoIterator<Item = &'a [Spot]>, stroke: Stroke) {
        let style = style(stroke.colour, stroke.width);
        let w = style.stroke_width;
        let elements = written(|svg| {
            for line in lines {
                // Writing into a String cannot fail; the same holds below.
                svg.draw_path(line.iter().map(|spot| units(*spot)), &style).ok();
            }
        });
        // One path is shorter than an element for each line, of which grids and ticks have hundreds.
        let path = relative_path(&elements);
        if path.is_empty() {
            return;
        }
        let dashes = match stroke.dash {
            Dash::Solid => String::new(),
            Dash::Dashed => format!(" stroke-dasharray=\"{} {}\"", 4 * w, 5 * w / 2),
            Dash::DashDot => format!(" stroke-dasharray=\"{} {} {} {}\"", 5 * w, 2 * w, w, 2 * w),
            Dash::Dotted => format!(" stroke-dasharray=\"0 {}\" stroke-linecap=\"round\"", 2 * w),
        };
        let colour = hex(stroke.colour);
        self.body.push_str(&format!(
            "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{w}\"{dashes} d=\"{path}\"/>\n"
        ));
    }

    pub(super) fn polygons<'a>(
        &mut self,
        outlines: impl IntoIterator<Item = &'a [Spot]>,
        colour: RGBColor,
        opacity: f64,
    ) {
        let elements = written(|svg| {
            for outline in outlines {
                svg.fill_polygon(outline.iter().map(|spot| units(*spot)), &colour).ok();
            }
        });
        self.group(&[("fill", hex(colour))], &opacity_attribute(opacity), &elements);
    }

    pub(super) fn rect(&mut self, rect: &Rect, colour: RGBColor, opacity: f64) {
        let (from, to) = (units((rect.left, rect.top)), units((rect.right, rect.bottom)));
        let elements = written(|svg| {
            svg.draw_rect(from, to, &colour, true).ok();
        });
        let common = [("fill", hex(colour)), ("stroke", "none".into())];
        self.group(&common, &opacity_attribute(opacity), &elements);
    }

    pub(super) fn circles(&mut self, centres: &[Spot], radius: f64, colour: RGBColor) {
        let radius = (radius * UNITS).round().max(1.0) as u32;
        let elements = written(|svg| {
            for centre in centres {
                svg.draw_circle(units(*centre), radius, &colour, true).ok();
            }
        });
        let common = [("fill", hex(colour)), ("stroke", "none".into()), ("stroke-width", "1".into())];
        self.group(&common, "", &elements);
    }

    /// Open circles.
    pub(super) fn rings(&mut self, centres: &[Spot], radius: f64, colour: RGBColor) {
        const WIDTH: f64 = 2.2;
        let style = style(colour, WIDTH);
        let radius = (radius * UNITS).round().max(1.0) as u32;
        let elements = written(|svg| {
            for centre in centres {
                svg.draw_circle(units(*centre), radius, &style, false).ok();
            }
        });
        let width = style.stroke_width.to_string();
        let common = [("fill", "none".into()), ("stroke", hex(colour)), ("stroke-width", width)];
        self.group(&common, "", &elements);
    }

    /// Sets texts with the middle of their capitals at their places.
    pub(super) fn texts<'a>(&mut self, texts: impl IntoIterator<Item = (&'a str, Spot)>, set: Type) {
        let anchor = match set.align {
            Align::Left => HPos::Left,
            Align::Centre => HPos::Center,
            Align::Right => HPos::Right,
        };
        let slant = if set.bold { FontStyle::Bold } else { FontStyle::Normal };
        // Plotters writes a 1.24th of the size that it is given.
        let given = set.size * UNITS * 1.24;
        let style = TextStyle::from((FontFamily::SansSerif, given, slant))
            .pos(Pos::new(anchor, VPos::Top))
            .color(&set.colour)
            .transform(if set.upright { FontTransform::Rotate270 } else { FontTransform::None });
        let size = format!(" font-size=\"{}\"", given / 1.24);
        let subscript =
            format!("<tspan dy=\"0.28em\" font-size=\"{}\">", (set.size * UNITS * text::SMALL).round());
        let after = format!("<tspan dy=\"-{:.3}em\">", 0.28 * text::SMALL);
        let baseline = 0.36 * set.size;
        let elements = written(|svg| {
            for (text, (x, y)) in texts {
                let spot = if set.upright { (x + baseline, y) } else { (x, y + baseline) };
                svg.draw_text(&marked(&printable(text)), &style, units(spot)).ok();
            }
        });
        // The line that the text stands on is placed above, for all fonts alike.
        let elements = elements.replace(" dy=\"0.76em\"", "").replace(" font-family=\"sans-serif\"", "");
        let elements = elements.replace(&size, "").replace(" text-anchor=\"start\"", "");
        let elements =
            elements.replace(SUBSCRIPT, &subscript).replace(AFTER, &after).replace(END, "</tspan>");
        let extra = format!(" font-size=\"{}\"", (set.size * UNITS).round());
        self.group(&[("fill", hex(set.colour))], &extra, &elements);
    }

    /// An image by its data URI, drawn out to the rectangle.
    pub(super) fn image(&mut self, rect: &Rect, uri: &str) {
        // Plotters would decode the image; and a field may reach farther than its units do.
        let [left, top, width, height] =
            [rect.left, rect.top, rect.width(), rect.height()].map(|pixels| (pixels * UNITS).round());
        self.body.push_str(&format!(
            "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"{uri}\"/>\n"
        ));
    }

    /// Elements in the units of axes whose 0 lies at `origin` and whose 1 at `unit`.
    pub(super) fn scaled_group(
        &mut self,
        class: &str,
        origin: Spot,
        unit: Spot,
        colour: RGBColor,
        elements: &str,
    ) {
        let [x, y] = [origin.0, origin.1].map(|at| at * UNITS);
        let [across, up] = [unit.0 - origin.0, unit.1 - origin.1].map(|length| length * UNITS);
        self.body.push_str(&format!(
            "<g class=\"{class}\" transform=\"matrix({across:.6} 0 0 {up:.6} {x:.2} {y:.2})\" fill=\"{}\">{elements}</g>\n",
            hex(colour)
        ));
        self.opening.clear();
    }

    /// Marks what `draw` puts down, for scripts.
    pub(super) fn marked(&mut self, class: &str, draw: impl FnOnce(&mut Self)) {
        self.body.push_str(&format!("<g class=\"{class}\">\n"));
        draw(self);
        self.body.push_str(END_OF_GROUP);
        self.opening.clear();
    }

    /// What `draw` puts down shows inside `rect` only.
    pub(super) fn clipped(&mut self, rect: &Rect, draw: impl FnOnce(&mut Self)) {
        // A picture in the picture cuts off what is outside, and needs no id that another might have.
        let (left, top) = units((rect.left, rect.top));
        let (right, bottom) = units((rect.right, rect.bottom));
        let (width, height) = (right - left, bottom - top);
        self.body.push_str(&format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"{left} {top} {width} {height}\">\n"
        ));
        draw(self);
        self.body.push_str("</svg>\n");
    }

    /// The whole picture on white, `width` by `height` CSS pixels, or `print` wide. A file has rules for a dark environment; a page
    /// has those of all its figures.
    pub(super) fn finish(
        self,
        title: &str,
        (width, height): (f64, f64),
        print: Option<Size>,
        is_file: bool,
    ) -> String {
        let (right, bottom) = units((width, height));
        let size = match print {
            None => format!("width=\"{width:.0}\" height=\"{height:.0}\""),
            Some(size) => {
                format!("width=\"{}mm\" height=\"{:.2}mm\"", size.width(), size.width() * height / width)
            }
        };
        let mut escaped = String::with_capacity(title.len());
        for c in printable(title).chars() {
            match c {
                '<' => escaped.push_str("&lt;"),
                '>' => escaped.push_str("&gt;"),
                '&' => escaped.push_str("&amp;"),
                other => escaped.push(other),
            }
        }
        let paper = format!("<rect width=\"{right}\" height=\"{bottom}\" fill=\"#FFFFFF\"/>\n");
        let body = paper + &self.body;
        let rules =
            if is_file { format!("<style>{}</style>\n", dark_rules_of(&body)) } else { String::new() };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" {size} \
             viewBox=\"0 0 {right} {bottom}\" stroke-linejoin=\"round\" font-family=\"{}\">\n<title>{escaped}</title>\n{rules}\
             {body}</svg>\n",
            text::FAMILY
        )
    }

    /// Says once what all elements share, also with those of the group before.
    fn group(&mut self, common: &[(&str, String)], extra: &str, elements: &str) {
        if elements.is_empty() {
            return;
        }
        let mut elements = elements.replace(" opacity=\"1\"", "").replace(" \"/>", "\"/>");
        let mut opening = "<g".to_owned();
        for (key, value) in common {
            let said = format!(" {key}=\"{value}\"");
            elements = elements.replace(&said, "");
            opening.push_str(&said);
        }
        opening = format!("{opening}{extra}>\n").replace(" stroke=\"none\"", "");
        match self.body.strip_suffix(END_OF_GROUP) {
            Some(body) if self.opening == opening => self.body.truncate(body.len()),
            _ => self.body.push_str(&opening),
        }
        self.body.push_str(&elements);
        self.body.push_str(END_OF_GROUP);
        // Where translucent shapes of two groups overlap, both are seen.
        self.opening = if opening.contains(" opacity=") { String::new() } else { opening };
    }
}

fn opacity_attribute(opacity: f64) -> String {
    if opacity == 1.0 { String::new() } else { format!(" opacity=\"{opacity}\"") }
}

const END_OF_GROUP: &str = "</g>\n";

/// The polylines of plotters as the data of one path, each point relative to the one before.
fn relative_path(polylines: &str) -> String {
    let mut path = String::new();
    let mut last = (0, 0);
    for line in polylines.split("points=\"").skip(1) {
        let points = line.split('"').next().unwrap_or_default().split_whitespace();
        let points = points.filter_map(|point| {
            let (x, y) = point.split_once(',')?;
            Some((x.parse::<i32>().ok()?, y.parse::<i32>().ok()?))
        });
        for (place, at) in points.enumerate() {
            path.push(if place == 0 { 'm' } else { ' ' });
            path.push_str(&format!("{},{}", at.0 - last.0, at.1 - last.1));
            last = at;
        }
    }
    path.replace(" -", "-").replace(",-", "-")
}

/// The elements that plotters writes, without the frame around them.
fn written(draw: impl FnOnce(&mut SVGBackend<'_>)) -> String {
    let mut svg = String::new();
    draw(&mut SVGBackend::with_string(&mut svg, (1, 1)));
    let inside = svg.split_once(">\n").map_or("", |(_, rest)| rest);
    inside.strip_suffix("</svg>\n").unwrap_or(inside).to_owned()
}

fn style(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width((width * UNITS).round().max(1.0) as u32)
}

fn units(spot: Spot) -> (i32, i32) {
    // Far outside any page, near enough for every viewer.
    let unit = |pixels: f64| (pixels * UNITS).round().clamp(-30_000.0, 30_000.0) as i32;
    (unit(spot.0), unit(spot.1))
}

fn hex(colour: RGBColor) -> String {
    format!("#{:02X}{:02X}{:02X}", colour.0, colour.1, colour.2)
}

/// Where a subscript begins, what follows it begins, and either ends, until they are elements: plotters escapes those.
const SUBSCRIPT: char = '\u{e000}';
const AFTER: char = '\u{e001}';
const END: char = '\u{e002}';

fn marked(text: &str) -> String {
    let mut marked = String::with_capacity(text.len());
    let mut is_lowered = false;
    for (part, is_subscript) in text::parts(text) {
        let begin = if is_subscript { Some(SUBSCRIPT) } else { is_lowered.then_some(AFTER) };
        marked.extend(begin);
        marked.push_str(part);
        marked.extend(begin.map(|_| END));
        is_lowered = is_subscript;
    }
    marked
}

/// Characters that XML forbids become blanks.
fn printable(text: &str) -> String {
    text.chars()
        .map(|c| {
            if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}' | '\u{e000}'..='\u{e002}') {
                ' '
            } else {
                c
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: RGBColor = RGBColor(0, 0, 0);

    #[test]
    fn equal_groups_are_one_unless_they_are_translucent() {
        let groups = |opacity: f64| {
            let mut canvas = Canvas::default();
            for left in [0.0, 1.0] {
                let corners = [(left, 0.0), (left + 2.0, 0.0), (left, 2.0)];
                canvas.polygons([&corners[..]], BLACK, opacity);
            }
            canvas.body.matches("<g ").count()
        };
        assert_eq!([groups(1.0), groups(0.5)], [1, 2]);
    }
}
