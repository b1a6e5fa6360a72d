//! A report page in two formats.
//!
//! A [`Page`] is a list of blocks. Its Markdown is what people read in the repository, with pictures
//! beside it; its HTML is the same content in one file that needs nothing else. Names come from
//! users: plain text is escaped here, and no text can bring markup of its own into the HTML.

mod html;
mod markdown;

use asperity_plot::{Figure, Size};
pub use html::{CHART_STYLE, chart_scripts, charts, document, escape as escape_html, page_style, with_minus};
use markdown::{address, cell_markdown, is_numeric, line_of, one_line};
pub use markdown::{escape, escape_around_code};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::value::RawValue;

use super::answer::{Answer, CardLine};
use super::view::{View, ViewText};
use crate::remedy::FrontEnd;

/// One cell of a table: plain text, with code in it or not, or a link.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Text as it is; nothing in it is markup.
    Text(String),
    /// The same, except that text between backticks is code.
    AroundCode(String),
    /// Text that leads to a relative address or a web page.
    Link { text: String, to: String },
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::Text(text.into())
    }
}

#[derive(Clone, Debug)]
enum Block {
    Title(String),
    Heading {
        level: u8,
        text: String,
    },
    /// What a reader should know first.
    Lead(String),
    Card(Vec<CardLine>),
    /// Any block whose HTML follows from its Markdown.
    Markdown(String),
    /// A table, with the places of the columns whose cells are verdicts.
    Table {
        markdown: String,
        verdicts: Vec<usize>,
    },
    Figure {
        file: String,
        figure: Box<Figure>,
        caption: String,
    },
    /// Folded in HTML, under a heading in Markdown.
    Details {
        level: u8,
        title: String,
        blocks: Vec<Block>,
    },
}

/// A figure as files hold it.
#[derive(Debug)]
struct Drawn {
    file: String,
    /// Of a page, as a file of its own.
    svg: String,
    /// Its content as JSON, if it can be drawn anew.
    data: Option<String>,
}

impl Drawn {
    /// Without its own rules for a dark environment.
    fn part_of_page(&self) -> String {
        match (self.svg.find("<style>"), self.svg.find("</style>\n")) {
            (Some(from), Some(to)) => {
                format!("{}{}", &self.svg[..from], &self.svg[to + "</style>\n".len()..])
            }
            _ => self.svg.clone(),
        }
    }
}

#[derive(Debug)]
pub struct Files {
    /// `report.md`.
    pub markdown: String,
    pub html: String,
    /// Names and contents of the pictures, which must be next to the Markdown file.
    pub figures: Vec<(String, String)>,
    /// The picture for the index, of the main figure.
    pub card: Option<String>,
}

/// A page in pieces of HTML, for a program that shows it as its results come.
#[derive(Debug, Default, Serialize)]
pub struct Pieces {
    pub title: String,
    /// What stands first besides card and figures.
    pub lead: String,
    pub card: Vec<CardPiece>,
    /// The figures before the first folded section.
    pub figures: Vec<FigurePiece>,
    /// All else; empty where it was not asked for.
    pub sections: String,
}

#[derive(Debug, Serialize)]
pub struct CardPiece {
    /// Its name for machines.
    pub key: String,
    pub label: String,
    pub html: String,
}

#[derive(Debug, Serialize)]
pub struct FigurePiece {
    pub id: String,
    /// Its picture; `None` where its data are enough.
    pub svg: Option<String>,
    /// Its content as `page.js` draws it.
    pub data: Option<Box<RawValue>>,
    pub caption: String,
}

/// A page under construction. Methods that take `markdown` accept inline markup (`*emphasis*`,
/// `[links](...)`); what comes from a user goes through [`escape`] first. All others take plain text.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    blocks: Vec<Block>,
}

impl Page {
    /// A page with its title, plain text.
    pub fn new(title: impl Into<String>) -> Self {
        let title = title.into();
        Self { blocks: vec![Block::Title(title.clone())], title }
    }

    /// Adds what a reader should know first: a sentence or two of inline Markdown.
    pub fn lead(&mut self, markdown: &str) -> &mut Self {
        self.blocks.push(Block::Lead(one_line(markdown)));
        self
    }

    /// Adds the card of one case.
    pub fn card(&mut self, lines: Vec<CardLine>) -> &mut Self {
        self.blocks.push(Block::Card(lines));
        self
    }

