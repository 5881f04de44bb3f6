//! How things are painted: colours, strokes, dashes, text weight.

use std::fmt;

/// An opaque colour, red, green and blue from 0 to 255.
///
/// On white paper the named colours are those of the Okabe-Ito palette that stay
/// readable there, told apart by people with any kind of colour vision.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Color {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
}

impl Color {
    /// Black, `000000`.
    pub const BLACK: Self = Self::rgb(0x00, 0x00, 0x00);
    /// Okabe-Ito blue, `0072B2`.
    pub const BLUE: Self = Self::rgb(0x00, 0x72, 0xB2);
    /// Okabe-Ito vermillion, `D55E00`.
    pub const VERMILLION: Self = Self::rgb(0xD5, 0x5E, 0x00);
    /// Okabe-Ito bluish green, `009E73`.
    pub const GREEN: Self = Self::rgb(0x00, 0x9E, 0x73);
    /// Okabe-Ito reddish purple, `CC79A7`.
    pub const PURPLE: Self = Self::rgb(0xCC, 0x79, 0xA7);
    /// White, for what must cover other items.
    pub const WHITE: Self = Self::rgb(0xFF, 0xFF, 0xFF);
    /// Dark grey, `555555`: secondary text.
    pub const DARK_GREY: Self = Self::rgb(0x55, 0x55, 0x55);
    /// Middle grey, `808080`: what is already there.
    pub const GREY: Self = Self::rgb(0x80, 0x80, 0x80);
    /// Light grey, `CCCCCC`: guides.
    pub const LIGHT_GREY: Self = Self::rgb(0xCC, 0xCC, 0xCC);
    /// Pale grey, `EEEEEE`: filled backgrounds.
    pub const PALE_GREY: Self = Self::rgb(0xEE, 0xEE, 0xEE);

    /// A colour from its three parts.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b }
    }

    /// A grey: 0 is black, 255 is white.
    pub const fn grey(level: u8) -> Self {
        Self::rgb(level, level, level)
    }

    /// One of the three parts, 0 to 255 in sRGB, as light from 0 to 1 (IEC 61966-2-1).
    pub fn linear_part(part: u8) -> f64 {
        let c = f64::from(part) / 255.0;
        if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    }

    /// The colour mixed with white: `share` 1 leaves it, 0 gives white.
    pub fn tint(self, share: f64) -> Self {
        let mix = |c: u8| (255.0 - (255.0 - f64::from(c)) * share.clamp(0.0, 1.0)).round() as u8;
        Self::rgb(mix(self.r), mix(self.g), mix(self.b))
    }
}

/// As in CSS and SVG: `#0072B2`.
impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02X}{:02X}{:02X}", self.r, self.g, self.b)
    }
}

/// How the ends of a line look.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Cap {
    /// Cut off square at the end point. Corners are mitred.
    #[default]
    Butt,
    /// A half disc around the end point. Corners are round too.
    Round,
    /// Cut off square half a line width beyond the end point. Corners are mitred.
    Square,
}

/// Lengths of dashes and gaps in turn, mm; at most three pairs.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Dash {
    lengths: [f64; 6],
    count: usize,
}

impl Dash {
    /// An unbroken line.
    pub const SOLID: Self = Self { lengths: [0.0; 6], count: 0 };
    /// Short dashes.
    pub const DASHED: Self = Self::new([2.0, 1.0]);
    /// Long dashes.
    pub const LONG: Self = Self::new([5.0, 1.5]);
    /// Dots.
    pub const DOTTED: Self = Self::new([0.4, 0.8]);
    /// Dash and dot, as centre lines are drawn.
    pub const DASH_DOT: Self = Self::new([4.0, 1.0, 0.6, 1.0]);
    /// Dash and two dots.
    pub const DASH_DOT_DOT: Self = Self::new([4.0, 1.0, 0.6, 1.0, 0.6, 1.0]);

    /// Dash, gap, dash, gap … in mm: one, two or three pairs (checked when compiled).
    pub const fn new<const N: usize>(lengths: [f64; N]) -> Self {
        const { assert!(N.is_multiple_of(2) && N <= 6, "dashes come in one to three pairs") };
        let mut all = [0.0; 6];
        let mut i = 0;
        while i < N {
            all[i] = lengths[i];
            i += 1;
        }
        Self { lengths: all, count: N }
    }

    /// Dash, gap, dash, gap …, mm. Empty for an unbroken line.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths[..self.count]
    }

    /// The same pattern, longer or shorter.
    pub fn scaled(self, factor: f64) -> Self {
        Self { lengths: self.lengths.map(|l| l * factor), ..self }
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stroke {
    /// Line width, mm.
    pub width: f64,
    /// Line colour.
    pub color: Color,
    /// Dashes.
    pub dash: Dash,
    /// Ends and corners.
    pub cap: Cap,
}

impl Stroke {
    /// An unbroken black line of this width in mm.
    pub const fn new(width: f64) -> Self {
        Self { width, color: Color::BLACK, dash: Dash::SOLID, cap: Cap::Butt }
    }

    /// In another colour.
    pub const fn color(self, color: Color) -> Self {
        Self { color, ..self }
    }

    /// With dashes.
    pub const fn dash(self, dash: Dash) -> Self {
        Self { dash, ..self }
    }

    /// With other ends.
    pub const fn cap(self, cap: Cap) -> Self {
        Self { cap, ..self }
    }

    /// With round ends and corners.
    pub const fn round(self) -> Self {
        self.cap(Cap::Round)
    }

    /// This line around an area filled with `color`.
    pub const fn fill(self, color: Color) -> Paint {
        Paint { stroke: Some(self), fill: Some(color) }
    }
}

/// Outline and filling of a figure. Builders take anything that becomes a `Paint`:
/// a [`Stroke`] alone, a [`Color`] alone (filled, no outline), or
/// `Stroke::new(0.2).fill(Color::WHITE)`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Paint {
    /// The outline; none if the figure is only filled.
    pub stroke: Option<Stroke>,
    /// The filling; none if the figure is only outlined.
    pub fill: Option<Color>,
}

impl From<Stroke> for Paint {
    fn from(stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), fill: None }
    }
}

impl From<Color> for Paint {
    fn from(fill: Color) -> Self {
        Self { stroke: None, fill: Some(fill) }
    }
}

/// How heavy letters are.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Weight {
    /// Plain letters.
    #[default]
    Regular,
    /// Bold letters.
    Bold,
}

impl fmt::Display for Weight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Regular => "regular",
            Self::Bold => "bold",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tint_runs_from_white_to_the_colour() {
        assert_eq!(Color::BLUE.tint(0.0), Color::WHITE);
        assert_eq!(Color::BLUE.tint(1.0), Color::BLUE);
        assert_eq!(Color::BLACK.tint(0.5), Color::grey(128));
        assert_eq!(Color::BLUE.to_string(), "#0072B2");
    }

    #[test]
    fn dash_keeps_as_many_lengths_as_given() {
        assert_eq!(Dash::new([3.0, 1.0]).scaled(2.0).lengths(), [6.0, 2.0]);
        assert!(Dash::SOLID.lengths().is_empty());
    }
}
