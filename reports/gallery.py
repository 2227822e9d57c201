# SPDX-License-Identifier: BSD-3-Clause
"""The paper's figures in motion: python3 gallery.py RESULTS.json

Draws one film a case that is tagged `paper`, NAME.gif beside RESULTS.json, and index.html, which shows them with what each case claims
and its verdict. `make gallery` runs the cases first. Exit: 0 every film is drawn, 1 one is not, 2 there is nothing to draw.
"""
from __future__ import annotations

import base64
import sys
from pathlib import Path

import animation
import load
import page
import table1
from summary import tone


def pictures(results):
    """@return (case, file name or "", why there is none, end of the film in s), in the order of the ids"""
    found = []
    for case in sorted((case for case in results.cases if "paper" in table1.tags(case)), key=lambda case: case.id):
        film = animation.film(results, case.id, case.title)
        name = case.id.replace("/", "-") + ".gif" if film.picture else ""
        if name:
            (results.folder / name).write_bytes(base64.b64decode(film.picture))
        found.append((case, name, film.note, film.end))
    return found


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    if len(arguments) != 1:
        print("usage: gallery.py RESULTS.json", file=sys.stderr)
        return 2
    try:
        results = load.load(arguments[0])
    except load.Unreadable as reason:
        print(f"gallery: {reason}", file=sys.stderr)
        return 2
    drawn = pictures(results)
    if not drawn:
        print(f"gallery: no case of {arguments[0]} is tagged paper: tripoint validate paper", file=sys.stderr)
        return 2
    index = results.folder / "index.html"
    index.write_text(page.render_gallery(results, [(case, name, note, end, tone(case.verdict)) for case, name, note, end in drawn]), encoding="utf-8")
    for case, _, note, _ in drawn:
        if note:
            print(f"gallery: {note}", file=sys.stderr)
    print(index)
    return 1 if any(note for _, _, note, _ in drawn) else 0


if __name__ == "__main__":
    sys.exit(main())
