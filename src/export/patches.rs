//! The contact of the boundary elements at a load: pressures and patches, point by point.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity::bem::Contact;
use asperity::compare::Control;
use asperity::surface::{AnalysisDepth, Step};
use asperity::topography::write::{GwyField, Note, Out, gwy};
use asperity::units::Dimension;
use asperity::work::Counter;
use asperity::{HeightMap, npy};
use asperity_contact_framework::input::{InputError, Source};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::Progress;
use asperity_contact_framework::report::format::quantity;

use super::identifier;
use super::surface::{SurfaceChoice, chosen, described, file_name, is_spec, origin, refuse_options};
use crate::experiment::Experiment;
use crate::kind::compare::reference::{ReferencePlan, ReferenceRun, Solution, numbered_patches};
use crate::kind::compare::spec::ComparePlan;
use crate::layer::thickness_words;
use crate::surface::{ContactOptions, FileOptions, SurfaceFactory, SurfacePlan, files_of};

/// The contacts of a comparison on one surface.
pub struct ExportedContacts {
    experiment: Experiment,
    plan: Arc<ComparePlan>,
    path: PathBuf,
    surface: usize,
    realisation: usize,
    /// The load that the command line states.
    stated: Option<StatedLoad>,
}

/// A load of the command line.
#[derive(Debug, Clone, Copy)]
enum StatedLoad {
    /// Pa.
    Pressure(f64),
    /// N, on an area of m², else on that of the surface.
    Force(f64, Option<f64>),
}

pub struct ExportedContact<'a> {
    /// How the names of its files begin.
    pub name: String,
    /// Where it comes from, its load and its area.
    pub notes: Vec<Note>,
    heights: &'a HeightMap,
    contact: &'a Contact,
    patches: Vec<u32>,
}

impl ExportedContacts {
    /// Of the comparison in the spec at `path`, at its loads or the one of `options`; or of a measured file with `options`.
    pub fn read(
        path: &Path,
        options: &FileOptions,
        choice: &SurfaceChoice,
        progress: &dyn Progress,
    ) -> Result<Self, InputError> {
        let refuse = |message: &str| Err(InputError::file(path, message));
        let (source, stated) = if is_spec(path) {
            let ContactOptions { load, area, pressure, .. } = &options.contact;
            let contact = ContactOptions {
                load: load.clone(),
                area: area.clone(),
                pressure: pressure.clone(),
                ..ContactOptions::default()
            };
            contact.check()?;
            let mut others = options.clone();
            (others.contact.load, others.contact.area, others.contact.pressure) = (None, None, None);
            refuse_options(path, &others)?;
            let text = std::fs::read_to_string(path)
                .map_err(|error| InputError::file(path, format!("cannot be read: {error}")))?;
            (Source::file(path, text), StatedLoad::new(&contact)?)
        } else {
            let contact = ContactOptions { reference: true, ..options.contact.clone() };
            let options = FileOptions { contact, ..options.clone() };
            options.check()?;
            (options.source(path), None)
        };
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let (experiment, plan) = Experiment::with_comparison(source, &stem, progress)?;
        let Some(plan) = plan else {
            return refuse(
                "holds another kind of experiment; allowed: [compare], whose contacts boundary elements solve",
            );
        };
        let Some(reference) = &plan.reference else {
            return refuse(
                "has no boundary elements; allowed: \"reference\" among the `models` of [compare]",
            );
        };
        if reference.prescribed.is_empty() && stated.is_none() {
            return refuse("has no load; allowed: --pressure or --load, or `pressure` or `force` in a spec");
        }
        let (surface, realisation) = chosen(path, &plan.study.surfaces, choice)?;
        Ok(Self { experiment, path: path.to_owned(), surface, realisation, stated, plan })
    }

    fn surface(&self) -> &SurfacePlan {
        &self.plan.study.surfaces[self.surface]
    }

    /// How the names of its files begin where there is one contact.
    pub fn name(&self) -> String {
        file_name(&self.path, self.surface(), self.plan.study.surfaces.len() > 1, self.realisation)
    }

