//! The whole way, from a design to a finished model. Read this first; what is then
//! drawn and written of the model stands in [`documents`](crate::documents).

mod error;
mod smaller;
mod stiffen;

pub use error::{BuildError, UNEVEN_ADVICE};

use crate::chart::PlanarChart;
use crate::design::{Design, MeasuredTable, Part, Sphere, Tiles};
use crate::frame::arrangement::arrangement;
use crate::frame::as_built::{AsBuilt, Cutting, as_built};
use crate::frame::canvas::{Canvas, MeshTiles, PlaneCanvas, SphereTiles};
use crate::frame::fit::{Fit, FitBy, fit};
use crate::frame::fit_turn::{fit_turn, safe_turns, safe_turns_of_slid};
use crate::frame::footprint::{Footprint, footprint};
use crate::frame::form::{FormError, FormSettings, Formed, form, median_rise};
use crate::frame::guide::Guide;
use crate::frame::measure::{Measures, measure};
use crate::frame::relax::{Relax, Relaxing, relax};
use crate::frame::tolerance::{Misfit, misfit};
use crate::frame::{Frame, Rod};
use crate::ids::RodId;
use crate::pattern::{Pattern, Shape};
use crate::shop::lengths::sticks;
use crate::shop::saw::{CutPlan, Offer, plan_some};
use crate::shop::{Assembly, JigError, Jigs, assembly, jigs};
use crate::statics::solve::StaticsError;
use crate::statics::study::{Study, study};
use crate::statics::wish::{LoadError, Wish};
use crate::surface::prepare::{Prepared, prepare, prepare_polygons};
use crate::surface::read::{read, read_polygons};
use crate::surface::topology::require_chartable;
use crate::tiling::Placement;
use crate::tiling::midsphere::midsphere;
use smaller::smaller_while_better;
use stiffen::stiffened;
pub use stiffen::{Stiffened, Tried};

/// A finished model: the frame and everything that was found on the way.
#[derive(Debug)]
pub struct Model {
    /// The surface that the frame follows.
    pub guide: Guide,
    /// What was mended in the surface, a sentence each.
    pub notes: Vec<String>,
    /// The size of the units, the turn of the rods, and the rise that comes of them.
    pub fit: Fit,
    /// The frame.
    pub formed: Formed,
    /// How its pattern was relaxed, if it was.
    pub relaxing: Option<Relaxing>,
    /// The plane that it was laid out on, if there is one.
    pub footprint: Option<Footprint>,
    /// Its figures.
    pub measures: Measures,
    /// What became of measurements on its sticks, if it was solved again with them.
    pub as_built: Option<AsBuilt>,
    /// What errors of marks and diameters do, if that was asked for.
    pub misfit: Option<Misfit>,
    /// The sawing plan; without sticks that are sawn.
    pub plan: CutPlan,
    /// What became of its turn, slide and tile edge, if it was stiffened.
    pub stiffened: Option<Stiffened>,
    /// Its stresses, or why it does not stand, if that was asked for.
    pub statics: Option<Result<Study, StaticsError>>,
    /// In which order it is put together; of models that are only tried, none.
    pub assembly: Option<Assembly>,
    /// What a laser cuts for it, or why that is left out; of models for which it is not
    /// wanted, none.
    pub jigs: Option<Result<Jigs, JigError>>,
}

/// The steps of a run, as they begin.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// Reading and mending the surface.
    Read,
    /// Flattening it.
    Chart,
    /// Finding the tile edge.
    Fit,
    /// Relaxing the pattern.
    Relax,
    /// Weaving, lifting and closing the frame.
    Form,
    /// Solving it again with what was measured on sticks.
    AsBuilt,
    /// Measuring the result.
    Measure,
    /// Trying what errors of marks and diameters do.
    Tolerance,
    /// Planning the saw cuts.
    Saw,
    /// Finding the order in which it is put together.
    Order,
    /// Changing it until it is stiffer.
    Stiffen,
    /// Finding its stresses.
    Statics,
    /// Laying out what a laser cuts.
    Jigs,
    /// Drawing and encoding the documents.
    Draw,
    /// Writing the folder.
    Write,
}

/// Makes the model that a design asks for. `begin` is called as each step begins.
///
/// # Errors
/// [`BuildError`] with what is wrong and what to try.
pub fn build(design: &Design, begin: &mut dyn FnMut(Step)) -> Result<Model, BuildError> {
    let mut model = planned(design, begin)?;
    if let Some(measured) = &design.measured {
        model = built(design, measured, model, begin)?;
    }
    if let Some(wish) = &design.statics {
        model = loaded(design, wish, model, begin)?;
    }
    if let Some(tolerance) = design.tolerance {
        begin(Step::Tolerance);
        let frame = &model.formed.frame;
        model.misfit = misfit(frame, tolerance, design.seed).map_err(BuildError::Tolerance)?;
    }
    begin(Step::Order);
    let tied = arrangement(&model.formed).tied;
    let assembly = assembly(&model.formed.frame, &tied, design.order);
    model.assembly = Some(assembly.map_err(BuildError::Order)?);
    if design.wants(Part::Jigs) {
        begin(Step::Jigs);
        model.jigs = Some(lasered(design, &model)?);
    }
    Ok(model)
}

