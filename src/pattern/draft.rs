//! A pattern file read and checked, up to the choice of a tiling.

use super::file::{PatternError, PatternFile};
use super::grammar::{Allowed, check};
use super::{Join, Parameter, Pattern, Rule, UnitKind};
use crate::tiling::UniformTiling;
use std::path::Path;

/// A pattern before it is said which of the tilings that its rules make is meant.
pub struct Draft {
    /// Its units.
    pub kinds: Vec<UnitKind>,
    /// How they connect.
    pub rules: Vec<Rule>,
    /// What the rules make.
    pub allowed: Allowed,
    file: PatternFile,
    figures: [Option<Parameter>; 2],
}

/// The turn of patterns that name none, degrees.
const USUAL_TURN: f64 = 20.0;

/// The slide of patterns that name none.
const STILL: Parameter = Parameter { usual: 0.0, safe: [0.0; 2] };

impl Draft {
    /// Reads a pattern file.
    ///
    /// # Errors
    /// [`PatternError`] with what is wrong in it, and where.
    pub fn read(file: &Path) -> Result<Self, PatternError> {
        let unreadable = |source| PatternError::Unreadable { file: file.to_path_buf(), source };
        Self::parse(&std::fs::read_to_string(file).map_err(unreadable)?)
    }

    /// Reads the text of a pattern file.
    ///
    /// # Errors
    /// [`PatternError`] with what is wrong in it, and where.
    pub fn parse(text: &str) -> Result<Self, PatternError> {
        let file: PatternFile = toml::from_str(text).map_err(Box::new)?;
        let kinds = file.kinds()?;
        let rules = file.rules(&kinds)?;
        all_in_use(&kinds, &rules)?;
        of_one_turn(&kinds, &rules)?;
        let figures = file.figures()?;
        if figures[0].is_some() && never_turned(&kinds) {
            let problem = "it turns nothing: every unit has its radius or is drawn by hand. Leave \
                           it out"
                .into();
            return Err(PatternError::Figure { key: "turn", problem });
        }
        let allowed = check(&kinds, &rules)?;
        Ok(Self { kinds, rules, allowed, file, figures })
    }

    /// The tiling that it asks for.
    pub fn tiling(&self) -> Option<&str> {
        self.file.tiling.as_deref()
    }

    /// The pattern on the tiling `cycle`, or else the one that the file names, or the only
    /// one that the rules make; `name` is for files that name none themselves.
    ///
    /// # Errors
    /// [`PatternError::Tiling`] where the rules do not make it, or it is not clear which.
    pub fn pattern(self, name: &str, cycle: Option<&str>) -> Result<Pattern, PatternError> {
        let tiling = self.allowed.choose(cycle.or(self.tiling()))?;
        let own = self.tiling().map_or(tiling, |own| UniformTiling::named(own).unwrap_or(tiling));
        let [turn, slide] = self.figures;
        let pattern = Pattern {
            name: self.file.name.unwrap_or_else(|| name.to_owned()),
            summary: self.file.summary.unwrap_or_else(|| plain_summary(own)),
            source: self.file.source.unwrap_or_default(),
            turn: turn.unwrap_or_else(|| usual_turn(&self.kinds, own)),
            slide: slide.unwrap_or(STILL),
            tiling: own,
            kinds: self.kinds,
            rules: self.rules,
        };
        Ok(pattern.moved_to(tiling))
    }
}

impl Pattern {
    /// Reads a pattern file; `cycle` names the tiling, where it is not to be the one that
    /// the file names.
    ///
    /// # Errors
    /// [`PatternError`] with what is wrong in it, and where.
    pub fn read(file: &Path, cycle: Option<&str>) -> Result<Self, PatternError> {
        let stem = file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        Draft::read(file)?.pattern(stem.trim_end_matches(".pattern"), cycle)
    }

    /// The pattern of a file's text; `name` is for those that name none themselves.
    ///
    /// # Errors
    /// [`PatternError`] with what is wrong in it, and where.
    pub fn parse(text: &str, name: &str) -> Result<Self, PatternError> {
        Self::parse_with(text, name, None)
    }

