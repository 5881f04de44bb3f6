//! Drawings as the pages of a PDF file.
//!
//! Lengths are true: a page has the size of its drawing, and the file asks viewers
//! to print it unscaled. Text is real text in one embedded font per weight, cut
//! down to the characters used. The same pages always give the same bytes: there is
//! no date in the file and its id is computed from its contents.
//!
//! printpdf writes the pages; what it has no setter for (print scaling, language, an
//! outline in chapters, names of pages, subset names, exact widths, the file's id) is set
//! on its document before saving.

mod content;
mod outline;

use std::collections::{BTreeMap, BTreeSet};

use lopdf::{Dictionary, Document, Object, StringFormat};
use printpdf::{FontId, LayerInternalId, ParsedFont, PdfDocument};
use printpdf::{PdfFont, PdfPage, PdfSaveOptions, PdfWarnMsg, Pt, Rect};

use self::content::page_ops;
use super::check::check;
use super::font::{advances, glyphs, subset_ttf};
use super::{Drawing, DrawingError, Item, Weight};

/// Points to the millimetre.
const PT_PER_MM: f64 = 72.0 / 25.4;

/// A page: a drawing and how the document's outline names it.
#[derive(Clone, PartialEq, Debug)]
pub struct Page {
    /// What is on the page, and its size.
    pub drawing: Drawing,
    /// Entry in the outline (bookmarks); none for a page that has no entry.
    pub title: Option<String>,
    /// Entry that this and its neighbours of the same chapter hang below.
    pub chapter: Option<String>,
    /// What viewers call the page; its number if it has no label.
    pub label: Option<String>,
}

impl Page {
    /// A page with an entry in the outline.
    pub fn titled(drawing: Drawing, title: impl Into<String>) -> Self {
        Self { title: Some(title.into()), ..drawing.into() }
    }
}

/// A page without an entry in the outline.
impl From<Drawing> for Page {
    fn from(drawing: Drawing) -> Self {
        Self { drawing, title: None, chapter: None, label: None }
    }
}

/// What the file says about itself. Empty texts are left out.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct DocumentInfo {
    /// Title, shown in the window of most viewers.
    pub title: String,
    /// Author.
    pub author: String,
    /// What the document is about.
    pub subject: String,
    /// The program that made the pages.
    pub creator: String,
    /// The language of the texts, as BCP 47 names it: `en`, `de-AT`.
    pub language: String,
}

/// All pages as the bytes of a PDF file.
pub fn render(pages: &[Page], info: &DocumentInfo) -> Result<Vec<u8>, DrawingError> {
    for page in pages {
        check(&page.drawing)?;
    }
    let fonts = Fonts::used_on(pages)?;
    let layers = Layers::used_on(pages);

    let mut pdf = PdfDocument::new(&info.title);
    pdf.pages = pages
        .iter()
        .map(|page| {
            let size = Rect::from_wh(pt(page.drawing.width), pt(page.drawing.height));
            let ops = page_ops(&page.drawing, &fonts, &layers)?;
            Ok(PdfPage { media_box: size.clone(), trim_box: size.clone(), crop_box: size, ops })
        })
        .collect::<Result<_, DrawingError>>()?;
    for font in &fonts.subsets {
        pdf.resources.fonts.map.insert(font.id(), font.embedded()?);
    }
    pdf.resources.layers.map = layers.described();
    save(&pdf, pages, &fonts, info)
}

/// mm to points, to a thousandth of a point: 0.35 µm, and short in the file.
fn pt(mm: f64) -> Pt {
    // Adding zero turns the minus zero that rounding may leave into zero.
    Pt((mm * PT_PER_MM * 1e3).round() as f32 / 1e3 + 0.0)
}

/// The fonts of the document, each cut down to what is used of it.
struct Fonts {
    subsets: Vec<Subset>,
}

/// One weight and the glyphs of it that some page uses.
struct Subset {
    weight: Weight,
    /// Glyph in the full font, to its number in the subset and a character it shows.
    glyphs: BTreeMap<u16, (u16, char)>,
}

