//! Conway's notation for polyhedra, with a geodesic frequency: `aI/2`.
//!
//! Letters are read from the right: the seed first, then one operator after the other.
//! The frequency after the slash divides the faces of the seed before any operator.
//!
//! | letter | what it does |
//! | --- | --- |
//! | T O C I D | seeds: tetrahedron, octahedron, cube, icosahedron, dodecahedron |
//! | d | dual |
//! | a | ambo: cut corners down to the middles of the edges |
//! | k, k5 | kis: a pyramid on every face, or on those of so many sides |
//! | g | gyro: pentagons, all turned one way |
//! | t, t5 | truncate: d k d, or only corners of so many edges |
//! | e | expand: a a |
//! | s | snub: d g d |
//! | j o m b n z | join d a d, ortho j j, meta k j, bevel t a, needle k d, zip d k |

use super::geodesic::divide;
use super::polyhedron::{Polyhedron, Seed};
use std::fmt;
use std::str::FromStr;

/// A polyhedron in Conway's notation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Notation {
    text: String,
    seed: Seed,
    frequency: usize,
    /// In the order in which they are applied.
    operators: Vec<Operator>,
}

/// An operator of which all others are made.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Operator {
    Dual,
    Ambo,
    Kis(Option<usize>),
    Gyro,
}

/// What is wrong with a notation, and at which letter.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{problem}\n  {text}\n  {:>place$}", '^', place = at + 1)]
pub struct NotationError {
    /// The notation as given.
    pub text: String,
    /// The letter at fault, counted from 0.
    pub at: usize,
    /// What is wrong with it.
    pub problem: String,
}

/// Most faces of a polyhedron: beyond, sticks are a thousandth of the span.
pub const MOST_FACES: usize = 50_000;

const OPERATORS: &str = "a b d e g j k m n o s t z";
const SEEDS: &str = "T O C I D";

impl FromStr for Notation {
    type Err = NotationError;

    fn from_str(text: &str) -> Result<Self, NotationError> {
        let letters: Vec<char> = text.chars().collect();
        let wrong = |at: usize, problem: String| NotationError { text: text.into(), at, problem };
        let mut operators = Vec::new();
        let mut at = 0;
        let seed = loop {
            let Some(&letter) = letters.get(at) else {
                return Err(wrong(at, format!("a seed is missing here: one of {SEEDS}")));
            };
            if let Some(seed) = seed(letter) {
                break seed;
            }
            let plain = operator(letter, None).ok_or_else(|| wrong(at, unknown(letter)))?;
            at += 1;
            let digits: String = letters[at..].iter().take_while(|c| c.is_ascii_digit()).collect();
            let parts = if digits.is_empty() {
                plain
            } else {
                let sides = sides(&digits).map_err(|problem| wrong(at, problem))?;
                operator(letter, Some(sides))
                    .ok_or_else(|| wrong(at, format!("{letter} takes no number; k and t do")))?
            };
            at += digits.len();
            operators.push(parts);
        };
        let frequency = frequency(&letters[at + 1..]).map_err(|problem| wrong(at + 1, problem))?;
        if seed == Seed::Dodecahedron && frequency > 1 {
            let problem = "a frequency divides triangles and squares, and D has pentagons: the \
                           dual of a divided icosahedron is dI/2, with operators before it";
            return Err(wrong(at, problem.into()));
        }
        let operators: Vec<Operator> = operators.into_iter().rev().flatten().collect();
        let notation = Self { text: text.into(), seed, frequency, operators };
        notation.check_size().map_err(|problem| wrong(0, problem))?;
        Ok(notation)
    }
}

fn seed(letter: char) -> Option<Seed> {
    Some(match letter {
        'T' => Seed::Tetrahedron,
        'O' => Seed::Octahedron,
        'C' => Seed::Cube,
        'I' => Seed::Icosahedron,
        'D' => Seed::Dodecahedron,
        _ => return None,
    })
}

fn unknown(letter: char) -> String {
    match letter {
        '/' => format!("a seed is missing before the slash: one of {SEEDS}"),
        _ => format!("{letter:?} is no operator ({OPERATORS}) and no seed ({SEEDS})"),
    }
}

/// The number after k or t.
fn sides(digits: &str) -> Result<usize, String> {
    let number = digits.parse().ok().filter(|n| (3..=1000).contains(n));
    number.ok_or_else(|| "a number of sides is from 3 to 1000".into())
}

/// The operator of a letter, in the order in which its parts are applied.
fn operator(letter: char, sides: Option<usize>) -> Option<Vec<Operator>> {
    use Operator::{Ambo, Dual, Gyro, Kis};
    let kis = Kis(sides);
    if sides.is_some() && !matches!(letter, 'k' | 't') {
        return None;
    }
    Some(match letter {
        'd' => vec![Dual],
        'a' => vec![Ambo],
        'k' => vec![kis],
        'g' => vec![Gyro],
        't' => vec![Dual, kis, Dual],
        'e' => vec![Ambo, Ambo],
        's' => vec![Dual, Gyro, Dual],
        'j' => vec![Ambo, Dual],
        'o' => vec![Ambo, Ambo, Dual],
        'm' => vec![Ambo, Dual, kis],
        'b' => vec![Ambo, Dual, kis, Dual],
        'n' => vec![Dual, kis],
        'z' => vec![kis, Dual],
        _ => return None,
    })
}

