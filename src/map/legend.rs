//! The column beside the views: what the marks mean, the steps of the film, and what the plan could not meet.

use cinesplat_objects::ObjectSet;
use cinesplat_trajectory::{Intent, Shot};
use glam::DVec2;

use crate::path_marks::tick_secs;
use crate::route::Route;
use crate::style::{CLEARANCE, CONE, GRAY, INK, PALE, SUBJECT, WHITE, number, speed_ink};
use cinesplat_plot::drawing::{Anchor, Ink, Mark, Stroke, TextStyle, text_width_px};

const TEXT_PX: f64 = 11.0;
const LINE_PX: f64 = 16.0;
const SYMBOL_PX: f64 = 34.0;
/// Width of the times before the steps, px.
const STEP_PX: f64 = 68.0;
/// Most steps and unmet requests in the column.
const MAX_STEPS: usize = 12;
const MAX_UNMET: usize = 5;

/// Marks from the top of a column downward.
pub(crate) struct Column {
    pub(crate) marks: Vec<Mark>,
    left: f64,
    width: f64,
    /// Top of the next line, px.
    pub(crate) y: f64,
}

impl Column {
    pub(crate) fn new(corner_px: DVec2, width: f64) -> Self {
        Self { marks: Vec::new(), left: corner_px.x, width, y: corner_px.y }
    }

    fn heading(&mut self, words: &str) {
        self.y += 8.0;
        let (left, right) = (DVec2::new(self.left, self.y), DVec2::new(self.left + self.width, self.y));
        self.marks.push(Mark::Line { points_px: vec![left, right], stroke: Stroke::solid(PALE, 0.8) });
        self.y += 17.0;
        self.marks.push(text(left + DVec2::new(0.0, 17.0), 12.0, INK, true, words));
        self.y += 7.0;
    }

    /// Text in as many lines as it takes.
    fn paragraph(&mut self, indent: f64, ink: Ink, words: &str) {
        for line in wrapped(words, self.width - indent, TEXT_PX) {
            self.marks.push(text(DVec2::new(self.left + indent, self.y + TEXT_PX), TEXT_PX, ink, false, &line));
            self.y += LINE_PX;
        }
        self.y += 2.0;
    }

    /// A symbol with its meaning; the symbol gets the middle of its place.
    fn entry(&mut self, symbol: impl FnOnce(DVec2) -> Vec<Mark>, words: &str) {
        let middle = DVec2::new(self.left + SYMBOL_PX / 2.0 - 4.0, self.y + 7.5);
        self.marks.extend(symbol(middle));
        self.paragraph(SYMBOL_PX, INK, words);
    }

    pub(crate) fn symbols(&mut self, shot: &Shot, route: &Route) {
        self.heading("Path");
        let (slowest, fastest) = route.speeds();
        if fastest > 0.0 {
            self.speed_bar(slowest, fastest);
            let step = tick_secs(route.duration_secs);
            let across = |at: DVec2| vec![line(at - DVec2::new(0.0, 6.0), at + DVec2::new(0.0, 6.0), INK, 1.7)];
            self.entry(
                across,
                &format!("every {}", if step > 1.0 { format!("{step} seconds") } else { "second".to_owned() }),
            );
        } else {
            self.paragraph(0.0, INK, "the camera stays in place");
        }
        let disc = |fill: Ink, ink: Ink| {
            move |at: DVec2| {
                let border = Some(Stroke::solid(INK, 1.5));
                vec![Mark::Circle { center_px: at, radius_px: 7.5, fill: Some(fill), border }, digit(at, ink)]
            }
        };
        self.entry(disc(INK, WHITE), "start, with the number of its key");
        if route.keys.len() > 1 {
            self.entry(disc(WHITE, INK), "key");
            let square = |at: DVec2| {
                let corners = [(-7.0, -7.0), (7.0, -7.0), (7.0, 7.0), (-7.0, 7.0)];
                let outline_px = corners.map(|(x, y)| at + DVec2::new(x, y)).to_vec();
                vec![Mark::Area { outline_px, fill: Some(INK), border: None }, digit(at, WHITE)]
            };
            self.entry(square, "last key");
        }
        let cone = |at: DVec2| {
            let outline_px = vec![at - DVec2::new(0.0, -7.0), at + DVec2::new(11.0, -7.0), at - DVec2::new(11.0, 7.0)];
            let border = Some(Stroke::solid(CONE.with_opacity(0.75), 1.1));
            vec![Mark::Area { outline_px, fill: Some(CONE.with_opacity(0.13)), border }]
        };
        let aspect = f64::from(shot.width) / f64::from(shot.height);
        let fovs = route.keys.iter().map(|key| 2.0 * ((key.fov_y_rad / 2.0).tan() * aspect).atan().to_degrees());
        let (low, high) = fovs.fold((f64::INFINITY, 0.0_f64), |(low, high), fov| (low.min(fov), high.max(fov)));
        let width = if high - low > 0.5 { format!("{low:.0} to {high:.0}") } else { format!("{low:.0}") };
        self.entry(cone, &format!("what a key sees, {width}\u{b0} across"));
    }

