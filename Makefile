# Everything from a fresh checkout: `make demo` and `make test` do their own set-up.
# Each target below is a real file, so that a second run has nothing to do.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help

PY := .venv/bin/python
UV := .venv/bin/uv
STAGE := scripts/stage
CJVAL_VERSION := 0.10.0

PACKAGES := .venv/.packages
EXTENSION := python/veduta/_core.abi3.so
NODE_PACKAGES := studio/node_modules/.package-lock.json
STUDIO := python/veduta/studio/static/index.html
CJVAL := build/cjval/.installed-$(CJVAL_VERSION)

RUST_SOURCES := $(shell find crates -name '*.rs' -o -name Cargo.toml)
STUDIO_SOURCES := $(shell find studio/src studio/public -type f) \
	studio/index.html studio/vite.config.ts studio/tsconfig.json

# PyO3 asks this interpreter what to build for, the same in every target: nothing is built twice.
export PYO3_PYTHON := $(CURDIR)/$(PY)

# Where this is set, as in some containers, each start of Python compiles all that it imports again:
# the tests start a thousand.
unexport PYTHONDONTWRITEBYTECODE

COMMA := ,

# Is there once `make gpu` was asked for: the extension then has graphics cards from there on.
GPU := .venv/.gpu

.PHONY: help setup gpu demo test lint lint-python lint-rust lint-studio test-python test-rust \
	test-studio test-browser test-changed bench wheel studio stubs pictures lock clean

help: ## what there is
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14

setup: $(EXTENSION) $(STUDIO) ## everything that `veduta` needs: .venv, the extension, the studio

gpu: $(PACKAGES) ## the extension with graphics cards, for --device: a minute or two more
	@touch $(GPU)
	@$(MAKE) --no-print-directory setup

demo: setup ## a synthetic street, rebuilt from its photo, and an animal in it; a walk through a gorge
	.venv/bin/veduta demo -o out/demo --animal $(DEMO)
	.venv/bin/veduta demo --walk -o out/demo-walk

studio: $(STUDIO) ## the web app alone

# ---- set-up ---------------------------------------------------------------------------------

.venv/.bootstrap: requirements/bootstrap.txt
	@scripts/need tools
	@python=$$(scripts/need python); \
	if ! $(PY) -c 'import pip, sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
		"$$python" -m venv --clear .venv; fi
	$(PY) -m pip install --quiet --disable-pip-version-check --require-hashes -r $<
	@touch $@

$(PACKAGES): requirements/lock.txt .venv/.bootstrap
	$(UV) pip sync --quiet --require-hashes --python $(PY) $<
	@touch $@

$(EXTENSION): $(PACKAGES) pyproject.toml Cargo.toml Cargo.lock $(RUST_SOURCES) $(wildcard $(GPU))
	@scripts/need cargo
	env -u CONDA_PREFIX VIRTUAL_ENV="$(CURDIR)/.venv" \
		.venv/bin/maturin develop --release --locked --uv --quiet \
		--features pyo3/extension-module$(if $(wildcard $(GPU)),$(COMMA)gpu)
	@touch $@

# Not `npm ci`: from 11.16 on it refuses a lock without download addresses, naming the packages of
# other platforms (npm issue 9846). This installs the same: what the lock says, hashes checked.
$(NODE_PACKAGES): studio/package.json studio/package-lock.json
	@scripts/need node
	cd studio && npm install --no-save --ignore-scripts --no-audit --no-fund --loglevel=error
	@touch $@

$(STUDIO): $(NODE_PACKAGES) $(STUDIO_SOURCES)
	cd studio && npm run --silent build -- --logLevel warn
	@touch $@

$(CJVAL):
	@scripts/need cargo
	cargo install --quiet --locked cjval --version =$(CJVAL_VERSION) --features build-binary \
		--force --root build/cjval --target-dir build/cjval/target
	@rm -rf build/cjval/target && touch $@

# ---- checks ---------------------------------------------------------------------------------

test: setup lint test-rust test-python test-studio test-browser ## all checks and all tests
	@printf '\nAll tests passed.\n'

# Two at a time: mypy and eslint use one core each.
lint: $(EXTENSION) $(NODE_PACKAGES) ## style and types of the three languages
	@$(MAKE) --no-print-directory --jobs=2 --output-sync=target lint-python lint-rust lint-studio

lint-python: $(EXTENSION)
	@$(STAGE) "ruff" $(PY) -m ruff check .
	@$(STAGE) "ruff format" $(PY) -m ruff format --check --quiet .
	@$(STAGE) "mypy" $(PY) -m mypy
	@$(STAGE) "import order" .venv/bin/lint-imports --no-cache --no-logo

