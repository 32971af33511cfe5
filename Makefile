PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
ALL_CORES := --numprocesses logical --maxprocesses 8 --dist worksteal

.PHONY: study live test tests test-long check docs gallery reference release-check bench clean

study: $(VENV)/installed  ## Run the four-lap study with twelve synthetic participants, and report it
	$(BIN)/lad-study run four-lap --out studies/four-lap-seed0

live: $(VENV)/installed-live  ## Drive yourself in a browser, helped by the shipped demonstrator
	$(BIN)/lad-study live drive-yourself --out studies/drive-yourself

test: $(VENV)/installed-test  ## Run every test and check, and build the site, side by side
	$(MAKE) --no-print-directory --jobs 2 tests check docs

tests: $(VENV)/installed-test
	$(BIN)/python -m pytest -m "not slow" $(ALL_CORES) --hypothesis-seed 0

test-long: $(VENV)/installed-test  ## Run the tests that take minutes, and every test with the lowest versions and later Pythons
	$(BIN)/python -m pytest -m slow $(ALL_CORES) --hypothesis-seed 0
	.ci/lowest
	.ci/pythons
	.ci/rocrate

check: $(VENV)/installed-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/codespell

docs: $(VENV)/installed-docs  ## Build the documentation site, strictly, without running the examples
	$(BIN)/python -m sphinx -W --keep-going -q -b html -D plot_gallery=0 docs docs/_build/html
	@! grep -rlE '<(script|link|img)[^>]*(src|href)="(https?:)?//' --include='*.html' docs/_build/html
	@echo "The site: docs/_build/html/index.html"

gallery: $(VENV)/installed-docs  ## The same, with every example run and its figures
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs docs/_build/html
	@echo "The site: docs/_build/html/index.html"

reference: $(VENV)/installed  ## Write the JSON Schemas and the generated pages again
	$(BIN)/python -m protocols.json_schema docs/schema
	$(BIN)/python docs/write_reference.py

release-check: $(VENV)/installed-test  ## What must hold before a release (docs/releasing.md)
	.ci/release-check

bench: $(VENV)/installed-test  ## Add this commit's costs to bench/history.csv, as ratios; one process
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python bench/history.py

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/installed: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable .
	touch $@

$(VENV)/installed-live: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[live]'
	touch $@ $(VENV)/installed

$(VENV)/installed-docs: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[docs,exchange,live]'
	touch $@ $(VENV)/installed $(VENV)/installed-live

$(VENV)/installed-test: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --no-compile --editable '.[test,docs]'
	-$(BIN)/python -m compileall -qq -j 0 -x /tests/ $(VENV)/lib  # on all cores; pip uses one
	touch $@ $(VENV)/installed $(VENV)/installed-live $(VENV)/installed-docs

clean:
	rm -rf $(VENV)