/// The frequency after the seed: nothing, or a slash and a whole number.
fn frequency(rest: &[char]) -> Result<usize, String> {
    let text: String = rest.iter().collect();
    if text.is_empty() {
        return Ok(1);
    }
    let Some(digits) = text.strip_prefix('/') else {
        return Err("nothing but a frequency such as /2 may follow the seed".into());
    };
    match digits.parse::<usize>() {
        Ok(n) if (1..=100).contains(&n) => Ok(n),
        _ => Err("a frequency is a whole number from 1 to 100".into()),
    }
}

impl Notation {
    /// The polyhedron. Only who borders on whom is exact; the places are rough.
    pub fn polyhedron(&self) -> Polyhedron {
        let seed = self.seed.polyhedron();
        // Dodecahedra with a frequency are refused when read; all other seeds divide.
        let start = divide(&seed, self.frequency).unwrap_or(seed);
        self.operators.iter().fold(start, |p, operator| match operator {
            Operator::Dual => p.dual(),
            Operator::Ambo => p.ambo(),
            Operator::Kis(sides) => p.kis(*sides),
            Operator::Gyro => p.gyro(),
        })
    }

    /// Follows the counts of vertices, edges and faces through the operators.
    fn check_size(&self) -> Result<(), String> {
        let p = self.seed.polyhedron();
        let f2 = self.frequency * self.frequency;
        let (mut e, mut f) = (p.net().edges.len() * f2, p.faces.len() * f2);
        let mut v = e + 2 - f;
        for operator in &self.operators {
            (v, e, f) = match operator {
                Operator::Dual => (f, e, v),
                Operator::Ambo => (e, 2 * e, f + v),
                // At most, where only some faces are raised.
                Operator::Kis(_) => (v + f, 3 * e, 2 * e),
                Operator::Gyro => (v + f + 2 * e, 5 * e, 2 * e),
            };
            if f.max(v) > MOST_FACES {
                return Err(format!(
                    "the polyhedron would have more than {MOST_FACES} faces or corners: take a \
                     lower frequency or fewer operators"
                ));
            }
        }
        if f > MOST_FACES {
            return Err(format!("the polyhedron would have {f} faces, more than {MOST_FACES}"));
        }
        Ok(())
    }
}

impl fmt::Display for Notation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(notation: &str) -> [usize; 3] {
        let p = notation.parse::<Notation>().expect(notation).polyhedron();
        [p.vertices.len(), p.net().edges.len(), p.faces.len()]
    }

    #[test]
    fn archimedean_solids_have_their_counts() {
        let cases = [
            ("aC", [12, 24, 14]),
            ("aD", [30, 60, 32]),
            ("tT", [12, 18, 8]),
            ("tI", [60, 90, 32]),
            ("eC", [24, 48, 26]),
            ("bD", [120, 180, 62]),
            ("sC", [24, 60, 38]),
            ("sD", [60, 150, 92]),
            ("gD", [92, 150, 60]),
            ("oC", [26, 48, 24]),
            ("mC", [26, 72, 48]),
            ("jC", [14, 24, 12]),
            ("nC", [14, 36, 24]),
            ("zC", [24, 36, 14]),
            ("I/3", [92, 270, 180]),
            ("dI/3", [180, 270, 92]),
            ("aI/2", [120, 240, 122]),
            ("C/3", [56, 108, 54]),
            ("k5aD", [42, 120, 80]),
            ("t5I", [60, 90, 32]),
        ];
        for (notation, wanted) in cases {
            assert_eq!(counts(notation), wanted, "{notation}");
        }
    }

    #[test]
    fn mistakes_are_shown_at_their_letter() {
        let cases = [
            ("axI", 1, "'x' is no operator"),
            ("ad", 2, "a seed is missing here"),
            ("", 0, "a seed is missing here"),
            ("a/2", 1, "a seed is missing before the slash"),
            ("aIk", 2, "nothing but a frequency"),
            ("aI/0", 2, "a whole number from 1 to 100"),
            ("aI/x", 2, "a whole number from 1 to 100"),
            ("aI/", 2, "a whole number from 1 to 100"),
            ("d5I", 1, "d takes no number"),
            ("k2I", 1, "from 3 to 1000"),
            ("kD/2", 1, "dI/2"),
            ("gggggI", 0, "more than 50000"),
            ("I/80", 0, "128000 faces"),
        ];
        for (text, at, problem) in cases {
            let error = text.parse::<Notation>().expect_err(text);
            assert_eq!(error.at, at, "{text}: {error}");
            assert!(error.problem.contains(problem), "{text}: {error}");
        }
        let shown = "axI".parse::<Notation>().expect_err("x").to_string();
        assert!(shown.ends_with("\n  axI\n   ^"), "{shown}");
    }
}