    pub(crate) fn subject_symbol(&mut self) {
        let dashes = |at: DVec2| vec![dashed(at, SUBJECT, [7.0, 4.0], 2.0)];
        self.entry(dashes, "box of a subject");
    }

    pub(crate) fn clearance(&mut self, shot: &Shot) {
        let Some(proof) = &shot.clearance else { return };
        let words = match (proof.min_distance.is_finite(), proof.failure) {
            (false, _) => "no solid matter near the path".to_owned(),
            (true, None) => {
                format!("least clearance {} at {:.1} s: clear all the way", number(proof.min_distance), proof.at_secs)
            }
            (true, Some(failure)) => format!(
                "too close to matter from {:.1} to {:.1} s: {}, the camera needs {}",
                failure.from_secs,
                failure.to_secs,
                number(failure.distance),
                number(proof.camera_radius)
            ),
        };
        self.entry(|at| vec![dashed(at, CLEARANCE, [3.0, 3.5], 1.5)], &words);
    }

    fn speed_bar(&mut self, slowest: f64, fastest: f64) {
        let (length, height) = (self.width.min(150.0), 8.0);
        for i in 0..24 {
            let share = f64::from(i) / 23.0;
            let x = self.left + length * f64::from(i) / 24.0;
            let corners = [
                (x, self.y),
                (x + length / 24.0 + 0.4, self.y),
                (x + length / 24.0 + 0.4, self.y + height),
                (x, self.y + height),
            ];
            let outline_px = corners.map(|(x, y)| DVec2::new(x, y)).to_vec();
            self.marks.push(Mark::Area { outline_px, fill: Some(speed_ink(share)), border: None });
        }
        let frame = [(0.0, 0.0), (length, 0.0), (length, height), (0.0, height)];
        let outline_px = frame.map(|(x, y)| DVec2::new(self.left + x, self.y + y)).to_vec();
        self.marks.push(Mark::Area { outline_px, fill: None, border: Some(Stroke::solid(INK, 0.8)) });
        self.y += height + 3.0;
        let least = if slowest < 0.02 * fastest { "0".to_owned() } else { format!("0 (slowest {})", number(slowest)) };
        self.marks.push(text(DVec2::new(self.left, self.y + TEXT_PX), TEXT_PX, INK, false, &least));
        let fastest = format!("{} units/s", number(fastest));
        let at = DVec2::new(self.left + length, self.y + TEXT_PX);
        let fits = text_width_px(&least, TEXT_PX) + text_width_px(&fastest, TEXT_PX) + 8.0 < length;
        let at =
            if fits { at - DVec2::new(text_width_px(&fastest, TEXT_PX), 0.0) } else { at + DVec2::new(6.0, -11.0) };
        self.marks.push(text(at, TEXT_PX, INK, false, &fastest));
        self.y += LINE_PX + 4.0;
    }

    /// The steps of the film with their times, as the keys state them.
    pub(crate) fn steps(&mut self, shot: &Shot, objects: &ObjectSet) {
        let steps = steps(shot, objects);
        if steps.is_empty() {
            return;
        }
        self.heading("Steps");
        for (secs, words) in steps.iter().take(MAX_STEPS) {
            let time = format!("{:.1}\u{2013}{:.1} s", secs[0], secs[1]);
            let at = DVec2::new(self.left, self.y + TEXT_PX);
            self.marks.push(text(at, TEXT_PX, GRAY, false, &time));
            self.paragraph(STEP_PX, INK, words);
        }
        if steps.len() > MAX_STEPS {
            self.paragraph(STEP_PX, GRAY, &format!("and {} more", steps.len() - MAX_STEPS));
        }
    }

