//! Films that a cluster renders; small programs stand for Slurm's.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use super::{SMALL_SCENE, data, write_shot};

/// The film of these tests: 24 frames.
const FILM: [&str; 9] = [SMALL_SCENE, "--shot", "shot.json", "--size", "320x180", "--fps", "24", "-o", "film.mp4"];

/// Writes its words, and the number 7 of a job. `tasks` runs the tasks of that job.
const SBATCH: &str = r#"#!/bin/sh
for word; do
    printf '<%s>' "$word"
    case "$word" in
        --array=1-*) num=${word#--array=1-} ;;
        --output=*) log=$(echo "${word#--output=}" | sed 's/%A-%a/7-1/') ;;
    esac
    script=$word
done >> sbatch.words
echo >> sbatch.words
cat > tasks <<END
export SLURM_ARRAY_TASK_COUNT=${num:-0}
for SLURM_ARRAY_TASK_ID in $(seq -s ' ' 1 ${num:-0}); do
    export SLURM_ARRAY_TASK_ID
    sh -c "\$(tail -n 1 '$script') \$1" >> '$log' 2>&1
done
END
echo 7
"#;

/// Runs the tasks at once.
const IDLE_QUEUE: &str = "#!/bin/sh\nsh tasks\n";

/// A person holds the tasks at first. Then they do the frames 0..9 and their node fails; those of the next job do the rest.
const BUSY_QUEUE: &str = r"#!/bin/sh
echo >> calls
case $(wc -l < calls) in
    1) echo 'PENDING|JobHeldUser' ;;
    2) sh tasks '--frames 0..9'; echo 'PENDING|launch failed requeued held' ;;
    *) sh tasks ;;
esac
";

const SCANCEL: &str = "#!/bin/sh\necho \"$@\" >> canceled\n";

/// A folder with a shot and programs that stand for Slurm's.
struct Cluster(tempfile::TempDir);