lint-rust: $(PACKAGES)
	@scripts/need rust-lint
	@$(STAGE) "rustfmt" cargo fmt --all --check
	@$(STAGE) "clippy" cargo clippy --quiet --locked --workspace --all-targets -- -D warnings

lint-studio: $(NODE_PACKAGES)
	@cd studio && ../$(STAGE) "tsc" npm run --silent typecheck
	@cd studio && ../$(STAGE) "eslint" npm run --silent lint

# The extension crate is tested from Python: as a program of its own it would need libpython.
test-rust: $(PACKAGES)
	@scripts/need cargo
	@$(STAGE) "cargo test" cargo test --quiet --locked --workspace --exclude veduta-py

# Chromium is brought here where it is missing and may be; without it only its tests are skipped.
test-python: setup $(CJVAL)
	@export CHROMIUM=$$(scripts/need chromium || true); $(STAGE) "pytest" $(PY) -m pytest

# Since main, or make test-changed SINCE=HEAD~3. `make test` is what counts; this is for on the way.
test-changed: setup ## the tests that a change can touch, of the three languages
	@crates=$$($(PY) scripts/changed_tests.py $(or $(SINCE),main) rust); \
	if [ -n "$$crates" ]; then \
		$(STAGE) "cargo test" cargo test --quiet --locked $$(printf -- '-p %s ' $$crates); fi
	@files=$$($(PY) scripts/changed_tests.py $(or $(SINCE),main)); \
	if [ -n "$$files" ]; then $(STAGE) "pytest" $(PY) -m pytest $$files; \
	else echo "No Python test is touched."; fi
	@files=$$($(PY) scripts/changed_tests.py $(or $(SINCE),main) studio); \
	if [ -n "$$files" ]; then $(MAKE) --no-print-directory test-studio; fi

test-studio: $(NODE_PACKAGES)
	@cd studio && ../$(STAGE) "vitest" npm run --silent test

test-browser: setup
	@if CHROMIUM=$$(scripts/need chromium); then export CHROMIUM; \
		cd studio && ../$(STAGE) "browser tests" npm run --silent test:browser; \
	else echo "== browser tests: SKIPPED, there is no Chromium (see above)" >&2; fi

bench: setup ## speed, memory and accuracy tables; dated results go to benchmarks/results
	@for name in $$($(PY) benchmarks | cut -d' ' -f1); do \
		$(STAGE) "$$name" $(PY) benchmarks "$$name"; done

pictures: setup ## the pictures of the docs, made from synthetic streets
	$(PY) docs/pictures.py
	$(PY) docs/facade_picture.py
	$(PY) docs/grammar_picture.py
	$(PY) docs/assets_picture.py
	$(PY) docs/textures_picture.py
	$(PY) docs/styles_picture.py
	$(PY) docs/roofs_picture.py
	$(PY) docs/photos_picture.py
	$(PY) docs/walk_picture.py

# One file with the extension and the studio; `pip install` of it needs neither Rust nor Node.
wheel: setup ## one wheel, with the extension and the studio, in build/wheel
	@rm -rf build/wheel
	env -u CONDA_PREFIX VIRTUAL_ENV="$(CURDIR)/.venv" \
		.venv/bin/maturin build --release --locked --quiet --out build/wheel
	@ls build/wheel/*.whl

stubs: $(PACKAGES) ## the types of the extension for Python, from its Rust sources
	@mkdir -p build
	cargo run --quiet --locked -p veduta-stubs -- crates/veduta-py/src > build/_core.pyi
	$(PY) -m ruff format --quiet build/_core.pyi
	@mv build/_core.pyi python/veduta/_core.pyi

# ---- locks ----------------------------------------------------------------------------------

COMPILE := $(UV) pip compile --quiet --universal --fork-strategy fewest --python-version 3.11 \
	--generate-hashes --no-header --no-emit-index-url --no-emit-find-links

lock: .venv/.bootstrap ## renew the locks of all three languages
	$(COMPILE) --upgrade requirements/bootstrap.in -o requirements/bootstrap.txt
	$(COMPILE) --upgrade pyproject.toml --group dev -o requirements/lock.txt
	cargo update
	cd studio && npm update --package-lock-only --no-audit --no-fund

clean: ## everything that was built
	rm -rf .venv build target $(EXTENSION) studio/node_modules python/veduta/studio/static
