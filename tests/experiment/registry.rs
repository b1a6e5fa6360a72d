//! What is written by hand about the laws, the height distributions and the kinds of experiment.

use std::fs;

use asperity::ContactLaw;
use asperity::contact_law::registry;
use asperity::distribution::REGISTRY;
use asperity_experiment::kind::KINDS;

fn assert_named(files: &[&str], names: impl Iterator<Item = String> + Clone) {
    for file in files {
        let text = fs::read_to_string(file).unwrap().to_lowercase();
        for name in names.clone() {
            assert!(text.contains(&name), "{name} is not in {file}");
        }
    }
}

#[test]
fn documents_name_every_law() {
    let names = registry().iter().map(ContactLaw::name);
    assert_named(&["docs/specs.md", "docs/theory.md"], names.clone().map(|name| format!("`{name}`")));
    // The comment of the template that `experiment new` writes.
    assert_named(&["src/template.toml"], names.map(|name| format!("\"{name}\"")));
}

#[test]
fn documents_name_every_height_distribution() {
    let names = REGISTRY.iter().map(|entry| entry.name.to_owned());
    assert_named(&["docs/specs.md", "docs/theory.md", "src/template.toml"], names);
}

#[test]
fn documents_and_messages_name_every_kind() {
    let names = KINDS.iter().map(|kind| format!("[{}]", kind.name));
    assert_named(&["docs/specs.md"], names.clone());
    let message = crate::results::run("title = \"t\"\n").err().unwrap();
    let all = names.collect::<Vec<_>>().join(", ");
    assert!(message.contains(&format!("exactly one of {all}")), "{message}");
}

/// A word that cites a year, such as "(2005)," or "1966).".
fn year(word: &str) -> Option<&str> {
    let digits = word.trim_matches(|c: char| !c.is_ascii_digit());
    let is_year = digits.len() == 4 && ["18", "19", "20"].iter().any(|century| digits.starts_with(century));
    (is_year && word.chars().all(|c| c.is_ascii_digit() || "(),.;:*}$".contains(c))).then_some(digits)
}

fn name(word: &str) -> &str {
    let plain = word.trim_matches(|c: char| !c.is_alphabetic());
    plain.strip_suffix("'s").unwrap_or(plain)
}

/// The last author and the year of each citation in a text: a capitalised name, or "NAME et al.", before a year.
fn citations(text: &str) -> Vec<(&str, &str)> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let cited = |place: usize| {
        let year = year(words[place])?;
        let last = name(words[place.checked_sub(1)?]);
        let author = if last == "al" { name(words[place.checked_sub(3)?]) } else { last };
        author.starts_with(char::is_uppercase).then_some((author, year))
    };
    (0..words.len()).filter_map(cited).collect()
}

#[test]
fn the_sources_of_the_theory_are_those_it_cites() {
    let text = fs::read_to_string("docs/theory.md").unwrap();
    let (body, sources) = text.split_once("## Sources").unwrap();
    let sources: Vec<&str> = sources.lines().filter(|line| line.starts_with("- ")).collect();
    let is_cited = |source: &str, (author, year): (&str, &str)| {
        source.contains(author) && source.contains(&format!("({year})"))
    };
    let cited = citations(body);
    for citation in &cited {
        assert!(sources.iter().any(|source| is_cited(source, *citation)), "{citation:?} is not listed");
    }
    for source in &sources {
        assert!(cited.iter().any(|citation| is_cited(source, *citation)), "not cited: {source}");
    }
    assert_eq!(
        citations("of Jeng and Wang (2003), as in Müser et al. 2017; J. Mech. 107, 2017, 469"),
        [("Wang", "2003"), ("Müser", "2017")]
    );
}
