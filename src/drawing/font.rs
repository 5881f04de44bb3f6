//! The one font family of all papers, and how long its lines are.
//!
//! DejaVu Sans Condensed, regular and bold, is part of the program: the same
//! letters and widths on every machine. Widths are sums of the font's own advances
//! without kerning, which is how the PDF sets them; the SVG asks its viewer for the
//! same length. Each character must have a glyph of its own: there is no shaping,
//! so scripts that need it (Arabic, Devanagari …) are not set properly.

use std::collections::HashMap;
use std::fmt::Display;
use std::sync::LazyLock;

use allsorts::binary::read::ReadScope;
use allsorts::font::read_cmap_subtable;
use allsorts::font_data::FontData;
use allsorts::subset::{CmapTarget, SubsetProfile, subset};
use allsorts::tables::cmap::Cmap;
use allsorts::tables::{FontTableProvider, HeadTable, HheaTable, HmtxTable, MaxpTable};
use allsorts::tag;

use super::{DrawingError, Weight};

/// Height of a capital as a share of the font size.
pub const CAP_HEIGHT: f64 = 0.729;
/// How far the highest letters reach above the baseline, as a share of the font size.
pub const ASCENT: f64 = 0.928;
/// How far the lowest letters reach below the baseline, as a share of the font size.
pub const DESCENT: f64 = 0.236;
/// Baselines of body text lie this many font sizes apart.
pub const LEADING: f64 = 1.25;

/// Family names for SVG: ours where it is installed, else something close.
pub(super) const SVG_FAMILIES: &str = "DejaVu Sans Condensed, DejaVu Sans, Arial, sans-serif";

const REGULAR_TTF: &[u8] = include_bytes!("../../assets/fonts/DejaVuSansCondensed.ttf");
const BOLD_TTF: &[u8] = include_bytes!("../../assets/fonts/DejaVuSansCondensed-Bold.ttf");

/// What is read from a font file once: which glyph a character has, how wide it is.
struct Face {
    glyphs: HashMap<char, u16>,
    advances: Vec<u16>,
    units_per_em: f64,
}

static REGULAR: LazyLock<Result<Face, String>> = LazyLock::new(|| Face::read(REGULAR_TTF));
static BOLD: LazyLock<Result<Face, String>> = LazyLock::new(|| Face::read(BOLD_TTF));

impl Face {
    fn of(weight: Weight) -> Result<&'static Self, DrawingError> {
        let face = match weight {
            Weight::Regular => &REGULAR,
            Weight::Bold => &BOLD,
        };
        face.as_ref().map_err(|reason| DrawingError::Font { weight, reason: reason.clone() })
    }

    fn read(ttf: &[u8]) -> Result<Self, String> {
        let font = ReadScope::new(ttf).read::<FontData<'_>>().map_err(say)?;
        let tables = font.table_provider(0).map_err(say)?;
        let table = |t| tables.read_table_data(t).map_err(say);

        let head = ReadScope::new(&table(tag::HEAD)?).read::<HeadTable>().map_err(say)?;
        let maxp = ReadScope::new(&table(tag::MAXP)?).read::<MaxpTable>().map_err(say)?;
        let hhea = ReadScope::new(&table(tag::HHEA)?).read::<HheaTable>().map_err(say)?;
        let counts = (usize::from(maxp.num_glyphs), usize::from(hhea.num_h_metrics));
        let hmtx_data = table(tag::HMTX)?;
        let hmtx = ReadScope::new(&hmtx_data).read_dep::<HmtxTable<'_>>(counts).map_err(say)?;
        let advances = (0..maxp.num_glyphs)
            .map(|glyph| hmtx.horizontal_advance(glyph).map_err(say))
            .collect::<Result<_, _>>()?;

        let cmap_data = table(tag::CMAP)?;
        let cmap = ReadScope::new(&cmap_data).read::<Cmap<'_>>().map_err(say)?;
        let (_, mapping) =
            read_cmap_subtable(&cmap).map_err(say)?.ok_or("no table of characters")?;
        let mut glyphs = HashMap::new();
        mapping
            .mappings_fn(|code, glyph| {
                if let (Some(c), true) = (char::from_u32(code), glyph != 0) {
                    glyphs.insert(c, glyph);
                }
            })
            .map_err(say)?;
        Ok(Self { glyphs, advances, units_per_em: f64::from(head.units_per_em) })
    }

    /// Advance of a glyph as a share of the font size.
    fn advance(&self, glyph: u16) -> f64 {
        self.advances.get(usize::from(glyph)).map_or(0.0, |&a| f64::from(a)) / self.units_per_em
    }
}

