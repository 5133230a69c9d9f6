use std::fs;
use std::time::Instant;

/// Ticks per second in which Linux counts the CPU time of processes (`USER_HZ`).
const TICKS_PER_SECOND: f64 = 100.0;

/// Wall time and CPU time of some work.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TimeCost {
    /// Wall time in seconds.
    pub wall_secs: f64,
    /// CPU time in seconds, summed over all threads.
    pub cpu_secs: f64,
}

/// Time of a film, computed from the times that its parts take alone on this machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmCost {
    /// Frames of the film.
    pub num_frames: usize,
    /// Frames that are rendered: all except those of a resting camera.
    pub num_rendered: usize,
    /// Rendering one frame into the memory of an earlier one.
    pub render: TimeCost,
    /// Encoding the first frame, with the setup of the encoder.
    pub first_encode: TimeCost,
    /// Encoding each further frame that was rendered.
    pub encode: TimeCost,
    /// Encoding a frame that equals the one before.
    pub still_encode: TimeCost,
    /// Frames that the encoder reads before it writes the first one.
    pub num_ahead: usize,
    /// Cores that renderer and encoder share.
    pub num_cores: usize,
}

impl FilmCost {
    /// Rendering all frames, with nothing running in parallel.
    pub fn render_all(&self) -> TimeCost {
        self.render.times(self.num_rendered as f64)
    }

    /// Encoding all frames, with nothing running in parallel.
    pub fn encode_all(&self) -> TimeCost {
        let num_still = self.num_frames.saturating_sub(self.num_rendered);
        let moving = self.encode.times(self.num_rendered.saturating_sub(1) as f64);
        self.first_encode.plus(moving).plus(self.still_encode.times(num_still as f64))
    }

    /// Wall time of the film in seconds. Renderer and encoder run in parallel: each at most as fast as alone, both together
    /// at most as fast as all cores allow. The encoder delay does not overlap: the encoder waits for its first frames and
    /// still works after the last frame is rendered.
    pub fn film_secs(&self) -> f64 {
        let (render, encode) = (self.render_all(), self.encode_all());
        let share = self.num_ahead.min(self.num_frames) as f64 / self.num_frames.max(1) as f64;
        let slower = (render.wall_secs + share * encode.wall_secs).max(encode.wall_secs + share * render.wall_secs);
        slower.min(render.wall_secs + encode.wall_secs).max(self.least_secs())
    }

    /// Wall time in seconds if every core were busy to the end.
    pub fn least_secs(&self) -> f64 {
        (self.render_all().cpu_secs + self.encode_all().cpu_secs) / self.num_cores.max(1) as f64
    }
}

impl TimeCost {
    /// Runs `work` and measures it. Where the system does not report CPU time, every core counts as busy.
    pub fn measure<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let (start, busy_before) = (Instant::now(), cpu_secs());
        let result = work();
        let wall_secs = start.elapsed().as_secs_f64();
        let busy = busy_before.zip(cpu_secs()).map(|(before, after)| after - before);
        (result, Self { wall_secs, cpu_secs: busy.unwrap_or(wall_secs * num_cores() as f64) })
    }

    /// Both times multiplied by `factor`.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { wall_secs: self.wall_secs * factor, cpu_secs: self.cpu_secs * factor }
    }

    /// The sum of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { wall_secs: self.wall_secs + other.wall_secs, cpu_secs: self.cpu_secs + other.cpu_secs }
    }

    /// The difference to `other`, at least 0.
    #[must_use]
    pub fn beyond(self, other: Self) -> Self {
        let least = |a: f64, b: f64| (a - b).max(0.0);
        Self { wall_secs: least(self.wall_secs, other.wall_secs), cpu_secs: least(self.cpu_secs, other.cpu_secs) }
    }
}

/// Number of cores that this process may use.
pub fn num_cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// CPU time of this process in seconds, to a hundredth, ended threads included. `None` where the system does not report it
/// (elsewhere than Linux).
fn cpu_secs() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The program's name is in parentheses. User and system time are the 12th and 13th fields after it.
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks = fields.split_whitespace().skip(11).take(2).map(|ticks| ticks.parse::<f64>().ok());
    Some(ticks.sum::<Option<f64>>()? / TICKS_PER_SECOND)
}
