//! A report page in two formats.
//!
//! A [`Page`] is a list of blocks. Its Markdown is what people read in the repository, with pictures
//! beside it; its HTML is the same content in one file that needs nothing else. Names come from
//! users: plain text is escaped here, and no text can bring markup of its own into the HTML.

use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd};

const STYLE: &str = include_str!("page.css");

/// One cell of a table: plain text, with code in it or not, or a link.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Text as it is; nothing in it is markup.
    Text(String),
    /// The same, except that text between backticks is code.
    AroundCode(String),
    /// Text that leads to a relative address or a web page.
    Link {
        /// What is shown.
        text: String,
        /// Where it leads.
        to: String,
    },
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::Text(text.into())
    }
}

#[derive(Clone, Debug)]
enum Block {
    /// Any block whose HTML follows from its Markdown.
    Markdown(String),
    Figure {
        file: String,
        svg: String,
        caption: String,
    },
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
        let heading = Block::Markdown(format!("# {}", escape(&title)));
        Self { title, blocks: vec![heading] }
    }

    /// Adds a heading, plain text; levels 2 (below the title) to 6.
    pub fn heading(&mut self, level: u8, text: &str) -> &mut Self {
        let marks = "#".repeat(level.clamp(2, 6).into());
        self.markdown_block(format!("{marks} {}", escape(text)))
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

    /// Adds terms (plain text) and what each means (inline Markdown).
    pub fn terms<T: AsRef<str>, M: AsRef<str>>(
        &mut self,
        terms: impl IntoIterator<Item = (T, M)>,
    ) -> &mut Self {
        let line = |(term, meaning): (T, M)| format!("**{}**: {}", escape(term.as_ref()), meaning.as_ref());
        self.bullets(terms.into_iter().map(line))
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
        let header: Vec<String> = header.into_iter().map(|name| escape(name.as_ref())).collect();
        let rows: Vec<Vec<Cell>> =
            rows.into_iter().map(|row| row.into_iter().map(Into::into).collect()).collect();
        let rules = (0..header.len()).map(|column| if is_numeric(&rows, column) { "---:" } else { "---" });
        let mut lines = vec![line_of(header.iter().cloned()), line_of(rules.map(str::to_owned))];
        for row in &rows {
            let cell = |column| row.get(column).map(cell_markdown).unwrap_or_default();
            lines.push(line_of((0..header.len()).map(cell)));
        }
        self.markdown_block(lines.join("\n"))
    }

    /// Adds a figure: the file next to the page, its SVG text and a caption in plain text.
    pub fn figure(&mut self, file: &str, svg: impl Into<String>, caption: &str) -> &mut Self {
        self.blocks.push(Block::Figure { file: file.into(), svg: svg.into(), caption: one_line(caption) });
        self
    }

    /// File names and SVG texts of the pictures, which must be next to the Markdown file.
    pub fn figures(&self) -> impl Iterator<Item = (&str, &str)> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Figure { file, svg, .. } => Some((file.as_str(), svg.as_str())),
            Block::Markdown(_) => None,
        })
    }

    /// The page as Markdown (GitHub's flavour).
    pub fn markdown(&self) -> String {
        let blocks = self.blocks.iter().map(|block| match block {
            Block::Markdown(text) => text.clone(),
            Block::Figure { file, caption, .. } => {
                let caption = escape(caption);
                format!("![{caption}]({})\n\n*{caption}*", address(file))
            }
        });
        blocks.collect::<Vec<_>>().join("\n\n") + "\n"
    }

    /// The page as self-contained HTML with embedded figures and style.
    pub fn html(&self) -> String {
        let mut body = String::new();
        let mut figures = 0;
        for block in &self.blocks {
            match block {
                Block::Markdown(text) => push_html(&mut body, text),
                Block::Figure { svg, caption, .. } => {
                    figures += 1;
                    let svg = with_own_ids(svg, &format!("figure-{figures}-"));
                    let caption = escape_html(caption);
                    body.push_str(&format!(
                        "<figure>\n<div class=\"picture\">\n{svg}</div>\n<figcaption>{caption}</figcaption>\n</figure>\n"
                    ));
                }
            }
        }
        // Wide tables scroll by themselves, so that the page stays as wide as the screen.
        let body =
            body.replace("<table>", "<div class=\"table\"><table>").replace("</table>", "</table></div>");
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n\
             <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
            escape_html(&self.title)
        )
    }

    fn markdown_block(&mut self, text: String) -> &mut Self {
        self.blocks.push(Block::Markdown(text));
        self
    }
}

