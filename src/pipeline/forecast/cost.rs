use std::fs;
use std::time::Instant;

/// Parts of a second in which Linux counts the time of processes (`USER_HZ`).
const TICKS_A_SECOND: f64 = 100.0;

/// What work takes: time by the clock, and time of all cores together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TimeCost {
    /// Seconds by the clock.
    pub wall_secs: f64,
    /// Seconds of running threads, summed.
    pub cpu_secs: f64,
}

/// What a film takes, from what its parts take alone on this machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmCost {
    /// Frames of the film.
    pub num_frames: usize,
    /// Those that are rendered: all but those of a camera that stands still.
    pub num_rendered: usize,
    /// Rendering a frame, with the memory of the frame before.
    pub render: TimeCost,
    /// Encoding the first frame, with all that an encoder needs once.
    pub first_encode: TimeCost,
    /// Encoding each further frame that was rendered.
    pub encode: TimeCost,
    /// Encoding a frame equal to the one before.
    pub still_encode: TimeCost,
    /// Frames that the encoder takes in before it gives its first one out.
    pub num_ahead: usize,
    /// Cores that renderer and encoder share.
    pub num_cores: usize,
}

impl FilmCost {
    /// Rendering all frames, with nothing beside it.
    pub fn render_all(&self) -> TimeCost {
        self.render.times(self.num_rendered as f64)
    }

    /// Encoding all frames, with nothing beside it.
    pub fn encode_all(&self) -> TimeCost {
        let num_still = self.num_frames.saturating_sub(self.num_rendered);
        let moving = self.encode.times(self.num_rendered.saturating_sub(1) as f64);
        self.first_encode.plus(moving).plus(self.still_encode.times(num_still as f64))
    }

    /// Seconds by the clock for the film: renderer and encoder side by side, each at most as fast as alone, both
    /// together at most as fast as all cores. Before its first frames come and after the last one was rendered, the
    /// encoder has nothing beside it.
    pub fn film_secs(&self) -> f64 {
        let (render, encode) = (self.render_all(), self.encode_all());
        let share = self.num_ahead.min(self.num_frames) as f64 / self.num_frames.max(1) as f64;
        let slower = (render.wall_secs + share * encode.wall_secs).max(encode.wall_secs + share * render.wall_secs);
        slower.min(render.wall_secs + encode.wall_secs).max(self.least_secs())
    }

    /// Seconds by the clock if every core were busy to the end.
    pub fn least_secs(&self) -> f64 {
        (self.render_all().cpu_secs + self.encode_all().cpu_secs) / self.num_cores.max(1) as f64
    }
}

impl TimeCost {
    /// Does work and measures it. Where the system does not tell how busy this process was, every core counts as busy.
    pub fn measure<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let (start, busy_before) = (Instant::now(), cpu_secs());
        let result = work();
        let wall_secs = start.elapsed().as_secs_f64();
        let busy = busy_before.zip(cpu_secs()).map(|(before, after)| after - before);
        (result, Self { wall_secs, cpu_secs: busy.unwrap_or(wall_secs * num_cores() as f64) })
    }

    /// So many times as much.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { wall_secs: self.wall_secs * factor, cpu_secs: self.cpu_secs * factor }
    }

    /// Both together.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { wall_secs: self.wall_secs + other.wall_secs, cpu_secs: self.cpu_secs + other.cpu_secs }
    }

    /// What it takes more than the other, at least nothing.
    #[must_use]
    pub fn beyond(self, other: Self) -> Self {
        let least = |a: f64, b: f64| (a - b).max(0.0);
        Self { wall_secs: least(self.wall_secs, other.wall_secs), cpu_secs: least(self.cpu_secs, other.cpu_secs) }
    }
}

/// Cores that this process may use.
pub fn num_cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Time of all threads that this process ever had, where the system tells (Linux), to a hundredth of a second.
fn cpu_secs() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The program's name is in parentheses; of what follows, the twelfth and thirteenth are user and system time.
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks = fields.split_whitespace().skip(11).take(2).map(|ticks| ticks.parse::<f64>().ok());
    Some(ticks.sum::<Option<f64>>()? / TICKS_A_SECOND)
}