    /// What the shot does not meet.
    pub(crate) fn unmet(&mut self, shot: &Shot) {
        let unmet: Vec<_> = shot.report.iter().filter(|line| !line.met).collect();
        if unmet.is_empty() {
            return;
        }
        self.heading("Not met");
        for line in unmet.iter().take(MAX_UNMET) {
            let got = if line.got.is_finite() { format!(", got {}", number(line.got)) } else { String::new() };
            self.paragraph(0.0, INK, &format!("{}: wanted {}{got}", line.clause, line.wanted));
        }
        if unmet.len() > MAX_UNMET {
            self.paragraph(0.0, GRAY, &format!("and {} more", unmet.len() - MAX_UNMET));
        }
    }
}

fn digit(at: DVec2, ink: Ink) -> Mark {
    let style = TextStyle { size_px: 9.5, ink, anchor: Anchor::Middle, is_bold: true };
    Mark::Text { at_px: at + DVec2::new(0.0, 3.4), style, halo_px: 0.0, text: "n".to_owned() }
}

fn line(from: DVec2, to: DVec2, ink: Ink, width_px: f64) -> Mark {
    Mark::Line { points_px: vec![from, to], stroke: Stroke::solid(ink, width_px) }
}

fn dashed(at: DVec2, ink: Ink, dash_px: [f64; 2], width_px: f64) -> Mark {
    let points_px = vec![at - DVec2::new(12.0, 0.0), at + DVec2::new(12.0, 0.0)];
    Mark::Line { points_px, stroke: Stroke::dashed(ink, width_px, dash_px) }
}

/// One line of text without a border.
pub(crate) fn text(at_px: DVec2, size_px: f64, ink: Ink, is_bold: bool, words: &str) -> Mark {
    let style = TextStyle { size_px, ink, anchor: Anchor::Start, is_bold };
    Mark::Text { at_px, style, halo_px: 0.0, text: words.to_owned() }
}

/// Text in lines of at most `width_px`; longer words are broken.
pub(crate) fn wrapped(words: &str, width_px: f64, size_px: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split_whitespace() {
        let Some(line) = lines.last_mut() else { break };
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if text_width_px(&joined, size_px) <= width_px {
            *line = joined;
            continue;
        }
        if !line.is_empty() {
            lines.push(String::new());
        }
        for letter in word.chars() {
            let Some(line) = lines.last_mut() else { break };
            if !line.is_empty() && text_width_px(&format!("{line}{letter}"), size_px) > width_px {
                lines.push(letter.to_string());
            } else {
                line.push(letter);
            }
        }
    }
    lines
}

/// Start and end of each step, seconds, and what happens in it.
fn steps(shot: &Shot, objects: &ObjectSet) -> Vec<([f64; 2], String)> {
    let mut steps: Vec<([f64; 2], String)> = Vec::new();
    for (i, key) in shot.keyframes.iter().enumerate() {
        let end = shot.keyframes.get(i + 1).map_or(shot.duration_secs, |next| next.time_secs);
        let Some(intent) = key.intent.as_ref().filter(|_| end - key.time_secs > 1e-6) else { continue };
        let words = sentence(intent, objects);
        match steps.last_mut() {
            Some((secs, last)) if *last == words => secs[1] = end,
            _ if words.is_empty() => {}
            _ => steps.push(([key.time_secs, end], words)),
        }
    }
    steps
}

/// Move, subjects, size and angle of an intent.
fn sentence(intent: &Intent, objects: &ObjectSet) -> String {
    let name = |id: &u32| match objects.get(*id).filter(|object| !object.label.is_empty()) {
        Some(object) => object.label.clone(),
        None => format!("<obj-{id}>"),
    };
    let subjects: Vec<String> = intent.subjects.iter().map(name).collect();
    let movement = intent.movement.map(|movement| movement.to_string());
    let size = intent.size.map(|size| size.to_string());
    let angle = intent.angle.map(|angle| angle.to_string());
    let subjects = (!subjects.is_empty()).then(|| subjects.join(" and "));
    movement.into_iter().chain(subjects).chain(size).chain(angle).collect::<Vec<_>>().join(", ")
}