/// The model with its stresses; stiffened before where that is asked for.
fn loaded(
    design: &Design,
    wish: &Wish,
    mut model: Model,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    if let Some(goal) = design.stiffen {
        begin(Step::Stiffen);
        let wish = wish.in_places(&model.formed.frame)?;
        return Ok(stiffened(design, goal, &wish, model)?);
    }
    begin(Step::Statics);
    model.statics = Some(studied(&model, wish)?);
    Ok(model)
}

/// The stresses of a model, or why it does not stand.
fn studied(model: &Model, wish: &Wish) -> Result<Result<Study, StaticsError>, LoadError> {
    let frame = &model.formed.frame;
    Ok(study(frame, wish.about(frame)?))
}

/// What a laser cuts for a model. What is wrong with it is an error only where jigs are named:
/// else they are left out.
fn lasered(design: &Design, model: &Model) -> Result<Result<Jigs, JigError>, JigError> {
    let jigs = jigs(&model.formed.frame, &model.plan, model.assembly.as_ref(), &design.jigs);
    if design.names(Part::Jigs) {
        return jigs.map(Ok);
    }
    Ok(jigs.and_then(|jigs| match jigs.sheets.len() {
        sheets if sheets > MOST_SHEETS => Err(JigError::TooMany { sheets }),
        _ => Ok(jigs),
    }))
}

/// More sheets for a laser are written only where they are named: nobody cuts so many who did not
/// mean to.
const MOST_SHEETS: usize = 30;

/// The model as planned, whatever was measured.
fn planned(design: &Design, begin: &mut dyn FnMut(Step)) -> Result<Model, BuildError> {
    match &design.tiles {
        Tiles::Pattern(pattern) => {
            let flat = flatten(design, begin)?;
            lay(design, pattern, &flat, begin)
        }
        Tiles::Mesh => on_polygons(design, begin),
        Tiles::Sphere(sphere) => on_sphere(design, sphere, begin),
    }
}

/// A surface laid flat, to lay patterns on.
#[derive(Debug)]
pub struct Flat {
    /// The way from the plane to the surface.
    pub chart: PlanarChart,
    /// What was mended in the surface, a sentence each.
    pub notes: Vec<String>,
}

/// Reads the surface of a design and lays it flat.
///
/// # Errors
/// [`BuildError`] with what is wrong and what to try.
pub fn flatten(design: &Design, begin: &mut dyn FnMut(Step)) -> Result<Flat, BuildError> {
    begin(Step::Read);
    let reading = read(&design.surface_file)?;
    let Prepared { mesh: surface, notes } =
        prepare(reading, design.up, design.component, design.cut, design.span)?;
    begin(Step::Chart);
    let topology = require_chartable(&surface)?;
    Ok(Flat { chart: PlanarChart::new(surface, &topology, design.chart)?, notes })
}

/// Makes the model of a pattern on a surface that is flat, whatever surface and pattern the
/// design names.
///
/// # Errors
/// [`BuildError`] with what is wrong and what to try.
pub fn lay(
    design: &Design,
    pattern: &Pattern,
    flat: &Flat,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    // What goes wrong on an uneven chart goes wrong for that.
    let uneven = flat.chart.distortion().uneven();
    in_plane(design, pattern, flat, begin).map_err(|e| match (e, uneven) {
        (e @ BuildError::Form(FormError::NoSuchRod { .. }), _) | (e, None) => e,
        (e, Some(uneven)) => BuildError::Uneven { e: Box::new(e), uneven },
    })
}

fn in_plane(
    design: &Design,
    pattern: &Pattern,
    flat: &Flat,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    begin(Step::Fit);
    let chart = &flat.chart;
    let usual = pattern.usual();
    let shape = Shape { turn: design.turn.unwrap_or(usual.turn), slide: design.slide };
    let place = |edge| Placement { origin: design.origin.into(), rotation: design.rotate, edge };
    let canvas = |edge| PlaneCanvas::new(chart, pattern, place(edge), shape);
    let Some(edge) = design.unit else {
        let fit = fit(chart, pattern, &place(design.rod), shape, design.rod)?;
        return smaller_while_better(fit, design.rod, |fit| {
            let canvas = canvas(fit.edge)?;
            let fit = match fit.by {
                FitBy::Smaller => Fit { by: fit.by, ..as_given(&canvas, fit.turn) },
                _ => fit,
            };
            on_plane(design, pattern, flat, canvas, fit, begin)
        });
    };
    let canvas = canvas(edge)?;
    let fit = as_given(&canvas, shape.turn);
    on_plane(design, pattern, flat, canvas, fit, begin)
}

