#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of JOB.json and result.json into docs/engines.md, between marks: engine_tables.py TRIPOINT --write
docs/engines.md (make pages)."""

import subprocess
import sys
from pathlib import Path


def with_tables(page, tripoint):
    for name in ("job", "result"):
        begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
        printed = subprocess.run(
            [tripoint, "schema", f"--{name}", "--page"], capture_output=True, text=True, check=True
        ).stdout
        before, rest = page.split(begin)
        page = before + begin + printed + end + rest.split(end)[1]
    return page


if __name__ == "__main__":
    tripoint, _, file = sys.argv[1:]
    Path(file).write_text(with_tables(Path(file).read_text(), tripoint))
