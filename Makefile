PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
ALL_CORES := --numprocesses logical --maxprocesses 8 --dist worksteal

.PHONY: study live test check clean

study: $(VENV)/installed  ## Run the four-lap study with twelve synthetic participants, and report it
	$(BIN)/lad-study run four-lap --out studies/four-lap-seed0

live: $(VENV)/installed-live  ## Drive yourself in a browser, helped by the shipped demonstrator
	$(BIN)/lad-study live drive-yourself --out studies/drive-yourself

test: $(VENV)/installed-test  ## Run every test and check
	$(BIN)/python -m pytest -m "not slow" $(ALL_CORES) --hypothesis-seed 0
	$(MAKE) check

check: $(VENV)/installed-test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/installed: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable .
	touch $@

$(VENV)/installed-live: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[live]'
	touch $@ $(VENV)/installed

$(VENV)/installed-test: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable '.[test]'
	touch $@ $(VENV)/installed

clean:
	rm -rf $(VENV)
