# make demo   builds cinesplat and films a generated room
# make test   the gate: formatting, lints, docs, tests
# make        this list

SHELL := /bin/bash
BIN := target/release/cinesplat
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
# What ffmpeg-next needs to build, besides libclang (see deps).
PACKAGES := build-essential pkg-config libavcodec-dev libavformat-dev libavutil-dev
DEMO_SCENE := synth:demo
DEMO_PROMPT := slowly push in on the sofa, then orbit it to the right

# Scenes of the bench, each with its cameras file behind an @.
DATA := ../shared/data
BENCH_REAL := kitchen/scene.spz@golden/kitchen.cameras.json composites/kitchen_plus_dev.spz@golden/kitchen.cameras.json \
	guitar/guitar.compressed.ply@golden/guitar.cameras.json composites/livingroom_surfels.spz skull/skull.sog \
	playbot/2_0 playbot/3_0 playbot/4_0 playbot/5_0 playbot/6_0
BENCH_FOUND := $(foreach scene,$(BENCH_REAL),$(if $(wildcard $(DATA)/$(firstword $(subst @, ,$(scene)))),$(scene)))
BENCH_SCENES := $(if $(BENCH_FOUND),$(foreach scene,$(BENCH_FOUND),$(DATA)/$(firstword $(subst @, ,$(scene)))@$(if \
	$(word 2,$(subst @, ,$(scene))),$(DATA)/$(word 2,$(subst @, ,$(scene))),auto)),synth:demo@auto synth:tabletop:1@auto)

FILM_SCENES := $(if $(wildcard $(DATA)/kitchen/scene.spz),$(DATA)/kitchen/scene.spz synth:demo \
	--cameras $(DATA)/golden/kitchen.cameras.json --cameras auto,synth:demo)

.DEFAULT_GOAL := help
.PHONY: help deps build demo test train bench bench-lens faults fuzz reliability check-shots check-exchange check-slurm gallery gallery-effects clean

help:
	@sed -n 's/^# //p' $(firstword $(MAKEFILE_LIST)) | sed -n '1,/^make   /p'

