use std::fs;

use super::{SMALL_SCENE, answer, data, run, write_shot};

#[test]
fn help_shows_every_command_and_examples() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["--help"]), @r#"
    exit 0
    Turn a Gaussian-splat scene and a sentence into a camera move, and render it as a film

    Usage: cinesplat [OPTIONS] <COMMAND>

    Commands:
      info         Print what a scene file contains
      objects      Find or read the objects of a scene
      read         Print what a sentence is understood as, without a scene
      plan         Turn a sentence into keyframes
      render       Render a film from a sentence or a shot
      map          Draw a shot in its scene, from above and from the side
      farm         Render a film with several programs over one job folder
      still        Render still pictures from given cameras
      export       Write a shot's camera path for another program
      import       Turn another program's camera path into a shot
      describe     Say what a camera does, from its path alone
      eval         Compare camera paths: absolute and relative pose error
      train        Train the director's network, which understands sentences
      dataset      Generate training data for the director's network
      bench        Measure time, memory and accuracy
      completions  Print a completion script for a shell
      man          Print the manual page, or write one page per command
      help         Print this message or the help of the given subcommand(s)

    Options:
      -q, --quiet
              Print only data and errors: no notes, warnings or progress

          --max-memory <SIZE>
              Memory that the program may take, such as 2G [default: what container and shell allow]
              
              A size takes the place of what the container has left and of the built-in caps, 4 GB for a picture and 32 GB for a scene. The memory of the machine and the container's limit bound it.

      -h, --help
              Print help (see a summary with '-h')

      -V, --version
              Print version

    Examples:
      cinesplat info room.spz
      cinesplat objects room.spz -o objects.json --sheet objects.png
      cinesplat render room.spz -p "push in on the lamp, then orbit it" --objects objects.json -o lamp.mp4
      cinesplat render synth:demo -p "slowly push in on the sofa" -o sofa.mp4

    SCENE is a file (.ply .spz .sog .splat .ksplat .glb .pcd), the folder of an unbundled SOG, or a generated scene:
    synth:demo, synth:room:SEED or synth:tabletop:SEED.
    Data goes to stdout, notes and progress go to stderr. No file is overwritten without --overwrite.
    Exit codes: 0 done, 2 wrong arguments, 65 bad data, 66 no such input, 69 codec missing, 70 fault of
    cinesplat, 71 over a cap, 73 cannot create the output, 74 I/O error, 75 stopped early, 77 permission
    denied, 130 interrupted twice.
    "#);
    insta::assert_snapshot!(answer(folder.path(), &["import", "-h"]), @r"
    exit 0
    Turn another program's camera path into a shot

    Usage: cinesplat import [OPTIONS] --output <SHOT.JSON> <FILE>

    Arguments:
      <FILE>  Camera path to read, or the folder of a COLMAP, EuRoC, nerfstudio or 7-Scenes capture, or RECORDING#TOPIC of ROS

    Options:
          --from <FORMAT>  Format to read [default: by the content of the file]
          --camera <NAME>  Camera to read of a file that holds several [default: the first]
      -q, --quiet          Print only data and errors: no notes, warnings or progress
      -h, --help           Print help (see more with '--help')

    Output:
      -o, --output <SHOT.JSON>  Shot to write, or - for stdout
          --overwrite           Overwrite files that exist already [default: refuse]

    Shot:
          --fps <FPS>   Frames per second [default: the file's, or what its times show]
          --size <WxH>  Frame size in pixels [default: the file's, or 1280x720]
          --fov <DEG>   Vertical field of view in degrees [default: the file's, or 50]
          --up <X,Y,Z>  World up [default: the file's]

    Examples:
      cinesplat import camera_path.json -o shot.json
      cinesplat import poses.txt --from kitti --fps 10 -o shot.json
      cinesplat import poses.tum --size 1920x1080 --fov 40 --up 0,0,1 -o shot.json
      cinesplat import run.bag#/odom -o shot.json
    ");
}

#[test]
fn short_help_fits_on_a_screen_and_long_help_says_more() {
    let folder = tempfile::tempdir().unwrap();
    let commands = [
        "info", "objects", "plan", "render", "map", "farm", "still", "export", "import", "eval", "train", "dataset",
        "bench",
    ];
    for command in commands {
        let (short, long) = (data(folder.path(), &[command, "-h"]), data(folder.path(), &[command, "--help"]));
        assert!(short.lines().count() <= 40, "{command}: {} lines", short.lines().count());
        assert!(long.len() >= short.len() && short.contains("Example"), "{command}");
    }
    assert!(data(folder.path(), &["import", "--help"]).contains("\nFormats:\n  tum "));
}

#[test]
fn features_of_points_are_stored_beside_their_clouds_when_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let dino = fs::canonicalize("tests/vision/dino").unwrap();
    let dino = dino.to_str().unwrap();
    data(folder.path(), &["objects", SMALL_SCENE, "-o", "without.json"]);
    data(folder.path(), &["objects", SMALL_SCENE, "--dino", dino, "-o", "with.json"]);
    // Kept where a file is read and written again.
    data(folder.path(), &["objects", SMALL_SCENE, "--objects", "with.json", "--name", "1=pane", "-o", "again.json"]);
    let bytes = |name: &str| fs::read(folder.path().join(name).with_extension("clouds.safetensors")).unwrap();
    let (without, with) = (bytes("without"), bytes("with"));
    assert!(with == bytes("again"), "other features after reading and writing");
    let tensors = |bytes| safetensors::SafeTensors::deserialize(bytes).unwrap();
    let (without, with) = (tensors(&without), tensors(&with));
    for name in without.names() {
        let (id, points) = (name.strip_suffix(".points").unwrap(), without.tensor(name).unwrap());
        assert!(points.data() == with.tensor(name).unwrap().data(), "{name}");
        assert_eq!(with.tensor(&format!("{id}.dino")).unwrap().shape(), [points.shape()[0], 32]);
    }
    insta::assert_snapshot!(answer(folder.path(), &["objects", SMALL_SCENE, "--dino", dino]), @r"
    exit 2
    error[USAGE]: --dino without a file to write, expected -o OBJECTS.JSON
    help: add -o objects.json: features are stored in the file of clouds beside it
    ");
    insta::assert_snapshot!(answer(folder.path(), &["objects", SMALL_SCENE, "--dino", "none", "-o", "o.json"]), @r"
    exit 66
    error[FILE-READ]: none/config.json: cannot read: No such file or directory (os error 2)
    help: check the path
    ");
}

#[test]
fn info_prints_the_same_facts_as_text_and_json() {
    let folder = tempfile::tempdir().unwrap();
    let info: serde_json::Value = serde_json::from_str(&data(folder.path(), &["info", SMALL_SCENE, "--json"])).unwrap();
    assert_eq!(info["up"], serde_json::json!([0.0, 1.0, 0.0]));
    assert_eq!(info["filter"], "classic");
    assert!(info["num_gaussians"].as_u64().unwrap() > 1000);
    let text = data(folder.path(), &["info", SMALL_SCENE]);
    assert!(text.contains(&format!("gaussians  {}", info["num_gaussians"])), "{text}");
    let turned: serde_json::Value =
        serde_json::from_str(&data(folder.path(), &["info", SMALL_SCENE, "--json", "--up", "0,0,-2"])).unwrap();
    assert_eq!((&turned["up"][2], &turned["up_source"]), (&(-1.0).into(), &"--up".into()));
}

#[test]
fn objects_are_listed_written_and_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let first = data(folder.path(), &["objects", SMALL_SCENE, "--json", "-o", "objects.json"]);
    let again = data(folder.path(), &["objects", SMALL_SCENE, "--json", "--objects", "objects.json"]);
    let (first, again): (serde_json::Value, serde_json::Value) =
        (serde_json::from_str(&first).unwrap(), serde_json::from_str(&again).unwrap());
    assert!(first.as_array().unwrap().len() > 2);
    let names = |list: &serde_json::Value| -> Vec<(u64, String)> {
        let entries = list.as_array().unwrap().iter();
        entries.map(|o| (o["id"].as_u64().unwrap(), o["label"].as_str().unwrap().to_owned())).collect()
    };
    assert_eq!(names(&first), names(&again));
    assert!(folder.path().join("objects.labels.npy").exists());
}

#[test]
fn an_exported_path_is_imported_unchanged() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    data(folder.path(), &["export", "shot.json", "--to", "nerfstudio", "--fps", "10", "-o", "path.json"]);
    let path: serde_json::Value = serde_json::from_slice(&fs::read(folder.path().join("path.json")).unwrap()).unwrap();
    assert_eq!(path["camera_path"].as_array().unwrap().len(), 10);
    data(folder.path(), &["export", "shot.json", "-o", "film.tum"]);
    insta::assert_snapshot!(answer(folder.path(), &["import", "film.tum", "-o", "back.json"]), @r"
    exit 0
    warning: the file has no frame rate: its times are even at 8 frames per second
    warning: the file has no image size: 1280 x 720 is assumed
    warning: the file has no field of view: 50 degrees is assumed
    warning: the file has no world up: the shot states none
    back.json: 8 keys, 1.00 s, from tum
    ");
    assert!(fs::read_to_string(folder.path().join("back.json")).unwrap().contains("\"cinesplat.shot\""));
    let eval = data(folder.path(), &["eval", "shot.json", "film.tum", "--json", "--plot", "plot.svg"]);
    let eval: serde_json::Value = serde_json::from_str(&eval).unwrap();
    assert_eq!(eval["pairs"], 8);
    assert!(eval["max"].as_f64().unwrap() < 1e-6, "{eval}");
    assert!(fs::read_to_string(folder.path().join("plot.svg")).unwrap().starts_with("<svg"));
}

#[test]
fn a_path_that_fits_two_formats_names_the_flag_that_settles_it() {
    let folder = tempfile::tempdir().unwrap();
    let lines = |separator: &str| -> String {
        (0..8).map(|idx| format!("{} {idx} 1.2 1.5 0 0 0 1\n", f64::from(idx) / 8.0).replace(' ', separator)).collect()
    };
    fs::write(folder.path().join("film.tum"), lines(" ")).unwrap();
    fs::write(folder.path().join("film.txt"), lines(",")).unwrap();
    let doubt = "note: film.txt: read as tum (8 columns, seconds, quaternion x y z w); --from euroc reads \
                 seconds, quaternion w x y z\n";
    let answered = answer(folder.path(), &["eval", "film.tum", "film.txt", "--json"]);
    assert!(answered.contains(doubt) && answered.contains("\"pairs\": 8"), "{answered}");
    let wanted = ["--fps", "8", "--size", "64x36", "--fov", "40", "--up", "0,-1,0"];
    let answered = answer(folder.path(), &[&["import", "film.txt", "-o", "film.json"][..], &wanted[..]].concat());
    assert_eq!(answered, format!("exit 0\n{doubt}film.json: 8 keys, 1.00 s, from tum\n"));
}

#[test]
fn an_edited_angle_and_a_misspelled_key_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    data(folder.path(), &["import", "shot.json", "-o", "a.json"]);
    let mut file: serde_json::Value = serde_json::from_slice(&fs::read(folder.path().join("a.json")).unwrap()).unwrap();
    file["keyframes"][1]["euler_deg"]["pitch"] = 12.5.into();
    file["keyframes"][1]["easng"] = "smooth".into();
    fs::write(folder.path().join("b.json"), file.to_string()).unwrap();
    let answer = answer(folder.path(), &["export", "b.json", "-o", "b.tum"]);
    let warnings = "exit 0
warning: b.json: keyframes[1].easng: unknown key, the nearest known key is easing
warning: b.json: keyframes[1].euler_deg: 12.50 degrees from rotation_xyzw, so it was edited and decides
";
    assert!(answer.starts_with(warnings), "{answer}");
}

#[test]
fn folders_are_compared_by_the_names_of_their_files() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    for name in ["planned", "flown"] {
        fs::create_dir(folder.path().join(name)).unwrap();
    }
    for path in ["planned/a.tum", "flown/a.csv", "planned/alone.tum"] {
        data(folder.path(), &["export", "shot.json", "-o", path]);
    }
    fs::copy(folder.path().join("planned/a.tum"), folder.path().join("planned/bad.tum")).unwrap();
    fs::write(folder.path().join("flown/bad.tum"), "no numbers").unwrap();
    let table = data(folder.path(), &["eval", "planned", "flown", "--csv"]);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 3, "{table}");
    assert!(lines[1].starts_with("a,8,") && lines[2].starts_with("bad,,") && lines[2].contains("bad.tum"), "{table}");
    let json = data(folder.path(), &["eval", "planned", "flown", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!((json["over_all"]["compared"].as_u64(), json["over_all"]["failed"].as_u64()), (Some(1), Some(1)));
    let text = data(folder.path(), &["eval", "planned", "flown"]);
    assert!(text.ends_with("1 compared, 1 failed; rmse mean 0.000000, median 0.000000, worst 0.000000\n"), "{text}");
    let motion = data(folder.path(), &["eval", "shot.json", "planned/a.tum", "--json", "--motion"]);
    let motion: serde_json::Value = serde_json::from_str(&motion).unwrap();
    assert_eq!(motion["motion"]["reference"]["table"].as_array().unwrap().len(), 8);
    assert!(motion["motion"]["estimate"]["smoothness"]["jerk_rms"].is_number(), "{motion}");
}

#[test]
fn two_files_of_one_stem_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    for name in ["planned", "flown"] {
        fs::create_dir(folder.path().join(name)).unwrap();
    }
    for path in ["planned/a.tum", "flown/a.csv", "flown/a.tum"] {
        data(folder.path(), &["export", "shot.json", "-o", path]);
    }
    insta::assert_snapshot!(answer(folder.path(), &["eval", "planned", "flown"]), @r#"
    exit 65
    error[EVAL-SAME-STEM]: flown/a.csv and flown/a.tum have the same stem "a", expected one file per stem
    help: rename one of the two, or move it out of the folder: files are paired by their names up to the first dot
    "#);
}

#[test]
fn stills_are_named_after_their_cameras() {
    let folder = tempfile::tempdir().unwrap();
    let camera = |name: &str| {
        format!(
            r#"{{"name":"{name}","width":48,"height":27,"fx":40,"fy":40,"cx":24,"cy":13.5,
                "world_from_camera":[[1,0,0,0],[0,-1,0,1.2],[0,0,-1,1.5],[0,0,0,1]]}}"#
        )
    };
    let cameras = format!(r#"{{"cameras":[{},{}]}}"#, camera("left"), camera("right"));
    fs::write(folder.path().join("cameras.json"), cameras).unwrap();
    let still = ["still", SMALL_SCENE, "--cameras", "cameras.json", "-o", "out", "--npy"];
    data(folder.path(), &still);
    let mut names: Vec<_> = fs::read_dir(folder.path().join("out")).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["left.T.npy", "left.npy", "left.png", "right.T.npy", "right.npy", "right.png"]);
    let npy = fs::read(folder.path().join("out/left.npy")).unwrap();
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (27, 48, 3), }";
    assert!(npy.starts_with(b"\x93NUMPY\x01\x00") && npy[10..].starts_with(header.as_bytes()));
    assert_eq!((npy.len() - 27 * 48 * 3 * 4) % 64, 0);
    let values = npy[npy.len() - 27 * 48 * 3 * 4..].chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap()));
    let png = image::open(folder.path().join("out/left.png")).unwrap().into_rgb8().into_raw();
    for (value, level) in values.zip(png) {
        assert_eq!((value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8, level);
    }
    assert_eq!(run(folder.path(), &still).status.code(), Some(73), "a second run overwrites nothing");
    let cameras = format!(r#"{{"cameras":[{},{},{}]}}"#, camera("left"), camera("right"), camera("left"));
    fs::write(folder.path().join("twice.json"), cameras).unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["still", "no.ply", "--cameras", "twice.json", "-o", "new"]), @r"
    exit 65
    error[CAMERA-NAMES]: twice.json: cameras[0] and cameras[2] both write new/left.png, expected one name per camera
    help: give each camera its own name
    ");
    assert!(!folder.path().join("new").exists());
}

