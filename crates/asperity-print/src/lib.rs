//! Figures for papers: SVG text to PDF, whose text stays text, and to PNG.
//!
//! Text is set in DejaVu Sans, which comes with the program: the same figure gives the same bytes on every machine.
#![deny(unsafe_code)]
#![warn(missing_docs)]

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use svg2pdf::usvg::fontdb::{Database, Source};
use svg2pdf::usvg::{Options, Tree};
use svg2pdf::{ConversionOptions, PageOptions};

/// Pixels along a side of a picture.
const MOST_PIXELS: u32 = 1 << 14;

/// Resolution of a length in an SVG, per inch.
const SVG_DPI: f32 = 96.0;

/// A figure that cannot be converted.
#[derive(Debug, thiserror::Error)]
pub enum PrintError {
    /// Text that is no SVG.
    #[error("is no SVG: {0}")]
    Svg(#[from] svg2pdf::usvg::Error),
    /// A picture without extent, or a large one.
    #[error("a picture of {0} x {1} pixels cannot be made")]
    Extent(u32, u32),
    /// What the encoder of PNG refuses.
    #[error("a PNG cannot be written: {0}")]
    Png(#[from] png::EncodingError),
    /// What the writer of PDF refuses.
    #[error("a PDF cannot be written: {0}")]
    Pdf(String),
}

/// The fonts of all figures.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for face in [dejavu::sans::regular(), dejavu::sans::bold()] {
        fonts.load_font_source(Source::Binary(Arc::new(face)));
    }
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

fn tree(svg: &str) -> Result<Tree, PrintError> {
    let options =
        Options { fontdb: FONTS.clone(), font_family: "DejaVu Sans".to_owned(), ..Options::default() };
    Ok(Tree::from_str(svg, &options)?)
}

/// The files of a figure beside its SVG, by the endings of their names: a PDF, and a PNG of 300 pixels per inch, as journals ask for.
///
/// # Errors
/// Text that is no SVG.
pub fn files(svg: &str) -> Result<Vec<(&'static str, Vec<u8>)>, PrintError> {
    const JOURNAL_DPI: f32 = 300.0;
    Ok(vec![("pdf", pdf(svg)?), ("png", png(svg, JOURNAL_DPI)?)])
}

/// A PDF of one page, as large as the figure.
///
/// # Errors
/// Text that is no SVG.
pub fn pdf(svg: &str) -> Result<Vec<u8>, PrintError> {
    let page = PageOptions { dpi: SVG_DPI };
    svg2pdf::to_pdf(&tree(svg)?, ConversionOptions::default(), page)
        .map_err(|error| PrintError::Pdf(error.to_string()))
}

/// A PNG on white, with `dpi` pixels per inch of the figure's size.
///
/// # Errors
/// Text that is no SVG, or a picture of more than 16384 pixels along a side.
pub fn png(svg: &str, dpi: f32) -> Result<Vec<u8>, PrintError> {
    let tree = tree(svg)?;
    let scale = dpi / SVG_DPI;
    let pixels = |length: f32| (length * scale).ceil() as u32;
    let (width, height) = (pixels(tree.size().width()), pixels(tree.size().height()));
    let fits = (1..=MOST_PIXELS).contains(&width) && (1..=MOST_PIXELS).contains(&height);
    let mut picture =
        fits.then(|| Pixmap::new(width, height)).flatten().ok_or(PrintError::Extent(width, height))?;
    picture.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
    encode(&picture, dpi)
}

/// The picture without its opaque alpha, with its resolution.
fn encode(picture: &Pixmap, dpi: f32) -> Result<Vec<u8>, PrintError> {
    const INCHES_PER_METRE: f32 = 1.0 / 0.0254;
    let colours: Vec<u8> =
        picture.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    let per_metre = (dpi * INCHES_PER_METRE).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&colours)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="85mm" height="40mm" viewBox="0 0 850 400"
        font-family="Helvetica, Arial, sans-serif"><rect x="0" y="0" width="425" height="400" fill="#0072B2"/>
        <text x="450" y="200" font-size="60">A/σ ≤ 10⁻³</text></svg>"##;

    #[test]
    fn a_pdf_has_the_size_and_its_font() {
        let pdf = pdf(SVG).unwrap();
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.starts_with("%PDF-"));
        // 85 mm and 40 mm in points.
        let page = text.split("/MediaBox").nth(1).unwrap();
        let corner: Vec<f64> =
            page.split(['[', ']']).nth(1).unwrap().split_whitespace().map(|n| n.parse().unwrap()).collect();
        assert!((corner[2] - 240.94).abs() < 0.1 && (corner[3] - 113.39).abs() < 0.1, "{corner:?}");
        assert!(text.contains("DejaVuSans"));
        assert_eq!(pdf, super::pdf(SVG).unwrap());
    }

    #[test]
    fn a_png_shows_the_figure_at_its_resolution() {
        let file = png(SVG, 300.0).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert!(info.width.abs_diff(1004) <= 1 && info.height.abs_diff(473) <= 1, "{info:?}");
        assert_eq!(reader.info().pixel_dims.unwrap().xppu, 11811);
        let at = |x: usize, y: usize| &pixels[3 * (y * info.width as usize + x)..][..3];
        assert_eq!(at(100, 100), [0x00, 0x72, 0xB2]);
        assert_eq!(at(1000, 10), [255; 3]);
        // Text is drawn.
        let dark =
            (520..1000).flat_map(|x| (150..260).map(move |y| (x, y))).filter(|&(x, y)| at(x, y)[0] < 100);
        assert!(dark.count() > 1000);
    }

    #[test]
    fn figures_of_a_report_are_converted() {
        let report = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/measured-fine-finish");
        for name in ["fine-finish-models.svg", "fine-finish-contact-map.svg"] {
            let svg = std::fs::read_to_string(std::path::Path::new(report).join(name)).unwrap();
            let [(pdf_ending, pdf), (png_ending, png)] = files(&svg).unwrap().try_into().unwrap();
            assert_eq!([pdf_ending, png_ending], ["pdf", "png"]);
            assert!(
                pdf.starts_with(b"%PDF-") && String::from_utf8_lossy(&pdf).contains("DejaVuSans"),
                "{name}"
            );
            let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
            assert_eq!(reader.info().pixel_dims.unwrap().xppu, 11811, "{name}: 300 per inch");
        }
    }

    #[test]
    fn what_is_no_figure_is_refused() {
        assert!(matches!(pdf("<svg"), Err(PrintError::Svg(_))));
        assert!(matches!(png(SVG, 1e7), Err(PrintError::Extent(..))));
    }
}
