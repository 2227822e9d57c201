#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Packs build/ into a wheel with the program inside: build/wheel/tripoint-VERSION-*.whl (python/backend.py).
#   tools/wheel.sh [DIR]     another folder for the wheel
set -euo pipefail
cd "$(dirname "$0")/.."
to=${1:-build/wheel}

[[ -x build/bin/tripoint ]] || { printf 'wheel: build first: make build\n' >&2; exit 2; }
packer=build/packer
[[ -x $packer/bin/pip ]] || /usr/bin/python3 -m venv "$packer"
mkdir -p "$to"
rm -f "$to"/tripoint-*.whl
"$packer/bin/pip" wheel --quiet --disable-pip-version-check --no-deps --wheel-dir "$to" ./python >&2
ls "$to"/tripoint-*.whl
