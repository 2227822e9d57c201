# SPDX-License-Identifier: BSD-3-Clause
"""Without --sandbox a third-party engine finds no truth that it could copy: third_parties_test.py TRIPOINT."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT = sys.argv[1]
THIEF = """#!/usr/bin/python3
import json, os, shutil, sys
verb = sys.argv[1]
if verb == "--info":
    print(json.dumps({"contract": 1, "name": "thief", "version": "1", "build": "", "library": {"path": "", "hash": \
""}, "capabilities": [], "presets": ["default"], "settings": {}, "deterministic": True}))
elif verb == "--check":
    print(json.dumps({"can": True, "reason": ""}))
else:
    job, here = json.load(open(sys.argv[2])), os.path.dirname(os.path.abspath(sys.argv[2]))
    roots = ["PLACE", os.getcwd(), *[os.path.normpath(os.path.join(here, *[".."] * n)) for n in range(1, 5)]]
    found = [os.path.join(at, name) for root in roots for at, _, names in os.walk(root) for name in names if \
name.startswith(("trajectory.", "gauges.", "checkpoint-")) and not at.startswith(here)]
    open(os.path.join(here, "found.json"), "w").write(json.dumps([found, job["reference"]["function"], \
job["reference"]["args"]]))
    for path in found:
        shutil.copy(path, here)
    if not found:
        sys.exit(9)
    bodies = [{k: b[k] for k in ("name", "mass", "centre", "principal_inertia")} for b in job["scene"]["bodies"]]
    json.dump({"contract": 1, "status": "ok", "time_reached": job["times"][-1], "readback": {"gravity": \
job["scene"]["gravity"], "bodies": bodies}}, open(os.path.join(here, "result.json"), "w"))
"""


class ThirdParties(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name).resolve()
        self.engine = self.folder / "engine-thief"
        self.engine.write_text(THIEF.replace("PLACE", place.name))
        self.engine.chmod(0o755)

    def validate(self, *words, cases=("rigid/ballistic", "rigid/torque-free")):
        return subprocess.run(
            [TRIPOINT, "validate", *cases, "--out", "out", "--no-report", "--no-history", *words],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )

    def found(self):
        return [json.loads(file.read_text()) for file in self.folder.rglob("found.json")]

    def status(self, name):
        results = json.loads((self.folder / "out/results.json").read_text())
        return {
            run["status"]
            for case in results["cases"]
            for engine in case["engines"]
            if engine["name"] == name
            for run in engine["runs"]
        }

    def test_an_engine_that_copies_what_it_finds_finds_nothing(self):
        first = self.validate("--engines", "exact")
        self.assertEqual(self.status("exact"), {"ok"}, first.stderr)
        for words in (
            ["--jobs", "2"],
            [],
            ["--resume"],
        ):  # after an earlier call, beside one's own runs, and where those are kept
            done = self.validate("--engines", "thief,exact", "--engine", self.engine, *words)
            self.assertTrue(self.found())
            self.assertEqual([one for one in self.found() if one != [[], "", {}]], [], words)
            self.assertEqual((self.status("thief"), self.status("exact")), ({"killed"}, {"ok"}), done.stderr)
            self.assertEqual(done.returncode, 4)

    def test_results_do_not_depend_on_who_runs_first(self):
        subprocess.run(
            [TRIPOINT, "engine", "new", "mine", "--lang", "python"], cwd=self.folder, check=True, capture_output=True
        )
        mine = self.folder / "mine/engine-mine"
        told = []
        for words in (
            ["--engines", "exact,tripoint"],
            ["--engines", "exact,tripoint,mine", "--engine", mine],
            ["--engines", "exact,tripoint,mine", "--engine", mine, "--resume"],
        ):
            done = self.validate(*words)
            results = json.loads((self.folder / "out/results.json").read_text())
            told.append(
                [
                    [run["metrics"], run["state_hash"]]
                    for case in results["cases"]
                    for engine in case["engines"]
                    if engine["name"] == "tripoint"
                    for run in engine["runs"]
                ]
            )
            self.assertTrue(told[-1], done.stderr)
        self.assertEqual(told[0], told[1])
        self.assertEqual(told[0], told[2])
        self.assertIn("kept", done.stderr)

    def test_the_engines_to_start_from_bounce_a_ball(self):
        for language in ("python", "cpp"):
            name = f"my-{language}"
            subprocess.run(
                [TRIPOINT, "engine", "new", name, "--lang", language], cwd=self.folder, check=True, capture_output=True
            )
            engine = self.folder / name / f"engine-{name}"
            if language == "cpp":
                subprocess.run(["c++", "-std=c++20", f"{engine}.cpp", "-o", engine], check=True)
            done = self.validate(
                "--engines",
                name,
                "--engine",
                engine,
                cases=("contact/ball-restitution-050", "contact/ball-restitution-000", "rigid/ballistic"),
            )
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(done.stdout.count("PASS"), 4, done.stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
