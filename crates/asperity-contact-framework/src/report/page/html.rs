//! The page as one HTML file that fetches nothing.
//!
//! Figures are SVG in the page. Those whose content is lines, points and bands carry it as JSON too, of which `page.js` makes
//! interactive charts by uPlot (MIT licence, `assets/uPlot-LICENSE`); without scripts, and in print, the SVG is shown.

use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd};
use serde_json::value::RawValue;

use super::markdown::escape_around_code;
use super::{Block, CardPiece, Drawn, FigurePiece, Pieces, drawn};
use crate::report::answer::CardLine;
use crate::report::glossary::{self, Explainer};

const STYLE: &str = include_str!("assets/page.css");
pub const CHART_STYLE: &str = include_str!("assets/uPlot.min.css");
const CHART_LICENCE: &str = include_str!("assets/uPlot-LICENSE");
const CHARTS: &str = include_str!("assets/uPlot.iife.min.js");
const SCRIPT: &str = include_str!("assets/page.js");

/// Classes of the cells of verdicts, by how they begin.
const VERDICTS: [(&str, &str); 5] =
    [("within", "within"), ("yes", "within"), ("beyond", "beyond"), ("no", "beyond"), ("", "open")];

/// Pages with more sections than this list them.
const MOST_UNLISTED: usize = 3;

/// The whole page; `figures` are those of its blocks, in their order.
pub(super) fn page(title: &str, blocks: &[Block], figures: &[Drawn]) -> String {
    let mut writer =
        Writer { figures, body: String::new(), sections: Vec::new(), explainer: Explainer::default() };
    writer.write(blocks);
    let contents = contents(&writer.sections);
    let mut body = scrolling(&writer.body.replacen(CONTENTS, &contents, 1));
    body.push_str(&writer.explainer.meanings());
    let (chart_style, charts) = if figures.iter().any(|figure| figure.data.is_some()) {
        (CHART_STYLE, charts())
    } else {
        ("", String::new())
    };
    let (style, script) = writer.explainer.assets();
    document(title, &body, &format!("{chart_style}\n{style}"), &format!("{charts}{script}"))
}

/// HTML in which wide tables scroll by themselves, by keyboard too, so that the page stays as wide as the screen.
fn scrolling(html: &str) -> String {
    html.replace(
        "<table>",
        "<div class=\"table\" role=\"region\" aria-label=\"Table\" tabindex=\"0\"><table>",
    )
    .replace("</table>", "</table></div>")
    .replace("<pre>", "<pre tabindex=\"0\">")
}

/// The pieces of a page: what stands before its first folded section, and all else where it `has_sections`.
pub(super) fn pieces(title: &str, blocks: &[Block], has_sections: bool) -> Pieces {
    let is_folded = |block: &Block| matches!(block, Block::Details { .. } | Block::Heading { .. });
    let (first, rest) = blocks.split_at(blocks.iter().position(is_folded).unwrap_or(blocks.len()));
    let drawn = drawn(if has_sections { blocks } else { first });
    let mut writer = Writer {
        figures: &drawn,
        body: String::new(),
        sections: Vec::new(),
        explainer: Explainer::default(),
    };
    let mut pieces = Pieces { title: title.to_owned(), ..Pieces::default() };
    for block in first {
        match block {
            Block::Title(_) => {}
            Block::Card(lines) => {
                pieces.card = lines
                    .iter()
                    .map(|line| CardPiece {
                        key: line.key.clone(),
                        label: line.label.clone(),
                        html: card_text(line, &mut writer.explainer),
                    })
                    .collect();
            }
            Block::Figure { caption, .. } => {
                let Some((figure, rest)) = writer.figures.split_first() else { continue };
                writer.figures = rest;
                pieces.figures.push(FigurePiece {
                    id: figure.file.trim_end_matches(".svg").to_owned(),
                    // A chart is made of the data alone; a map with frames is its picture.
                    svg: figure
                        .data
                        .as_ref()
                        .is_none_or(|data| data.contains("\"frames\":"))
                        .then(|| figure.part_of_page()),
                    data: figure.data.clone().and_then(|data| RawValue::from_string(data).ok()),
                    caption: writer.explainer.mark(&escape(&with_minus(caption))),
                });
            }
            other => writer.write(std::slice::from_ref(other)),
        }
    }
    pieces.lead = scrolling(&std::mem::take(&mut writer.body));
    if has_sections {
        writer.write(rest);
        let contents = contents(&writer.sections);
        pieces.sections = scrolling(&writer.body.replacen(CONTENTS, &contents, 1));
    }
    pieces
}