#[test]
fn bench_without_a_scene_or_a_benchmark_is_a_usage_error() {
    let folder = tempfile::tempdir().unwrap();
    let twice = answer(folder.path(), &["bench", "promises", "a/x.ply", "b/x.ply"]);
    assert!(twice.starts_with("exit 2\n") && twice.contains("have one name"), "{twice}");
    assert!(answer(folder.path(), &["bench"]).starts_with("exit 2\n"));
    assert!(answer(folder.path(), &["bench", "operator", "void"]).starts_with("exit 2\n"));
    assert!(answer(folder.path(), &["bench", "operator", "--help"]).contains("films"));
}

#[test]
fn bench_render_prints_rows_and_writes_table_and_plots() {
    let folder = tempfile::tempdir().unwrap();
    let bench = ["bench", "render", SMALL_SCENE, "--sizes", "64x36", "--runs", "1", "--max-cameras", "1", "-o", "out"];
    let csv = data(folder.path(), &bench);
    assert!(csv.starts_with("scene,camera,width,height,kind,variant,threads,median_ms,"), "{csv}");
    assert_eq!(fs::read_to_string(folder.path().join("out/render.csv")).unwrap(), csv);
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let finals = csv.lines().map(cells).find(|row| row[5] == "final").unwrap();
    assert!(finals[18].parse::<f64>().unwrap() > 60.0, "{finals:?}");
    assert!(csv.lines().map(cells).filter(|row| row[4] == "free").all(|row| row[18] == "inf"));
    for name in ["render.md", "render.psnr.svg", "render.ssim.svg", "render.worst.svg"] {
        assert!(folder.path().join("out").join(name).exists(), "{name}");
    }
}

