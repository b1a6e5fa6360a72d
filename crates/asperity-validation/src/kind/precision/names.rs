//! Names of quadrature rules and summation methods, in reports and tables.

use super::findings::Candidate;
use crate::precision::integral::{Effort, Family, Rule};
use asperity_framework::report::format::input_number;

/// Name of a rule or a summation method.
pub fn candidate_name(candidate: &Candidate) -> String {
    match candidate {
        Candidate::Rule(rule) => rule_name(rule),
        Candidate::Way(way) => way.name().to_owned(),
    }
}

/// Name of a rule with its order or tolerance.
pub fn rule_name(rule: &Rule) -> String {
    let family = match (rule.family, rule.split) {
        (Family::Laguerre, true) => "gauss-laguerre behind gauss-legendre",
        (family, _) => family.name(),
    };
    let effort = match rule.effort {
        Effort::Order(order) => format!(", order {order}"),
        Effort::Tolerance(tolerance) => format!(", tolerance {}", input_number(tolerance)),
        Effort::Fixed => String::new(),
    };
    let used = match (rule.family, rule.split, rule.substituted) {
        (Family::Shipped | Family::Panels | Family::Jacobi | Family::Laguerre | Family::Hermite, ..) => "",
        (_, true, true) => ", split and substituted",
        (_, true, false) => ", split",
        (_, false, true) => ", substituted",
        (_, false, false) => ", as it is",
    };
    format!("{family}{used}{effort}")
}
