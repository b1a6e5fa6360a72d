//! Why the models differ, and why they differ from the reference.

use crate::compare::{
    Cause, ComparedQuantity, Contribution, Contributions, Estimate, Stretch, Verdict, largest, leading,
};

use super::verdicts::Verdicts;

/// The cause that contributes most to a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeadingCause {
    /// One between the statistical and the deterministic model.
    Between(Cause),
    /// What the sum leaves out beside the reference: interaction and shape of the asperities, under a cap also the law, and under a
    /// layer also the rule of the effective modulus.
    LeftOut,
}

impl LeadingCause {
    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Between(cause) => cause.name(),
            Self::LeftOut => "left-out",
        }
    }

    /// The name in sentences.
    pub fn label(self) -> &'static str {
        match self {
            Self::Between(cause) => cause.label(),
            Self::LeftOut => "what the sum leaves out",
        }
    }
}

/// What can be said of the cause of a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatedCause {
    /// It leads: its 95 % interval is apart from those of all others.
    Leading(LeadingCause),
    /// None leads, but on the one surface that was compared this is the largest in every order of replacement.
    LargestOnSurface(LeadingCause),
}

impl StatedCause {
    /// The cause that leads.
    pub fn leading(self) -> Option<LeadingCause> {
        if let Self::Leading(cause) = self { Some(cause) } else { None }
    }

    /// The largest cause on this surface, where none leads.
    pub fn largest_on_surface(self) -> Option<LeadingCause> {
        if let Self::LargestOnSurface(cause) = self { Some(cause) } else { None }
    }
}

impl Verdicts {
    /// The contributions to the difference between the models in a quantity at a load (Pa).
    pub fn contributions(&self, quantity: ComparedQuantity, load: f64) -> Option<&Contributions> {
        self.attribution.iter().find(|at| at.load == load)?.contributions(quantity)
    }

    /// The loads of the admissible range at which a quantity is divided, by growing load, with the contributions.
    pub fn divided(&self, quantity: ComparedQuantity) -> impl Iterator<Item = (f64, &Contributions)> {
        let is_admissible =
            |load: f64| self.differences.iter().any(|at| at.load == load && at.exceeded().is_none());
        let divided =
            self.attribution.iter().filter_map(move |at| Some((at.load, at.contributions(quantity)?)));
        divided.filter(move |(load, _)| is_admissible(*load))
    }

    /// The cause of the largest difference of a stretch between the models, unless it is known to be within what is accepted.
    pub fn cause(&self, stretch: &Stretch) -> Option<StatedCause> {
        let (_, parts) = self.largest_divided(stretch)?;
        let causes = Cause::ALL.map(|cause| (LeadingCause::Between(cause), *parts.of_cause(cause)));
        self.stated(&parts.total, &causes)
    }

    /// The part of a difference that leads, or that is the largest on the one surface that was compared; none on one that is not fit.
    fn stated(&self, total: &Estimate, parts: &[(LeadingCause, Contribution)]) -> Option<StatedCause> {
        if self.is_blocked {
            return None;
        }
        let on_surface =
            || largest(total, parts).filter(|_| self.has_one_surface()).map(StatedCause::LargestOnSurface);
        leading(total, parts).map(StatedCause::Leading).or_else(on_surface)
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

    /// The same of a stretch of the statistical model against the reference. The difference of the sum is not divided: all of it is
    /// what the sum leaves out.
    pub fn cause_against_reference(&self, stretch: &Stretch) -> Option<StatedCause> {
        let (load, total) = stretch.largest.filter(|_| stretch.verdict != Verdict::Within)?;
        let missed = (LeadingCause::LeftOut, self.missed(stretch.quantity, load)?.into());
        let between = self.contributions(stretch.quantity, load)?;
        let causes = Cause::ALL.map(|cause| (LeadingCause::Between(cause), *between.of_cause(cause)));
        self.stated(&total, &std::iter::once(missed).chain(causes).collect::<Vec<_>>())
    }

    /// The sum minus the reference at a load (Pa), where both are there.
    pub fn missed(&self, quantity: ComparedQuantity, load: f64) -> Option<Estimate> {
        let sum = &self.reference.as_ref()?.against.models[1];
        sum.iter().find(|at| at.load == load)?.estimates[quantity as usize]
    }
}