#[test]
fn bench_lens_prints_rows_and_writes_a_plot() {
    let folder = tempfile::tempdir().unwrap();
    let sampling = ["bench", "lens", SMALL_SCENE, "--parts", "sampling", "--size", "64x36", "--runs", "1", "-o", "out"];
    let csv = data(folder.path(), &sampling);
    assert_eq!(fs::read_to_string(folder.path().join("out/lens.csv")).unwrap(), csv);
    assert!(folder.path().join("out/lens.svg").exists());
    let rows: Vec<Vec<String>> = csv.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect();
    // Eight kinds of blur: three presets, no blur, eight numbers of blurred samples, and sharp ones of two kinds from two on.
    assert_eq!(rows.len(), 8 * (3 + 1 + 8 + 7 + 7), "{csv}");
    let psnr_db = |row: &Vec<String>| row[7].parse::<f64>().unwrap();
    let of = |method: &str, samples: &str| -> Vec<f64> {
        rows.iter().filter(|row| row[5] == method && row[6] == samples).map(psnr_db).collect()
    };
    let (blurred, plain) = (of("blurred", "16"), of("plain", "1"));
    assert!(blurred.len() == 8 && blurred.iter().zip(&plain).all(|(blurred, plain)| blurred > plain), "{csv}");
}

