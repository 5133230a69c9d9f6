"""Writes `tests/reliability.md` anew: load held, faults survived, bad inputs tried, and the matrix of faults with its tests.

Usage: python3 tests/faults/page.py target/release/cinesplat [--rows ROW ..] [--kills 20] [--panics PROGRAM] [--fuzz-logs DIR]
           [--slurm-log FILE]

The rows named by --rows are measured now (none without it); figures of other rows stay as they were measured, each with its
date and commit. The page is written after each row. `--rows all` leaves out rows that were measured at this commit without a
fault, so the same line goes on where it was stopped. Figures are kept in a comment at the end of the page. Exits with 1 if a
row finds a fault, or if a test that the matrix names does not exist.
"""

import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys

import run

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "tests" / "reliability.md"
MARK = "<!-- figures "

# Row, fault, and the tests or rows of `run.py` (in backquotes) that cover it; none = not covered.
MATRIX = [
    (1, "PLY counts of 2^60, -1, 1e23, text", ["inconsistent_headers_are_rejected"]),
    (2, "PLY cut at every byte", ["every_truncation_gives_an_error_or_a_scene", "truncated_binary_rows_do_not_load", "`cuts`"]),
    (3, "PLY headers of any kind", ["inconsistent_headers_are_rejected", "a_header_whose_last_line_ending_straddles_the_limit_is_refused"]),
    (4, "PLY with other elements, big-endian, doubles", ["layouts_of_one_gaussian_load_alike", "extra_elements_and_properties_are_skipped"]),
    (5, "trailing bytes", ["bytes_after_the_last_row_give_a_note"]),
    (6, ".splat of a wrong size", ["partial_records_are_rejected"]),
    (7, "decompression bombs", ["decompression_bombs_are_rejected", "an_spz_of_zeros_is_refused_beyond_what_any_small_file_may_unpack_to",
                                "pictures_of_a_sog_that_unpack_to_far_more_than_their_size_are_refused"]),
    (8, "SPZ headers", ["inconsistent_headers_are_rejected", "flipped_header_bits_of_an_spz_never_panic"]),
    (9, "bad checksums, cut streams", ["damaged_gzip_is_rejected"]),
    (10, "all NaN, no Gaussian, one Gaussian", ["no_valid_gaussian_is_an_error_and_one_is_a_scene"]),
    (11, "some Gaussians poisoned", ["invalid_gaussians_are_dropped_and_the_others_are_unchanged", "poisoned_gaussians_change_nothing"]),
    (12, "a million full-screen splats", ["work_above_the_limits_is_an_error_before_any_allocation"]),
    (13, "extreme coordinates", ["extreme_values_are_kept_and_finite", "gaussians_astray_do_not_change_the_objects",
                                 "a_ray_from_a_splat_far_outside_of_the_grid_ends"]),
    (14, "damaged weights", ["a_written_model_loads_and_damage_is_named", "infinite_weights_are_rejected_even_if_the_hash_fits",
                           "weights_whose_outputs_overflow_are_bad_data_and_no_program",
                           "a_tokenizer_with_parts_of_other_programs_is_rejected"]),
    (15, "weights changed after they were read", ["weights_that_change_after_they_were_read_change_nothing"]),
    (16, "weights of another version or hash", ["changed_weights_are_rejected"]),
    (17, "hostile prompts", ["random_and_hostile_prompts_give_finite_programs_about_known_objects", "prompts_that_are_too_long_or_empty_are_rejected",
                             "control_characters_of_files_are_replaced_in_texts"]),
    (18, "hostile keyframes", ["refuses_with_the_place_and_the_reason", "hostile_text_is_refused_cleanly", "a_million_keys_are_refused_in_time"]),
    (19, "unknown objects", ["a_prompt_that_names_an_unknown_object", "an_unknown_object_is_an_error_with_the_nearest_names"]),
    (20, "places that cannot be written", ["places_that_cannot_be_written_are_refused_before_any_work"]),
    (21, "outputs that exist", ["a_file_is_replaced_only_where_the_caller_says_so", "an_output_that_is_an_input_is_refused_before_any_work",
                               "a_file_that_appears_while_the_new_one_is_written_is_kept",
                               "a_name_of_an_open_file_is_written_and_never_replaced"]),
    (22, "strange names of outputs", ["strange_names_of_outputs_are_names", "names_that_look_like_protocols_or_options_are_file_names"]),
    (23, "a full disk at every stage", ["`disk`", "`enospc`", "`writes-enospc`"]),
    (24, "EIO, short write, EINTR at the nth call", ["`eio`", "`short`", "`eintr`", "`writes-eio`", "`writes-short`", "`writes-eintr`"]),
    (25, "limit on file sizes", ["a_limit_on_file_sizes_is_an_error_that_keeps_the_frames", "`file-limits`"]),
    (26, "SIGINT, SIGTERM", ["a_stopped_film_says_the_line_that_goes_on", "a_signal_before_the_first_frame_says_that_nothing_was_begun",
                           "a_stopped_farm_says_one_line_to_go_on", "`stops`"]),
    (27, "SIGKILL", ["a_killed_film_goes_on_and_has_the_bytes_of_an_undisturbed_one", "a_folder_whose_removal_was_cut_off_is_removed_by_the_next_run",
                   "`kills`", "`cleanups`"]),
    (28, "loss of power", ["a_log_that_is_cut_at_any_byte_loses_only_the_frames_after_the_cut", "`losses`"]),
    (29, "frames of another film", ["frames_of_another_film_are_refused_field_by_field", "frames_of_another_build_are_refused",
                                 "another_scene_prompt_or_objects_file_is_refused", "`changes`"]),
    (30, "a damaged frame", ["damaged_frames_and_lines_are_rendered_again"]),
    (31, "two programs on one film", ["one_program_works_on_a_film_and_a_lock_without_a_holder_is_none", "several_programs_render_one_film", "`farm`", "`locks`"]),
    (32, "a lock without a holder", ["one_program_works_on_a_film_and_a_lock_without_a_holder_is_none", "the_file_of_a_program_without_locks_is_heeded_until_it_is_old", "`locks`"]),
    (33, "limits on memory", ["a_bound_on_memory_is_kept_by_bands_or_by_refusal", "a_limit_on_address_space_ends_in_an_error_and_never_in_an_abort",
                              "a_program_that_barely_starts_ends_with_its_exit_code", "a_library_that_gets_no_thread_is_a_lack_of_memory",
                              "what_caches_files_is_left_of_a_containers_memory", "a_block_that_grows_counts_once",
                              "temporary_files_are_removed_at_an_end_without_destructors",
                              "`address-space`", "`max-memory`"]),
    (34, "any number of threads, any instruction set", ["a_film_has_the_same_bytes_on_any_number_of_threads", "every_instruction_set_gives_the_same_bits"]),
    (35, "missing encoder, odd size, too many frames", ["a_film_of_too_many_frames_is_refused_before_it_is_planned", "invalid_arguments"]),
    (36, "other clocks and locales", ["other_locales_and_time_zones_change_no_byte", "`clock`"]),
    (37, "requests for files elsewhere", []),
    (38, "floods of requests", []),
    (39, "a panic of a worker", ["a_panic_leaves_the_finished_frames_and_no_film", "`panics`"]),
    (40, "closed pipes, no HOME, no TMPDIR", ["a_closed_pipe_and_a_missing_home_are_no_faults", "`tmpdir`"]),
]
NO_SERVER = "applies once there is a server"