impl Cluster {
    fn new(sbatch: &str, squeue: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        write_shot(folder.path());
        fs::create_dir(folder.path().join("bin")).unwrap();
        for (name, text) in [("sbatch", sbatch), ("squeue", squeue), ("scancel", SCANCEL)] {
            let path = folder.path().join("bin").join(name);
            fs::write(&path, text).unwrap();
            fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
        }
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    /// Exit code and stderr of a farm.
    fn farm(&self, arguments: &[&str]) -> (i32, String) {
        let path = format!("{}:{}", self.path().join("bin").display(), std::env::var("PATH").unwrap());
        let mut program = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
        let program = program.args(["farm", "--slurm"]).args(arguments).current_dir(self.path()).env("PATH", path);
        let output = program.output().unwrap();
        (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
    }

    /// The words of each job, each word in angle brackets.
    fn submitted(&self) -> Vec<String> {
        let text = fs::read_to_string(self.path().join("sbatch.words")).unwrap_or_default();
        text.lines().map(str::to_owned).collect()
    }
}

/// Tasks that a person held used to be canceled.
#[test]
fn a_cluster_renders_one_film_waits_for_held_tasks_and_is_given_again_what_it_lost() {
    let cluster = Cluster::new(SBATCH, BUSY_QUEUE);
    data(cluster.path(), &[&["render"], &FILM[..], &["--keep-frames"]].concat());
    let film = cluster.path().join("film.mp4");
    let whole = fs::read(&film).unwrap();
    fs::remove_file(&film).unwrap();
    fs::remove_dir_all(cluster.path().join("film.mp4.job")).unwrap();

    let (code, said) = cluster.farm(&[&["--parts", "3", "--sbatch", "--partition=long -t 5"], &FILM[..]].concat());
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("tasks: 1 held") && said.contains("held tasks run after `scontrol release 7`"), "{said}");
    assert!(said.contains("never starts the tasks that are left: launch failed requeued held"), "{said}");
    assert!(said.contains("15 frames are missing: they are submitted again"), "{said}");
    assert!(fs::read(&film).unwrap() == whole);
    assert_eq!(fs::read_to_string(cluster.path().join("canceled")).unwrap(), "7\n", "once, and not while it was held");
    let jobs = cluster.submitted();
    assert_eq!(jobs.len(), 2, "{jobs:?}");
    let ends = "<--partition=long><-t><5><film.mp4.job/tasks/part.sh>";
    assert!(jobs[0].contains("<--array=1-3>") && jobs[0].ends_with(ends), "{}", jobs[0]);
    assert!(!cluster.path().join("film.mp4.job").exists());
}

/// A dependency of the user's used to take the place of the one on the tasks: the film was made before they had begun.
#[test]
fn the_job_that_makes_the_film_waits_for_the_tasks_and_for_what_the_user_names() {
    for (words, expected, further) in [
        (
            "--comment='two words' --dependency=afterok:99",
            "<--dependency=afterany:7,afterok:99>",
            "<--comment=two words>",
        ),
        ("-d afterok:98 \"--comment=it's\"", "<--dependency=afterany:7,afterok:98>", "<--comment=it's>"),
        ("--depend afterok:1?afterok:2", "<--dependency=afterany:7>", ""),
    ] {
        let cluster = Cluster::new(SBATCH, IDLE_QUEUE);
        let (code, said) = cluster.farm(&[&["--no-wait", "--sbatch", words], &FILM[..]].concat());
        assert_eq!(code, 0, "{said}");
        let jobs = cluster.submitted();
        assert_eq!(jobs.len(), 2, "{jobs:?}");
        assert!(jobs[0].contains("afterok:") && jobs[0].contains(further), "{}", jobs[0]);
        assert!(jobs[1].contains(expected) && jobs[1].contains(further), "{}", jobs[1]);
        assert_eq!(jobs[1].matches("afterok:").count(), usize::from(expected.contains("afterok")), "{}", jobs[1]);
    }
    let cluster = Cluster::new(SBATCH, IDLE_QUEUE);
    let (code, said) = cluster.farm(&[&["--sbatch", "--comment='two"], &FILM[..]].concat());
    assert!(code == 2 && said.contains("a quote ' without its end"), "{code}: {said}");
}

/// They used to be submitted, to fail there, and to end in 69 whatever was wrong.
#[test]
fn bad_inputs_are_refused_before_anything_is_submitted() {
    let cluster = Cluster::new(SBATCH, IDLE_QUEUE);
    fs::write(cluster.path().join("cut.ply"), "ply\nformat ascii 1.0\n").unwrap();
    fs::write(cluster.path().join("bad.json"), "{}").unwrap();
    let prompt = ["-p", "push in on the unicorn"];
    for (scene, shot, code, said) in [
        ("none.ply", &["--shot", "shot.json"], 66, "error[SCENE-NOT-FOUND]: none.ply"),
        ("cut.ply", &["--shot", "shot.json"], 65, "error[PLY-HEADER]: cut.ply"),
        (SMALL_SCENE, &["--shot", "none.json"], 66, "none.json"),
        (SMALL_SCENE, &["--shot", "bad.json"], 65, "bad.json"),
        (SMALL_SCENE, &prompt, 65, "unicorn"),
    ] {
        let found = cluster.farm(&[&[scene], &shot[..], &["-o", "film.mp4"]].concat());
        assert!(found.0 == code && found.1.contains(said), "{scene} {shot:?}: {found:?}");
    }
    assert_eq!(cluster.submitted(), [""; 0]);
    assert!(!cluster.path().join("film.mp4.job").exists());
}

/// Inputs that an earlier job makes were missed.
#[test]
fn tasks_that_wait_for_a_job_are_submitted_before_their_inputs_are_there() {
    let cluster = Cluster::new(SBATCH, IDLE_QUEUE);
    let line = ["--no-wait", "--sbatch", "--dependency=afterok:9", "none.ply", "-p", "x", "-o", "film.mp4"];
    let (code, said) = cluster.farm(&line);
    assert!(code == 0 && cluster.submitted().len() == 2, "{code}: {said}");
}

#[test]
fn what_the_cluster_refuses_is_told_from_a_cluster_that_is_away() {
    for (reason, expected) in [
        ("sbatch: error: invalid partition specified: x", 2),
        ("sbatch: error: Batch job submission failed: Unable to contact slurm controller (connect failure)", 69),
    ] {
        let cluster = Cluster::new(&format!("#!/bin/sh\necho '{reason}' >&2\nexit 1\n"), IDLE_QUEUE);
        let (code, said) = cluster.farm(&FILM);
        assert!(code == expected && said.contains(reason), "{code}: {said}");
        assert!(!cluster.path().join("film.mp4.job").exists(), "nothing is left of a job that was not taken");
    }
    let cluster = Cluster::new("#!/bin/sh\necho 7\n", "#!/bin/sh\n");
    let (code, said) = cluster.farm(&FILM);
    assert!(code == 69 && said.contains("the tasks of job 7 finished no frame: they said nothing"), "{code}: {said}");
}

/// It used to leave a job folder with a script.
#[test]
fn without_slurm_a_farm_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let mut program = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
    let program = program.args(["farm", "--slurm"]).args(FILM).current_dir(folder.path()).env("PATH", folder.path());
    let output = program.output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(69) && said.contains("error[SLURM-MISSING]: sbatch: "), "{said}");
    assert!(!folder.path().join("film.mp4.job").exists());
}