    /// Adds what only some readers want, folded under a title (plain text, a heading of `level` in Markdown). Nothing where
    /// `write` adds nothing.
    pub fn details(&mut self, level: u8, title: &str, write: impl FnOnce(&mut Self)) -> &mut Self {
        let mut inside = Self { title: title.to_owned(), blocks: Vec::new() };
        write(&mut inside);
        if !inside.blocks.is_empty() {
            let title = one_line(title);
            self.blocks.push(Block::Details { level, title, blocks: inside.blocks });
        }
        self
    }

    /// Adds a heading, plain text; levels 2 (below the title) to 6.
    pub fn heading(&mut self, level: u8, text: &str) -> &mut Self {
        self.blocks.push(Block::Heading { level: level.clamp(2, 6), text: one_line(text) });
        self
    }

    /// Adds a paragraph of inline Markdown.
    pub fn paragraph(&mut self, markdown: &str) -> &mut Self {
        self.markdown_block(one_line(markdown))
    }

    /// Adds a bullet list of inline Markdown.
    pub fn bullets<T: AsRef<str>>(&mut self, items: impl IntoIterator<Item = T>) -> &mut Self {
        let items: Vec<String> =
            items.into_iter().map(|item| format!("- {}", one_line(item.as_ref()))).collect();
        if items.is_empty() {
            return self;
        }
        self.markdown_block(items.join("\n"))
    }

    /// Adds a warning of inline Markdown in a box of its own.
    pub fn warning(&mut self, markdown: &str) -> &mut Self {
        self.markdown_block(format!("> [!WARNING]\n> {}", one_line(markdown)))
    }

    /// Adds text in fixed pitch; `language` may be empty.
    pub fn code(&mut self, language: &str, text: &str) -> &mut Self {
        // The fence is longer than any run of backticks inside.
        let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
        let fence = "`".repeat(longest.max(2) + 1);
        let language: String = language.chars().filter(char::is_ascii_alphanumeric).collect();
        self.markdown_block(format!("{fence}{language}\n{}\n{fence}", text.trim_end_matches('\n')))
    }

    /// Adds a table. Columns that hold numbers only are set to the right; short rows are filled up and
    /// cells beyond the header are left out.
    pub fn table<H: AsRef<str>, C: Into<Cell>>(
        &mut self,
        header: impl IntoIterator<Item = H>,
        rows: impl IntoIterator<Item = Vec<C>>,
    ) -> &mut Self {
        let header: Vec<H> = header.into_iter().collect();
        let header: Vec<&str> = header.iter().map(AsRef::as_ref).collect();
        let rows = rows.into_iter().map(|row| row.into_iter().map(Into::into).collect()).collect();
        self.rows(&header, rows, Vec::new())
    }

    /// Adds a view of a table; nothing where it has no rows.
    pub fn view(&mut self, view: &View) -> &mut Self {
        self.view_text(view.text())
    }

    /// Adds the first row of a table as a list of properties and values; nothing without a row.
    pub fn properties(&mut self, view: &View) -> &mut Self {
        self.view_text(view.properties())
    }

