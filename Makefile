# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# The short way; what stands behind it is in CMakePresets.json and tools/.
JOBS ?= $(shell nproc 2>/dev/null || echo 2)

.DEFAULT_GOAL := help
.PHONY: help demo test build docs site deb bench judge tidy clean packages test-packages judge-packages oracle \
        engine-packages wheel wheel-packages
.DELETE_ON_ERROR:

help:
	@echo "make demo    build tenon quickly (build/quick), let the example hand grasp, show what to look at"
	@echo "make test    build with sanitizers and run every test"
	@echo "make build   only the program: build/release/bin/tenon; ENGINES=all: PhysX and Jolt too"
	@echo "make wheel   the Python package with every engine: dist/tenon_usd-*.whl"
	@echo "make docs    the reference of the C++ headers: build/docs/html"
	@echo "make site    the documentation as a web site: build/site/index.html"
	@echo "make deb     a Debian package with all engines: dist/tenon_*.deb"
	@echo "make bench   measure, beside usd-core; BASE=<commit>: beside that commit"
	@echo "make judge   the long runs, hours of them; ONLY=\"NAME...\" chooses, tools/judge.py --list"
	@echo "make tidy    clang-tidy over the whole program, half an hour of processor time"
	@echo "make clean   remove build/"

# ENGINES=all: with every engine, PhysX and Jolt too; a build folder that has them keeps them.
ifeq ($(ENGINES),all)
build: engine-packages packages
	@cmake --preset release -DTENON_WITH_PHYSX=ON -DTENON_WITH_JOLT=ON
else
build: packages
endif
	@tools/quiet_build.sh release $(JOBS) all

wheel: engine-packages wheel-packages
	@cmake --preset release -DTENON_WITH_PHYSX=ON -DTENON_WITH_JOLT=ON > /dev/null
	@tools/quiet_build.sh release $(JOBS) all
	@JOBS=$(JOBS) tools/make_wheel.sh

docs: build
	@tools/bootstrap.sh docs
	@tools/python.sh tools/make_reference.py

site: docs
	@python3 tools/make_site.py

deb:
	@$(MAKE) --no-print-directory build ENGINES=all
	@tools/bootstrap.sh deb
	@mkdir -p dist
	@cpack --config build/release/CPackConfig.cmake -B build/deb > build/deb.log || { cat build/deb.log; exit 1; }
	@mv build/deb/*.deb dist/ && ls dist/*.deb

demo: packages
	@tools/quiet_build.sh quick $(JOBS) all
	@tools/demo.sh build/quick

# Some tests are of the program that users run.
test: test-packages oracle build/dev/build.ninja build/release/build.ninja
	@cmake --preset release -DTENON_WITH_PHYSX=ON -DTENON_WITH_JOLT=ON > /dev/null
	@tools/quiet_build.sh dev $(JOBS) all
	@tools/quiet_build.sh release $(JOBS) all
	@tools/quiet_tests.sh dev -LE judge -j $(JOBS)

ifdef BASE
bench: test-packages build/bench/build.ninja
	@cmake --build build/bench -j $(JOBS) --target tenon_cli
	@tools/python.sh bench/compare.py $(BASE) $(ONLY)
else
bench: test-packages oracle build/bench/build.ninja
	@cmake --build build/bench -j $(JOBS)
	@tools/python.sh bench/run.py
endif

judge: judge-packages build/dev/build.ninja build/release/build.ninja build/bench/build.ninja
	@cmake --build build/dev -j $(JOBS)
	@cmake --build build/release -j $(JOBS)
	@python3 tools/judge.py --jobs $(JOBS) $(ONLY)

tidy: test-packages oracle
	@tools/python.sh tools/tidy.py --jobs $(JOBS)

clean:
	rm -rf build

# System packages and the oracle are made once; each script returns at once when nothing is missing.
packages:
	@tools/bootstrap.sh build

engine-packages:
	@tools/bootstrap.sh build engines

wheel-packages:
	@tools/bootstrap.sh build wheel

test-packages:
	@tools/bootstrap.sh build test

judge-packages:
	@tools/bootstrap.sh build test judge

oracle: | test-packages
	@tools/make_oracle.sh

build/dev/build.ninja build/bench/build.ninja: | test-packages oracle
build/%/build.ninja: CMakePresets.json
	cmake --preset $*
	@touch $@