# Installs only missing packages. The name of the libclang package contains a version; the newest one is installed.
deps:
	@command -v cargo >/dev/null || { echo "cargo is missing: install Rust 1.95 or newer from https://rustup.rs" >&2; exit 69; }
	@command -v dpkg-query >/dev/null || { echo "not Debian or Ubuntu: install FFmpeg's development files (libavcodec, libavformat, libavutil), pkg-config, a C compiler and libclang, then 'make build'" >&2; pkg-config --exists libavcodec libavformat libavutil; exit; }
	@installed() { dpkg-query -W -f='$${db:Status-Abbrev}\n' "$$1" 2>/dev/null | grep -q '^ii'; }; \
	missing=""; for package in $(PACKAGES); do installed "$$package" || missing="$$missing $$package"; done; \
	{ installed 'libclang1-*' || installed 'libclang-[0-9]*-dev'; } && installed 'libclang-common-*-dev' || missing="$$missing clang"; \
	[ -n "$$missing" ] || exit 0; \
	echo "installing:$$missing"; \
	$(SUDO) apt-get update -q || exit 69; \
	if [[ "$$missing" == *" clang" ]]; then \
		missing="$${missing% clang}"; \
		for number in $$(apt-cache search --names-only '^libclang-common-[0-9]+-dev$$' | grep -oE '[0-9]+' | sort -rnu); do \
			library=$$(apt-cache search --names-only "^libclang1-$${number}(t64)?$$" | cut -d' ' -f1 | head -n1); \
			[ -n "$$library" ] && { missing="$$missing $$library libclang-common-$${number}-dev"; break; }; \
		done; \
	fi; \
	$(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $$missing || exit 69

build: deps
	cargo build --release --locked

# Writes renders/demo.mp4, renders/demo.shot.json and renders/demo.sheet.png. Needs nothing but this folder.
demo: build
	$(BIN) render $(DEMO_SCENE) -p "$(DEMO_PROMPT)" -o renders/demo.mp4 \
		--save-shot renders/demo.shot.json --sheet renders/demo.sheet.png --overwrite

# One gate for people and CI. Tests run optimized and share the demo's compiled dependencies.
# Without RAYON_NUM_THREADS, candle counts the processors again before each product of matrices: training takes twice as long.
test: deps
	cargo fmt --check
	cargo clippy --release --locked --workspace --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --release --locked --workspace --no-deps
	RAYON_NUM_THREADS=$$(nproc) cargo test --release --locked --workspace

# Long runs, not part of the gate. Training takes hours; models/README.md says what the shipped weights were made with.
train: build
	$(BIN) dataset -o target/train/shots
	$(BIN) train --names -o target/train/model --sentences prompts/corpus
	$(BIN) train -o target/train/model --sentences prompts/corpus --shots target/train/shots
	$(BIN) train --calibrate target/train/model --sentences prompts/corpus

# Accuracy against time, how cost grows, films against forecasts: CSV, tables and plots in renders/bench. Uses the real scenes in DATA, if there are any.
bench: build
	$(BIN) bench render $(foreach scene,$(BENCH_SCENES),$(word 1,$(subst @, ,$(scene)))) \
		$(foreach scene,$(BENCH_SCENES),--cameras $(word 2,$(subst @, ,$(scene)))) \
		--sizes 1280x720,1920x1080 --overwrite -o renders/bench > /dev/null
	$(BIN) bench scaling synth:tabletop:1 --overwrite -o renders/bench > /dev/null
	$(BIN) bench films $(FILM_SCENES) --overwrite -o renders/bench > /dev/null
	$(BIN) bench encoder $(FILM_SCENES) --overwrite -o renders/video > /dev/null
	$(BIN) bench director --overwrite -o renders/bench > /dev/null

# Effects: blur over samples and methods, films with effects where they show against films with effects on every frame, and the
# cost of each. Takes a quarter of an hour on two cores, in pieces of LENS_SECS at most: rows that the folder holds are kept.
LENS_SECS := 450
LENS_REAL := composites/kitchen_plus_dev.spz@golden/kitchen.cameras.json playbot/2_0@auto skull/skull.sog@auto
LENS_FOUND := $(foreach scene,$(LENS_REAL),$(if $(wildcard $(DATA)/$(firstword $(subst @, ,$(scene)))),$(scene)))
LENS_SCENES := $(if $(LENS_FOUND),$(foreach scene,$(LENS_FOUND),$(DATA)/$(firstword $(subst @, ,$(scene)))@$(patsubst \
	golden%,$(DATA)/golden%,$(word 2,$(subst @, ,$(scene))))),synth:demo@auto)
bench-lens: build
	timeout --foreground $(LENS_SECS) nice $(BIN) bench lens $(foreach scene,$(LENS_SCENES),$(word 1,$(subst @, ,$(scene)))) \
		$(foreach scene,$(LENS_SCENES),--cameras $(word 2,$(subst @, ,$(scene)))) \
		--size 480x270 --resume --overwrite -o renders/lens > /dev/null || \
		{ code=$$?; [ $$code = 124 ] || exit $$code; echo "stopped: make bench-lens again goes on with the next row" >&2; exit 75; }

# Kills, stops and starves renders and other commands, and compares their films with undisturbed ones; prints a table.
# Takes about half an hour. Needs Python, and a C compiler for the rows of failing writes.
faults: target/cinesplat-panics
	python3 tests/faults/run.py $(BIN) --panics target/cinesplat-panics

# The program with the feature panic-points.
target/cinesplat-panics: build
	cargo build --release --locked --features panic-points && cp $(BIN) $@
	cargo build --release --locked

# Films on a Slurm cluster of two virtual nodes on this machine that lose tasks and nodes; prints a table. Needs root and
# Debian's packages slurmctld, slurmd, slurm-client and munge; takes ten minutes.
check-slurm: build
	set -o pipefail; python3 tests/slurm/check.py $(BIN) | tee target/slurm.txt

# Fuzzes every reader for FUZZ_SECS seconds each, guided by coverage; a crash stops its target, is written to
# tests/fuzz/artifacts, and makes this fail when the other targets are done.
# Needs a nightly compiler and cargo-fuzz (`cargo install cargo-fuzz`).
FUZZ_SECS := 1800
FUZZ_TARGETS := scene path shot cameras objects array model names vocabulary gguf mask prompt reading
fuzz:
	mkdir -p target/fuzz
	cd tests/fuzz && cargo +nightly fuzz build --fuzz-dir . --target-dir ../../target/fuzz -s none
	cd tests/fuzz && failed=""; for target in $(FUZZ_TARGETS); do \
		mkdir -p corpus/$$target; log=../../target/fuzz/$$target.log; \
		if cargo +nightly fuzz run --fuzz-dir . --target-dir ../../target/fuzz -s none $$target corpus/$$target seeds/$$target -- \
			-max_total_time=$(FUZZ_SECS) -rss_limit_mb=2048 -timeout=20 -max_len=16384 > $$log 2>&1; then \
			echo "$$target: $$(grep '^Done ' $$log || tail -n 1 $$log)"; \
		else \
			echo "$$target: failed, the end of target/fuzz/$$target.log:" >&2; tail -n 30 $$log >&2; failed="$$failed $$target"; \
		fi; \
	done; \
	[ -z "$$failed" ] || { echo "failed:$$failed" >&2; exit 1; }

# Measures all rows that were not measured at this commit, and writes the page of their figures after each.
reliability: target/cinesplat-panics
	python3 tests/faults/page.py $(BIN) --rows all --kills 200 --panics target/cinesplat-panics --fuzz-logs target/fuzz \
		$(if $(wildcard target/slurm.txt),--slurm-log target/slurm.txt)

# Checks that the camera does what the prompts say. Plans the cases of ../shared (not part of this repository) with the
# solver off and full, from the network's programs and from hand-written ones, and runs the checker of ../shared.
CASES := ../shared/data/prompts/public.jsonl
CHECKER := python3 ../shared/tools/check_shot.py
check-shots: build
	@for solve in off full; do \
		for by in network hand; do \
			[ $$by = hand ] && intents="--intents tests/operator/intents.json" || intents=""; \
			echo "== solver $$solve, programs by $$by"; \
			$(BIN) bench operator films --cases $(CASES) $$intents --solve $$solve --overwrite -o target/shots/$$by-$$solve 2>/dev/null; \
			$(CHECKER) --cases $(CASES) --paths target/shots/$$by-$$solve; \
		done; \
	done || true

# Opens exports in the programs that they are for, and compares `eval --like-evo` with evo on the data of evo's repository.
# Prints the tables of tests/exchange/README.md. Needs PyPI, npm and GitHub (about 2.5 GB, most of it PyTorch), Node, and Python
# 3.11, which the packages of Blender and PyTorch are for; takes half an hour.
EXCHANGE_PROMPT := slowly push in on the sofa, then orbit it to the right while zooming in
EXCHANGE := target/exchange
check-exchange: build
	for name in venv blender nerfstudio; do test -x $(EXCHANGE)/$$name/bin/python || python3 -m venv $(EXCHANGE)/$$name || exit; done
	$(EXCHANGE)/venv/bin/pip install -q evo==1.38.1 open3d-cpu pycolmap usd-core pygltflib rosbags
	$(EXCHANGE)/blender/bin/pip install -q bpy==5.0.1
	$(EXCHANGE)/nerfstudio/bin/pip install -q torch==1.13.1 'numpy<2' scipy splines==0.3.0 viser==0.2.7 \
		opencv-python-headless==4.10.0.84 jaxtyping imageio pillow rich
	$(EXCHANGE)/nerfstudio/bin/pip install -q --no-deps nerfstudio==1.1.5
	npm install --silent --no-save --prefix $(EXCHANGE)/node @playcanvas/supersplat-viewer@1.36.2 playcanvas@2.23.3
	test -d $(EXCHANGE)/evo || git clone -q --depth 1 https://github.com/MichaelGrupp/evo $(EXCHANGE)/evo
	$(BIN) plan $(DEMO_SCENE) -p "$(EXCHANGE_PROMPT)" -o $(EXCHANGE)/demo.shot.json --overwrite
	$(EXCHANGE)/venv/bin/python tests/exchange/open_exports.py $(BIN) $(EXCHANGE)/demo.shot.json \
		$(EXCHANGE)/blender/bin/python $(EXCHANGE)/nerfstudio/bin/python $(EXCHANGE)/node
	$(EXCHANGE)/venv/bin/python tests/exchange/other_files.py $(BIN)
	$(EXCHANGE)/venv/bin/python tests/exchange/evo_figures.py $(BIN) $(EXCHANGE)/evo/test/data

# The pictures of the README: the demo film, a sheet of each film of prompts/gallery.txt, and one of the objects of a room. Needs the program ffmpeg.
gallery: demo
	ffmpeg -v error -y -i renders/demo.mp4 -vf "fps=12,scale=640:-2:flags=lanczos" \
		-c:v libwebp_anim -loop 0 -quality 60 -compression_level 6 renders/gallery/demo.webp
	mkdir -p target/gallery
	while IFS='|' read -r name scene prompt; do \
		name=$${name% }; $(BIN) render $$scene -p "$${prompt# }" -o target/gallery/$$name.mp4 --size 640x360 --fps 24 \
			--sheet target/gallery/$$name.png --overwrite && \
		ffmpeg -v error -y -i target/gallery/$$name.png -vf scale=1040:-2:flags=lanczos -quality 72 renders/gallery/$$name.webp \
			< /dev/null || exit; \
	done < prompts/gallery.txt
	$(BIN) objects synth:room:21 -o target/gallery/objects.json --sheet target/gallery/objects.png --overwrite
	ffmpeg -v error -y -i target/gallery/objects.png -vf "crop=1396:2420:0:0,scale=900:-2:flags=lanczos" -quality 70 \
		renders/gallery/objects.webp

# Each effect of prompts/gallery-effects.txt off (left) and on (right) with its cost under it (renders/lens/lens-costs.csv), on
# one sheet. Needs the program ffmpeg and the scene.
GALLERY_SCENE := $(DATA)/composites/kitchen_plus_dev.spz
GALLERY_PX := 320x180
gallery-effects: build
	test -f $(GALLERY_SCENE) || { echo "no scene $(GALLERY_SCENE)" >&2; exit 66; }
	rm -rf target/gallery-effects && mkdir -p target/gallery-effects
	number=100; while IFS='|' read -r name shot frame; do \
		name=$${name// } shot=$${shot// } frame=$${frame// } number=$$((number + 1)); \
		for effects in off $$name; do \
			[ -f target/gallery-effects/$$shot-$$effects-$$(printf %03d $$frame).png ] || \
			$(BIN) render $(GALLERY_SCENE) --shot prompts/gallery-effects/$$shot.shot.json --effects $$effects --quality final \
				--size $(GALLERY_PX) --frames $$frame..$$((frame + 1)) --no-job --overwrite -q \
				-o target/gallery-effects/$$shot-$$effects-%03d.png < /dev/null || exit; \
		done; \
		cost=$$(awk -F, -v name=$$name '$$3 == name && $$1 ~ /kitchen/ { print $$5 }' renders/lens/lens-costs.csv); \
		still=$$(printf %03d $$frame); \
		ffmpeg -v error -y -i target/gallery-effects/$$shot-off-$$still.png -i target/gallery-effects/$$shot-$$name-$$still.png \
			-filter_complex "hstack=inputs=2,pad=iw+8:ih+30:4:4:white,drawtext=text='$${name//-/ }  $${cost:+$$cost x}':x=6:y=h-21:fontsize=16:fontcolor=black" \
			-frames:v 1 target/gallery-effects/sheet-$$number.png < /dev/null || exit; \
	done < prompts/gallery-effects.txt
	ffmpeg -v error -y -start_number 101 -i target/gallery-effects/sheet-%03d.png -filter_complex \
		"tile=2x$$((($$(wc -l < prompts/gallery-effects.txt) + 1) / 2)):color=white" -frames:v 1 -quality 78 -compression_level 6 \
		renders/lens/effects.webp

clean:
	cargo clean
	rm -f renders/demo.*