    fn view_text(&mut self, text: ViewText) -> &mut Self {
        let ViewText { header, rows, verdicts } = text;
        if rows.is_empty() {
            return self;
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let rows = rows.into_iter().map(|row| row.into_iter().map(Cell::AroundCode).collect()).collect();
        self.rows(&header, rows, verdicts)
    }

    fn rows(&mut self, header: &[&str], rows: Vec<Vec<Cell>>, verdicts: Vec<usize>) -> &mut Self {
        let header: Vec<String> = header.iter().map(|name| escape(name)).collect();
        let rules = (0..header.len()).map(|column| if is_numeric(&rows, column) { "---:" } else { "---" });
        let mut lines = vec![line_of(header.iter().cloned()), line_of(rules.map(str::to_owned))];
        for row in &rows {
            let cell = |column| row.get(column).map(cell_markdown).unwrap_or_default();
            lines.push(line_of((0..header.len()).map(cell)));
        }
        self.blocks.push(Block::Table { markdown: lines.join("\n"), verdicts });
        self
    }

    /// Adds a figure: the file next to the page and a caption in plain text.
    pub fn figure(&mut self, file: &str, figure: impl Into<Figure>, caption: &str) -> &mut Self {
        let figure = Box::new(figure.into());
        self.blocks.push(Block::Figure { file: file.into(), figure, caption: one_line(caption) });
        self
    }

    /// The page and its figures as files, with the figures in a size for print or as wide as the page.
    pub fn files(&self, size: Option<Size>) -> Files {
        let mut figures = Vec::new();
        figures_of(&self.blocks, &mut figures);
        let drawn = drawn(&self.blocks);
        let html = html::page(&self.title, &self.blocks, &drawn);
        let card = figures.first().map(|(_, figure, caption)| with_title(figure.card(), caption));
        let in_print = |(at, drawn): (usize, Drawn)| {
            (
                drawn.file,
                if size.is_some() { with_title(figures[at].1.file(size), figures[at].2) } else { drawn.svg },
            )
        };
        Files {
            markdown: self.markdown(),
            html,
            figures: drawn.into_iter().enumerate().map(in_print).collect(),
            card,
        }
    }

    /// What a reader should know first: the card with its answer as the sentence, or the sentences before the first figure.
    pub fn answer(&self) -> Answer {
        let lead = |block: &Block| match block {
            Block::Lead(markdown) => Some(html::plain(markdown)),
            _ => None,
        };
        let card = self.blocks.iter().find_map(|block| match block {
            Block::Card(lines) => Some(lines.clone()),
            _ => None,
        });
        let lines = card.unwrap_or_default();
        let of_card = lines.iter().find(|line| line.key == CardLine::ANSWER).map(CardLine::text);
        let sentence =
            of_card.unwrap_or_else(|| self.blocks.iter().filter_map(lead).collect::<Vec<_>>().join(" "));
        Answer { sentence, lines }
    }

    /// The file of the first figure.
    pub fn main_figure(&self) -> Option<&str> {
        let mut figures = Vec::new();
        figures_of(&self.blocks, &mut figures);
        figures.first().map(|(file, ..)| *file)
    }

    /// The page with the keys that its texts advise in the form of a front end.
    #[must_use]
    pub fn read_in(mut self, front_end: FrontEnd) -> Self {
        read_in(&mut self.blocks, front_end);
        self
    }

    /// The page in pieces: all of it, or what stands before its first folded section.
    pub fn pieces(&self, has_sections: bool) -> Pieces {
        html::pieces(&self.title, &self.blocks, has_sections)
    }

    /// The page as Markdown (GitHub's flavour).
    pub fn markdown(&self) -> String {
        let mut parts = Vec::new();
        markdown_of(&self.blocks, &mut parts);
        parts.join("\n\n") + "\n"
    }

    /// The page as self-contained HTML with embedded figures, style and scripts.
    pub fn html(&self) -> String {
        self.files(None).html
    }

    fn markdown_block(&mut self, text: String) -> &mut Self {
        self.blocks.push(Block::Markdown(text));
        self
    }
}

fn read_in(blocks: &mut [Block], front_end: FrontEnd) {
    for block in blocks {
        match block {
            Block::Card(lines) => {
                lines
                    .iter_mut()
                    .flat_map(|line| &mut line.texts)
                    .for_each(|text| *text = front_end.text(text));
            }
            Block::Lead(text) | Block::Markdown(text) => *text = front_end.text(text),
            Block::Details { blocks, .. } => read_in(blocks, front_end),
            Block::Title(_) | Block::Heading { .. } | Block::Table { .. } | Block::Figure { .. } => {}
        }
    }
}

/// The figures of blocks as files.
fn drawn(blocks: &[Block]) -> Vec<Drawn> {
    let mut figures = Vec::new();
    figures_of(blocks, &mut figures);
    figures
        .par_iter()
        .map(|(file, figure, caption)| Drawn {
            file: (*file).to_owned(),
            svg: with_title(figure.file(None), caption),
            data: figure.data().and_then(|data| serde_json::to_string(&data).ok()),
        })
        .collect()
}

/// A picture without a title has its caption as one, for those who cannot see it.
fn with_title(svg: String, caption: &str) -> String {
    const NONE: &str = "<title></title>";
    if !svg.contains(NONE) {
        return svg;
    }
    svg.replacen(NONE, &format!("<title>{}</title>", html::escape(caption)), 1)
}

/// Figures with the names of their files and their captions, in the order of the page.
fn figures_of<'a>(blocks: &'a [Block], figures: &mut Vec<(&'a str, &'a Figure, &'a str)>) {
    for block in blocks {
        match block {
            Block::Figure { file, figure, caption } => figures.push((file, figure, caption)),
            Block::Details { blocks, .. } => figures_of(blocks, figures),
            _ => {}
        }
    }
}

fn markdown_of(blocks: &[Block], parts: &mut Vec<String>) {
    let heading = |level: u8, text: &str| format!("{} {}", "#".repeat(level.into()), escape(text));
    for block in blocks {
        match block {
            Block::Title(text) => parts.push(heading(1, text)),
            Block::Heading { level, text } => parts.push(heading(*level, text)),
            Block::Card(lines) => parts.push(markdown::card(lines)),
            Block::Lead(text) | Block::Markdown(text) | Block::Table { markdown: text, .. } => {
                parts.push(text.clone());
            }
            Block::Figure { file, figure, caption } => {
                let alternative = if figure.title().is_empty() { caption } else { figure.title() };
                parts.push(format!("![{}]({})", escape(alternative), address(file)));
                parts.push(format!("*{}*", escape(caption)));
            }
            Block::Details { level, title, blocks } => {
                parts.push(heading(*level, title));
                markdown_of(blocks, parts);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use asperity_plot::{Axis, Layer, Plot};

    use super::*;

    const ATTACK: &str =
        "a|b <script>alert(1)</script> ![x](http://evil/x.png) [y](javascript:alert(1)) `c` *d*\n# e";

    fn figure(title: &str) -> Figure {
        let plot = Plot::new(title, Axis::linear("x"), Axis::linear("y"));
        plot.with(Layer::line([(0.0, 1.0), (1.0, 2.0)]).named("</script>")).into()
    }

    fn sample() -> Page {
        let mut page = Page::new("Lead & steel");
        page.heading(2, "Gap").paragraph("How *far* apart.").warning("Beyond the model at `A/A_nom > 0.05`.");
        page.table(["surface", "P"], vec![vec!["fine", "1.5e-6"], vec!["rough", "-2 %"]]);
        page.figure("gap.svg", figure("Gap against load"), "The gap");
        page.details(3, "More", |page| {
            page.paragraph("Inside.").figure("two.svg", figure(""), "Another");
        });
        page
    }

    #[test]
    fn code_between_backticks_stays_code() {
        assert_eq!(
            escape_around_code("a_b: set (`level = \"x_y\"`) or `l`, see *c*."),
            "a\\_b: set (`level = \"x_y\"`) or `l`, see \\*c\\*."
        );
        assert_eq!(escape_around_code("one ` only_"), "one \\` only\\_");
        let cell = Cell::AroundCode("set `l = 2`_".to_owned());
        assert!(Page::new("t").table(["remedy"], [vec![cell]]).markdown().contains("| set `l = 2`\\_ |"));
    }

    #[test]
    fn one_content_in_two_forms() {
        let (markdown, html) = (sample().markdown(), sample().html());
        assert!(markdown.starts_with("# Lead &amp; steel\n\n## Gap\n\n"));
        assert!(markdown.contains("> [!WARNING]\n> Beyond"));
        assert!(markdown.contains("| surface | P |\n| --- | ---: |\n| fine | 1.5e-6 |"));
        assert!(markdown.contains("![Gap against load](gap.svg)\n\n*The gap*"));
        assert!(
            html.contains("<title>Lead &amp; steel</title>")
                && html.contains("<h2 id=\"section-1\">Gap</h2>")
        );
        assert!(html.contains("markdown-alert-warning") && html.contains("<em>far</em>"));
        assert!(html.contains("<figcaption>The gap</figcaption>") && !html.contains("<img"));
        assert!(html.contains("text-align: right"));
    }

    #[test]
    fn details_are_folded_in_html_and_under_a_heading_in_markdown() {
        let (markdown, html) = (sample().markdown(), sample().html());
        assert!(
            markdown.contains("\n\n### More\n\nInside.\n\n![Another](two.svg)\n\n*Another*\n"),
            "{markdown}"
        );
        assert!(
            html.contains("<details>\n<summary>More</summary>\n<p>Inside.</p>\n<figure id=\"two\">"),
            "{html}"
        );
        let empty = Page::new("t").details(3, "None", |_| {}).markdown();
        assert_eq!(empty, "# t\n");
    }

    #[test]
    fn figures_are_files_and_parts_of_the_page() {
        let files = sample().files(None);
        let names: Vec<&str> = files.figures.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["gap.svg", "two.svg"]);
        assert!(files.figures[0].1.contains("<style>@media screen and (prefers-color-scheme:dark)"));
        assert!(files.html.contains("<figure id=\"gap\">") && files.html.matches("<style>").count() == 1);
        // The data of a figure stand once in the page and cannot end their element.
        assert_eq!(files.html.matches("\"places\":[[0.0,1.0]]").count(), 2);
        assert!(files.html.contains("\"name\":\"\\u003c/script>\""), "{}", files.html);
        let print = sample().files(Some(Size::new(85.0, 8.0)));
        assert!(print.figures[0].1.contains("width=\"85mm\"") && !print.html.contains("85mm"));
    }

    #[test]
    fn pages_without_charts_have_no_scripts() {
        let mut page = Page::new("t");
        page.paragraph("Text.");
        assert!(!page.html().contains("<script"));
        assert!(sample().html().contains("Permission is hereby granted"));
    }

    #[test]
    fn verdicts_in_tables_have_a_class() {
        let header = ["load", "verdict"];
        let rows = ["within", "beyond: +3 %", "cannot tell", "blocked (within)", "within"];
        let rows = rows.map(|verdict| vec![Cell::from("within 2 N"), Cell::from(verdict)]).to_vec();
        let mut page = Page::new("t");
        page.rows(&header, rows, vec![1]);
        let html = page.html();
        for cell in [
            "class=\"within\">within",
            "class=\"beyond\"><button",
            "class=\"open\"><button",
            "class=\"open\">blocked",
        ] {
            assert!(html.contains(cell), "{cell}");
        }
        assert_eq!(html.matches("<td>within 2 N").count(), 4);
    }

    #[test]
    fn terms_are_explained_once_in_cells_captions_and_leads_and_not_in_paragraphs() {
        let mut page = Page::new("t");
        page.paragraph("The dual gap.").table(["effective contacts", "P"], vec![vec!["S filter", "1"]]);
        page.figure("a.svg", figure("A"), "The S filter and the dual gap");
        let html = page.html();
        for (term, count) in [("effective-contacts", 1), ("S-filter", 1), ("dual-gap", 1), ("L-filter", 0)] {
            let button = format!("<button type=\"button\" class=\"term\" popovertarget=\"term-{term}\"");
            assert_eq!(html.matches(&button).count(), count, "{term}");
            assert_eq!(html.matches(&format!("popover id=\"term-{term}\"")).count(), count, "{term}");
        }
        assert!(html.contains("<p>The dual gap.</p>"));
    }

    #[test]
    fn many_sections_are_listed() {
        let mut page = Page::new("t");
        (1..=4).for_each(|k| {
            page.heading(2, &format!("Part <{k}>"));
        });
        let html = page.html();
        assert!(html.contains("<li><a href=\"#section-4\">Part &lt;4&gt;</a></li>"), "{html}");
        assert!(
            html.contains("<h2 id=\"section-4\">") && html.find("<nav").unwrap() < html.find("<h2").unwrap()
        );
        assert!(!sample().html().contains("<nav"));
    }

    #[test]
    fn no_text_brings_markup_along() {
        let mut page = Page::new(ATTACK);
        page.heading(2, ATTACK).paragraph(&escape(ATTACK)).table([ATTACK], vec![vec![ATTACK]]);
        page.card(vec![CardLine::new("a", ATTACK, ATTACK)]).figure("x.svg", figure(ATTACK), ATTACK);
        // Not even where a caller forgot to escape.
        page.paragraph(ATTACK).bullets([ATTACK]).warning(ATTACK).paragraph("<img src=x onerror=alert(1)>");
        page.table(["l"], vec![vec![Cell::Link { text: ATTACK.into(), to: "javascript:alert(1)".into() }]]);
        let html = page.html();
        assert!(!html.contains("<script>alert"));
        for markup in ["<img", "href=\"javascript", "href=\"http://evil", "<em>d</em> <h1"] {
            assert!(!html.contains(markup), "{markup}\n{html}");
        }
        assert_eq!(html.matches("<h1").count(), 1);
    }

    #[test]
    fn a_cell_shows_exactly_its_text() {
        for text in
            ["a|b", "x_1*y_2*", "<b>", "a\\|b", "&amp;", "1. one", "- item", "`tick`", "[a](b)", "$x$ ~~y~~"]
        {
            let mut page = Page::new("t");
            page.table(["h", "k"], vec![vec![text, "end"]]);
            let shown = format!(
                "<td>{}</td><td>end</td>",
                text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
            );
            assert!(page.html().contains(&shown), "{text}: {}", page.html());
            let mut page = Page::new("t");
            page.paragraph(&escape(text));
            let shown = shown.replace("<td>end</td>", "").replace("td>", "p>");
            assert!(page.html().contains(&shown), "{text}: {}", page.html());
        }
    }

    #[test]
    fn code_cannot_leave_its_fence() {
        let mut page = Page::new("t");
        page.code("toml", "a = 1\n```\n<script>\n````");
        let html = page.html();
        assert!(
            html.contains(
                "<pre tabindex=\"0\"><code class=\"language-toml\">a = 1\n```\n&lt;script&gt;\n````\n</code></pre>"
            ),
            "{html}"
        );
    }

    #[test]
    fn the_page_fetches_nothing() {
        let html = sample().html();
        for fetching in ["src=", "@import", "url(http", "<link", "fetch(", "XMLHttpRequest"] {
            assert!(!html.contains(fetching), "{fetching}");
        }
    }
}
