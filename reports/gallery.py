# SPDX-License-Identifier: BSD-3-Clause
"""The paper's figures in motion: python3 gallery.py RESULTS.json [TRIPOINT]

Draws one film a case that is tagged `paper`, NAME.gif beside RESULTS.json, and index.html, which shows them with what each case claims
and its verdict. With the program, `tripoint render` also draws six frames of each with their surfaces, ray-traced: NAME.png.
`make gallery` runs the cases first. Exit: 0 all is drawn, 1 something is not, 2 there is nothing to draw.
"""
from __future__ import annotations

import base64
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import animation
import load
import page
import table1
import trajectories
from summary import tone


SIZE = "400x300"  # of one frame [pixels]


def pictures(results, program=None):
    """@return (case, names of the film and of the sheet, each "" where there is none, why there is none, end of the film in s), in the order of the ids"""
    found = []
    for case in sorted((case for case in results.cases if "paper" in table1.tags(case)), key=lambda case: case.id):
        film = animation.film(results, case.id, case.title)
        name = case.id.replace("/", "-") + ".gif" if film.picture else ""
        if name:
            (results.folder / name).write_bytes(base64.b64decode(film.picture))
        sheet, note = surfaces(results, case, program) if program and name else ("", film.note)
        found.append((case, name, sheet, note, film.end))
    return found


def surfaces(results, case, program):
    """@return name of the sheet of six frames with their surfaces, and why there is none"""
    run = animation.run_to_draw(case)
    name = case.id.replace("/", "-") + ".png"
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, "render", trajectories.folder_of(results.folder, run), "--out", folder, "--size", SIZE], capture_output=True, text=True, check=False)
        if done.returncode != 0 or not (Path(folder) / "sheet.png").is_file():
            return "", f"{case.id}: no surfaces: {done.stderr.strip()}"
        shutil.copy(Path(folder) / "sheet.png", results.folder / name)
    return name, ""


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    if len(arguments) not in (1, 2):
        print("usage: gallery.py RESULTS.json [TRIPOINT]", file=sys.stderr)
        return 2
    try:
        results = load.load(arguments[0])
    except load.Unreadable as reason:
        print(f"gallery: {reason}", file=sys.stderr)
        return 2
    drawn = pictures(results, *arguments[1:])
    if not drawn:
        print(f"gallery: no case of {arguments[0]} is tagged paper: tripoint validate paper", file=sys.stderr)
        return 2
    index = results.folder / "index.html"
    index.write_text(page.render_gallery(results, [(case, name, sheet, note, end, tone(case.verdict)) for case, name, sheet, note, end in drawn]), encoding="utf-8")
    for _, _, _, note, _ in drawn:
        if note:
            print(f"gallery: {note}", file=sys.stderr)
    print(index)
    return 1 if any(note for _, _, _, note, _ in drawn) else 0


if __name__ == "__main__":
    sys.exit(main())
