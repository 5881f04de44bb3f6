//! Which of the tilings that rules make is meant.

use super::{Allowed, written};
use crate::tiling::UniformTiling;
use thiserror::Error;

/// Why rules and a tiling do not go together.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum ChoiceError {
    /// No tiling has this name.
    #[error("there is no tiling {name}; the rules make {made}")]
    Unknown { name: String, made: String },
    /// The rules do not make the tiling that is named.
    #[error("the rules do not make the tiling {name}: {why}. They make {made}")]
    NotMade { name: String, why: String, made: String },
    /// They make more than one, and none is named.
    #[error(
        "the rules make {made}. Say which one is meant: with tiling = \"...\" in the file, or \
         with --cycle NAME"
    )]
    Several { made: String },
    /// Walks close round a vertex, but no tiling has only such vertices, or none can be laid.
    #[error("units can lie round a vertex as {cycles}, but make no tiling: {why}")]
    Nothing { cycles: String, why: String },
}

impl Allowed {
    /// The tiling of this name, or the only one where none is named.
    ///
    /// # Errors
    /// [`ChoiceError`] where the rules do not make it, or it is not clear which.
    pub fn choose(&self, name: Option<&str>) -> Result<&'static UniformTiling, ChoiceError> {
        let made = self.made();
        let Some(name) = name else {
            return match self.tilings[..] {
                [one] => Ok(one),
                [] => Err(ChoiceError::Nothing {
                    cycles: self.configurations().join(", "),
                    why: self.unlaid.first().map_or_else(
                        || "other vertices would have to lie between them".into(),
                        |(_, e)| e.to_string(),
                    ),
                }),
                _ => Err(ChoiceError::Several { made }),
            };
        };
        let Some(tiling) = UniformTiling::named(name) else {
            return Err(ChoiceError::Unknown { name: name.to_owned(), made });
        };
        match self.obstacle(tiling) {
            None => Ok(tiling),
            Some(why) => Err(ChoiceError::NotMade { name: name.to_owned(), why, made }),
        }
    }

    /// Why the rules do not make a tiling; `None` where they do.
    pub fn obstacle(&self, tiling: &UniformTiling) -> Option<String> {
        let found = self.configurations();
        let missing = tiling.configurations().find(|c| !found.contains(&written(c).as_str()));
        if let Some(missing) = missing {
            return Some(self.why_missing(&missing));
        }
        let unlaid = self.unlaid.iter().find(|(t, _)| t.name == tiling.name);
        unlaid.map(|(_, e)| e.to_string())
    }

    /// Why no walk closes with these polygons.
    fn why_missing(&self, configuration: &[usize]) -> String {
        let n = configuration.len();
        let pairs = (0..n).map(|i| {
            let (a, b) = (configuration[i], configuration[(i + 1) % n]);
            [a.min(b), a.max(b)]
        });
        let is_known = |sides: &&usize| self.meetings.iter().flatten().any(|m| m == *sides);
        let what = match (
            configuration.iter().find(|sides| !is_known(sides)),
            pairs.filter(|pair| !self.meetings.contains(pair)).min(),
        ) {
            (Some(sides), _) => format!("no rule is about a unit of {sides} sides"),
            (None, Some([a, b])) if a == b => format!("no rule joins two units of {a} sides"),
            (None, Some([a, b])) => {
                format!("no rule joins a unit of {a} sides to one of {b}")
            }
            (None, None) => "no walk closes so with the units and sides that are named".into(),
        };
        format!("it has vertices {}, but {what}", written(configuration))
    }

    /// The vertex configurations of the cycles, each once, in their order.
    pub fn configurations(&self) -> Vec<&str> {
        let mut all: Vec<&str> = self.cycles.iter().map(|c| c.configuration.as_str()).collect();
        all.dedup();
        all
    }

    /// The tilings in words.
    fn made(&self) -> String {
        let names: Vec<&str> = self.tilings.iter().map(|t| t.name).collect();
        if names.is_empty() { "no tiling".into() } else { names.join(", ") }
    }
}
