//! The pages with the figures: what was taken, what came of it.

use super::Subject;
use super::marks::NAMED;
use super::pictures::{hottest, size};
use crate::sheets::SheetError;
use crate::sheets::page::{self, Column, Flow, Leaf, Table};
use crate::sheets::text::TextError;
use crate::sheets::text::message::messages;
use crate::statics::study::{Case, Largest};
use crate::surface::Vector3;

messages! {
    mod say in "statics.toml" {
        "title" => Title {}
        "introduction" => Introduction {}
        "taken" => Taken {}
        "what" => What {}
        "taken-for" => TakenFor {}
        "material" => Material {}
        "material-is" => MaterialIs { name: String, young: String, shear: String, density: String, strength: String }
        "joint" => Joint {}
        "joint-is" => JointIs { kind: String }
        "feet" => Feet {}
        "feet-are" => FeetAre { kind: String, own: usize, added: usize }
        "area-load" => AreaLoad {}
        "area-load-is" => AreaLoadIs { pressure: String }
        "point-load" => PointLoad {}
        "point-load-is" => PointLoadIs { rod: String, at: String, x: String, y: String, z: String }
        "more-loads" => MoreLoads { count: usize }
        "studied-size" => StudiedSize {}
        "studied-size-is" => StudiedSizeIs { scale: String }
        "cases" => Cases {}
        "case" => CaseHead {}
        "case-of" => CaseOf {}
        "factors" => Factors { weight: String, area: String, points: String }
        "total" => Total {}
        "used" => Used {}
        "moved" => Moved {}
        "at" => At { rod: String, at: String }
        "most-used" => MostUsed {}
        "rod" => Rod {}
        "stress" => Stress {}
        "from-a" => FromA {}
        "tied" => Tied {}
        "tied-none" => TiedNone {}
        "tied-note" => TiedNote { count: usize, kind: String }
        "contact" => Contact {}
        "over" => Over {}
        "under" => Under {}
        "pull" => Pull {}
        "tied-rest" => TiedRest { list: String }
        "tied-more" => TiedMore { count: usize }
        "reactions" => Reactions {}
        "reactions-note" => ReactionsNote {}
        "foot" => Foot {}
        "along-x" => AlongX {}
        "along-y" => AlongY {}
        "up" => Up {}
        "all-feet" => AllFeet {}
        "more-feet" => MoreFeet { count: usize }
    }
}

/// Rods in the table of the most used.
const MOST_USED: usize = 10;
/// As many contacts that pull are named below those in the table.
const LISTED: usize = 150;
/// Feet that are listed of a case, those that bear most.
const FEET: usize = 12;
/// Room kept below a heading, mm.
const BELOW: f64 = 20.0;
/// Reactions below this part of all are rounding, and printed as 0.
const SLIGHT: f64 = 1e-9;

/// The figures of a study.
pub(super) fn pages(subject: &Subject) -> Result<Vec<Leaf>, SheetError> {
    let settings = &subject.settings;
    let mut flow = Flow::new(settings, "statics", &settings.say(say::Title {})?);
    flow.skip(1.5);
    flow.paragraph(&settings.say(say::Introduction {})?)?;
    if let Some(size) = size(subject)? {
        flow.paragraph(&size)?;
    }
    flow.heading(&settings.say(say::Taken {})?, BELOW);
    flow.table(&taken(subject)?)?;
    flow.heading(&settings.say(say::Cases {})?, BELOW);
    flow.table(&cases(subject)?)?;
    flow.paragraph(&hottest(subject)?)?;
    if let count @ 1.. = subject.beyond() {
        flow.paragraph(&settings.say(super::pictures::say::Beyond { count })?)?;
    }
    flow.heading(&settings.say(say::MostUsed {})?, BELOW);
    flow.table(&most_used(subject)?)?;
    tied(subject, &mut flow)?;
    flow.heading(&settings.say(say::Reactions {})?, BELOW);
    flow.paragraph(&settings.say(say::ReactionsNote {})?)?;
    flow.table(&reactions(subject)?)?;
    Ok(flow.finish(None))
}

