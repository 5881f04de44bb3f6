//! Drawings in millimetres: drawn once, rendered to SVG, PDF and DXF.
//!
//! A [`Drawing`] is a sheet of a given size with named layers of [`Item`]s. The
//! origin is the top left corner and y points down, as on a screen. Everything is
//! plain data; the short way to add items is the trait [`Draw`]:
//!
//! ```
//! use rodwright::drawing::{Anchor, Color, Draw, Drawing, Stroke, svg};
//!
//! let mut sheet = Drawing::new(210.0, 297.0);
//! sheet.rect([10.0, 10.0], [190.0, 277.0], Stroke::new(0.35));
//! sheet.text([105.0, 30.0], 6.0, "R012").bold().anchor(Anchor::Middle);
//! sheet.layer("CUT").circle([105.0, 150.0], 40.0, Stroke::new(0.1).color(Color::VERMILLION));
//! let text = svg::render(&sheet)?;
//! # assert!(text.contains("R012"));
//! # Ok::<(), rodwright::drawing::DrawingError>(())
//! ```
//!
//! The room knows no rods and no paper formats. Its parts: what can be drawn
//! (`item`, `style`, `scale`), the builders (`draw`), moving and cutting groups of items
//! (`place`, `clip`), the one font ([`font`]) and the renderers ([`svg`], [`pdf`], [`dxf`]).

mod check;
mod clip;
mod draw;
pub mod dxf;
mod error;
pub mod font;
mod geometry;
mod item;
pub mod pdf;
mod place;
mod scale;
mod style;
pub mod svg;

pub use clip::{clip, crosses, within};
pub use draw::Draw;
pub use error::DrawingError;
pub use geometry::{Point, Rect, bounds};
pub use item::{Anchor, Figure, Item, Shape, Text};
pub use place::Placement;
pub use scale::scale_color;
pub use style::{Cap, Color, Dash, Paint, Stroke, Weight};

/// Name of the layer that takes what is drawn on a [`Drawing`] before any other
/// layer is asked for.
pub const FIRST_LAYER: &str = "drawing";

/// A sheet: its size in mm and what is on it, bottom layer first.
#[derive(Clone, PartialEq, Debug)]
pub struct Drawing {
    /// Width, mm.
    pub width: f64,
    /// Height, mm.
    pub height: f64,
    /// Layers, painted in this order.
    pub layers: Vec<Layer>,
}

/// A named group of items. SVG and PDF viewers list layers by name.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Layer {
    /// The name shown in viewers.
    pub name: String,
    /// Items, painted in this order.
    pub items: Vec<Item>,
}

impl Drawing {
    /// An empty sheet of `width` × `height` mm.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, layers: Vec::new() }
    }

    /// The layer of that name; appended on top if there is none yet.
    pub fn layer(&mut self, name: &str) -> &mut Layer {
        let at = self.layers.iter().position(|l| l.name == name).unwrap_or_else(|| {
            self.layers.push(Layer { name: name.to_owned(), items: Vec::new() });
            self.layers.len() - 1
        });
        &mut self.layers[at]
    }

    /// The whole sheet as a rectangle.
    pub fn frame(&self) -> Rect {
        Rect::new([0.0, 0.0], [self.width, self.height])
    }

    /// All items of all layers, bottom first.
    pub fn items(&self) -> impl Iterator<Item = &Item> {
        self.layers.iter().flat_map(|l| &l.items)
    }

    /// Puts another drawing on this one, each of its layers onto the layer of the
    /// same name.
    pub fn place_drawing(&mut self, other: &Drawing, placement: &Placement) {
        for layer in &other.layers {
            self.layer(&layer.name).place(&layer.items, placement);
        }
    }

    /// The part of the drawing that lies in `rect`, layer by layer, still at its
    /// own coordinates and on a sheet of the same size. See [`clip`].
    pub fn clipped(&self, rect: Rect) -> Drawing {
        let layers = self
            .layers
            .iter()
            .map(|l| Layer { name: l.name.clone(), items: clip(&l.items, rect) })
            .collect();
        Drawing { layers, ..*self }
    }
}
