//! The job folder: what is trusted after every kind of damage.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use cinesplat::pipeline::{
    FilmProgress, FilmReport, FilmSettings, JobError, JobSettings, Piece, PipelineError, film, film_part,
};
use cinesplat::render::Renderer;
use cinesplat::trajectory::{EffectRequest, Shot};
use cinesplat::video::VideoSettings;

use super::{scene, settings, shot};

fn with_job() -> FilmSettings {
    FilmSettings { job: Some(JobSettings::default()), ..settings() }
}

/// Films until `num_frames` frames are done.
fn film_until(path: &Path, settings: &FilmSettings, num_frames: usize) -> Result<FilmReport, PipelineError> {
    let mut watch = |progress: FilmProgress| {
        if progress.done == num_frames { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    film(&Renderer::new(&scene().gaussians), &shot(), path, settings, &mut watch)
}

fn film_all(path: &Path, settings: &FilmSettings) -> Result<FilmReport, PipelineError> {
    film_until(path, settings, usize::MAX)
}

/// A folder, the path of a film in it, and the bytes of that film as an undisturbed run makes it.
fn undisturbed() -> (tempfile::TempDir, std::path::PathBuf, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mkv");
    film_all(&path, &settings()).unwrap();
    let whole = fs::read(&path).unwrap();
    fs::remove_file(&path).unwrap();
    (folder, path, whole)
}

fn num_files(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

#[test]
fn a_stopped_film_keeps_its_frames_and_goes_on() {
    let (folder, path, whole) = undisturbed();
    let stopped = film_until(&path, &with_job(), 4).unwrap();
    assert_eq!((stopped.num_frames, stopped.num_wanted, stopped.is_partial()), (4, 10, true));
    assert!(!path.exists());
    let again = film_until(&path, &with_job(), 6).unwrap();
    assert_eq!((again.num_kept, again.num_frames), (4, 6));
    let report = film_all(&path, &with_job()).unwrap();
    assert_eq!((report.num_kept, report.num_damaged, report.is_partial()), (6, 0, false));
    assert!(fs::read(&path).unwrap() == whole);
    assert_eq!(num_files(folder.path()), 1, "the job folder is gone");
}

#[test]
fn a_log_that_is_cut_at_any_byte_loses_only_the_frames_after_the_cut() {
    let (folder, path, whole) = undisturbed();
    film_until(&path, &with_job(), 3).unwrap();
    let (job, saved) = (folder.path().join("film.mkv.job"), folder.path().join("saved"));
    let log = fs::read(job.join("done.log")).unwrap();
    fs::rename(&job, &saved).unwrap();
    for num_bytes in 0..=log.len() {
        fs::create_dir_all(job.join("frames")).unwrap();
        fs::copy(saved.join("job.json"), job.join("job.json")).unwrap();
        for frame in 0..3 {
            let name = format!("frames/{frame:06}.yuv");
            fs::copy(saved.join(&name), job.join(&name)).unwrap();
        }
        fs::write(job.join("done.log"), &log[..num_bytes]).unwrap();
        let num_lines = log[..num_bytes].split(|byte| *byte == b'\n').count() - 1;
        let report = film_all(&path, &with_job()).unwrap();
        assert_eq!((report.num_kept, report.num_damaged), (num_lines, 0), "{num_bytes} bytes");
        assert!(fs::read(&path).unwrap() == whole, "{num_bytes} bytes");
        fs::remove_file(&path).unwrap();
    }
}

#[test]
fn damaged_frames_and_lines_are_rendered_again() {
    let (folder, path, whole) = undisturbed();
    film_until(&path, &with_job(), 8).unwrap();
    let frame = |idx: usize| folder.path().join(format!("film.mkv.job/frames/{idx:06}.yuv"));
    let mut bytes = fs::read(frame(1)).unwrap();
    bytes[1000] ^= 1;
    fs::write(frame(1), &bytes).unwrap();
    fs::write(frame(2), &bytes[..100]).unwrap();
    fs::write(frame(3), b"").unwrap();
    fs::remove_file(frame(4)).unwrap();
    let log = folder.path().join("film.mkv.job/done.log");
    let lines = fs::read_to_string(&log).unwrap();
    let zeros = "\0".repeat(30);
    let wrong =
        format!("{lines}5 0000000000000000\nnot a line\n99 1\n7\n{zeros}\n-1 0123456789abcdef\n6 0123456789abcde");
    fs::write(&log, wrong).unwrap();
    let report = film_all(&path, &with_job()).unwrap();
    assert_eq!((report.num_kept, report.num_damaged), (3, 5), "0, 6 and 7 are whole");
    assert!(fs::read(&path).unwrap() == whole);
}

#[test]
fn a_finished_film_survives_a_failed_rename() {
    let (folder, path, whole) = undisturbed();
    let mut taken = |progress: FilmProgress| {
        if progress.done == 10 {
            fs::create_dir(&path).unwrap();
        }
        ControlFlow::Continue(())
    };
    let made = film(&Renderer::new(&scene().gaussians), &shot(), &path, &with_job(), &mut taken);
    let Err(PipelineError::Job(JobError::NotPlaced { kept, .. })) = made else { panic!("{made:?}") };
    assert!(fs::read(&kept).unwrap() == whole);
    fs::remove_dir(&path).unwrap();
    let mut unasked = |_: FilmProgress| panic!("nothing is rendered");
    film(&Renderer::new(&scene().gaussians), &shot(), &path, &with_job(), &mut unasked).unwrap();
    assert!(fs::read(&path).unwrap() == whole);
    assert_eq!(num_files(folder.path()), 1);
}

/// Its frames used to be examined for effects first, which takes minutes for a long film.
#[test]
fn a_film_that_is_whole_already_is_planned_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mkv");
    let settings = FilmSettings { effects: "vignette".parse().unwrap(), ..with_job() };
    let mut taken = |progress: FilmProgress| {
        if progress.done == 10 {
            fs::create_dir(&path).unwrap();
        }
        ControlFlow::Continue(())
    };
    assert!(film(&Renderer::new(&scene().gaussians), &shot(), &path, &settings, &mut taken).is_err());
    fs::remove_dir(&path).unwrap();
    let report = film_all(&path, &settings).unwrap();
    assert_eq!((report.num_kept, report.effects.effects.len()), (10, 0), "nothing was examined");
}

#[test]
fn a_stopped_film_with_opacity_goes_on_with_its_opacity() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, stopped) = (folder.path().join("whole.mov"), folder.path().join("stopped.mov"));
    let transparent = EffectRequest {
        kind: "background".to_owned(),
        because: "the test".to_owned(),
        settings: vec![("alpha".to_owned(), 1.0)],
        runs: None,
    };
    let shot = Shot { effects: vec![transparent], ..shot() };
    let film_until = |path: &Path, num_frames: usize| {
        let mut watch = |progress: FilmProgress| {
            if progress.done == num_frames { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        film(&Renderer::new(&scene().gaussians), &shot, path, &with_job(), &mut watch).unwrap()
    };
    film_until(&whole, usize::MAX);
    film_until(&stopped, 4);
    assert_eq!(film_until(&stopped, usize::MAX).num_kept, 4);
    assert!(fs::read(&whole).unwrap() == fs::read(&stopped).unwrap());
}

#[test]
fn a_panic_leaves_the_finished_frames_and_no_film() {
    let (folder, path, whole) = undisturbed();
    let disturbed = std::panic::catch_unwind(|| {
        let mut panics = |progress: FilmProgress| {
            assert!(progress.done != 6, "the sixth frame");
            ControlFlow::Continue(())
        };
        film(&Renderer::new(&scene().gaussians), &shot(), &path, &with_job(), &mut panics)
    });
    assert!(disturbed.is_err() && !path.exists());
    let report = film_all(&path, &with_job()).unwrap();
    assert_eq!((report.num_kept, report.num_damaged), (6, 0));
    assert!(fs::read(&path).unwrap() == whole);
    assert_eq!(num_files(folder.path()), 1, "nothing else is left");
}

#[test]
fn files_of_others_in_a_job_folder_stay() {
    let (folder, path, _) = undisturbed();
    film_until(&path, &with_job(), 4).unwrap();
    let notes = folder.path().join("film.mkv.job/notes.txt");
    fs::write(&notes, "mine").unwrap();
    film_all(&path, &with_job()).unwrap();
    assert_eq!(fs::read(&notes).unwrap(), b"mine");
    assert_eq!(num_files(&folder.path().join("film.mkv.job")), 1, "nothing else is left");
}

#[test]
fn pictures_of_a_sequence_are_their_own_frames() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, stopped) = (folder.path().join("whole/%02d.png"), folder.path().join("stopped/%02d.png"));
    film_all(&whole, &settings()).unwrap();
    film_until(&stopped, &with_job(), 6).unwrap();
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    fs::write(folder.path().join("stopped/02.png"), "damaged").unwrap();
    fs::write(folder.path().join("stopped/08.png"), "mine").unwrap();
    let refused = film_all(&stopped, &with_job());
    assert!(matches!(&refused, Err(error) if error.to_string().contains("08.png: exists already")), "{refused:?}");
    fs::remove_file(folder.path().join("stopped/08.png")).unwrap();
    let sheet = Some(folder.path().join("sheet.png"));
    let report = film_all(&stopped, &FilmSettings { sheet: sheet.clone(), ..with_job() }).unwrap();
    assert_eq!((report.num_kept, report.num_damaged), (5, 1));
    for idx in 0..10 {
        assert!(read(&format!("stopped/{idx:02}.png")) == read(&format!("whole/{idx:02}.png")), "{idx}");
    }
    assert_eq!(num_files(&folder.path().join("stopped")), 10, "the job folder is gone");
    let all_at_once = Some(folder.path().join("other.png"));
    film_all(&folder.path().join("other/%02d.png"), &FilmSettings { sheet: all_at_once, ..with_job() }).unwrap();
    assert!(read("sheet.png") == read("other.png"), "the same sheet");
}

