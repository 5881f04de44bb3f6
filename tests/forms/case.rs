//! A design for the library: a surface, a pattern on it, and how the rods are made.

use rodwright::chart::{Chart, Method, PlanarChart};
use rodwright::frame::canvas::PlaneCanvas;
use rodwright::frame::close::Way;
use rodwright::frame::fit::fit;
use rodwright::frame::form::{FormSettings, Formed, form};
use rodwright::frame::layer::Layering;
use rodwright::pattern::{Pattern, Shape};
use rodwright::surface::Mesh;
use rodwright::surface::samples::sample;
use rodwright::surface::topology::require_disk;
use rodwright::tiling::Placement;
use std::fmt::{Debug, Display};

/// Everything that a frame is made of. The placement's edge is `None` to be fitted.
#[derive(Clone, Debug)]
pub struct Case {
    pub mesh: Mesh,
    pub pattern: &'static Pattern,
    pub shape: Shape,
    pub origin: [f64; 2],
    pub rotation: f64,
    pub edge: Option<f64>,
    pub settings: FormSettings,
}

/// Why a case has no frame.
#[derive(Debug)]
pub struct Refusal {
    /// Where it stopped, and the name of the error.
    pub kind: String,
    /// What the user reads.
    pub message: String,
}

impl Refusal {
    fn new(place: &str, e: &(impl Debug + Display)) -> Self {
        let name = format!("{e:?}");
        let name = name.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
        Self { kind: format!("{place}: {name}"), message: e.to_string() }
    }
}

impl Case {
    /// A pattern on a sample surface, with 3 mm rods and everything else as usual.
    pub fn on(surface: &str, pattern: &str) -> Self {
        let pattern = Pattern::named(pattern).expect("a name of the library");
        Self {
            mesh: sample(surface).expect("a name of a sample"),
            pattern,
            shape: pattern.usual(),
            origin: [0.0; 2],
            rotation: 0.0,
            edge: None,
            settings: FormSettings {
                diameter: 3.0,
                sizes: Default::default(),
                overhang: 6.0,
                round: 0.5,
                share: rodwright::frame::share::Share::Off,
                layering: Layering::Auto,
                way: Way::default(),
                surface_low: 0.0,
            },
        }
    }

    /// The surface laid flat.
    pub fn chart(&self) -> Result<PlanarChart, Refusal> {
        let topology = require_disk(&self.mesh).map_err(|e| Refusal::new("surface", &e))?;
        PlanarChart::new(self.mesh.clone(), &topology, Method::Abf)
            .map_err(|e| Refusal::new("chart", &e))
    }

    /// The fitted edge, mm.
    pub fn fitted(&self, chart: &impl Chart) -> Result<f64, Refusal> {
        fit(chart, self.pattern, &self.place(1.0), self.shape, self.settings.diameter)
            .map(|fit| fit.edge)
            .map_err(|e| Refusal::new("fit", &e))
    }

    pub fn form(&self) -> Result<Formed, Refusal> {
        let chart = self.chart()?;
        let edge = self.edge.map_or_else(|| self.fitted(&chart), Ok)?;
        let canvas = PlaneCanvas::new(&chart, self.pattern, self.place(edge), self.shape)
            .map_err(|e| Refusal::new("canvas", &e))?;
        form(&canvas, &self.settings).map_err(|e| Refusal::new("form", &e))
    }

    fn place(&self, edge: f64) -> Placement {
        Placement { origin: self.origin.into(), rotation: self.rotation, edge }
    }
}