impl Fonts {
    fn used_on(pages: &[Page]) -> Result<Self, DrawingError> {
        let mut used: BTreeMap<Weight, BTreeMap<u16, char>> = BTreeMap::new();
        let items = pages.iter().flat_map(|p| p.drawing.items());
        for item in items {
            let Item::Text(text) = item else { continue };
            if text.string.is_empty() {
                continue;
            }
            let pairs = glyphs(&text.string, text.weight)?.into_iter().zip(text.string.chars());
            used.entry(text.weight).or_default().extend(pairs);
        }
        let subsets = used.into_iter().map(|(weight, shown)| Subset {
            weight,
            // Number 0 is the empty box that every font begins with.
            glyphs: (1..).zip(shown).map(|(new, (old, c))| (old, (new, c))).collect(),
        });
        Ok(Self { subsets: subsets.collect() })
    }

    /// The subset of a weight, if some text has that weight.
    fn of(&self, weight: Weight) -> Option<&Subset> {
        self.subsets.iter().find(|s| s.weight == weight)
    }
}

impl Subset {
    /// Its name among the resources of a page.
    fn id(&self) -> FontId {
        FontId(match self.weight {
            Weight::Regular => "Regular".to_owned(),
            Weight::Bold => "Bold".to_owned(),
        })
    }

    /// The name of the cut font: six capitals and `+` mark it as a subset.
    fn base_font(&self) -> &'static str {
        match self.weight {
            Weight::Regular => "RODREG+DejaVuSansCondensed",
            Weight::Bold => "RODBLD+DejaVuSansCondensed-Bold",
        }
    }

    fn embedded(&self) -> Result<PdfFont, DrawingError> {
        let kept: Vec<u16> = self.glyphs.keys().copied().collect();
        let ttf = subset_ttf(self.weight, &kept)?;
        let font = ParsedFont::from_bytes(&ttf, 0, &mut Vec::new()).ok_or_else(|| {
            let reason = "the cut font cannot be read back".to_owned();
            DrawingError::Font { weight: self.weight, reason }
        })?;
        Ok(PdfFont::new(font))
    }

    /// Widths of all its glyphs from number 1 on, thousandths of the font size.
    fn widths(&self) -> Result<Vec<Object>, DrawingError> {
        let kept: Vec<u16> = self.glyphs.keys().copied().collect();
        let advances = advances(&kept, self.weight)?;
        Ok(advances.into_iter().map(|a| Object::from((a * 1e6).round() / 1e3)).collect())
    }
}

/// The layers of all pages by name. A document with one layer only has none in the
/// file: a list of one entry tells a viewer nothing.
struct Layers {
    ids: BTreeMap<String, LayerInternalId>,
}

impl Layers {
    fn used_on(pages: &[Page]) -> Self {
        let all = pages.iter().flat_map(|p| &p.drawing.layers);
        let names: BTreeSet<&str> = all.map(|l| &*l.name).collect();
        let ids = if names.len() < 2 { BTreeSet::new() } else { names };
        let number = |(i, name): (usize, &str)| {
            (name.to_owned(), LayerInternalId(format!("Layer{:03}", i + 1)))
        };
        Self { ids: ids.into_iter().enumerate().map(number).collect() }
    }

    fn id(&self, name: &str) -> Option<&LayerInternalId> {
        self.ids.get(name)
    }

    fn described(&self) -> BTreeMap<LayerInternalId, printpdf::Layer> {
        let describe = |(name, id): (&String, &LayerInternalId)| {
            let creator = env!("CARGO_PKG_NAME").to_owned();
            (id.clone(), printpdf::Layer { creator, ..printpdf::Layer::new(name) })
        };
        self.ids.iter().map(describe).collect()
    }
}

fn save(
    pdf: &PdfDocument,
    pages: &[Page],
    fonts: &Fonts,
    info: &DocumentInfo,
) -> Result<Vec<u8>, DrawingError> {
    // The fonts are cut already.
    let options = PdfSaveOptions { subset_fonts: false, ..PdfSaveOptions::default() };
    let mut warnings: Vec<PdfWarnMsg> = Vec::new();
    let mut file = pdf.to_lopdf_document(&options, &mut warnings);
    if let Some(warning) = warnings.first() {
        return Err(DrawingError::Pdf(warning.msg.clone()));
    }
    let say = |e: lopdf::Error| DrawingError::Pdf(e.to_string());

    // Layers came with 1.5, /PrintScaling with 1.6.
    file.version = "1.6".to_owned();
    let outline = outline::add(&mut file, pages).map_err(say)?;
    outline::label(&mut file, pages).map_err(say)?;
    set_catalog(&mut file, outline, &info.language).map_err(say)?;
    set_info(&mut file, info).map_err(say)?;
    for font in &fonts.subsets {
        set_font(&mut file, font)?;
    }
    name_layers(&mut file);
    file.compress();

    let mut write = |id: Option<u128>| {
        match id.map(|id| Object::String(id.to_be_bytes().to_vec(), StringFormat::Hexadecimal)) {
            Some(id) => file.trailer.set("ID", vec![id.clone(), id]),
            None => drop(file.trailer.remove(b"ID")),
        }
        let mut bytes = Vec::new();
        file.save_to(&mut bytes).map_err(|e| DrawingError::Pdf(e.to_string()))?;
        Ok(bytes)
    };
    let id = fnv1a(&write(None)?);
    write(Some(id))
}