#[test]
fn bench_lens_compares_planned_films_with_forced_ones_and_prices_every_effect() {
    let folder = tempfile::tempdir().unwrap();
    let both = ["bench", "lens", SMALL_SCENE, "--parts", "auto,costs", "--size", "64x36", "--runs", "1", "-o", "out"];
    data(folder.path(), &both);
    let rows = |name: &str| -> Vec<Vec<String>> {
        let csv = fs::read_to_string(folder.path().join("out").join(name)).unwrap();
        csv.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    // Four shots at two qualities; no film takes more pictures than the one whose effects run on every frame.
    let films = rows("lens-auto.csv");
    let number = |row: &Vec<String>, at: usize| row[at].parse::<f64>().unwrap();
    assert_eq!(films.len(), 8);
    assert!(films.iter().all(|row| number(row, 6) <= number(row, 7) && number(row, 5) <= 24.0), "{films:?}");
    assert_eq!(rows("lens-costs.csv").len(), cinesplat::lens::KINDS.len());
    // The rows of one camera are not those of another one.
    let two = [&both[..], &["--max-cameras", "2", "--resume", "--overwrite"]].concat();
    data(folder.path(), &two);
    let costs = rows("lens-costs.csv");
    assert_eq!(costs.iter().filter(|row| row[1] == "front").count(), costs.len() / 2);
    assert_eq!((rows("lens-auto.csv").len(), costs.len()), (16, 2 * cinesplat::lens::KINDS.len()));
}

#[test]
fn bench_films_compares_films_with_stills_and_forecasts() {
    let folder = tempfile::tempdir().unwrap();
    let bench =
        ["bench", "films", SMALL_SCENE, "--size", "64x36", "--frames", "8", "--qualities", "draft", "-o", "out"];
    let csv = data(folder.path(), &bench);
    assert_eq!(fs::read_to_string(folder.path().join("out/films.csv")).unwrap(), csv);
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let rows: Vec<_> = csv.lines().skip(1).map(cells).collect();
    let secs = |measure: &str| rows.iter().find(|row| row[5] == measure).unwrap()[6].parse::<f64>().unwrap();
    let off = 100.0 * (secs("predicted") / secs("film") - 1.0);
    let stated: f64 = rows.iter().find(|row| row[5] == "predicted").unwrap()[10].parse().unwrap();
    // The figures are rounded to milliseconds, which is coarse for so short a film.
    let rounding = 0.2 / secs("film");
    assert!((off - stated).abs() <= 0.1 + rounding, "{stated} % printed, {off} % computed");
    assert!(rows.iter().all(|row| row.len() == 11 && row[3] == "8" && row[4] == "draft"), "{csv}");
    assert_eq!(fs::read_to_string(folder.path().join("out/films.md")).unwrap().lines().count(), rows.len() + 2);
}

#[test]
fn bench_scaling_measures_each_case_in_its_own_process() {
    let folder = tempfile::tempdir().unwrap();
    let csv = data(folder.path(), &["bench", "scaling", SMALL_SCENE, "--runs", "1", "--most", "200", "-o", "out"]);
    let growths: Vec<&str> = csv.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(growths, ["pixels", "overdraw", "overdraw", "overdraw", "overdraw"]);
    assert!(fs::read_to_string(folder.path().join("out/scaling.svg")).unwrap().starts_with("<svg"));
}

#[test]
fn a_colmap_model_goes_into_a_new_folder_and_is_overwritten_only_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let export = ["export", "shot.json", "--to", "colmap", "-o", "new/model"];
    assert!(run(folder.path(), &export).status.success());
    let images = folder.path().join("new/model/images.txt");
    fs::write(&images, "mine").unwrap();
    assert_eq!(run(folder.path(), &export).status.code(), Some(73));
    assert_eq!(fs::read_to_string(&images).unwrap(), "mine");
    assert!(run(folder.path(), &[&export[..], &["--overwrite"]].concat()).status.success());
    assert_ne!(fs::read_to_string(&images).unwrap(), "mine");
    // A model in the other layout, which programs read first.
    fs::create_dir(folder.path().join("binary")).unwrap();
    fs::write(folder.path().join("binary/images.bin"), "mine").unwrap();
    let beside = ["export", "shot.json", "--to", "colmap", "-o", "binary"];
    assert_eq!(run(folder.path(), &beside).status.code(), Some(73));
    assert_eq!(fs::read_dir(folder.path().join("binary")).unwrap().count(), 1);
}

