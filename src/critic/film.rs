//! A finished film, as the critic sees it.

use cinesplat_operator::{Pass, Program, Sighting, Solution, Step, World};
use cinesplat_trajectory::{CameraPath, Move};

/// Times closer than this are one moment.
const MOMENT_SECS: f64 = 1e-3;

/// A film to judge: where the camera is at each moment, and what its words ask for.
#[derive(Debug, Clone)]
pub struct Film {
    /// The camera's path.
    pub path: CameraPath,
    /// Length.
    pub duration_secs: f64,
    /// Size of the film's frames in pixels: width, height.
    pub size_px: [u32; 2],
    /// When it should show which object.
    pub sightings: Vec<Sighting>,
    /// Stretches in which the words ask for matter in front of the lens, from and to, seconds.
    pub foregrounds: Vec<[f64; 2]>,
    /// Whether the scene surrounds the camera: only there is void a fault.
    pub is_indoor: bool,
    /// The cost that the operator minimized, per step of the program, 0 or more.
    pub cost_per_step: f64,
}

impl Film {
    /// The film of a solution.
    pub fn new(world: &World, program: &Program, solution: &Solution, size_px: [u32; 2]) -> Self {
        Self {
            path: CameraPath::fine(solution.keyframes.clone(), world.frame),
            duration_secs: solution.duration_secs,
            size_px,
            sightings: solution.sightings.clone(),
            foregrounds: foregrounds(program, solution),
            is_indoor: world.is_indoor(),
            cost_per_step: solution.cost / program.steps.len().max(1) as f64,
        }
    }

    /// Whether the words ask for matter in front of the lens at a time.
    pub(super) fn wants_foreground(&self, time_secs: f64) -> bool {
        self.foregrounds.iter().any(|[from, to]| (*from..=*to).contains(&time_secs))
    }

    /// Moments at which to look, in order: `num` at even times, the ends included, and those of sightings that last a moment.
    pub(super) fn moments(&self, num: usize) -> Vec<f64> {
        let last = num.max(2) - 1;
        let mut times: Vec<f64> = (0..=last).map(|i| self.duration_secs * i as f64 / last as f64).collect();
        let single = self.sightings.iter().filter(|sighting| sighting.to_secs - sighting.from_secs < MOMENT_SECS);
        times.extend(single.map(|sighting| sighting.from_secs.clamp(0.0, self.duration_secs)));
        times.sort_by(f64::total_cmp);
        times.dedup_by(|a, b| *a - *b < MOMENT_SECS);
        times
    }
}

/// Paths are equal where their keyframes are.
impl PartialEq for Film {
    fn eq(&self, other: &Self) -> bool {
        let key = |film: &Self| (film.duration_secs, film.size_px, film.is_indoor, film.cost_per_step);
        self.path.keyframes() == other.path.keyframes()
            && key(self) == key(other)
            && self.sightings == other.sightings
            && self.foregrounds == other.foregrounds
    }
}

/// The stretches of steps whose words bring matter close to the lens or between lens and subject.
fn foregrounds(program: &Program, solution: &Solution) -> Vec<[f64; 2]> {
    let time = |key: usize| solution.keyframes.get(key).map_or(solution.duration_secs, |key| key.time_secs);
    let spans = solution.step_keys.windows(2).map(|pair| [time(pair[0]), time(pair[1])]);
    program.steps.iter().zip(spans).filter(|(step, _)| is_about_foreground(step)).map(|(_, span)| span).collect()
}

fn is_about_foreground(step: &Step) -> bool {
    let passes = step.via.as_ref().is_some_and(|via| via.how != Pass::Front);
    let hides = step.start.hidden || step.end.hidden;
    passes || hides || matches!(step.movement, Move::Reveal | Move::FlyThrough)
}
