//! The operator: turns a program into an exact, collision-free, smooth camera path.
//!
//! Enters: a scene prepared as [`World`], a [`Program`] of steps, and cameras that the director proposes
//! ([`StepCameras`]). Leaves: keyframes whose path carries out each step as
//! [`Move`](cinesplat_trajectory::Move) defines it, and a report that compares requested with measured values
//! ([`realize()`]).
//!
//! A bounded, seeded search chooses the parameters that the steps leave open, such as the bearing from which a subject
//! is seen or the length of a push. It minimizes a cost over framing, visibility, clearance, and the region that the
//! capture covers. The path's clearance is then certified for every moment by branch and bound ([`prove_clear`]).
//!
//! The crate does no IO.

mod as_filmed;
mod attainable;
mod capture_region;
mod captured_side;
mod clearance;
mod composition;
mod constraint;
mod contents;
mod cost;
mod crowding;
mod detours;
mod distinct;
mod dutch;
mod ends;
mod facets;
mod film_limits;
mod flow;
mod forbidden;
mod framing;
mod framing_cost;
mod grid;
mod handles;
mod inward;
mod limit;
mod lookout;
mod lookouts;
mod measure;
mod motion;
mod moves;
mod opacity_grid;
mod outline;
mod pacing;
mod passage;
mod pictures;
mod posture;
mod program;
mod realize;
mod report;
mod route;
mod safer;
mod search;
mod settings;
mod sighting;
mod simultaneous;
mod steadiness;
mod stops;
mod suggestion;
mod takes;
mod underside;
mod vertigo;
mod view;
mod wall_side;
mod wording;
mod world;

pub use clearance::{ClearanceIndex, Nearest, SIGMA_LEVEL};
pub use detours::{prove_clear, prove_clear_around, restate_clearance};
pub use program::{
    Amount, FramePlace, Framing, Lens, Level, Limit, Look, MAX_SECOND_MOVES, Motion, Pass, Program, Speed, Step,
    SubjectPart, SubjectSide, Via,
};
pub use realize::{Solution, finalists, realize};
pub use route::{NoRoute, Route, route};
pub use settings::{Slant, SolveLevel, SolveSettings};
pub use sighting::Sighting;
pub use suggestion::StepCameras;
pub use world::World;