fn say(error: impl Display) -> String {
    error.to_string()
}

/// The glyph of each character, in order.
pub(super) fn glyphs(string: &str, weight: Weight) -> Result<Vec<u16>, DrawingError> {
    let face = Face::of(weight)?;
    let missing =
        |character| DrawingError::MissingGlyph { character, text: string.to_owned(), weight };
    string.chars().map(|c| face.glyphs.get(&c).copied().ok_or_else(|| missing(c))).collect()
}

/// Advances of glyphs of the full font, as shares of the font size.
pub(super) fn advances(glyphs: &[u16], weight: Weight) -> Result<Vec<f64>, DrawingError> {
    let face = Face::of(weight)?;
    Ok(glyphs.iter().map(|&g| face.advance(g)).collect())
}

/// Length of a line of text, mm, at a font size in mm.
pub fn text_width(string: &str, size: f64, weight: Weight) -> Result<f64, DrawingError> {
    let face = Face::of(weight)?;
    Ok(glyphs(string, weight)?.into_iter().map(|g| face.advance(g)).sum::<f64>() * size)
}

/// The largest font size, at most `size`, at which the text is no longer than `room` mm.
pub fn fit_size(string: &str, size: f64, weight: Weight, room: f64) -> Result<f64, DrawingError> {
    let width = text_width(string, size, weight)?;
    Ok(if width > room { size * room / width } else { size })
}

/// The text, cut short with `…` where it is longer than `room` mm.
pub fn elide(string: &str, size: f64, weight: Weight, room: f64) -> Result<String, DrawingError> {
    let mut short = string.to_owned();
    if text_width(&short, size, weight)? <= room {
        return Ok(short);
    }
    while short.pop().is_some() {
        let cut = format!("{}…", short.trim_end());
        if text_width(&cut, size, weight)? <= room {
            return Ok(cut);
        }
    }
    Ok(short)
}

/// The text broken at spaces into lines no longer than `room` mm; line breaks in it
/// stay. A word that is longer than the room has a line of its own and sticks out.
pub fn wrap(
    string: &str,
    size: f64,
    weight: Weight,
    room: f64,
) -> Result<Vec<String>, DrawingError> {
    let space = text_width(" ", size, weight)?;
    let mut lines = Vec::new();
    for paragraph in string.lines() {
        let (mut line, mut length) = (String::new(), 0.0);
        for word in paragraph.split(' ').filter(|w| !w.is_empty()) {
            let width = text_width(word, size, weight)?;
            if line.is_empty() {
                (line, length) = (word.to_owned(), width);
            } else if length + space + width <= room {
                line.push(' ');
                line.push_str(word);
                length += space + width;
            } else {
                lines.push(std::mem::replace(&mut line, word.to_owned()));
                length = width;
            }
        }
        lines.push(line);
    }
    Ok(lines)
}

