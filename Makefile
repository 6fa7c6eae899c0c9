# `make demo` and `make test` need nothing but Python 3.11 or newer: what they install goes into .venv, but for the
# system libraries of the tests, which they install only as root on Debian and otherwise name. The viewer's page is
# built where there are Node.js and npm; what they install goes into web/node_modules.
# Another Python: make PYTHON=python3.13 demo
# Less of the benchmarks: make bench QUICK=--quick
# Longer fuzzing, from other random numbers: make fuzz MINUTES=60 SEED=monday

PYTHON ?= python3
BIN := .venv/bin
# --no-compile: most modules of the packages are never imported, and Python compiles the others when they are
INSTALL := $(BIN)/python -m pip install --quiet --no-compile
# one process of tests more than cores: some wait for a browser or a server
TESTERS := $(shell $(PYTHON) -c 'import os; print(min(4, 1 + (os.cpu_count() or 1)))')
PYTEST := $(BIN)/python -m pytest --quiet --numprocesses $(TESTERS) --dist worksteal
SHAPES := examples/shapes
COLOURS := tests/core/svg/fixtures/groups/nested.svg
BENCHMARKS := packed_fidelity colours wgsl speed gpu_cost packed_conversion size fidelity conversion icons live load
WEB_BENCHMARKS := page_fidelity page_conversion web_speed editing flood flood_water
CORE := packages/vexture
GEO := packages/vexture-geo
EVIDENCE := packages/vexture-evidence
PROJECTS := $(CORE)/pyproject.toml $(GEO)/pyproject.toml $(EVIDENCE)/pyproject.toml
VIEWER := $(CORE)/src/vexture/pages/built/viewer.js
FLOOD_PAGE := $(GEO)/src/vexture_geo/flood/built
WEB_SOURCES := $(shell find web/src web/viewer web/flood web/notebook web/generated -name '*.js' -o -name '*.css')
QUICK ?=
MINUTES ?= 5
SEED ?= 1
RELEASED := $(CORE) $(GEO) $(EVIDENCE) web
REPOSITORY ?=

# hundreds of processes would compile what they import, each for itself
unexport PYTHONDONTWRITEBYTECODE

.NOTPARALLEL:
.DELETE_ON_ERROR:
.PHONY: help demo counties docs gallery report viewer wasm test test-core sweep checks checks-web lint kernels test-web bench conformance fuzz dist dist-check clean

help:
	@echo 'make demo    convert and draw the example drawings; the pictures come into demo/'
	@echo 'make viewer  build the pages of `vexture view` and `export`, of floods and of notebooks, with node and npm'
	@echo 'make gallery  build a site of live, editable examples, with node and npm; it opens from the disk, too'
	@echo 'make counties  build a page with a map of all counties of the United States, with node and npm'
	@echo 'make wasm    compile the kernels that JavaScript calls to WebAssembly, and make its font; make viewer does it, too'
	@echo 'make test    lint, types and all tests but the slow ones, with all that they need'
	@echo 'make lint    the checks of style and types, with the tools that they need'
	@echo 'make test-core  the tests of the core, without vexture-geo and vexture-evidence'
	@echo 'make sweep   the tests that take long and find little that those do not, and 24,000 drawings of others'
	@echo 'make docs    build the documentation into site/, to be read from the disk'
	@echo 'make report  measure the tables and figures of the thesis again; the page is demo/report/index.html'
	@echo 'make conformance  compare 1,400 files with what resvg and librsvg draw; a page of all pictures, a table in docs/'
	@echo 'make fuzz    read damaged files for some minutes; what breaks a reader comes into fuzz-findings/'
	@echo 'make bench   measure fidelity, speed and size; the figures come into packages/vexture-evidence/benchmarks/results/'
	@echo 'make dist    build the wheels, the sdist and the npm tarball into dist/; make dist-check tries them'
	@echo 'make clean   remove all of that again'

.venv/made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo 'vexture needs Python 3.11 or newer; name one, as in: make PYTHON=python3.13 demo' >&2; exit 1; }
	@$(PYTHON) tools/prepare.py venv
	@touch $@