    /// The same, on the tiling `cycle` instead of the one that the file names.
    ///
    /// # Errors
    /// [`PatternError`] with what is wrong in it, and where.
    pub fn parse_with(text: &str, name: &str, cycle: Option<&str>) -> Result<Self, PatternError> {
        Draft::parse(text)?.pattern(name, cycle)
    }

    /// The same units and rules on another tiling that the rules make.
    ///
    /// # Errors
    /// [`PatternError::Tiling`] where they do not make it.
    pub fn on(&self, cycle: &str) -> Result<Self, PatternError> {
        let tiling = check(&self.kinds, &self.rules)?.choose(Some(cycle))?;
        Ok(self.clone().moved_to(tiling))
    }

    /// Turn and slide are safe on the tiling that they were found for; on another one they
    /// are what its vertices allow. The summary, too, is of that tiling.
    fn moved_to(self, tiling: &'static UniformTiling) -> Self {
        if self.tiling.name == tiling.name {
            return self;
        }
        let name = format!("{} as {}", self.name, tiling.name);
        let summary = plain_summary(tiling);
        let turn = usual_turn(&self.kinds, tiling);
        Self { name, summary, tiling, turn, slide: STILL, ..self }
    }
}

/// What a pattern looks like of which nobody has said it.
fn plain_summary(tiling: &UniformTiling) -> String {
    let sides: Vec<String> = tiling.polygons().iter().map(usize::to_string).collect();
    match &sides[..] {
        [one] => format!("units of {one} rods"),
        [first @ .., last] => format!("units of {} and {last} rods", first.join(", ")),
        [] => String::new(),
    }
}

/// Turns that are safe on a tiling, as far as its vertices tell: the more tiles there are
/// round one, the sooner rods meet there. Where no unit is turned, only its sign matters.
fn usual_turn(kinds: &[UnitKind], tiling: &UniformTiling) -> Parameter {
    if never_turned(kinds) {
        return Parameter { usual: USUAL_TURN, safe: [USUAL_TURN; 2] };
    }
    let triangles = tiling.polygons().contains(&3);
    let most = match tiling.configurations().map(|c| c.len()).max() {
        Some(0..=3) => 44.0,
        Some(4) if !triangles => 36.0,
        _ => 24.0,
    };
    Parameter { usual: USUAL_TURN, safe: [8.0, most] }
}

/// Whether a turn would change no unit: each has its radius, or is drawn by hand.
fn never_turned(kinds: &[UnitKind]) -> bool {
    kinds.iter().all(|k| k.radius.is_some() || !k.outer.is_empty())
}

/// A unit that no rule names would never be laid.
fn all_in_use(kinds: &[UnitKind], rules: &[Rule]) -> Result<(), PatternError> {
    let in_use = |kind: usize| rules.iter().flat_map(|r| r.slots).any(|s| s.kind == kind);
    match (0..kinds.len()).find(|&kind| !in_use(kind)) {
        None => Ok(()),
        Some(kind) => Err(PatternError::Unit {
            unit: kinds[kind].name.clone(),
            problem: "no rule uses it; add a rule, or leave the unit out".into(),
        }),
    }
}