fn set_catalog(file: &mut Document, outline: bool, language: &str) -> lopdf::Result<()> {
    let catalog = file.catalog_mut()?;
    let mut preferences = Dictionary::new();
    preferences.set("PrintScaling", "None");
    preferences.set("DisplayDocTitle", true);
    catalog.set("ViewerPreferences", preferences);
    if !language.is_empty() {
        catalog.set("Lang", lopdf::text_string(language));
    }
    catalog.set("PageLayout", "SinglePage");
    catalog.set("PageMode", if outline { "UseOutlines" } else { "UseNone" });
    Ok(())
}

/// Replaces the whole entry: printpdf always writes dates there.
fn set_info(file: &mut Document, info: &DocumentInfo) -> lopdf::Result<()> {
    let producer = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
    let mut entries = Dictionary::new();
    for (key, value) in [
        ("Title", &*info.title),
        ("Author", &info.author),
        ("Subject", &info.subject),
        ("Creator", &info.creator),
        ("Producer", producer),
    ] {
        if !value.is_empty() {
            entries.set(key, lopdf::text_string(value));
        }
    }
    let id = file.trailer.get(b"Info")?.as_reference()?;
    file.objects.insert(id, entries.into());
    Ok(())
}

/// Marks the font as a subset and gives its widths exactly; printpdf cuts them to
/// whole thousandths, which adds up along a line.
fn set_font(file: &mut Document, font: &Subset) -> Result<(), DrawingError> {
    let widths = font.widths()?;
    let cap_height = (super::font::CAP_HEIGHT * 1e3).round();
    let say = |e: lopdf::Error| DrawingError::Pdf(e.to_string());
    let set = || -> lopdf::Result<()> {
        let id = find_font(file, &font.id().0).ok_or(lopdf::Error::DictKey("Font".to_owned()))?;
        let outer = file.get_dictionary_mut(id)?;
        outer.set("BaseFont", font.base_font());
        let inner = outer.get_mut(b"DescendantFonts")?.as_array_mut()?;
        let inner = inner.first_mut().ok_or(lopdf::Error::DictKey("first".to_owned()))?;
        let inner = inner.as_dict_mut()?;
        inner.set("BaseFont", font.base_font());
        inner.set("W", vec![1.into(), Object::Array(widths)]);
        let descriptor = inner.get(b"FontDescriptor")?.as_reference()?;
        let descriptor = file.get_dictionary_mut(descriptor)?;
        descriptor.set("FontName", font.base_font());
        descriptor.set("CapHeight", cap_height);
        Ok(())
    };
    set().map_err(say)
}

/// The object that printpdf wrote for a font: named after its resource.
fn find_font(file: &Document, name: &str) -> Option<lopdf::ObjectId> {
    let is_it = |object: &Object| {
        let dict = object.as_dict().ok()?;
        let base = dict.get(b"BaseFont").and_then(Object::as_name).ok()?;
        (dict.has_type(b"Font") && base == name.as_bytes()).then_some(())
    };
    file.objects.iter().find(|(_, object)| is_it(object).is_some()).map(|(id, _)| *id)
}

/// Layer names as PDF text: printpdf writes their UTF-8 bytes, which viewers read
/// as Latin letters. It also calls the usage notes of a layer a layer.
fn name_layers(file: &mut Document) {
    for object in file.objects.values_mut() {
        let Ok(dict) = object.as_dict_mut() else { continue };
        if !dict.has_type(b"OCG") {
            continue;
        }
        let Ok(Object::String(bytes, _)) = dict.get(b"Name") else {
            dict.remove(b"Type");
            continue;
        };
        let name = String::from_utf8_lossy(bytes).into_owned();
        dict.set("Name", lopdf::text_string(&name));
    }
}

/// 128-bit FNV-1a: tells files apart, which is all that the id of a PDF is for.
fn fnv1a(bytes: &[u8]) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.iter().fold(OFFSET, |hash, &byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests;