/// Everything after the size of the units is chosen.
fn on_plane<'a>(
    design: &Design,
    pattern: &Pattern,
    Flat { chart, notes }: &'a Flat,
    canvas: PlaneCanvas<'a, PlanarChart>,
    fit: Fit,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    let mesh = chart.mesh();
    let form_on = |canvas: &PlaneCanvas<_>, fit, begin: &mut dyn FnMut(Step)| {
        let guide = Guide::Chart { mesh: mesh.clone(), distortion: chart.distortion().clone() };
        let mut model = finish(design, canvas, fit, guide, notes.clone(), begin)?;
        model.footprint = Some(footprint(canvas, pattern, &model.formed.tiles));
        Ok(model)
    };
    match design.relax {
        Relax::Off => form_on(&canvas, fit, begin),
        Relax::On => relaxed(canvas, fit, form_on, begin),
    }
}

/// Relaxes a pattern before the frame is formed. Where that has more units left out than
/// without, the pattern is taken as it was.
fn relaxed<'a>(
    plain: PlaneCanvas<'a, PlanarChart>,
    plain_fit: Fit,
    form_on: impl Fn(
        &PlaneCanvas<'a, PlanarChart>,
        Fit,
        &mut dyn FnMut(Step),
    ) -> Result<Model, BuildError>,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    begin(Step::Relax);
    let mut canvas = plain.clone();
    let mut relaxing = relax(&mut canvas);
    let (units, rise) = median_rise(&canvas).unwrap_or((plain_fit.units, plain_fit.rise));
    let mut model = form_on(&canvas, Fit { units, rise, ..plain_fit }, begin);
    if model.as_ref().map_or(true, |model| !model.formed.frame.dropped.is_empty()) {
        let units = |of: &Result<Model, BuildError>| {
            of.as_ref().map_or(0, |model| model.formed.frame.units.len())
        };
        let without = form_on(&plain, plain_fit, &mut |_| {});
        if model.is_err() || units(&without) > units(&model) {
            model = without;
            relaxing = relaxing.map(|relaxing| Relaxing { used: false, ..relaxing });
        }
    }
    model.map(|model| Model { relaxing, ..model })
}

/// The polygons of the surface as they are.
fn on_polygons(design: &Design, begin: &mut dyn FnMut(Step)) -> Result<Model, BuildError> {
    begin(Step::Read);
    let reading = read_polygons(&design.surface_file)?;
    let notes = reading.notes.clone();
    let mesh = prepare_polygons(reading, design.up, design.component, design.cut, design.span)?;
    begin(Step::Fit);
    let tiles = MeshTiles::new(&mesh.points, &mesh.faces);
    let shape = |turn| Shape { turn, slide: design.slide };
    let fit = turned_fit(design, tiles.alternates(), |turn| tiles.shaped(shape(turn)))?;
    finish(design, &tiles.shaped(shape(fit.turn)), fit, Guide::Mesh(mesh), notes, begin)
}

/// A polyhedron on a sphere.
fn on_sphere(
    design: &Design,
    sphere: &Sphere,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    begin(Step::Chart);
    let mut form = midsphere(&sphere.notation.polyhedron())?;
    form.warp(sphere.warp);
    begin(Step::Fit);
    let radius = sphere.radius;
    let cut = design.cut.map(|plane| plane.height([-radius, radius]));
    if let Some(at) = cut.filter(|at| !(-radius..radius).contains(at)) {
        return Err(BuildError::CutPastSphere { at, radius });
    }
    let tiles = SphereTiles::new(&form, radius, cut, design.rotate);
    let shape = |turn| Shape { turn, slide: design.slide };
    let fit = turned_fit(design, tiles.alternates(), |turn| tiles.shaped(shape(turn)))?;
    let guide = Guide::Sphere { faces: tiles.faces(), radius, low: tiles.low() };
    finish(design, &tiles.shaped(shape(fit.turn)), fit, guide, Vec::new(), begin)
}

/// Everything after the tiles are found.
fn finish(
    design: &Design,
    canvas: &impl Canvas,
    fit: Fit,
    guide: Guide,
    notes: Vec<String>,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    begin(Step::Form);
    let settings = FormSettings {
        diameter: design.rod,
        sizes: design.sizes.clone(),
        overhang: design.overhang,
        round: design.round,
        share: design.share,
        layering: design.layer,
        way: design.close,
        surface_low: guide.low(),
    };
    let formed = form(canvas, &settings).map_err(|e| unsuited(e, &fit))?;
    begin(Step::Measure);
    let measures = measure(&formed, &guide);
    begin(Step::Saw);
    let plan = sawing_plan(design, &formed, &[])?;
    Ok(Model {
        guide,
        notes,
        fit,
        formed,
        relaxing: None,
        footprint: None,
        measures,
        as_built: None,
        misfit: None,
        plan,
        stiffened: None,
        statics: None,
        assembly: None,
        jigs: None,
    })
}