/// Pictures that cannot be flushed fail the sequence: they are its output, so that they must be on the disk at its end.
#[test]
fn the_last_pictures_of_a_sequence_are_flushed_before_it_counts_as_whole() {
    let folder = tempfile::tempdir().unwrap();
    let mut watch = |progress: FilmProgress| {
        // By now the encoder has written it: at most five later pictures wait.
        if let Some(written) = progress.done.checked_sub(6) {
            fs::remove_file(folder.path().join(format!("{written:02}.png"))).unwrap();
        }
        ControlFlow::Continue(())
    };
    let pattern = folder.path().join("%02d.png");
    let filmed = film(&Renderer::new(&scene().gaussians), &shot(), &pattern, &with_job(), &mut watch);
    assert!(matches!(filmed, Err(PipelineError::Job(JobError::File(_)))), "{filmed:?}");
}

#[test]
fn a_resting_camera_is_kept_without_copies() {
    let (folder, path, _) = undisturbed();
    let mut resting = shot();
    resting.keyframes.truncate(1);
    let keeps = JobSettings { keeps_frames: true, ..JobSettings::default() };
    let all = |path: &Path, settings: &FilmSettings| {
        film(&Renderer::new(&scene().gaussians), &resting, path, settings, &mut |_| ControlFlow::Continue(())).unwrap();
        fs::read(path).unwrap()
    };
    let whole = all(&folder.path().join("plain.mkv"), &settings());
    assert!(all(&path, &FilmSettings { job: Some(keeps), ..settings() }) == whole);
    let frames = folder.path().join("film.mkv.job/frames");
    assert_eq!(num_files(&frames), 10);
    #[cfg(unix)]
    assert_eq!(std::os::unix::fs::MetadataExt::nlink(&fs::metadata(frames.join("000007.yuv")).unwrap()), 10);
}