.venv/for-demo: $(PROJECTS) | .venv/made
	@echo 'installing vexture and its libraries into .venv (a minute or less) ...'
	@$(INSTALL) --editable '$(CORE)[gpu,server,text,trace]' --editable '$(GEO)[gis]'
	@touch $@

.venv/for-test: $(PROJECTS) | .venv/made
	@echo 'installing vexture, its libraries and the tools of its tests into .venv (a minute or two) ...'
	@$(INSTALL) --editable $(CORE) --editable $(GEO) --editable '$(EVIDENCE)[docs,test]'
	@touch .venv/for-demo .venv/for-docs .venv/for-report .venv/for-wasm $@

.venv/for-report: $(PROJECTS) | .venv/made
	@echo 'installing vexture and what its report draws and compares with into .venv (a minute or less) ...'
	@$(INSTALL) --editable $(CORE) --editable $(GEO) --editable $(EVIDENCE)
	@touch $@

.venv/for-dist: $(PROJECTS) | .venv/made
	@echo 'installing what builds a release into .venv (a minute or less) ...'
	@$(INSTALL) --editable $(CORE) --editable $(GEO) --editable '$(EVIDENCE)[dist]'
	@touch .venv/for-wasm $@

.venv/for-wasm: $(PROJECTS) | .venv/made
	@echo 'installing what compiles kernels to WebAssembly into .venv (a minute or less) ...'
	@$(INSTALL) --editable $(CORE) --editable $(GEO) --editable '$(EVIDENCE)[wasm]'
	@touch $@

.venv/for-docs: $(PROJECTS) | .venv/made
	@echo 'installing vexture and MkDocs into .venv (a minute or less) ...'
	@$(INSTALL) --editable $(CORE) --editable $(GEO) --editable '$(EVIDENCE)[docs]'
	@touch $@

web/node_modules/made: web/package.json web/package-lock.json
	@$(PYTHON) tools/prepare.py web
	@echo 'installing the packages of web/ into web/node_modules ...'
	@npm ci --prefix web --no-audit --no-fund --loglevel error
	@touch $@

$(VIEWER): web/node_modules/made tools/notices.py $(WEB_SOURCES)
	@echo 'building the pages of the viewer, of floods and of notebooks (some seconds) ...'
	@for page in viewer flood notebook; do npm run --silent $$page --prefix web || exit 1; done
	@$(PYTHON) tools/notices.py $(@D) $(FLOOD_PAGE)

viewer: $(VIEWER) wasm

# does nothing where the kernels and the tools have not changed; takes some minutes else
wasm: .venv/for-wasm
	@$(BIN)/python tools/make_default_font.py
	@$(BIN)/python tools/build_wasm.py

