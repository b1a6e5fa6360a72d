//! Why the models differ, and why they differ from the reference.

use crate::compare::{
    Cause, ComparedQuantity, Contributions, Estimate, ModelKind, Stretch, Verdict, leading,
};

use super::verdicts::Verdicts;

/// The cause that contributes most to a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeadingCause {
    /// One between the statistical and the deterministic model.
    Between(Cause),
    /// What the sum leaves out beside the reference: interaction and shape of the asperities.
    Interaction,
}

impl LeadingCause {
    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Between(cause) => cause.name(),
            Self::Interaction => "interaction",
        }
    }

    /// The name in sentences.
    pub fn label(self) -> &'static str {
        match self {
            Self::Between(cause) => cause.label(),
            Self::Interaction => "what the sum leaves out",
        }
    }
}

impl Verdicts {
    /// The contributions to the difference between the models in a quantity at a load (Pa).
    pub fn contributions(&self, quantity: ComparedQuantity, load: f64) -> Option<&Contributions> {
        self.attribution.iter().find(|at| at.load == load)?.contributions(quantity)
    }

    /// The loads of the valid range at which a quantity is divided, by growing load, with the contributions.
    pub fn divided(&self, quantity: ComparedQuantity) -> impl Iterator<Item = (f64, &Contributions)> {
        let is_valid =
            |load: f64| self.differences.iter().any(|at| at.load == load && at.exceeded().is_none());
        let divided =
            self.attribution.iter().filter_map(move |at| Some((at.load, at.contributions(quantity)?)));
        divided.filter(move |(load, _)| is_valid(*load))
    }

    /// The leading cause of the largest difference of a stretch, unless it is known to be within what is accepted.
    pub fn cause(&self, stretch: &Stretch) -> Option<LeadingCause> {
        let (_, parts) = self.largest_divided(stretch)?;
        parts.leading().map(LeadingCause::Between)
    }

    /// The load of the largest difference of a stretch that is divided, with the contributions; `None` where the stretch is within
    /// what is accepted. With several realisations the largest difference of all may be at a load that not all of them divide.
    fn largest_divided(&self, stretch: &Stretch) -> Option<(f64, &Contributions)> {
        if stretch.verdict == Verdict::Within {
            return None;
        }
        let [from, to] = stretch.loads;
        let in_stretch = self.divided(stretch.quantity).filter(|(load, _)| (from..=to).contains(load));
        in_stretch.max_by(|a, b| a.1.gap().abs().total_cmp(&b.1.gap().abs()))
    }

    /// The same of a stretch of a model against the reference.
    pub fn cause_against_reference(&self, model: ModelKind, stretch: &Stretch) -> Option<LeadingCause> {
        let (load, _) = stretch.largest.filter(|_| stretch.verdict != Verdict::Within)?;
        if model == ModelKind::Deterministic {
            return Some(LeadingCause::Interaction);
        }
        let missed = self.missed(stretch.quantity, load)?;
        let between = self.contributions(stretch.quantity, load)?;
        let mut parts = vec![(LeadingCause::Interaction, missed)];
        parts.extend(
            Cause::ALL.map(|cause| (LeadingCause::Between(cause), between.estimates[cause as usize])),
        );
        leading(&parts)
    }

    /// The sum minus the reference at a load (Pa), where both are there.
    pub fn missed(&self, quantity: ComparedQuantity, load: f64) -> Option<Estimate> {
        let sum = &self.reference.as_ref()?.against.models[1];
        sum.iter().find(|at| at.load == load)?.estimates[quantity as usize]
    }
}
