# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# The short way; what stands behind it is in CMakePresets.json and tools/.
JOBS ?= $(shell nproc 2>/dev/null || echo 2)

.DEFAULT_GOAL := help
.PHONY: help demo test build bench clean packages test-packages oracle
.DELETE_ON_ERROR:

help:
	@echo "make demo    build tenon, let the example hand grasp, say what to look at"
	@echo "make test    build with sanitizers and run every test"
	@echo "make build   only the program: build/release/bin/tenon"
	@echo "make bench   measure, beside usd-core"
	@echo "make clean   remove build/"

build: packages build/release/build.ninja
	@cmake --build build/release -j $(JOBS) --target tenon_cli

demo: build
	@tools/demo.sh

test: test-packages oracle build/dev/build.ninja
	@cmake --build build/dev -j $(JOBS)
	@ctest --preset dev -j $(JOBS)

bench: test-packages oracle build/bench/build.ninja
	@cmake --build build/bench -j $(JOBS)
	@tools/python.sh bench/run.py

clean:
	rm -rf build

# System packages and the oracle are made once; each script returns at once when nothing is missing.
packages:
	@tools/bootstrap.sh build

test-packages:
	@tools/bootstrap.sh build test

oracle: | test-packages
	@tools/make_oracle.sh

build/release/build.ninja: | packages
build/dev/build.ninja build/bench/build.ninja: | test-packages oracle
build/%/build.ninja: CMakePresets.json
	cmake --preset $*
	@touch $@