/// What the frame was taken for, a line each.
fn taken(subject: &Subject) -> Result<Table, TextError> {
    let (settings, format) = (&subject.settings, subject.format());
    let question = &subject.study.question;
    let taken = &question.taken;
    let material = &taken.material;
    let (feet, own) = (subject.study.model().feet.len(), subject.study.own_feet);
    let figure = |x: f64| format.three_digits(x);
    let material = say::MaterialIs {
        name: page::printable(&question.material),
        young: figure(material.young),
        shear: figure(material.shear),
        density: figure(material.density),
        strength: figure(material.strength),
    };
    let mut rows = vec![
        [settings.say(say::Material {})?, settings.say(material)?],
        [
            settings.say(say::Joint {})?,
            settings.say(say::JointIs { kind: taken.hold.code().to_owned() })?,
        ],
        [
            settings.say(say::Feet {})?,
            settings.say(say::FeetAre {
                kind: taken.feet.code().to_owned(),
                own,
                added: feet - own,
            })?,
        ],
        [
            settings.say(say::StudiedSize {})?,
            settings.say(say::StudiedSizeIs { scale: format.factor(taken.scale) })?,
        ],
    ];
    if question.pressure != 0.0 {
        let pressure = figure(question.pressure * 1000.0);
        rows.push([settings.say(say::AreaLoad {})?, settings.say(say::AreaLoadIs { pressure })?]);
    }
    for load in question.points.iter().take(NAMED) {
        let [x, y, z] = [load.force.x, load.force.y, load.force.z].map(figure);
        let at = format.measure(load.at * taken.scale);
        let load = say::PointLoadIs { rod: load.rod.to_string(), at, x, y, z };
        rows.push([settings.say(say::PointLoad {})?, settings.say(load)?]);
    }
    if let count @ 1.. = question.points.len().saturating_sub(NAMED) {
        rows.push([String::new(), settings.say(say::MoreLoads { count })?]);
    }
    Ok(Table {
        columns: vec![
            Column::text(settings.say(say::What {})?),
            Column::wrapped(settings.say(say::TakenFor {})?),
        ],
        rows: rows.into_iter().map(Vec::from).collect(),
    })
}

/// A case in a line.
fn cases(subject: &Subject) -> Result<Table, TextError> {
    let (settings, format, study) = (&subject.settings, subject.format(), subject.study);
    let head = |text: Result<String, TextError>| text.map(Column::text);
    let row = |(i, case): (usize, &Case)| {
        let c = &case.combination;
        let [weight, area, points] =
            [c.weight, c.area, c.points].map(|factor| format.factor(factor));
        let mut row = vec![
            subject.case(i),
            settings.say(say::Factors { weight, area, points })?,
            format.three_digits(case.load.total(study.model()).norm()),
        ];
        let [used, moved] =
            [study.stresses(i), study.moves(i)].map(|all| all.into_iter().reduce(Largest::larger));
        for (largest, value) in [
            (used, used.map(|l| format.share(l.value))),
            (moved, moved.map(|l| format.small(l.value))),
        ] {
            row.push(value.unwrap_or_default());
            let place = largest.filter(|l| l.value > 0.0).map(|l| {
                let (rod, at) = (l.rod.to_string(), format.length(l.at));
                settings.say(say::At { rod, at })
            });
            row.push(place.transpose()?.unwrap_or_default());
        }
        Ok(row)
    };
    let at = || settings.say(say::FromA {}).map(Column::text);
    Ok(Table {
        columns: vec![
            head(settings.say(say::CaseHead {}))?,
            Column::wrapped(settings.say(say::CaseOf {})?),
            Column::figure(settings.say(say::Total {})?),
            Column::figure(settings.say(say::Used {})?),
            at()?,
            Column::figure(settings.say(say::Moved {})?),
            at()?,
        ],
        rows: study.cases.iter().enumerate().map(row).collect::<Result<_, TextError>>()?,
    })
}

fn most_used(subject: &Subject) -> Result<Table, TextError> {
    let (settings, format) = (&subject.settings, subject.format());
    let row = |rod: crate::ids::RodId| {
        let figures = &subject.figures[rod];
        vec![
            rod.to_string(),
            format.share(figures.utilisation),
            format.three_digits(figures.stress),
            subject.place(rod),
            subject.case(figures.case),
            format.small(figures.displacement),
        ]
    };
    Ok(Table {
        columns: vec![
            Column::text(settings.say(say::Rod {})?),
            Column::figure(settings.say(say::Used {})?),
            Column::figure(settings.say(say::Stress {})?),
            Column::figure(settings.say(say::FromA {})?),
            Column::text(settings.say(say::CaseHead {})?),
            Column::figure(settings.say(say::Moved {})?),
        ],
        rows: subject.by_use().into_iter().take(MOST_USED).map(row).collect(),
    })
}