    /// Solves the contacts, one at each load under each layer, and calls `take` with each. Gives the loads that are left out, in words.
    pub fn each<E: From<InputError>>(
        &self,
        progress: &dyn Progress,
        mut take: impl FnMut(&ExportedContact) -> Result<(), E>,
    ) -> Result<Vec<String>, E> {
        let Some(reference) = self.plan.reference.as_deref() else { return Ok(Vec::new()) };
        let input = self.experiment.watched_input(progress)?;
        let context = self.experiment.context(&input, progress);
        let plan = self.surface();
        let counter = Counter::default();
        let (mut files, mut timing) = (files_of(std::slice::from_ref(plan), &counter), Timing::default());
        let mut factory = SurfaceFactory::new(plan, &context, &counter).keeping_map(true).of_any(true);
        let surface = factory.make(self.realisation, AnalysisDepth::Asperities, &mut files, &mut timing)?;
        let Some(prepared) = &surface.prepared else { return Ok(Vec::new()) };
        let area = self.plan.setup(&context).load_area(&surface);
        let loads = self.loads(reference, area);
        let mut of_surface = origin(&self.path, &context.source.text, context.seed, plan, self.realisation)?;
        if let Some(preparation) = factory.preparation() {
            of_surface.push(("Preparation", described(&preparation, Step::Filtered)));
        }
        let run = ReferenceRun {
            reference,
            compare: &self.plan,
            plan,
            surface: &surface,
            prepared,
            is_viewed: false,
        };
        let mut names: Vec<String> = Vec::new();
        let mut left_out = Vec::new();
        for solution in &reference.solutions {
            let cap = solution.cap.unwrap_or(f64::INFINITY);
            let (carried, beyond): (Vec<f64>, Vec<f64>) = loads.iter().copied().partition(|&load| load < cap);
            left_out.extend(beyond.iter().map(|&load| {
                format!(
                    "{}: not below the hardness of {}, which no contact carries",
                    quantity(load, "Pa"),
                    quantity(cap, "Pa")
                )
            }));
            run.each_contact(&context, solution, &carried, |heights, load, contact| {
                let name = identifier(&format!(
                    "{}{}",
                    self.name(),
                    differs(reference, solution, load, loads.len())
                ));
                let repeats = names.iter().filter(|other| **other == name).count();
                names.push(name.clone());
                let name = if repeats > 0 { format!("{name}-{}", repeats + 1) } else { name };
                let mut notes = of_surface.clone();
                let (patches, count) = numbered_patches(contact);
                notes.extend(self.facts(reference, solution, contact, [load, area]));
                notes.push(("Patches", count.to_string()));
                take(&ExportedContact { name, notes, heights, contact, patches })
            })?;
        }
        Ok(left_out)
    }

    /// Nominal pressures, Pa; forces act on an area (m²).
    fn loads(&self, reference: &ReferencePlan, area: f64) -> Vec<f64> {
        match self.stated {
            Some(StatedLoad::Pressure(pressure)) => vec![pressure],
            Some(StatedLoad::Force(force, stated)) => vec![force / stated.unwrap_or(area)],
            None => {
                let pressure = |&(control, load): &(Control, f64)| {
                    if control == Control::Force { load / area } else { load }
                };
                reference.prescribed.iter().map(pressure).collect()
            }
        }
    }

    /// How a contact was solved, and what was found.
    fn facts(
        &self,
        reference: &ReferencePlan,
        solution: &Solution,
        contact: &Contact,
        [load, area]: [f64; 2],
    ) -> Vec<Note> {
        let [bare, coated] = [&self.plan.study.bodies.rough, &self.plan.study.bodies.flat];
        let number = |value: f64| format!("{value:e}");
        let mut notes = vec![("Bodies", format!("{bare} on {coated}"))];
        notes.extend(solution.thickness.map(|thickness| ("Layer thickness (m)", number(thickness))));
        notes.extend(solution.cap.map(|cap| ("Largest pressure allowed (Pa)", number(cap))));
        notes.extend([
            ("Boundary", contact.boundary().name().to_owned()),
            ("Relative dual gap", number(reference.error)),
            ("Nominal pressure (Pa)", number(load)),
            ("Force (N)", number(load * area)),
            ("Area of the force (m^2)", number(area)),
            ("Points in contact over all points", number(contact.raw_area_ratio())),
            ("Contact area over nominal area", number(contact.area_ratio())),
            ("Mean gap (m)", number(contact.mean_gap())),
            ("Points", contact.points().map(|count| count.to_string()).join(" x ")),
            ("Pixel (m)", contact.pixel().map(number).join(" x ")),
        ]);
        notes
    }
}

/// What tells a contact from the others at so many loads, behind a dash each: the layer, whether a hardness limits its pressures, the load.
fn differs(reference: &ReferencePlan, solution: &Solution, load: f64, loads: usize) -> String {
    let mut parts = Vec::new();
    let others = |differs: &dyn Fn(&Solution) -> bool| reference.solutions.iter().any(differs);
    if others(&|other| other.thickness != solution.thickness) {
        parts.extend(solution.thickness.map(thickness_words));
    }
    if others(&|other| other.thickness == solution.thickness && other.cap != solution.cap) {
        parts.push(if solution.cap.is_some() { "plastic" } else { "elastic" }.to_owned());
    }
    if loads > 1 {
        parts.push(quantity(load, "Pa"));
    }
    parts.iter().map(|part| format!("-{part}")).collect()
}