/// The model solved again with what was measured on its sticks.
fn built(
    design: &Design,
    measured: &MeasuredTable,
    mut model: Model,
    begin: &mut dyn FnMut(Step),
) -> Result<Model, BuildError> {
    begin(Step::AsBuilt);
    let cutting = Cutting { overhang: design.overhang, round: design.round };
    let (frame, what) = as_built(&model.formed.frame, &measured.rows, cutting)
        .map_err(|e| BuildError::AsBuilt { file: measured.file.clone(), e })?;
    model.formed.moves = moves(&model.formed.frame, &frame);
    model.formed.frame = frame;
    model.formed.closing.error = what.error;
    begin(Step::Measure);
    model.measures = measure(&model.formed, &model.guide);
    begin(Step::Saw);
    model.plan = sawing_plan(design, &model.formed, &what.sawn)?;
    Ok(Model { as_built: Some(what), ..model })
}

/// How far each end of each rod moves from one frame to the other, mm.
fn moves(from: &Frame, to: &Frame) -> Vec<f64> {
    let of = |(old, new): (&Rod, &Rod)| old.axis.moves_to(&new.axis);
    from.rods.iter().zip(to.rods.iter()).flat_map(of).collect()
}

/// Where units fail whose size and turn could not be fitted to the rods, says which rods
/// would suit them; where they were fitted, no longer says to fit them.
fn unsuited(mut e: FormError, fit: &Fit) -> BuildError {
    if let FormError::TooManyDropped { fitting, .. } = &mut e {
        *fitting = fitting.filter(|_| fit.by == FitBy::Given);
    }
    match e {
        FormError::TooManyDropped { diameter, .. }
            if !fit.is_flat(diameter)
                && !(1.0 / SUITING..=SUITING).contains(&(fit.rise / diameter)) =>
        {
            BuildError::Unsuited { e, suits: fit.rise }
        }
        e => e.into(),
    }
}

/// Rods this much thinner or thicker than the rise suit well enough; it is not they that
/// make units fail.
const SUITING: f64 = 1.5;

/// Size and turn as the user gave them, with the rise that comes of them.
fn as_given(canvas: &impl Canvas, turn: f64) -> Fit {
    let (units, rise) = median_rise(canvas).unwrap_or_default();
    Fit { edge: canvas.edge(), turn, rise, units, by: FitBy::Given }
}

/// The turn given, if it is safe for these tiles, or the one that fits.
fn turned_fit<C: Canvas>(
    design: &Design,
    alternates: bool,
    make: impl Fn(f64) -> C,
) -> Result<Fit, BuildError> {
    let slide = design.slide;
    if slide != 0.0 && !alternates {
        return Err(BuildError::Alternate { slide });
    }
    let turns = if slide == 0.0 {
        safe_turns(&make, design.rod)
    } else {
        safe_turns_of_slid(&make, design.rod).ok_or(BuildError::Slide { slide })?
    };
    match design.turn {
        None => Ok(fit_turn(make, turns, design.rod)?),
        Some(turn) if (turns[0]..=turns[1]).contains(&turn.abs()) => {
            Ok(as_given(&make(turn), turn))
        }
        Some(turn) => {
            let [turn, least, most] = [turn, turns[0], turns[1]].map(f64::to_degrees);
            Err(BuildError::Turn { turn, least, most })
        }
    }
}

/// The sawing plan. Where the user names no stock: bars of 1 m, or of enough whole metres to
/// hold every rod. `sawn` are rods that need not be sawn any more, in order.
fn sawing_plan(design: &Design, formed: &Formed, sawn: &[RodId]) -> Result<CutPlan, BuildError> {
    let sticks = sticks(&formed.frame);
    let open = || sticks.ids().filter(|rod| sawn.binary_search(rod).is_err());
    let mut stock = design.stock.clone();
    if stock.bars.iter().all(|bar| bar.at_hand) {
        let longest = open().map(|rod| sticks[rod].length).fold(0.0, f64::max);
        let metres = ((longest + 2.0 * stock.trim) / METRE).ceil().max(1.0);
        stock.bars.push(Offer::plain(metres * METRE));
    }
    Ok(plan_some(&sticks, open(), &stock)?)
}

/// Sticks are sold by the metre, mm.
const METRE: f64 = 1000.0;