demo: .venv/for-demo
	@mkdir -p demo/pictures
	$(BIN)/vexture convert $(SHAPES)/*.svg -o demo
	$(BIN)/vexture convert $(SHAPES)/*.svg --atlas demo/all.ktx2 >demo/all.log
	$(BIN)/vexture convert $(SHAPES)/duck.svg -o demo/thesis --encoding thesis
	$(BIN)/vexture info demo/duck.ktx2
	$(BIN)/vexture render $(SHAPES)/duck.svg -o demo/pictures/duck-exact.png --size 500 --renderer exact --silhouette
	$(BIN)/vexture render demo/duck.ktx2 -o demo/pictures/duck-1000.png --size 1000 --renderer cpu
	$(BIN)/vexture render demo/all.ktx2 --root duck -o demo/pictures/duck-50.png --size 50 --renderer cpu
	$(BIN)/vexture render demo/ocean.ktx2 -o demo/pictures/ocean-detail.png --size 500 --renderer cpu --view 0.8,0.26,0.12,0.12
	$(BIN)/vexture render demo/font.ktx2 -o demo/pictures/font-turned.png --size 500 --renderer cpu --rotate 30
	$(BIN)/vexture render demo/thesis/duck -o demo/pictures/duck-thesis.png --size 1000 --renderer cpu
	@echo '$(BIN)/vexture render demo/cake.ktx2 -o demo/pictures/cake-gpu.png --size 500 --renderer gpu'
	@$(BIN)/vexture render demo/cake.ktx2 -o demo/pictures/cake-gpu.png --size 500 --renderer gpu || \
		echo 'so there is no picture by the GPU this time; all the others are there'
	@if ! command -v node >/dev/null || ! command -v npm >/dev/null; then \
		echo 'node or npm is missing, so the viewer cannot be built, and there are no pages demo/duck.html and demo/05/flood.html this time'; \
	elif $(MAKE) --no-print-directory $(VIEWER); then \
		$(BIN)/vexture export $(SHAPES)/duck.svg -o demo/duck.html && \
		$(BIN)/python examples/05_santa_cruz_flood.py demo/05 >demo/05.log && \
		$(BIN)/vexture flood --extent demo/05/flood.nc --time-dim time --ground demo/05/ground.jpg -o demo/05/flood.html && \
		echo 'Open demo/duck.html in a browser to look at the duck from nearby; $(BIN)/vexture view shows any drawing so.' && \
		echo 'Open demo/05/flood.html to stand on a beach while a storm surge comes in.'; \
	else \
		echo 'so the viewer is not built, and there are no pages demo/duck.html and demo/05/flood.html this time'; \
	fi
	@echo
	@echo 'Open the pictures in demo/pictures/: duck-1000.png is drawn from the texture demo/duck.ktx2, duck-50.png from'
	@echo 'demo/all.ktx2, which holds all the drawings; duck-exact.png is what they must look like.'

examples/counties/node_modules/made: examples/counties/package.json examples/counties/package-lock.json
	@$(PYTHON) tools/prepare.py web
	@echo 'installing the packages of the example into examples/counties/node_modules ...'
	@npm ci --prefix examples/counties --no-audit --no-fund --loglevel error
	@touch $@

counties: .venv/for-demo examples/counties/node_modules/made
	@PATH="$(CURDIR)/$(BIN):$$PATH" npm run --silent build --prefix examples/counties

# the icons and maps come from npm; the index has screenshots where Chromium and Playwright are, else drawn pictures
gallery: .venv/for-demo $(VIEWER) wasm
	$(BIN)/python tools/make_gallery.py

report: .venv/for-report
	$(BIN)/vexture report -o demo/report

# not --quiet: it keeps --strict from seeing the warnings that it is to fail for
docs: .venv/for-docs
	@if ! command -v node >/dev/null || ! command -v npm >/dev/null; then \
		echo 'node or npm is missing, so the reference of the JavaScript API is left out'; \
	elif ! $(MAKE) --no-print-directory web/node_modules/made; then \
		echo 'so the reference of the JavaScript API is left out'; \
	fi
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict
	@echo 'Open site/index.html in a browser.'

# two cores are kept busy: the web is installed and checked beside Python's packages, lint and types; the kernels, which
# the tests find then, are compiled beside those; the tests take from each other what is left
test: .venv/made
	@$(MAKE) --no-print-directory checks-web & web=$$!; \
		$(MAKE) --no-print-directory checks; checked=$$?; \
		wait $$web && exit $$checked
	$(PYTEST) -m 'not slow'

# as where only the core is installed; tests that compare with other programs, which vexture-evidence has, say that they
# are skipped
test-core: kernels
	PYTHONPATH=tools $(PYTEST) -p core_alone -m 'not slow' tests/core

# what `test` leaves out; the drawings come from npm and, on Debian, from apt
sweep: .venv/for-test $(VIEWER)
	@$(BIN)/python tools/prepare.py system
	$(PYTEST) -m slow
	$(BIN)/python $(EVIDENCE)/benchmarks/sweep.py $(QUICK)

checks: .venv/for-test
	@$(BIN)/python tools/prepare.py system
	@$(MAKE) --no-print-directory kernels & kernels=$$!; \
		$(MAKE) --no-print-directory lint; linted=$$?; \
		wait $$kernels && exit $$linted

# without its cache: what a renamed module does to the order of other files' imports is not seen from it
lint: .venv/for-test
	$(BIN)/ruff check --no-cache .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python tools/make_web.py --check

checks-web:
	@if $(MAKE) --no-print-directory web/node_modules/made; then \
		$(MAKE) --no-print-directory test-web; \
	else \
		echo 'skipped, as said above: the tests of web/, the viewer and the tests of its page'; \
	fi

# in three processes: that of WebAssembly shares nothing; the next begins with what it alone needs, and finds then what the
# last has compiled
kernels: .venv/for-test
	@echo 'compiling the kernels once, before the tests run side by side ...'
	@set -e; scratch=$$(mktemp -d); trap 'rm -rf "$$scratch"' EXIT; exec >"$$scratch/log"; \
	$(BIN)/python tools/make_default_font.py; $(BIN)/python tools/build_wasm.py & wasm=$$!; \
	( $(BIN)/vexture render $(SHAPES)/duck.svg -o "$$scratch/exact.png" --size 16 --renderer exact && \
		$(BIN)/python -m pytest --quiet tests/core/bezier/test_known_curves.py && \
		$(BIN)/vexture convert $(SHAPES)/duck.svg -o "$$scratch/thesis" --encoding thesis && \
		$(BIN)/vexture convert $(SHAPES)/duck.svg -o "$$scratch/sampled" --encoding thesis --strategy sampled && \
		$(BIN)/vexture render "$$scratch/thesis/duck" -o "$$scratch/cpu.png" --size 16 --renderer cpu ) & thesis=$$!; \
	$(BIN)/vexture convert $(SHAPES)/duck.svg -o "$$scratch/packed"; \
	$(BIN)/vexture render "$$scratch/packed/duck.ktx2" -o "$$scratch/packed.png" --size 16 --renderer cpu; \
	$(BIN)/vexture render $(COLOURS) -o "$$scratch/colours.png" --size 16; \
	$(BIN)/vexture render $(COLOURS) -o "$$scratch/colours.png" --size 16 --renderer exact; \
	wait $$thesis; wait $$wasm

test-web: $(VIEWER)
	npm run --silent check --prefix web
	npm run --silent test --prefix web

# the tests come from apt, on Debian
conformance: .venv/for-test
	$(BIN)/python $(EVIDENCE)/benchmarks/conformance.py

bench: .venv/for-test
	@$(BIN)/python tools/prepare.py system
	@names='$(BENCHMARKS)'; \
	if $(MAKE) --no-print-directory viewer; then names="$$names $(WEB_BENCHMARKS)"; \
	else echo 'so the web is not measured: $(WEB_BENCHMARKS)'; fi; \
	for name in $$names; do echo && $(BIN)/python "$(EVIDENCE)/benchmarks/$$name.py" $(QUICK) || exit 1; done

fuzz: .venv/for-test
	@PYTHONPATH=tests:$(EVIDENCE)/benchmarks $(BIN)/python tests/fuzz/campaign.py $(MINUTES) $(SEED)

# of RELEASED, the folders of projects; with REPOSITORY=https://..., a registry's pages can link to the sources.
# pip takes the wheel of the platform where it can: its kernels are compiled, for Linux with any C library of the last
# ten years; the wheel for any platform compiles them when they are first used
dist: $(VIEWER) .venv/for-dist wasm
	@$(BIN)/python tools/release.py
	@rm -rf dist
	$(BIN)/python tools/compile_kernels.py
	@$(BIN)/python tools/dist.py --output dist --repository '$(REPOSITORY)' $(RELEASED)
	@rm -rf $(CORE)/src/vexture/compiled
	@$(BIN)/python -m twine check --strict dist/*.whl dist/*.tar.gz

# installed as anyone would: with all packages from the registry, and kernels compiled for the first time
dist-check: dist .venv/for-test
	VEXTURE_DIST=dist $(BIN)/python -m pytest --quiet tests/release

clean:
	rm -rf .venv demo build dist $(CORE)/src/vexture/compiled packages/*/src/*.egg-info $(EVIDENCE)/benchmarks/results \
		.cache .hypothesis .mypy_cache .pytest_cache .ruff_cache fuzz-findings \
		web/kernels web/node_modules examples/counties/node_modules web/types $(CORE)/src/vexture/pages/built $(FLOOD_PAGE) tests/web/screenshots site gallery/built
