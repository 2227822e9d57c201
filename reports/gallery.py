# SPDX-License-Identifier: BSD-3-Clause
"""The paper's figures in motion: python3 gallery.py RESULTS.json [TRIPOINT]

Draws one film a case that is tagged `paper`, NAME.gif beside RESULTS.json, and index.html, which shows them with what
each case claims and its verdict. With the program, `tripoint render` also draws six frames of each with their surfaces,
ray-traced: NAME.png. `make gallery` runs the cases first. Exit: 0 all is drawn, 1 something is not, 2 there is nothing
to draw."""

from __future__ import annotations

import base64
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import no_plugins  # noqa: F401  before h5py
import animation
import load
import page
import table1
import trajectories
from summary import gate_word, tone


SIZE = "400x300"  # of one frame [pixels]
LEGEND = "colours: "  # a line of `tripoint render`
PAPER = {  # what the paper says of each figure, by the beginning of the case's name; the first that fits
    "fig-01-merge": "A heated solid melts and touches another one; cooled, both are one solid.",
    "fig-01-split": "A heated solid melts and parts of it come off; cooled, there are independent solids.",
    "fig-08": "Pressure alone keeps bodies apart, with a high gas constant k; nothing handles collisions.",
    "fig-09": "A heated ground melts a rigid and an elastic block; cooled, they are one object with rigid and elastic "
    "parts.",
    "fig-10-heated": "Blocks that are heated while one moves past them melt at a side and stick to it when cooled.",
    "fig-10-cold": "Without heating the blocks stay distinct, although they touch.",
    "fig-10-elastic": "Rigid blocks and one elastic block on a plate: with heating they merge, without it they stay "
    "distinct.",
    "fig-11-slower": "A higher melting point or slower diffusion of heat makes the bunny melt more slowly.",
    "fig-11": "A rigid bunny in hot liquid melts; its density decides whether it floats.",
    "fig-12": "Hot liquid dropped into a cold viscous one cools down and solidifies wholly.",
    "fig-13": "A part solidifies to a shell, which is lifted and turned while the cream stands still; the liquid "
    "inside flows out and solidifies on the cold splash.",
    "fig-14": "A cold bunny dipped into hot liquid gets coated or melts, by the time that it stays there.",
}


def said_by_the_paper(case):
    """@return what the paper says of the case's figure, in a sentence of ours; "" where it is no figure of the paper"""
    name = case.id.rpartition("/")[2]
    return next((text for start, text in PAPER.items() if name.startswith(start)), "")


def pictures(results, program=None):
    """@return (case, names of the film and of the sheet, each "" where there is none, why there is none, colours of the
    sheet, end of the film in s), in the order of the ids"""
    found = []
    for case in sorted((case for case in results.cases if "paper" in table1.tags(case)), key=lambda case: case.id):
        film = animation.film(results, case.id, case.title)
        name = case.id.replace("/", "-") + ".gif" if film.picture else ""
        if name:
            (results.folder / name).write_bytes(base64.b64decode(film.picture))
        sheet, note, legend = surfaces(results, case, program) if program and name else ("", film.note, "")
        found.append((case, name, sheet, note, legend, film.end))
    return found


def surfaces(results, case, program):
    """@return name of the sheet of six frames with their surfaces, why there is none, and what its colours mean"""
    run = animation.run_to_draw(case)
    name = case.id.replace("/", "-") + ".png"
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [program, "render", trajectories.folder_of(results.folder, run), "--out", folder, "--size", SIZE],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0 or not (Path(folder) / "sheet.png").is_file():
            return "", f"{case.id}: no surfaces: {done.stderr.strip()}", ""
        shutil.copy(Path(folder) / "sheet.png", results.folder / name)
    legend = next((line.partition(LEGEND)[2] for line in done.stderr.splitlines() if LEGEND in line), "")
    return name, "", legend


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
    index.write_text(
        page.render_gallery(
            results,
            [
                (
                    case,
                    name,
                    sheet,
                    note,
                    legend,
                    end,
                    tone(gate_word(case.verdict, case.physics)),
                    said_by_the_paper(case),
                )
                for case, name, sheet, note, legend, end in drawn
            ],
        ),
        encoding="utf-8",
    )
    complaints = [note for _, _, _, note, _, _ in drawn if note]
    for note in complaints:
        print(f"gallery: {note}", file=sys.stderr)
    print(index)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