/// The contacts that must be tied.
fn tied(subject: &Subject, flow: &mut Flow) -> Result<(), SheetError> {
    let (settings, format) = (&subject.settings, subject.format());
    flow.heading(&settings.say(say::Tied {})?, BELOW);
    if subject.pulls.is_empty() {
        return Ok(flow.paragraph(&settings.say(say::TiedNone {})?)?);
    }
    let kind = subject.study.question.taken.hold.code().to_owned();
    flow.paragraph(&settings.say(say::TiedNote { count: subject.pulls.len(), kind })?)?;
    let row = |&(id, pull): &(crate::ids::ContactId, f64)| {
        let contact = &subject.frame.contacts[id];
        let on = |rod: crate::ids::RodId, at: f64| {
            settings.say(say::At { rod: rod.to_string(), at: format.length(at) })
        };
        Ok(vec![
            id.to_string(),
            on(contact.over, contact.at_over)?,
            on(contact.under, contact.at_under)?,
            format.three_digits(pull),
        ])
    };
    let (first, rest) = subject.pulls.split_at(NAMED.min(subject.pulls.len()));
    flow.table(&Table {
        columns: vec![
            Column::text(settings.say(say::Contact {})?),
            Column::text(settings.say(say::Over {})?),
            Column::text(settings.say(say::Under {})?),
            Column::figure(settings.say(say::Pull {})?),
        ],
        rows: first.iter().map(row).collect::<Result<_, TextError>>()?,
    })?;
    if !rest.is_empty() {
        let named: Vec<String> = rest.iter().take(LISTED).map(|(c, _)| c.to_string()).collect();
        flow.paragraph(&settings.say(say::TiedRest { list: named.join(", ") })?)?;
    }
    if let count @ 1.. = rest.len().saturating_sub(LISTED) {
        flow.paragraph(&settings.say(say::TiedMore { count })?)?;
    }
    Ok(())
}

/// What the ground does to the feet that bear most, and to all, in each case.
fn reactions(subject: &Subject) -> Result<Table, TextError> {
    let (settings, format, study) = (&subject.settings, subject.format(), subject.study);
    let mut rows = Vec::new();
    for (i, case) in study.cases.iter().enumerate() {
        let feet = study.model().feet.iter().zip(&case.response.reactions);
        let mut feet: Vec<(String, Vector3)> =
            feet.map(|(f, r)| (f.rod.to_string(), Vector3::new(r[0], r[1], r[2]))).collect();
        let total: Vector3 = feet.iter().map(|f| f.1).sum();
        let slight = SLIGHT * feet.iter().map(|f| f.1.norm()).fold(0.0, f64::max);
        feet.sort_by(|a, b| b.1.norm().total_cmp(&a.1.norm()));
        let more = feet.len().saturating_sub(FEET);
        feet.truncate(FEET);
        feet.push((settings.say(say::AllFeet {})?, total));
        for (k, (foot, force)) in feet.into_iter().enumerate() {
            let figures = [force.x, force.y, force.z]
                .map(|x| if x.abs() > slight { format.three_digits(x) } else { "0".into() });
            let name = if k == 0 { subject.case(i) } else { String::new() };
            rows.push([vec![name, foot], figures.to_vec()].concat());
        }
        if more > 0 {
            let text = settings.say(say::MoreFeet { count: more })?;
            let before = rows.len() - 1;
            rows.insert(before, [vec![String::new(), text], vec![String::new(); 3]].concat());
        }
    }
    Ok(Table {
        columns: vec![
            Column::text(settings.say(say::CaseHead {})?),
            Column::text(settings.say(say::Foot {})?),
            Column::figure(settings.say(say::AlongX {})?),
            Column::figure(settings.say(say::AlongY {})?),
            Column::figure(settings.say(say::Up {})?),
        ],
        rows,
    })
}