#[test]
fn a_dash_is_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let tum = data(folder.path(), &["export", "shot.json", "--to", "tum", "-o", "-"]);
    assert!(run(folder.path(), &["export", "shot.json", "-o", "path.tum"]).status.success());
    assert_eq!(tum, fs::read_to_string(folder.path().join("path.tum")).unwrap());
    let shot = data(folder.path(), &["import", "path.tum", "-o", "-"]);
    assert!(shot.contains("\"format\": \"cinesplat.shot\""), "{shot}");
    let colmap = run(folder.path(), &["export", "shot.json", "--to", "colmap", "-o", "-"]);
    assert_eq!(colmap.status.code(), Some(2), "a folder is no stream");
}

#[test]
fn quiet_leaves_data_and_errors_alone() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &["-q", "info", SMALL_SCENE]);
    assert!(output.stderr.is_empty() && !output.stdout.is_empty());
    let failed = run(folder.path(), &["info", "no.ply", "--quiet"]);
    assert!(String::from_utf8(failed.stderr).unwrap().starts_with("error["));
}

#[test]
fn completions_and_manual_pages_name_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let script = data(folder.path(), &["completions", "bash"]);
    assert!(script.contains("--overwrite") && script.contains("supersplat"));
    assert!(data(folder.path(), &["man"]).starts_with(".ie"), "roff");
    assert!(run(folder.path(), &["man", "-o", "man1"]).status.success());
    for command in ["", "-render", "-eval", "-bench"] {
        assert!(folder.path().join(format!("man1/cinesplat{command}.1")).exists(), "{command}");
    }
    assert_eq!(run(folder.path(), &["man", "-o", "man1"]).status.code(), Some(73));
}

