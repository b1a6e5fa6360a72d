//! The registry and what is made of it.

use asperity::contact_law::{named, registry};
use asperity::law::OptionError;
use asperity::{ContactLaw, Law, Material, Pair, Zmc};

use super::own::{Abrupt, jump};

#[test]
fn names_and_options_are_unique() {
    for (k, law) in registry().iter().enumerate() {
        assert!(registry()[..k].iter().all(|other| other.name() != law.name()), "{law:?}");
        assert_eq!(named(&law.name()).as_ref(), Some(law));
        let options = law.law().options();
        let defaults: Vec<f64> = options.iter().map(|option| option.default).collect();
        assert_eq!(law.law().option_values(), defaults, "{law:?}");
        for (k, option) in options.iter().enumerate() {
            assert!(options[..k].iter().all(|other| other.name != option.name), "{law:?}");
            assert_eq!((option.check(option.default), option.check(option.example)), (Ok(()), Ok(())));
        }
    }
}

#[test]
fn options_given_stand_behind_the_name() {
    let zmc = named("zmc").unwrap();
    let with = |options: &[(&str, f64)]| zmc.with_options(options).unwrap();
    assert_eq!(zmc.label(), "zmc");
    assert_eq!(with(&[("transition-ratio", 110.0)]).label(), "zmc(transition-ratio=110)");
    let both = with(&[("transition-ratio", 54.0), ("onset", 0.89)]);
    assert_eq!(both.label(), "zmc(onset=0.89 transition-ratio=54)");
    assert_eq!(both.law().option_values(), Zmc::new(0.89, 54.0).unwrap().option_values());
    assert_eq!(with(&[("transition-ratio", 54.0)]), zmc);
    assert_ne!(both, zmc);
    assert_ne!(named("elliptic-zmc").unwrap(), zmc);
    // One after the other as both at once.
    assert_eq!(with(&[("onset", 0.89)]).with_options(&[("transition-ratio", 54.0)]).unwrap(), both);
}

#[test]
fn options_that_cannot_be_set_are_refused() {
    let error = |law: &str, option, value| named(law).unwrap().with_options(&[(option, value)]).unwrap_err();
    for value in [1.0, f64::NAN, f64::INFINITY, -2.0] {
        let found = error("zmc", "transition-ratio", value);
        assert!(matches!(found, OptionError::OutOfRange { option: "transition-ratio", .. }), "{found}");
        assert!(found.to_string().contains("above 1"), "{found}");
    }
    let unknown = error("zmc", "ratio", 110.0).to_string();
    assert_eq!(unknown, "the key `ratio`; allowed: `onset` or `transition-ratio`");
    assert!(matches!(error("ceb", "ratio", 110.0), OptionError::NoOptions { .. }));
}

#[test]
fn facts_follow_from_the_law() {
    let names = |holds: fn(&ContactLaw) -> bool| -> Vec<String> {
        registry().iter().filter(|law| holds(law)).map(ContactLaw::name).collect()
    };
    assert_eq!(names(|law| !law.has_ranges()), ["hertz", "fully-plastic", "elliptic-hertz"]);
    assert_eq!(names(|law| !law.supports_layers()), ["jackson-green"]);
    assert_eq!(names(ContactLaw::is_greenwood_williamson), ["hertz"]);
    assert_eq!(names(ContactLaw::is_elliptic), ["elliptic-hertz", "elliptic-zmc"]);
}

#[test]
fn a_law_from_outside_is_one_like_the_others() {
    let body = Material::new(2e11, 0.3, Some(2e9), None).unwrap();
    let law = ContactLaw::scalable(Abrupt { onset: 1.0 }).with_options(&[("onset", 2.0)]).unwrap();
    assert_eq!((law.label(), law.has_ranges()), ("abrupt(onset=2)".to_owned(), true));
    let pair = Pair::between(law.law(), &body, &body).unwrap();
    assert!((law.law().jumps(&pair)[0] / jump(2.0) - 1.0).abs() < 1e-12);
}