#[test]
fn parts_share_a_folder_and_a_film_waits_for_them() {
    let (folder, path, whole) = undisturbed();
    let scene = scene();
    let part = |frames: &str, num_frames: usize| {
        let mut watch = |progress: FilmProgress| {
            if progress.done == num_frames {
                let locked = film_all(&path, &with_job());
                assert!(matches!(locked, Err(PipelineError::Job(JobError::Locked { .. }))), "{locked:?}");
            }
            ControlFlow::Continue(())
        };
        let frames = frames.parse().unwrap();
        film_part(&Renderer::new(&scene.gaussians), &shot(), &path, (&with_job(), frames, Piece::default()), &mut watch)
            .unwrap()
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(|| part("2..8", usize::MAX));
        part("0..6", 3);
        other.join().unwrap();
    });
    let log = fs::read_to_string(folder.path().join("film.mkv.job/done.log")).unwrap();
    assert_eq!(log.lines().count(), 8, "no frame twice: {log}");
    assert_eq!(film_all(&path, &with_job()).unwrap().num_kept, 8);
    assert!(fs::read(&path).unwrap() == whole);
}

#[test]
fn a_film_that_begins_to_fail_at_its_first_frame_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let broken = FilmSettings { video: VideoSettings { crf: 99, ..VideoSettings::default() }, ..with_job() };
    assert!(film_all(&folder.path().join("film.mkv"), &broken).is_err());
    assert_eq!(num_files(folder.path()), 0);
}