#[test]
fn a_file_of_prompts_gives_a_shot_per_line() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("moves.txt"), "# moves\nstatic shot\nleft\tpan left\nbad\tpush in on <obj-9999>\n")
        .unwrap();
    fs::create_dir(folder.path().join("shots")).unwrap();
    let plan = ["plan", SMALL_SCENE, "--prompts", "moves.txt", "--solve", "off", "-o", "shots/{}.json"];
    let output = run(folder.path(), &plan);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(65), "{said}");
    assert!(said.contains("1 of 3 prompts failed: bad"), "{said}");
    assert!(folder.path().join("shots/002.json").exists() && folder.path().join("shots/left.json").exists());
    let one_name = run(folder.path(), &["plan", SMALL_SCENE, "--prompts", "moves.txt", "-o", "shot.json"]);
    assert_eq!(one_name.status.code(), Some(2));
}

#[test]
fn lines_of_prompts_without_a_name_for_a_file_of_their_own_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |text: &str| {
        fs::write(folder.path().join("p.txt"), text).unwrap();
        answer(folder.path(), &["plan", SMALL_SCENE, "--prompts", "p.txt", "--solve", "off", "-o", "{}.json"])
    };
    for (text, found) in [
        ("../a\tpan left", "line 1: name \"../a\""),
        ("a\tpan left\na\tpan right", "lines 1 and 2"),
        ("a\t ", "line 1: no prompt"),
        ("# nothing\n", "no prompt"),
    ] {
        let said = refused(text);
        assert!(said.starts_with("exit 65") && said.contains(found), "{text:?}: {said}");
    }
    assert!(refused("# of the lamp\npan left\n\nwide\tpull out \r\n").starts_with("exit 0"));
    assert!(folder.path().join("002.json").exists() && folder.path().join("wide.json").exists());
}