/// A font file with only the given glyphs, for embedding. Its glyph 0 is the empty
/// box that every font begins with, then follow those of `glyphs` (sorted, without
/// repeats, without 0) in order.
pub(super) fn subset_ttf(weight: Weight, glyphs: &[u16]) -> Result<Vec<u8>, DrawingError> {
    let ttf = match weight {
        Weight::Regular => REGULAR_TTF,
        Weight::Bold => BOLD_TTF,
    };
    let cut = || -> Result<Vec<u8>, String> {
        let font = ReadScope::new(ttf).read::<FontData<'_>>().map_err(say)?;
        let tables = font.table_provider(0).map_err(say)?;
        let kept: Vec<u16> = std::iter::once(0).chain(glyphs.iter().copied()).collect();
        subset(&tables, &kept, &SubsetProfile::Pdf, CmapTarget::Unicode).map_err(say)
    };
    cut().map_err(|reason| DrawingError::Font { weight, reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_is_the_sum_of_advances() {
        // Advances in 2048ths of the font size, read from the file's hmtx table.
        let units = |c: &str| text_width(c, 2048.0, Weight::Regular).expect("in the font");
        assert_eq!(units("R") + units("0") + units("1"), units("R01"));
        assert_eq!(units(""), 0.0);
        let digits: Vec<f64> = "0123456789".chars().map(|c| units(&c.to_string())).collect();
        assert!(digits.iter().all(|&d| d == digits[0]), "figures align in columns");
        assert!(units("W") > units("i"));
    }

    #[test]
    fn width_grows_with_size_and_weight() {
        let regular = text_width("R012", 3.0, Weight::Regular).expect("in the font");
        assert!(
            (text_width("R012", 6.0, Weight::Regular).expect("same") - 2.0 * regular).abs() < 1e-12
        );
        assert!(text_width("R012", 3.0, Weight::Bold).expect("in the font") > regular);
    }

    #[test]
    fn workshop_signs_have_glyphs_in_both_weights() {
        let signs = "Ø ± ∠ ° × ▲ △ ▶ ◆ ● ○ → ← ↑ ↓ ↺ ↻ ≤ ≥ ≈ − – — … · µ ½ ¼ ″ ′ ✓ äöüß éè";
        for weight in [Weight::Regular, Weight::Bold] {
            glyphs(signs, weight).unwrap_or_else(|e| panic!("{e}"));
        }
    }

    #[test]
    fn missing_glyph_is_an_error_that_names_it() {
        let error = text_width("a猫", 3.0, Weight::Bold).expect_err("no Chinese in DejaVu");
        assert_eq!(error.to_string(), "no bold glyph for '猫' (U+732B) in \"a猫\"");
        assert!(text_width("a\nb", 3.0, Weight::Regular).is_err(), "a line break is no glyph");
    }

    #[test]
    fn elided_text_fits() {
        let long = "a name that is much longer than the card";
        for room in [5.0, 10.0, 20.0, 30.0] {
            let cut = elide(long, 3.0, Weight::Regular, room).expect("in the font");
            assert!(cut.ends_with('…'));
            assert!(text_width(&cut, 3.0, Weight::Regular).expect("in the font") <= room);
        }
        assert_eq!(elide("short", 3.0, Weight::Regular, 50.0).expect("in the font"), "short");
        assert_eq!(elide("short", 3.0, Weight::Regular, 0.1).expect("in the font"), "");
    }

    #[test]
    fn fitted_size_fills_the_room() {
        let size = fit_size("R012", 100.0, Weight::Bold, 20.0).expect("in the font");
        let width = text_width("R012", size, Weight::Bold).expect("in the font");
        assert!((width - 20.0).abs() < 1e-9);
        assert_eq!(fit_size("R012", 3.0, Weight::Bold, 20.0).expect("in the font"), 3.0);
    }

    #[test]
    fn wrapped_lines_fit_and_keep_their_words() {
        let text = "lift the rod on the left  and slide\nthe new one under";
        let lines = wrap(text, 3.0, Weight::Regular, 30.0).expect("in the font");
        assert!(lines.len() > 2);
        for line in &lines {
            assert!(text_width(line, 3.0, Weight::Regular).expect("in the font") <= 30.0);
        }
        let words = |s: &str| s.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(words(&lines.join(" ")), words(text));
    }

    #[test]
    fn subset_is_small_and_keeps_order_and_widths() {
        let mut wanted = glyphs("R012Ø", Weight::Regular).expect("in the font");
        wanted.sort_unstable();
        let ttf = subset_ttf(Weight::Regular, &wanted).expect("can be subset");
        assert!(ttf.len() < 20_000, "{} bytes", ttf.len());
        let (small, full) = (Face::read(&ttf).expect("a font"), Face::of(Weight::Regular));
        let full = full.expect("a font");
        for (i, &glyph) in wanted.iter().enumerate() {
            assert_eq!(small.advances[i + 1], full.advances[usize::from(glyph)]);
        }
    }
}