impl StatedLoad {
    /// The load of options, `None` where there is none.
    fn new(options: &ContactOptions) -> Result<Option<Self>, InputError> {
        let read = |option: &str, given: &Option<String>, dimension: Dimension, example: &str| {
            let Some(text) = given else { return Ok(None) };
            let value = text.trim().parse().ok().or_else(|| dimension.parse(text));
            value.filter(|value: &f64| *value > 0.0 && value.is_finite()).map(Some).ok_or_else(|| {
                let message = format!(
                    "found \"{text}\"; allowed: a positive number with its unit, such as \"{example}\""
                );
                InputError::file(Path::new(&format!("--{option}")), message)
            })
        };
        let pressure = read("pressure", &options.pressure, Dimension::Pressure, "1.25 MPa")?;
        let force = read("load", &options.load, Dimension::Force, "5 N")?;
        let area = read("area", &options.area, Dimension::Area, "4 mm2")?;
        Ok(pressure.map(Self::Pressure).or(force.map(|force| Self::Force(force, area))))
    }
}

impl ExportedContact<'_> {
    /// Points in contact over all points.
    pub fn raw_area_ratio(&self) -> f64 {
        self.contact.raw_area_ratio()
    }

    /// Contact pressures, numbers of the patches and the heights of the map as the fields of a `.gwy`.
    pub fn write_gwy(&self, out: &mut dyn Out) -> io::Result<()> {
        let map = |numbers: Vec<f64>| {
            let made = HeightMap::new(self.contact.points(), self.contact.pixel(), numbers, 0.0);
            made.map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error.to_string()))
        };
        let pressures = map(self.contact.pressures().to_vec())?;
        let patches = map(self.numbers().collect())?;
        let fields = [
            GwyField { title: "Contact pressure", unit: "Pa", map: &pressures },
            GwyField { title: "Contact patches", unit: "", map: &patches },
            GwyField { title: "Height", unit: "m", map: self.heights },
        ];
        gwy(out, &fields, &self.notes)
    }

    /// Contact pressures in Pa as an array, the first index along x.
    pub fn write_pressures(&self, out: &mut dyn Out) -> io::Result<()> {
        npy::write(out, self.contact.points(), self.contact.pressures().iter().copied())
    }

    /// The number of the patch of each point as an array, 0 out of contact.
    pub fn write_patches(&self, out: &mut dyn Out) -> io::Result<()> {
        npy::write(out, self.contact.points(), self.numbers())
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.patches.iter().map(|&number| f64::from(number))
    }

    /// A picture with a pixel for each point, the first y at the top, as instruments show maps: white out of contact, darker by pressure.
    pub fn write_png(&self, out: &mut dyn Out) -> io::Result<()> {
        let [nx, ny] = self.contact.points();
        let side = |count: usize| {
            u32::try_from(count).map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error))
        };
        let highest = self.contact.pressures().iter().fold(0.0f64, |highest, &p| highest.max(p));
        let colour = |p: f64| if p > 0.0 { 1 + (p / highest * 254.0) as u8 } else { 0 };
        let mut encoder = png::Encoder::new(out, side(nx)?, side(ny)?);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(palette());
        for (name, text) in &self.notes {
            encoder.add_itxt_chunk((*name).to_owned(), text.clone())?;
        }
        let scale = format!("white 0, then light to dark from 0 to {highest:e}");
        encoder.add_itxt_chunk("Pressure (Pa)".to_owned(), scale)?;
        let pressures = self.contact.pressures();
        let pixels: Vec<u8> =
            (0..ny).flat_map(|iy| (0..nx).map(move |ix| colour(pressures[ix * ny + iy]))).collect();
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&pixels)?;
        writer.finish()?;
        Ok(())
    }
}

/// White, then from light to dark blue.
fn palette() -> Vec<u8> {
    const LIGHT: [f64; 3] = [158.0, 202.0, 225.0];
    const DARK: [f64; 3] = [8.0, 29.0, 88.0];
    let colour = |k: u32| {
        let share = f64::from(k) / 254.0;
        [0, 1, 2].map(|channel| (LIGHT[channel] + share * (DARK[channel] - LIGHT[channel])).round() as u8)
    };
    [[255; 3]].into_iter().chain((0..255).map(colour)).flatten().collect()
}
