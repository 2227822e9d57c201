#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the guide: build/docs/index.html, by Sphinx and MyST in .venv-docs (pinned by hash; 20 MB to fetch, 116 MB on the disk).
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'docs: %s\n' "$*" >&2; }
pins=tools/requirements-docs.txt stamp=.venv-docs/docs.sha256 want=
want=$(sha256sum <"$pins")
if [[ ! -f $stamp || $(<"$stamp") != "$want" ]]; then
  say "Sphinx into .venv-docs: 20 MB to fetch, 116 MB on the disk"
  { [[ -x .venv-docs/bin/pip ]] || /usr/bin/python3 -m venv .venv-docs; } >&2
  .venv-docs/bin/pip install --quiet --disable-pip-version-check --require-hashes --only-binary :all: --requirement "$pins" >&2 || { say "no guide: PyPI or python3-venv failed"; exit 1; }
  printf '%s\n' "$want" >"$stamp"
fi
rm -rf build/docs
.venv-docs/bin/sphinx-build -q -W --keep-going -b html -d build/docs-work docs build/docs
say "open build/docs/index.html"