/// Plain text as Markdown that shows exactly that text: nothing in it is markup. Line breaks and other
/// control characters become blanks.
pub fn escape(text: &str) -> String {
    let text = one_line(text);
    let mut escaped = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '|' | '~' | '#' | '$' => {
                escaped.extend(['\\', c])
            }
            // At the start of a line these would make a list, a rule or a heading, unless a number
            // or a word goes on.
            '-' | '+' | '=' | '.' | ')'
                if escaped.bytes().all(|b| b.is_ascii_digit())
                    && !rest.peek().is_some_and(|c| c.is_alphanumeric()) =>
            {
                escaped.extend(['\\', c]);
            }
            _ => escaped.push(c),
        }
    }
    escaped
}

/// The same, except that text between backticks is code.
pub fn escape_around_code(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    // Backticks that are not pairs are no markup.
    if parts.len().is_multiple_of(2) {
        return escape(text);
    }
    let part = |(index, part): (usize, &&str)| {
        if !index.is_multiple_of(2) {
            return format!("`{}`", one_line(part));
        }
        // Letters keep blanks at the ends; only the first part is at the start of a line.
        let before = if index == 0 { "" } else { "x" };
        let escaped = escape(&format!("{before}{part}x"));
        escaped[before.len()..escaped.len() - 1].to_owned()
    };
    parts.iter().enumerate().map(part).collect::<String>().trim().to_owned()
}

fn escape_html(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&#39;")
}

/// Control characters, line breaks among them, as blanks: a text cannot leave its block.
fn one_line(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.trim().to_owned()
}

/// An address for a Markdown link: what could end the link is percent-encoded.
fn address(to: &str) -> String {
    let mut address = String::new();
    for byte in to.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' => address.push(byte.into()),
            b'-' | b'.' | b'_' | b'~' | b'/' | b':' | b'#' | b'?' | b'=' | b'&' | b'%' | b'+' | b',' => {
                address.push(byte.into());
            }
            other => address.push_str(&format!("%{other:02X}")),
        }
    }
    address
}

fn cell_markdown(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) => escape(text),
        Cell::AroundCode(text) => escape_around_code(text),
        Cell::Link { text, to } => format!("[{}]({})", escape(text), address(to)),
    }
}

fn line_of(cells: impl Iterator<Item = String>) -> String {
    format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
}

/// Whether a column holds numbers, with or without a unit or a percent sign, and no text.
fn is_numeric(rows: &[Vec<Cell>], column: usize) -> bool {
    let mut any = false;
    for row in rows {
        let text = match row.get(column) {
            Some(Cell::Text(text) | Cell::AroundCode(text)) => text.trim(),
            Some(Cell::Link { .. }) => return false,
            None => "",
        };
        if matches!(text, "" | "–" | "∞") {
            continue;
        }
        let mut words = text.split_whitespace();
        let number = words.next().unwrap_or("").replace(',', "").replace('−', "-");
        let is_number =
            number.ends_with(|c: char| c.is_ascii_digit()) && number.parse::<f64>().is_ok() || number == "∞";
        if !is_number || words.count() > 1 {
            return false;
        }
        any = true;
    }
    any
}

