//! Union, difference and intersection of thousands of random solids: closed, with volumes that add
//! up, also where faces lie nearly on faces.
//!
//! With `BOOLEANS_TO` in the environment, the pairs are also written to that file with the volumes
//! found, a line of JSON each, for `benchmarks/grammar/booleans.py`, which asks another library; as many as
//! `FUZZ_CASES` says.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::draw;

use std::f64::consts::TAU;
use std::fmt::Write;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{
    boolean, cone, cube, cylinder, roofed, sphere, Boolean, Gables, Mesh, RoofKind,
};

use draw::Draw;

const ALL: [Boolean; 3] = [Boolean::Union, Boolean::Subtract, Boolean::Intersect];
const PAIRS: u64 = 2_000;

impl Draw {
    /// From -1 to 1.
    fn number(&mut self) -> f64 {
        self.share() * 2.0 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    fn turn(&mut self) -> DMat3 {
        DMat3::from_axis_angle(self.vector().normalize(), TAU * self.number())
    }

    /// A solid of some size around the origin; `steps` makes faces lie on faces of others.
    fn solid(&mut self, steps: bool) -> Mesh {
        let base = match self.below(6) {
            0 | 1 => cube(),
            2 => cylinder(3 + self.below(9)),
            3 => cone(3 + self.below(9)),
            4 => sphere(3 + self.below(5), 2 + self.below(4)),
            _ => {
                let plan = [
                    (0.0, 0.0),
                    (1.0, 0.0),
                    (1.0, 0.4),
                    (0.5, 0.4),
                    (0.5, 1.0),
                    (0.0, 1.0),
                ];
                let plan = Mesh::polygon(&[plan.map(|(x, y)| DVec3::new(x, y, 0.0))]);
                let kinds = [
                    RoofKind::HIP,
                    RoofKind::GABLE,
                    RoofKind::Mansard {
                        upper: 0.3,
                        knee: 0.1,
                    },
                    RoofKind::Gable {
                        gables: Gables::Edges(vec![0, 2]),
                        even: false,
                    },
                ];
                roofed(&plan, &kinds[self.below(4)], 0.7).unwrap()
            }
        };
        let quarter = |v: DVec3| if steps { (4.0 * v).round() / 4.0 } else { v };
        let size = 1.0 + 0.5 * quarter(self.vector());
        let by = quarter(self.vector());
        let turn = match (steps, self.below(4)) {
            (true, 0) => DMat3::from_rotation_z(TAU / 8.0),
            (true, _) => DMat3::IDENTITY,
            (false, _) => self.turn(),
        };
        base.mapped(|unit| turn * ((unit - 0.5) * size) + by)
    }

    /// A pair, and how it is made.
    fn pair(&mut self) -> (Mesh, Mesh, &'static str) {
        let steps = self.below(2) == 0;
        let (a, b) = (self.solid(steps), self.solid(steps));
        let tiny = 10f64.powf(-8.0 + 3.0 * self.number());
        match self.below(8) {
            0 | 1 => (a, b, "any"),
            2 => (nearly(&a, self, tiny), a, "nearly the same"),
            3 => (nearly(&a, self, tiny), b, "nearly beside"),
            4 => (combined(&a, &b, Boolean::Union), b, "the union and a part"),
            5 => (
                combined(&a, &b, Boolean::Subtract),
                b,
                "the rest and what was cut",
            ),
            6 => {
                let c = self.solid(steps);
                let turn = self.turn();
                let both = combined(&a, &b, Boolean::Union);
                (
                    both.mapped(|p| turn * p),
                    c.mapped(|p| turn * p),
                    "three, turned",
                )
            }
            _ => {
                let far = 1e5 * self.vector();
                (
                    a.mapped(|p| p + far),
                    b.mapped(|p| p + far),
                    "far from the origin",
                )
            }
        }
    }
}

/// A solid moved and turned by very little.
fn nearly(solid: &Mesh, draw: &mut Draw, tiny: f64) -> Mesh {
    let turn = DMat3::from_axis_angle(draw.vector().normalize(), tiny * draw.number());
    let by = tiny * draw.vector();
    solid.clone().mapped(|p| turn * p + by)
}

fn combined(a: &Mesh, b: &Mesh, how: Boolean) -> Mesh {
    match boolean(a, b, how) {
        Ok(made) if !made.mesh.is_empty() => made.mesh,
        _ => a.clone(),
    }
}

/// What became of a pair that has no volumes.
enum Fault {
    Refused,
    Wrong(String),
}

/// The volumes of union, difference and intersection; what is wrong with them as words.
fn volumes(a: &Mesh, b: &Mesh) -> Result<[f64; 3], Fault> {
    let mut found = [0.0; 3];
    for (operation, volume) in ALL.into_iter().zip(&mut found) {
        let made = boolean(a, b, operation).map_err(|_| Fault::Refused)?;
        if !(made.mesh.is_empty() || made.mesh.is_closed()) {
            return Err(Fault::Wrong(format!("{operation:?} is open")));
        }
        *volume = made.mesh.volume();
    }
    let [union, rest, common] = found;
    let scale = 1e-6 * (a.volume() + b.volume());
    let near = |x: f64, y: f64| (x - y).abs() <= scale;
    if near(union + common, a.volume() + b.volume()) && near(rest + common, a.volume()) {
        Ok(found)
    } else {
        let (a, b) = (a.volume(), b.volume());
        Err(Fault::Wrong(format!("volumes {found:?} of {a} and {b}")))
    }
}

/// A mesh as JSON: points, and faces as lists of rings.
fn written(mesh: &Mesh) -> String {
    let points: Vec<[f64; 3]> = mesh.points.iter().map(|p| p.to_array()).collect();
    let faces: Vec<Vec<&[u32]>> = mesh.faces().map(|face| face.rings().collect()).collect();
    format!("{{\"points\": {points:?}, \"faces\": {faces:?}}}")
}

#[test]
fn volumes_add_up_and_hardly_any_pair_is_refused() {
    let told = |name: &str| std::env::var(name).ok();
    let number = |name: &str| told(name).and_then(|told| told.parse::<u64>().ok());
    let first = number("FUZZ_FIRST").unwrap_or(0);
    let mut lines = String::new();
    let (mut wrong, mut refused) = (Vec::new(), Vec::new());
    let count = number("FUZZ_CASES").unwrap_or(PAIRS);
    for seed in first..first + count {
        let mut draw = Draw(seed.wrapping_mul(0xd134_2543_de82_ef95));
        let (a, b, kind) = draw.pair();
        let found = volumes(&a, &b);
        if told("BOOLEANS_TO").is_some() {
            let volumes = found
                .as_ref()
                .map_or("null".into(), |found| format!("{found:?}"));
            let (one, other) = (written(&a), written(&b));
            let line = format!("{{\"pair\": {seed}, \"kind\": {kind:?}, \"a\": {one}, \"b\": {other}, \"volumes\": {volumes}}}");
            writeln!(lines, "{line}").unwrap();
        }
        match found {
            Ok(_) => {}
            Err(Fault::Refused) => refused.push(seed),
            Err(Fault::Wrong(why)) => wrong.push(format!("FUZZ_FIRST={seed} ({kind}): {why}")),
        }
    }
    if let Some(path) = told("BOOLEANS_TO") {
        std::fs::write(path, lines).unwrap();
    }
    assert!(
        wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
    // Of 10,000 pairs about three are refused: with a message, and nothing is made.
    assert!(
        refused.len() as u64 <= 1 + count / 1_000,
        "refused: {refused:?}"
    );
}
