# SPDX-License-Identifier: BSD-3-Clause
"""Instructions of a step, counted by callgrind: the same number in every run, whatever else the machine does.

    instructions.py gate COUNT_STEPS        counts every scene of instructions.toml, compares with the stored counts;
    exit 1 outside the band
    instructions.py store COUNT_STEPS       counts and stores
    instructions.py effects FULL NAME=FILTERED...   counts the scene NAME with the full list of effects and with the
    list NAME alone, the allocator's work left out; exit 1 above 1 %
    instructions.py table COUNT_STEPS       what each effect adds to a particle-step, in instructions and bytes

Exit 77 (skipped) where valgrind is missing or the compiler is not the one that the counts were stored with.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENES, COUNTS = HERE / "instructions.toml", HERE / "instructions.counts.toml"
CASES = HERE.parent.parent / "cases"
SKIPPED = 77
SAID = re.compile(r"(\d+) particles, (.*), (\d+) bytes")
COUNTED = re.compile(r"Collected : (\d+)")
ALLOCATED = re.compile(r"^\s*([\d,]+) .*\bmalloc\.c:", re.MULTILINE)


class Count:
    """What one scene took: instructions of its counted steps, and what the program said of it."""

    def __init__(self, program, scene):
        with tempfile.TemporaryDirectory() as folder:
            words = [
                "valgrind",
                "--tool=callgrind",
                f"--callgrind-out-file={folder}/out",
                "--toggle-collect=counted_steps",
                program,
                str(CASES / (scene["case"] + ".toml")),
                scene.get("mode", "corrected"),
                str(scene.get("warm", 2)),
                str(scene["steps"]),
                *scene.get("set", []),
            ]
            done = subprocess.run(
                words,
                capture_output=True,
                text=True,
                check=False,
                timeout=1800,
                env=os.environ | {"OMP_NUM_THREADS": "1"},
            )
            by_function = subprocess.run(
                ["callgrind_annotate", "--threshold=100", f"{folder}/out"], capture_output=True, text=True, check=False
            )
        said, counted = (
            SAID.search(done.stdout),
            max(map(int, COUNTED.findall(done.stderr)), default=0),
        )  # of a helper that a library forks too
        if done.returncode or not said or counted == 0:
            sys.exit(f"{scene['name']}: {done.stderr[-600:]}")
        self.instructions, self.particles, self.compiler, self.bytes = counted, int(said[1]), said[2], int(said[3])
        self.allocator = sum(int(seen.replace(",", "")) for seen in ALLOCATED.findall(by_function.stdout))
        self.per_particle_step = self.instructions / (self.particles * scene["steps"])


def scenes():
    return tomllib.loads(SCENES.read_text(encoding="utf-8"))["scene"]


def store(program):
    lines = ["# Counted by `instructions.py store`; instructions of the counted steps of each scene."]
    for n, scene in enumerate(scenes()):
        count = Count(program, scene)
        if n == 0:
            lines.append(f'compiler = "{count.compiler}"')
            lines.append("[counts]")
        lines.append(f'"{scene["name"]}" = {count.instructions} # {count.per_particle_step:.0f} a particle-step')
        print(lines[-1], flush=True)
    COUNTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0


def gate(program):
    stored, failed = tomllib.loads(COUNTS.read_text(encoding="utf-8")), []
    for scene in scenes():
        count, band = Count(program, scene), scene.get("band", 0.05)
        if count.compiler != stored["compiler"]:
            print(f"counts were stored with {stored['compiler']}, this is {count.compiler}")
            return SKIPPED
        before = stored["counts"].get(scene["name"])
        change = count.instructions / before - 1.0 if before else float("inf")
        inside = abs(change) <= band
        print(
            f"{'ok  ' if inside else 'FAIL'} {scene['name']:22} {count.per_particle_step:10.0f} a particle-step, "
            f"{100 * change:+6.2f} % (band {100 * band:.0f} %)",
            flush=True,
        )
        if not inside:
            failed.append(scene["name"])
    if failed:
        print(
            f"outside the band: {', '.join(failed)}. If that is meant, store the new counts: instructions.py store, "
            "and say why in the commit."
        )
    return 1 if failed else 0


def effects(full, filtered):
    by_name, failed = {scene["name"]: scene for scene in scenes()}, False
    for pair in filtered:
        name, program = pair.split("=", 1)
        scene = by_name[name]
        all_effects, alone = Count(full, scene), Count(program, scene)
        # The allocator searches more or less by where earlier blocks happen to lie, which moves with the length of a
        # path: up to 3 % of a small scene.
        all_effects, alone = (count.instructions - count.allocator for count in (all_effects, alone))
        more = all_effects / alone - 1.0
        failed |= more > 0.01
        print(
            f"{'ok  ' if more <= 0.01 else 'FAIL'} {name:10} {all_effects} with every effect in the program, {alone} "
            f"with {name} alone: {100 * more:+.4f} %",
            flush=True,
        )
    return 1 if failed else 0


def table(program):
    made = {scene["name"]: Count(program, scene) for scene in scenes()}
    print(
        "| effect | scene | particles | instructions a particle-step | more than without | bytes a particle (fields) "
        "| more |\n|---|---|---|---|---|---|---|"
    )
    for scene in scenes():
        count, base = made[scene["name"]], made.get(scene.get("adds_to"))
        more = (
            ("-", "-")
            if not base
            else (f"{count.per_particle_step - base.per_particle_step:+.0f}", f"{count.bytes - base.bytes:+d}")
        )
        print(
            f"| {scene['shows']} | {scene['name']} | {count.particles} | {count.per_particle_step:.0f} | {more[0]} | "
            f"{count.bytes} | {more[1]} |"
        )
    return 0


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if not shutil.which("valgrind"):
        print("valgrind is not installed")
        return SKIPPED
    if sys.argv[1] == "effects":
        return effects(sys.argv[2], sys.argv[3:])
    return {"gate": gate, "store": store, "table": table}[sys.argv[1]](sys.argv[2])


if __name__ == "__main__":
    sys.exit(main())