fn push_html(body: &mut String, markdown: &str) {
    let options = Options::ENABLE_TABLES | Options::ENABLE_GFM;
    let mut hidden_links = Vec::new();
    let events = Parser::new_ext(markdown, options).filter_map(|event| match event {
        // Markup that a text brings along is shown, not obeyed.
        Event::Html(text) | Event::InlineHtml(text) => Some(Event::Text(text)),
        Event::Start(Tag::HtmlBlock) | Event::End(TagEnd::HtmlBlock) => None,
        // A picture inside a text would be fetched from elsewhere; its description stays.
        Event::Start(Tag::Image { .. }) | Event::End(TagEnd::Image) => None,
        Event::Start(Tag::Link { ref dest_url, .. }) => {
            let safe = is_safe(dest_url);
            hidden_links.push(!safe);
            safe.then_some(event)
        }
        Event::End(TagEnd::Link) => (!hidden_links.pop().unwrap_or(false)).then_some(event),
        other => Some(other),
    });
    pulldown_cmark::html::push_html(body, events);
}

/// Web pages and addresses relative to this one; no other scheme, which could run a script.
fn is_safe(to: &CowStr<'_>) -> bool {
    let scheme = to.split(['/', '?', '#']).next().unwrap_or("");
    !scheme.contains(':') || to.starts_with("https://") || to.starts_with("http://")
}

/// Gives every id in a picture, and what refers to it, a prefix: pictures share one page.
fn with_own_ids(svg: &str, prefix: &str) -> String {
    if !svg.contains(" id=\"") {
        return svg.to_owned();
    }
    let marks = [" id=\"", "href=\"#", "url(#", "aria-labelledby=\"", "aria-describedby=\""];
    marks.iter().fold(svg.to_owned(), |svg, mark| svg.replace(mark, &format!("{mark}{prefix}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ATTACK: &str =
        "a|b <script>alert(1)</script> ![x](http://evil/x.png) [y](javascript:alert(1)) `c` *d*\n# e";

    fn sample() -> Page {
        let mut page = Page::new("Lead & steel");
        page.heading(2, "Gap").paragraph("How *far* apart.").warning("Beyond the model at `A/A_nom > 0.05`.");
        page.table(["surface", "P"], vec![vec!["fine", "1.5e-6"], vec!["rough", "-2 %"]]);
        page.figure("gap.svg", "<svg><g id=\"a\"/><use href=\"#a\"/></svg>\n", "The gap");
        page.figure("two.svg", "<svg><g id=\"a\"/></svg>\n", "Another");
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
        assert!(markdown.contains("![The gap](gap.svg)"));
        assert!(html.contains("<title>Lead &amp; steel</title>") && html.contains("<h2>Gap</h2>"));
        assert!(html.contains("markdown-alert-warning") && html.contains("<em>far</em>"));
        assert!(html.contains("<figcaption>The gap</figcaption>") && !html.contains("<img"));
        assert!(html.contains("text-align: right"));
    }

    #[test]
    fn ids_of_two_pictures_stay_apart() {
        let html = sample().html();
        assert!(html.contains("id=\"figure-1-a\"") && html.contains("href=\"#figure-1-a\""));
        assert!(html.contains("id=\"figure-2-a\"") && !html.contains("id=\"a\""));
    }

    #[test]
    fn no_text_brings_markup_along() {
        let mut page = Page::new(ATTACK);
        page.heading(2, ATTACK).paragraph(&escape(ATTACK)).table([ATTACK], vec![vec![ATTACK]]);
        page.terms([(ATTACK, escape(ATTACK))]).figure("x.svg", "<svg/>", ATTACK);
        // Not even where a caller forgot to escape.
        page.paragraph(ATTACK).bullets([ATTACK]).warning(ATTACK).paragraph("<img src=x onerror=alert(1)>");
        page.table(["l"], vec![vec![Cell::Link { text: ATTACK.into(), to: "javascript:alert(1)".into() }]]);
        let html = page.html();
        for markup in ["<script", "<img", "href=\"javascript", "href=\"http://evil", "<em>d</em> <h1"] {
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
                "<pre><code class=\"language-toml\">a = 1\n```\n&lt;script&gt;\n````\n</code></pre>"
            ),
            "{html}"
        );
    }

    #[test]
    fn the_page_fetches_nothing() {
        let html = sample().html();
        assert!(!html.contains("src=") && !html.contains("@import") && !html.contains("url(http"));
    }
}