def existing_tests():
    """Names of all functions of the tests, in `tests` and in the sources."""
    texts = (path.read_text() for folder in ("tests", "src") for path in (ROOT / folder).rglob("*.rs"))
    return {name for text in texts for name in re.findall(r"fn ([a-z0-9_]+)", text)}


def figures():
    """The figures of the last page."""
    text = PAGE.read_text() if PAGE.exists() else ""
    found = text.split(MARK, 1)[1].split(" -->", 1)[0] if MARK in text else "{}"
    return json.loads(found)


def commit():
    """The commit, with a plus where files differ from it."""
    git = lambda *words: subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!tests/reliability.md")
    return git("rev-parse", "--short", "HEAD") + ("+" if changed else "")


def measured(name, make):
    """One row of `run.py`, measured now."""
    row = make()
    for fault in row.faults[:5]:
        print(f"{name}: {fault}", file=sys.stderr, flush=True)
    result = row.result if not row.faults else f"**{len(row.faults)} faults** ({row.result})"
    print(f"| {row.fault} | {row.tried} | {result} |", flush=True)
    return {"fault": row.fault, "tried": row.tried, "result": result, "faults": len(row.faults), "date": str(datetime.date.today()), "commit": commit()}


def fuzzed(folder):
    """Executions, time and coverage per target, from the last line of the logs of `make fuzz`."""
    found = {}
    for log in sorted(pathlib.Path(folder).glob("*.log")):
        text = log.read_text(errors="replace")
        done = re.findall(r"Done (\d+) runs in (\d+) second", text)
        seen = re.findall(r"#(\d+)\s.*?cov: (\d+).*?corp: (\d+)", text)
        runs, secs = (sum(int(run) for run, _ in done), sum(int(secs) for _, secs in done)) if done else (int(seen[-1][0]) if seen else 0, 0)
        found[log.stem] = {"runs": runs, "secs": secs, "corpus": int(seen[-1][2]) if seen else 0,
                           "crashes": len(re.findall(r"(?m)^==\d+== ?ERROR", text)), "date": str(datetime.date.today()), "commit": commit()}
    return found


def of_cluster(log):
    """The rows that `make check-slurm` printed, if it found no fault."""
    lines = [line.strip("| \n").split(" | ") for line in pathlib.Path(log).read_text().splitlines() if line.startswith("| Slurm")]
    assert lines and all(len(line) == 3 and "**" not in line[2] for line in lines), f"{log}: no table, or one with faults"
    return [[*line, str(datetime.date.today()), commit()] for line in lines]