fn card_text(line: &CardLine, explainer: &mut Explainer) -> String {
    let text = |text: &String| {
        let mut html = String::new();
        push_markdown(&mut html, &escape_around_code(text));
        html
    };
    explainer.mark(&line.texts.iter().map(text).collect::<String>())
}

/// A document of its own with the style of all pages, and `style` and `script` (elements) besides.
pub fn document(title: &str, body: &str, style: &str, script: &str) -> String {
    let dark = asperity_plot::dark_rules();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n\
         <style>\n{style}\n{STYLE}{dark}\n</style>\n</head>\n<body>\n<main>\n{body}</main>\n{script}</body>\n</html>\n",
        escape(title)
    )
}

/// The library for charts with its licence, and what makes charts of the figures: two scripts.
pub fn chart_scripts() -> [String; 2] {
    let pairs: Vec<String> =
        asperity_plot::DARK_COLOURS.iter().map(|(light, dark)| format!("[\"{light}\",\"{dark}\"]")).collect();
    [
        format!("/*\nuPlot\n{CHART_LICENCE}*/\n{CHARTS}\n"),
        format!("const DARK_COLOURS = new Map([{}]);\n{SCRIPT}", pairs.join(",")),
    ]
}

pub fn charts() -> String {
    let [library, charts] = chart_scripts();
    format!("<script>\n{library}</script>\n<script>\n{charts}</script>\n")
}

/// The style of all pages, of charts and of explained terms.
pub fn page_style() -> String {
    format!("{CHART_STYLE}\n{}\n{STYLE}{}\n", glossary::STYLE, asperity_plot::dark_rules())
}

/// Where the list of sections goes.
const CONTENTS: &str = "<!-- contents -->\n";

fn contents(sections: &[(String, String)]) -> String {
    if sections.len() <= MOST_UNLISTED {
        return String::new();
    }
    let item = |(id, text): &(String, String)| format!("<li><a href=\"#{id}\">{}</a></li>\n", escape(text));
    let items: String = sections.iter().map(item).collect();
    format!(
        "<nav aria-label=\"Contents\">\n<details>\n<summary>Contents</summary>\n<ul>\n{items}</ul>\n</details>\n</nav>\n"
    )
}

struct Writer<'a> {
    figures: &'a [Drawn],
    body: String,
    /// Ids and names of the sections so far.
    sections: Vec<(String, String)>,
    explainer: Explainer,
}

impl Writer<'_> {
    fn write(&mut self, blocks: &[Block]) {
        for block in blocks {
            match block {
                Block::Title(text) => {
                    self.body.push_str(&format!("<h1>{}</h1>\n", escape(text)));
                }
                Block::Heading { level: 2, text } => {
                    if self.sections.is_empty() {
                        self.body.push_str(CONTENTS);
                    }
                    let id = format!("section-{}", self.sections.len() + 1);
                    self.body.push_str(&format!("<h2 id=\"{id}\">{}</h2>\n", escape(text)));
                    self.sections.push((id, text.clone()));
                }
                Block::Heading { level, text } => {
                    self.body.push_str(&format!("<h{level}>{}</h{level}>\n", escape(text)));
                }
                Block::Lead(markdown) => {
                    let mut text = String::new();
                    push_markdown(&mut text, markdown);
                    let text = self.explainer.mark(&text);
                    self.body.push_str(&format!("<div class=\"lead\">\n{text}</div>\n"));
                }
                Block::Card(lines) => self.card(lines),
                Block::Markdown(text) => push_markdown(&mut self.body, text),
                Block::Table { markdown, verdicts } => self.table(markdown, verdicts),
                Block::Figure { caption, .. } => self.figure(caption),
                Block::Details { title, blocks, .. } => {
                    self.body.push_str(&format!("<details>\n<summary>{}</summary>\n", escape(title)));
                    self.write(blocks);
                    self.body.push_str("</details>\n");
                }
            }
        }
    }

    fn card(&mut self, lines: &[CardLine]) {
        let explainer = &mut self.explainer;
        let row = |line: &CardLine| {
            let texts = card_text(line, explainer);
            format!("<div>\n<dt>{}</dt>\n<dd>{texts}</dd>\n</div>\n", escape(&line.label))
        };
        let rows: String = lines.iter().map(row).collect();
        self.body.push_str(&format!("<dl class=\"card\">\n{rows}</dl>\n"));
    }

    fn table(&mut self, markdown: &str, verdicts: &[usize]) {
        let mut table = String::new();
        push_markdown(&mut table, markdown);
        let coloured = if verdicts.is_empty() { table } else { with_colours(&table, verdicts) };
        self.body.push_str(&self.explainer.mark(&coloured));
    }

    fn figure(&mut self, caption: &str) {
        let Some((drawn, rest)) = self.figures.split_first() else { return };
        self.figures = rest;
        let data = drawn.data.as_ref().map_or_else(String::new, |data| {
            // No text in it can end the element.
            let data = data.replace('<', "\\u003c");
            format!("<script type=\"application/json\">{data}</script>\n")
        });
        self.body.push_str(&format!(
            "<figure id=\"{}\">\n<div class=\"picture\" role=\"region\" aria-label=\"Figure\" tabindex=\"0\">\n{}</div>\n{data}<figcaption>{}</figcaption>\n</figure>\n",
            escape(drawn.file.trim_end_matches(".svg")),
            drawn.part_of_page(),
            self.explainer.mark(&escape(&with_minus(caption)))
        ));
    }
}