/// A shared rod serves two units, so that all of a pattern are turned alike: none can have
/// a radius of its own.
fn of_one_turn(kinds: &[UnitKind], rules: &[Rule]) -> Result<(), PatternError> {
    for (i, rule) in rules.iter().enumerate().filter(|(_, r)| r.join == Join::Shared) {
        let kind = rule.slots.iter().map(|s| &kinds[s.kind]).find(|k| k.radius.is_some());
        if let Some(kind) = kind {
            let names = rule.slots.map(|s| kinds[s.kind].name.as_str());
            let problem = format!(
                "\"{}\" has a radius, but shares its rods: shared rods all have one turn, which \
                 gives the radius of every unit. Take the radius out, or join = \"end\" or \
                 \"rest\"",
                kind.name
            );
            let slots = names.join(" - ");
            return Err(PatternError::Rule { rule: i + 1, slots, problem });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of units with these sides, named a, b and so on, and rules between them.
    fn file(head: &str, units: &[&str], rules: &[&str]) -> String {
        let unit =
            |(name, rest): (char, &&str)| format!("[[units]]\nname = \"{name}\"\nsides = {rest}\n");
        let rule = |text: &&str| {
            let (slots, join) = text.split_once(": ").unwrap_or((text, "shared"));
            let (a, b) = slots.split_once('-').unwrap();
            format!("[[rules]]\nunits = [\"{a}\", \"{b}\"]\njoin = \"{join}\"\n")
        };
        let units: String = ('a'..).zip(units).map(unit).collect();
        let rules: String = rules.iter().map(rule).collect();
        format!("{head}\n{units}{rules}")
    }

    fn refused(text: &str) -> String {
        Pattern::parse(text, "mine").unwrap_err().to_string()
    }

    #[test]
    fn the_only_tiling_need_not_be_named() {
        let pattern = Pattern::parse(&file("", &["3", "6"], &["a-b"]), "mine").unwrap();
        assert_eq!((pattern.name.as_str(), pattern.tiling.name), ("mine", "3.6.3.6"));
        assert_eq!(pattern.turn, Parameter { usual: 20.0, safe: [8.0, 24.0] });
        assert_eq!(pattern.summary, "units of 3 and 6 rods");
        let message = refused(&file("", &["3", "4"], &["a-a", "a-b"]));
        assert!(message.contains("3.3.4.3.4") && message.contains("--cycle"), "{message}");
    }

    #[test]
    fn a_cycle_stands_before_the_tiling_of_the_file() {
        let head = "tiling = \"3.3.4.3.4\"\nturn = { usual = 15, safe = [10, 18] }";
        let text = file(head, &["3", "4"], &["a-a", "a-b"]);
        let own = Pattern::parse(&text, "mine").unwrap();
        assert_eq!((own.tiling.name, own.turn.usual), ("3.3.4.3.4", 15.0));
        let other = Pattern::parse_with(&text, "mine", Some("3.3.3.3.3.3")).unwrap();
        assert_eq!((other.name.as_str(), other.turn.usual), ("mine as 3.3.3.3.3.3", 20.0));
        assert_eq!(other.summary, "units of 3 rods");
        let same = own.on("3.3.3.3.3.3").unwrap();
        assert_eq!((&same.name, same.tiling.name), (&other.name, other.tiling.name));
        assert_eq!(own.on("3.3.4.3.4").unwrap().turn.usual, 15.0);
        let message = own.on("6.6.6").unwrap_err().to_string();
        assert!(message.contains("no rule is about a unit of 6 sides"), "{message}");
        // Where the file names no tiling, its turn is for every one.
        let free = text.replace("tiling = \"3.3.4.3.4\"", "");
        let free = Pattern::parse_with(&free, "mine", Some("3.3.3.3.3.3")).unwrap();
        assert_eq!((free.name.as_str(), free.turn.usual), ("mine", 15.0));
    }

    #[test]
    fn tilings_that_the_rules_do_not_make_are_refused() {
        let message = refused(&file("tiling = \"6.6.6\"", &["4"], &["a-a"]));
        assert!(message.contains("6.6.6") && message.ends_with("They make 4.4.4.4"), "{message}");
        let message = refused(&file("", &["5"], &["a-a"]));
        assert!(message.contains("432°"), "{message}");
    }

    #[test]
    fn units_without_a_rule_are_refused() {
        let message = refused(&file("", &["4", "8"], &["a-a"]));
        assert!(message.starts_with("unit \"b\": no rule uses it"), "{message}");
        let message = refused("units = []\nrules = []");
        assert!(message.contains("no rules"), "{message}");
    }

    #[test]
    fn shared_rods_have_no_radius_of_their_own() {
        let units = ["4\nradius = 0.3", "4"];
        let message = refused(&file("", &units, &["b-b: end", "a-b"]));
        assert!(message.starts_with("rule 2, a - b: \"a\" has a radius"), "{message}");
        let own_rods = file("", &units, &["a-b: end", "a-a: rest"]);
        assert_eq!(Pattern::parse(&own_rods, "").unwrap().kinds[0].radius, Some(0.3));
    }

    #[test]
    fn figures_that_contradict_themselves_are_refused() {
        for turn in ["{ usual = 30, safe = [8, 24] }", "{ usual = 20, safe = [8, inf] }"] {
            let message = refused(&file(&format!("turn = {turn}"), &["4"], &["a-a"]));
            assert!(message.starts_with("turn: the usual value"), "{message}");
        }
    }
}
