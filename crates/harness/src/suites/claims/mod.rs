//! Claims: what the papers say, the rule that decides whether it holds here, and the table of all.
//!
//! A claim is data. It says which paper makes it where, in our words; a [`Rule`] measures a number of
//! the figure that the claim stands under and compares it with a limit, for which the claim gives
//! the reason. The verdict is *holds*, *does not hold*, *undecided* where the limit lies within the
//! noise, or *holds only for* some cases. Nothing else is said about a figure, so no sentence on a
//! page is without a rule.
//!
//! The tests make up numbers for each claim of each suite: for each rule some with which it holds,
//! some with which it does not, and, where it reads anything noisy, some with which it is undecided.

pub mod make;
mod numbers;
mod rule;
mod unjudged;

#[cfg(test)]
mod tests;

pub use numbers::{
    EVERY, Interval, Noise, Numbers, Pick, Place, Term, Which, at, each, first, last, of,
};
pub use rule::{Case, Finding, Limit, Measure, Rule, Shown, Verdict};
pub use unjudged::UNJUDGED;

/// Something that can turn out true or not.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Who says so.
    pub paper: Paper,
    /// Where, such as `4.3`.
    pub section: &'static str,
    /// What, in our words: a whole sentence.
    pub says: &'static str,
    /// What decides.
    pub rule: Rule,
    /// Why the limit is where it is: a whole sentence.
    pub why: &'static str,
}

/// Who makes a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Paper {
    /// The bachelor's thesis of 2013.
    Szabo2013,
    /// The paper at CESCG.
    SzaboCescg,
    /// The paper of 2005.
    Estalella2005,
    /// The master's thesis of 2017.
    Ciz2017,
    /// This project: not published elsewhere.
    Ours,
}

impl Paper {
    /// As it is cited.
    pub fn name(self) -> &'static str {
        match self {
            Self::Szabo2013 => "Szabo 2013",
            Self::SzaboCescg => "Szabo CESCG",
            Self::Estalella2005 => "Estalella et al. 2005",
            Self::Ciz2017 => "Číž 2017",
            Self::Ours => "this project",
        }
    }
}

impl Verdict {
    /// In words.
    pub fn words(&self) -> String {
        match self {
            Self::Holds => "holds".to_owned(),
            Self::DoesNotHold => "does not hold".to_owned(),
            Self::Undecided => "undecided".to_owned(),
            Self::OnlyIf(cases) => format!("holds only for {}", cases.join("; ")),
        }
    }

    /// The same in one word, for styles and for programs.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::DoesNotHold => "does-not-hold",
            Self::Undecided => "undecided",
            Self::OnlyIf(_) => "only-if",
        }
    }
}

impl Claim {
    /// Who says it where.
    pub fn source(&self) -> String {
        match self.section {
            "" => self.paper.name().to_owned(),
            section => format!("{}, {section}", self.paper.name()),
        }
    }
}
