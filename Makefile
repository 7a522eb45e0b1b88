# make demo   set up, build the scene graph of a small plant, say what was found
# make install  set up all of it, generated plants and evaluation included; make demo needs less
# make test   set up, run every test; with LEAVE_OUT=long without those that take minutes
# make test-fast  the quick tests: about ten minutes of one processor
# make test-physics  the tests in PhysX and Newton, in an environment of their own (Linux on x86; 3 GB, some minutes)
# make browser  a browser for the tests that need one: the system's Chromium, where it can be had without asking
# make web    the page of the viewer anew, from web/ (needs Node)
# make web-test   the page's types, and its tests that need no browser (needs Node)
# make screenshots  the pictures of the viewer in docs/ (needs a browser; some minutes)
# make check-wheel  a wheel of the product alone, tried out in an empty environment (needs a package index)
# make check  style, types, structure, complexity, generated documents
# make bench  the benchmarks, with what a user would pick instead in the same run
# make fuzz   spoilt files of every kind, read or refused in one line? ten thousand, or make fuzz SECONDS=60 SEED=1
# make train  the embedded labeler anew, with its page of figures (one and a half hours on two cores; needs torch)
# make docs   write the generated documents anew
# make gallery  the pictures of all generated devices in docs/devices (five minutes on two cores)

PYTHON ?= $(shell for p in python3 python3.13 python3.12 python3.11 python; do \
	$$p -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --disable-pip-version-check --quiet --no-compile --constraint constraints.txt
WHOLE := --editable '.[all,dev]' --editable packages/cadplants --editable packages/cadlab
PROJECTS := pyproject.toml packages/cadplants/pyproject.toml packages/cadlab/pyproject.toml constraints.txt

# Byte code is kept, whatever the shell says: the tests start hundreds of processes, which would compile every module again.
unexport PYTHONDONTWRITEBYTECODE

BROWSERS := chromium chromium-browser google-chrome google-chrome-stable microsoft-edge
WEB_TOOLS := web/node_modules/.package-lock.json
NO_NODE := the page needs Node 20 or newer with npm to be built or checked: https://nodejs.org; the one that is built already works without

.PHONY: demo install test test-fast test-physics browser web web-tools web-test screenshots check check-wheel bench fuzz train docs gallery clean

demo: $(VENV)/.with-all
	$(BIN)/cadgraph demo --output demo

install: $(VENV)/.with-dev
	@echo "cadgraph is in $(VENV): '. $(BIN)/activate', then 'cadgraph --help'"

# By file, as what a file's tests share is made once. One more than processors, as some tests wait for servers and other
# processes; more than four want more memory than a laptop has. In the order of tests/conftest.py, which begins with the
# longest files.
COUNT_WORKERS := import os; print(min(4, 1 + (os.cpu_count() or 1)))
WORKERS = --numprocesses $(shell $(BIN)/python -c '$(COUNT_WORKERS)') --dist loadfile --no-loadscope-reorder

test: $(VENV)/.with-dev
	$(BIN)/python -m pytest $(WORKERS) $(if $(LEAVE_OUT),-m "not $(LEAVE_OUT)")

test-fast: $(VENV)/.with-dev
	$(BIN)/python -m pytest $(WORKERS) -m "not slow"

# The engines bring a USD library of their own, which can't live beside the one of the product.
PHYSICS := .venv-physics

test-physics: $(VENV)/.with-dev $(PHYSICS)/.with-engines
	CADGRAPH_PHYSICS_PYTHON=$(CURDIR)/$(PHYSICS)/bin/python $(BIN)/python -m pytest tests/physics

$(PHYSICS)/.with-engines: tests/physics/requirements.txt
	@test -n "$(PYTHON)" || { echo "cadgraph needs Python 3.11 or newer; name it with: make PYTHON=/path/to/python3"; exit 1; }
	$(PYTHON) -m venv $(PHYSICS)
	@echo "installing the engines into $(PHYSICS) (once, some minutes)"
	$(PHYSICS)/bin/python -m pip install --disable-pip-version-check --quiet --requirement $<
	@touch $@

# Never fails: tests in a browser are skipped where there is none.
browser:
	@for name in $$CADGRAPH_BROWSER $(BROWSERS); do command -v $$name >/dev/null && exit 0; done; \
	if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
		echo "installing Chromium for the tests in a browser (once)"; export DEBIAN_FRONTEND=noninteractive; \
		{ apt-get -qq update && apt-get -qq install --yes --no-install-recommends chromium; } >/dev/null || \
			echo "Chromium could not be installed; tests in a browser are skipped"; \
	else echo "no browser: install Chromium (apt install chromium, dnf install chromium...); tests in a browser are skipped without it"; fi

web: web-tools
	@if command -v npm >/dev/null; then cd web && npm run --silent build; fi

web-test: web-tools
	@if command -v npm >/dev/null; then cd web && npm run --silent check && npm run --silent test; fi

web-tools:
	@if command -v npm >/dev/null; then $(MAKE) --no-print-directory $(WEB_TOOLS); else echo "$(NO_NODE)"; fi

$(WEB_TOOLS): web/package.json web/package-lock.json
	npm ci --prefix web --silent
	@touch $@

screenshots: $(VENV)/.with-dev
	$(BIN)/python tools/take_screenshots.py

check: $(VENV)/.with-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python -m pytest -q tests/test_architecture.py
	$(BIN)/python tools/write_docs.py --check
	$(BIN)/python tools/draw_architecture.py --check

check-wheel: $(VENV)/bin/python
	$(BIN)/python tools/check_wheel.py

bench: $(VENV)/.with-dev
	@for f in packages/cadlab/benchmarks/[!_]*.py; do echo "== $$f"; $(BIN)/python $$f || exit 1; done

MUTATIONS := 10000
SECONDS := 0
SEED :=

fuzz: $(VENV)/.with-dev
	$(BIN)/python -m cadlab.fuzz --mutations $(MUTATIONS) --seconds $(SECONDS) $(if $(SEED),--seed $(SEED)) --keep fuzz-found

train: $(VENV)/.with-train
	$(BIN)/python -m cadlab.training

docs: $(VENV)/.with-dev
	$(BIN)/python tools/write_docs.py
	$(BIN)/python tools/draw_architecture.py

gallery: $(VENV)/.with-dev
	$(BIN)/python tools/draw_devices.py

clean:
	rm -rf $(VENV) $(PHYSICS) demo .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(VENV)/bin/python:
	@test -n "$(PYTHON)" || { echo "cadgraph needs Python 3.11 or newer; name it with: make PYTHON=/path/to/python3"; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.with-all: pyproject.toml constraints.txt | $(VENV)/bin/python
	@echo "installing into $(VENV) (once, a minute or two)"
	$(PIP) --editable '.[all]'
	@$(BIN)/python -m cadgraph.cli.warm
	@touch $@

$(VENV)/.with-dev: $(PROJECTS) | $(VENV)/bin/python
	@echo "installing into $(VENV) (once, a minute or two)"
	$(PIP) $(WHOLE)
	@$(BIN)/python -m cadgraph.cli.warm
	@touch $@ $(VENV)/.with-all

$(VENV)/.with-train: $(VENV)/.with-dev
	$(PIP) $(WHOLE) --editable 'packages/cadlab[train]'
	@touch $@
