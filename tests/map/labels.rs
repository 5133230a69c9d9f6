use cinesplat::map::draw;
use cinesplat::map::drawing::Anchor;
use cinesplat::map::drawing::Mark;
use cinesplat::trajectory::Shot;
use glam::{DVec2, DVec3};

use super::{key, mapped, room, texts, travel, views};

#[test]
fn names_and_prompts_are_escaped() {
    let (scene, mut objects) = room();
    objects.objects[0].label = "<obj>&\"\u{1}".to_owned();
    let shot = Shot { prompt: "</svg><script>&".to_owned(), ..travel() };
    let svg = draw(&scene, &objects, &shot).unwrap().to_svg();
    assert!(svg.contains(">&lt;obj&gt;&amp;&quot; &lt;obj-7&gt;</text>"));
    assert!(svg.contains("&lt;/svg&gt;&lt;script&gt;&amp;") && !svg.contains("<script") && !svg.contains('\u{1}'));
    assert_eq!(svg.matches("</svg>").count(), 1);
    assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
}

#[test]
fn the_map_names_start_end_subject_and_prompt() {
    let drawing = mapped(&travel());
    let words: Vec<&str> = texts(&drawing).into_iter().map(|(_, words)| words).collect();
    for expected in ["truck right", "start", "end", "chest <obj-7>", "1", "2", "1 s", "2 s", "3 s"] {
        assert!(words.contains(&expected), "{expected} is not among {words:?}");
    }
    assert_eq!(words.iter().filter(|words| words.starts_with("4 s")).count(), 0, "the end has no tick");
}

/// Rectangle of a text by the width that the SVG states.
fn rectangles(svg: &str) -> Vec<(DVec2, DVec2, String)> {
    let attribute = |line: &str, name: &str| -> Option<String> {
        let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
        Some(line[start..].split('"').next()?.to_owned())
    };
    let texts = svg.lines().filter(|line| line.starts_with("<text") && line.contains("paint-order"));
    texts
        .map(|line| {
            let number = |name: &str| attribute(line, name).unwrap().parse::<f64>().unwrap();
            assert_eq!(attribute(line, "text-anchor").unwrap(), "middle");
            let (middle, size) =
                (DVec2::new(number("x"), number("y") - 0.36 * number("font-size")), number("font-size"));
            let half = DVec2::new(number("textLength") / 2.0, 0.4 * size);
            let words = line.split('>').nth(1).unwrap().split('<').next().unwrap();
            (middle - half, middle + half, words.to_owned())
        })
        .collect()
}

#[test]
fn labels_do_not_cover_each_other() {
    let looks = [DVec3::NEG_Z, DVec3::X, DVec3::new(1.0, -0.5, -1.0), DVec3::NEG_X];
    let keys = looks.iter().enumerate().map(|(i, look)| {
        let at = DVec3::new(0.2 * (i % 2) as f64, 1.2 + 0.1 * i as f64, 0.1);
        key(2.0 * i as f64, at, *look, DVec3::Y)
    });
    let shot = Shot { keyframes: keys.collect(), duration_secs: 7.5, ..travel() };
    let drawing = mapped(&shot);
    assert!(drawing.marks.iter().all(|mark| !matches!(mark, Mark::Text { style, halo_px, .. }
        if *halo_px > 0.0 && style.anchor != Anchor::Middle)));
    let found = rectangles(&drawing.to_svg());
    assert!(found.len() > 8, "{found:?}");
    for (i, a) in found.iter().enumerate() {
        for b in &found[..i] {
            let apart = a.0.cmpge(b.1).any() || a.1.cmple(b.0).any();
            assert!(apart, "{a:?} and {b:?}");
        }
    }
    let inside =
        |(corner, size): &(DVec2, DVec2), at: DVec2| at.cmpge(*corner).all() && at.cmple(*corner + *size).all();
    let views = views(&drawing);
    assert!(found.iter().all(|(low, high, _)| views.iter().any(|view| inside(view, *low) && inside(view, *high))));
}
