# make run and make test do everything from a fresh checkout; what is already done is not done again.

PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11 python; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV ?= .venv
DATASET := data/horologium-core.h5
STAMP := $(VENV)/.installed
BIN := $(VENV)/$(if $(filter Windows_NT,$(OS)),Scripts,bin)
RUN := $(BIN)/python
# A process a processor; the tests of one file share what they make.
PARALLEL := -n auto --dist loadfile

# What pyproject.toml allows, from its lower bounds to the newest of everything; what is old may use what is deprecated.
SETS := lowest-direct highest
FLAGS_lowest-direct := -W default::DeprecationWarning -W default::PendingDeprecationWarning

.PHONY: help setup run data test bounds interop bench clean

help:
	@echo "make run    print the pendulum's tables (sets everything up first)"
	@echo "make test   lint, type-check and run all tests (sets everything up first)"
	@echo "make setup  create $(VENV) with the pinned dependencies"
	@echo "make data   build the core dataset, if it is not there"
	@echo "make bounds run all tests with the lowest and with the newest versions that pyproject.toml allows"
	@echo "make interop install other packages and judge their methods, and run docs/interop.md"
	@echo "make bench  run the benchmarks"
	@echo "make clean  remove $(VENV), caches and builds; the dataset stays"
	@echo "PYTHON=... chooses the interpreter (3.11 or newer), VENV=... the environment's folder."

setup: $(STAMP)

$(STAMP): pyproject.toml constraints.txt
	@test -n "$(PYTHON)" || { echo "No Python 3.11 or newer was found; make PYTHON=/path/to/python names one." >&2; exit 2; }
	@command -v "$(PYTHON)" >/dev/null || { echo "PYTHON is $(PYTHON), which is no program; Python 3.11 or newer is needed." >&2; exit 2; }
	@"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "PYTHON is $(PYTHON), which is $$("$(PYTHON)" --version 2>&1); Python 3.11 or newer is needed." >&2; exit 2; }
	"$(PYTHON)" -m venv $(VENV)
	$(RUN) -m pip install --quiet --constraint constraints.txt hatchling
	$(RUN) -m pip install --quiet --constraint constraints.txt --no-build-isolation --editable '.[test]'
	@touch $@

data: $(DATASET)

$(DATASET): | $(STAMP)
	@mkdir -p $(@D)
	$(RUN) -m reference build --profile core --out $@

run: $(STAMP) $(DATASET)
	@$(RUN) -m compare pendulum

test: $(STAMP) $(DATASET)
	$(RUN) -m ruff check .
	$(RUN) -m ruff format --check .
	$(RUN) -m mypy
	$(RUN) -m pytest $(PARALLEL)

bounds: $(STAMP) $(DATASET)
	$(foreach set,$(SETS),$(call tested_with,$(set)))

define tested_with
@echo "== $(1)"
"$(PYTHON)" -m venv --clear .venv-$(1)
.venv-$(1)/$(notdir $(BIN))/python -m pip install --quiet --constraint constraints.txt uv
.venv-$(1)/$(notdir $(BIN))/python -m uv pip install --python .venv-$(1) --resolution $(1) --editable '.[test,xarray]'
.venv-$(1)/$(notdir $(BIN))/python -m pytest $(PARALLEL) $(FLAGS_$(1))
.venv-$(1)/$(notdir $(BIN))/python -c 'import reference; print(reference.load().to_xarray()["pendulum/libration"])'

endef

# The packages are there or this fails: none of its tests is skipped.  pytest collects these files where they are named.
interop: .venv-interop/.installed $(DATASET)
	.venv-interop/$(notdir $(BIN))/python -m pytest $(PARALLEL:loadfile=load) $(addprefix tests/interop/, \
		recipes.py compiled.py programs.py third_party.py coefficients.py solvers.py)

.venv-interop/.installed: pyproject.toml
	"$(PYTHON)" -m venv .venv-interop
	.venv-interop/$(notdir $(BIN))/python -m pip install --quiet --editable '.[interop,test]'
	@touch $@

bench: $(STAMP) $(DATASET)
	@for script in tests/benchmarks/*.py; do echo "== $$script"; $(RUN) $$script || exit 1; done

clean:
	@if test -L "$(VENV)" || { test -e "$(VENV)" && ! test -f "$(STAMP)"; }; then \
		echo "$(VENV) was not set up by make; it stays." >&2; else rm -rf "$(VENV)"; fi
	rm -rf $(SETS:%=.venv-%) .venv-interop build dist .pytest_cache .ruff_cache .mypy_cache .hypothesis
	find reference compare tests -name __pycache__ -type d -prune -exec rm -rf {} +