def table(head, lines):
    rule = "|" + "---|" * len(head)
    return "\n".join(["| " + " | ".join(head) + " |", rule, *("| " + " | ".join(line) + " |" for line in lines)])


def matrix(tests, rows):
    """The lines of the matrix, and the names that do not exist."""
    lines, missing = [], []
    for number, fault, names in MATRIX:
        missing += [name for name in names if not name.startswith("`") and name not in tests]
        missing += [name for name in names if name.startswith("`") and name.strip("`") not in rows]
        covered = ", ".join(name if name.startswith("`") else f"*{name}*" for name in names)
        lines.append([str(number), fault, covered or NO_SERVER])
    return lines, missing


def cost():
    """The section of the last page about cost, which is written by hand."""
    text = PAGE.read_text() if PAGE.exists() else ""
    return "## Cost" + text.split("## Cost", 1)[1].split(MARK, 1)[0].rstrip() + "\n\n" if "## Cost" in text else ""


def page(kept, lines):
    lines_of = lambda is_load: [[row["fault"], row["tried"], row["result"], f"`{name}`", row["date"], row["commit"]]
                                for name, row in kept["rows"].items() if name.startswith("load-") == is_load]
    fuzz = [[f"`{name}`", f"{row['runs']:,}", f"{row['secs'] // 60} min", str(row["corpus"]), str(row["crashes"]), row["date"], row["commit"]]
            for name, row in kept["fuzz"].items()]
    return f"""# Reliability

Written by `python3 tests/faults/page.py target/release/cinesplat --rows ROW ..`; do not edit, but for the section on cost. Every figure has the date and the
commit that it was measured at, a plus for a commit with changes. `make faults` measures all rows, `make fuzz` runs the fuzz targets.

## Load held

Memory is the most that the system counted at one time; of several programs it is the sum of their peaks, with shared pages counted
for each.

{table(["load", "tried", "result", "row", "date", "commit"], lines_of(True))}

## Faults survived

`python3 tests/faults/run.py target/release/cinesplat --only ROW` measures one row alone. Films are compared byte by byte with
those of undisturbed runs.

{table(["fault", "tried", "result", "row", "date", "commit"], lines_of(False))}

`make check-slurm`: films of 240 frames by real `sbatch` on two virtual nodes of one machine, compared with the film that one
thread makes.

{table(["fault", "tried", "result", "date", "commit"], kept["slurm"])}

## Bad inputs tried

`make fuzz` (libFuzzer, guided by coverage). Each crash that was found is a small file in `tests/fuzz/seeds`, which the quick tests
read whole, cut and changed (`every_seed_of_the_fuzz_targets_is_read_without_a_panic`).
Reading of `.usdc` and of packed recordings was added after these figures were measured.

{table(["target", "executions", "time", "inputs kept", "open crashes", "date", "commit"], fuzz)}

## Matrix

Names in italics are tests of `make test`, names in backquotes rows of `make faults`.

{table(["", "fault", "covered by"], lines)}

{cost()}{MARK}{json.dumps(kept)} -->
"""


def is_measured(row, num_kills):
    """Whether a row was measured without a fault at this commit, with as many kills."""
    found = commit()
    # A plus stands for changes that no commit tells apart.
    return bool(row) and not row.get("faults", 1) and row.get("kills") == num_kills and row["commit"] == found and not found.endswith("+")


def write(text):
    """Writes the page, whole or not at all."""
    new = PAGE.with_suffix(".md.tmp")
    new.write_text(text)
    new.replace(PAGE)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--rows", nargs="*", default=[])
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--fuzz-logs", help="folder of the logs of make fuzz")
    parser.add_argument("--slurm-log", help="what make check-slurm printed")
    parser.add_argument("--panics", help="the program built with the feature panic-points")
    arguments = parser.parse_args()
    rows = run.rows(os.path.abspath(arguments.program), arguments.kills, arguments.panics)
    kept = {"rows": {}, "fuzz": {}, "slurm": [], **figures()}
    # The row of panics exists in the matrix whether its program was built or not.
    lines, missing = matrix(existing_tests(), [*rows, "panics"])
    if arguments.fuzz_logs:
        kept["fuzz"].update(fuzzed(arguments.fuzz_logs))
    if arguments.slurm_log:
        kept["slurm"] = of_cluster(arguments.slurm_log)
    write(page(kept, lines))
    for name in missing:
        print(f"the matrix names {name}, which does not exist", file=sys.stderr)
    num_faults = 0
    for name in rows if arguments.rows == ["all"] else arguments.rows:
        if arguments.rows == ["all"] and is_measured(kept["rows"].get(name), arguments.kills):
            continue
        kept["rows"][name] = {**measured(name, rows[name]), "kills": arguments.kills}
        num_faults += kept["rows"][name]["faults"]
        write(page(kept, lines))
    sys.exit(1 if missing or num_faults else 0)


if __name__ == "__main__":
    main()