/// A table with the classes of the cells in columns of verdicts.
fn with_colours(table: &str, verdicts: &[usize]) -> String {
    let mut coloured = String::with_capacity(table.len());
    for line in table.split_inclusive("<tr>") {
        for (column, cell) in line.split_inclusive("</td>").enumerate() {
            let text = cell.trim_start().strip_prefix("<td>").filter(|_| verdicts.contains(&column));
            let class = text.and_then(|text| VERDICTS.iter().find(|(verdict, _)| text.starts_with(verdict)));
            match class.zip(text) {
                Some(((_, class), text)) => {
                    coloured.push_str(&format!("<td class=\"{class}\">{text}"));
                }
                None => coloured.push_str(cell),
            }
        }
    }
    coloured
}

fn push_markdown(body: &mut String, markdown: &str) {
    let options = Options::ENABLE_TABLES | Options::ENABLE_GFM;
    let mut hidden_links = Vec::new();
    let mut is_code = false;
    let events = Parser::new_ext(markdown, options).filter_map(|event| match event {
        Event::Start(Tag::CodeBlock(_)) | Event::End(TagEnd::CodeBlock) => {
            is_code = matches!(event, Event::Start(_));
            Some(event)
        }
        Event::Text(text) if !is_code => Some(Event::Text(with_minus(&text).into())),
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

/// Negative numbers with the minus sign that figures have; files for machines and code keep the hyphen.
pub fn with_minus(text: &str) -> String {
    let mut before = ' ';
    let mut rest = text.chars().peekable();
    let mut shown = String::with_capacity(text.len());
    while let Some(c) = rest.next() {
        let begins = before.is_whitespace() || matches!(before, '(' | '[' | '±' | '/');
        let is_minus = c == '-' && begins && rest.peek().is_some_and(char::is_ascii_digit);
        shown.push(if is_minus { '−' } else { c });
        before = c;
    }
    shown
}

pub(super) fn plain(markdown: &str) -> String {
    let text = |event| match event {
        Event::Text(text) | Event::Code(text) => Some(text.into_string()),
        Event::SoftBreak | Event::HardBreak => Some(" ".to_owned()),
        _ => None,
    };
    Parser::new(markdown).filter_map(text).collect()
}

/// Web pages and addresses relative to this one; no other scheme, which could run a script.
fn is_safe(to: &CowStr<'_>) -> bool {
    let scheme = to.split(['/', '?', '#']).next().unwrap_or("");
    !scheme.contains(':') || to.starts_with("https://") || to.starts_with("http://")
}

pub fn escape(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&#39;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negative_numbers_have_a_minus_sign_and_code_a_hyphen() {
        let mut body = String::new();
        push_markdown(&mut body, "map-1: -5.34 nm (-2 to -1), `missing = -9999`, 1e-6, 2026-11-25, - 3");
        assert_eq!(
            body.trim(),
            "<p>map-1: −5.34 nm (−2 to −1), <code>missing = -9999</code>, 1e-6, 2026-11-25, - 3</p>"
        );
        let mut body = String::new();
        push_markdown(&mut body, "```toml\nheight = -5\n```\n");
        assert!(body.contains("height = -5"), "{body}");
    }
}
