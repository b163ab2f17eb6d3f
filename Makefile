# SPDX-License-Identifier: GPL-2.0-or-later
# The commands of the README; the build itself is CMake's.
BUILD ?= build
PREFIX ?= /usr/local
CMAKE_OPTIONS ?=
DEMO_OUTPUT ?= results/demo
DEMO_OPTIONS ?=

.PHONY: all deps configure build package demo test bench bench-quick bench-wall bench-far-field accuracy install uninstall format format-check clean

all: build

deps:
	@tools/install-dependencies.sh

configure: deps
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_INSTALL_PREFIX=$(PREFIX) $(CMAKE_OPTIONS) > $(BUILD).log 2>&1 \
	  && rm -f $(BUILD).log || { cat $(BUILD).log; rm -f $(BUILD).log; exit 1; }

build: configure
	cmake --build $(BUILD)

# What users run, without the tests.
package: configure
	cmake --build $(BUILD) --target grainfall_core grainfall_package

# The whole chain on real input, in a few minutes: the 57 mm replica dropped on coarse sand.
demo: package
	PYTHONPATH=$(abspath $(BUILD))/python yade -j2 -n -x scenarios/drop_test.py \
	  --preset m70-full --quick --output $(DEMO_OUTPUT) $(DEMO_OPTIONS)

test: build
	ctest --test-dir $(BUILD) --output-on-failure -j$(shell nproc)

bench: build
	PYTHONPATH=$(abspath $(BUILD))/python yade -j1 -n -x benchmarks/law_cost.py
	/usr/bin/python3 benchmarks/instruction_count.py $(BUILD)
	/usr/bin/python3 benchmarks/effect_cost/measure.py $(BUILD)
	PYTHONPATH=$(abspath $(BUILD))/python:benchmarks yade -j1 -n -x benchmarks/flat_effects.py $(BUILD) --page docs/flat_path.md
	PYTHONPATH=benchmarks /usr/bin/python3 -m speed.run $(BUILD)

# The speed of a step in a minute or two: results/speed/.
bench-quick: package
	cmake --build $(BUILD) --target bare_loop
	PYTHONPATH=benchmarks /usr/bin/python3 -m speed.run $(BUILD) --quick

# The deformable wall: set-up, memory, a step's cost, closest point (docs/physics/far_field.md).
bench-wall: package
	cmake --build $(BUILD) --target closest_point_cost
	$(BUILD)/benchmarks/closest_point_cost
	PYTHONPATH=$(abspath $(BUILD))/python yade -j1 -n -x benchmarks/wall_cost.py
	PYTHONPATH=$(abspath $(BUILD))/python:benchmarks yade -j1 -n -x benchmarks/wall_scene.py
	PYTHONPATH=$(abspath $(BUILD))/python:benchmarks yade -j1 -n -x benchmarks/wall_accuracy.py

# How near the boundary of a bed may be, with a continuum outside and without: docs/physics/far_field.md. An hour or two.
bench-far-field: package
	PYTHONPATH=$(abspath $(BUILD))/python:benchmarks /usr/bin/python3 -m far_field_size.run

# Error against time for every knob that buys accuracy: docs/accuracy.md.
accuracy: package
	PYTHONPATH=$(abspath $(BUILD))/python:benchmarks yade -j1 -n -x benchmarks/accuracy_cost/run.py

install: package
	cmake --install $(BUILD)

uninstall:
	@test -f $(BUILD)/install_manifest.txt || { echo "nothing was installed from $(BUILD)"; exit 1; }
	sed 's|^|$(DESTDIR)|' $(BUILD)/install_manifest.txt | xargs -d '\n' rm -f
	sed 's|^|$(DESTDIR)|' $(BUILD)/install_manifest.txt | xargs -d '\n' -n1 dirname | sort -ru \
	  | grep '/grainfall' | while read -r folder; do rm -rf "$$folder/__pycache__"; rmdir -p --ignore-fail-on-non-empty "$$folder" 2>/dev/null || true; done

CXX_SOURCES = $(shell git ls-files '*.cpp' '*.hpp')
format: deps
	clang-format -i $(CXX_SOURCES)
	black -q .

format-check: deps
	clang-format --dry-run --Werror $(CXX_SOURCES)
	black --check -q .
	flake8

clean:
	rm -rf $(BUILD)
