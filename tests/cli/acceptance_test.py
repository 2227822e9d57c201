# SPDX-License-Identifier: BSD-3-Clause
"""The profile of limits that any engine must hold: acceptance_test.py TRIPOINT SOURCE [unittest arguments].

Each limit is exceeded by an engine that has one constant wrong by 1 to 5 %, or by a registered defect of our solver:
KILLS says which."""

import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
ENGINES = TRIPOINT.parent.parent / "libexec" / "tripoint"
CHANGED = SOURCE / "tests" / "cli" / "toy" / "engine-changed"

# case, metric of the limit, engine that is changed, what is changed and by which factor; "defect NAME SIZE": one that
# our solver registers
KILLS = (
    ("rigid/ballistic", "position", "bullet", "gravity 1.02"),
    ("rigid/torque-free", "angle", "bullet", "inertia 1.05"),
    ("rigid/torque-free", "energy", "toy", "scheme 1"),  # the gyroscopic torque of the start of the step
    ("rigid/torque-free", "angle.order", "bullet", "inertia 0.95"),
    ("rigid/merge-in-flight", "position", "bullet", "late 1"),  # events, by a frame
    ("contact/turned-slope", "stays", "bullet", "pairs 1"),  # the law of the first pair for all
    ("heat/cosine-mode", "rate", "tripoint", "conductivity 1.05"),
    ("heat/spreading-walkers", "diffusivity", "lammps", "conductivity 1.02"),  # by the walkers' own mean square way
    ("heat/step-insulated", "energy", "selftest/tripoint", "defect heat.one_sided 1e-3"),
    ("heat/two-conductivities", "energy", "selftest/tripoint", "defect heat.one_sided 1e-3"),
)


def executable(engine):
    if engine == "toy":
        return SOURCE / "tests" / "cli" / "toy" / "engine-toy"
    folder, _, name = engine.rpartition("/")
    return ENGINES / folder / f"engine-{name}"


def acceptance(case):
    whole = subprocess.run(
        [TRIPOINT, "explain", SOURCE / "cases" / f"{case}.toml", "--resolved"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return [
        gate
        for gate in tomllib.loads(whole)["gate"]
        if not gate.get("engine") and gate.get("mode", "not paper") == "not paper"
    ]


def profile():
    done = subprocess.run(
        [TRIPOINT, "list", "--profile", "acceptance", "--json"], capture_output=True, text=True, timeout=60, check=True
    )
    return [case["id"] for case in json.loads(done.stdout)["cases"]]


class Acceptance(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint acceptance ")
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def call(self, *words, **environment):
        return subprocess.run(
            [TRIPOINT, *map(str, words)],
            cwd=self.path,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
            env=os.environ | environment,
        )

    def rows(self, case, metric, inner, change="nothing 1"):
        """Verdicts of the acceptance limit on the metric, for an engine that is `inner` with this change."""
        environment = {"CHANGED_INNER": str(executable(inner)), "CHANGED": change}
        if change.startswith("scheme "):
            environment["TOY_EULER"] = "1"
        if inner == "lammps":
            environment["CHANGED_SETTINGS"] = json.dumps({"conduction": "langevin", "walkers": 2e5})
        if change.startswith("defect "):
            _, name, size = change.split()
            environment = {"CHANGED_INNER": str(executable(inner)), "TRIPOINT_DEFECT": f"{name}={size}"}
        self.call(
            "validate", case, "--engine", CHANGED, "--engines", "changed", "--no-report", "--no-history", **environment
        )
        results = json.loads((self.path / "report" / "results.json").read_text())["cases"][0]
        lines = {gate["line"] for gate in results["gates"] if not gate["engine"]}
        return [
            row["verdict"]
            for engine in results["engines"]
            for row in engine["gates"]
            if row["metric"] == metric and row["line"] in lines
        ]

    def test_every_case_of_the_profile_has_a_limit_for_any_engine_and_no_other_case_claims_one(self):
        ids = profile()
        self.assertGreater(len(ids), 20)
        for case in ids:
            self.assertTrue(acceptance(case), case)
        for file in (SOURCE / "cases").rglob("*.toml"):
            case = str(file.relative_to(SOURCE / "cases"))[:-5]
            text = file.read_text()
            if "acceptance of any engine" in text:
                self.assertIn(case, ids)

    def test_each_limit_is_exceeded_by_an_engine_with_one_constant_wrong(self):
        for case, metric, inner, change in KILLS:
            with self.subTest(f"{case} {metric}: {change}"):
                sound = self.rows(case, metric, inner)
                self.assertTrue(sound)
                self.assertEqual(set(sound), {"pass"})
                self.assertIn("fail", self.rows(case, metric, inner, change))

    def test_the_scorecard_of_an_engine(self):
        done = self.call(
            "validate",
            "rigid/ballistic",
            "rigid/torque-free",
            "heat/cosine-mode",
            "--profile",
            "acceptance",
            "--engines",
            "bullet,exact",
            "--no-report",
            "--no-history",
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("scorecard of bullet", done.stdout)
        card = json.loads((self.path / "report" / "scorecard.json").read_text())
        bullet = next(e for e in card["engines"] if e["engine"] == "bullet")
        self.assertEqual(
            [(row["case"], row["verdict"]) for row in bullet["rows"]],
            [("heat/cosine-mode", "refused"), ("rigid/ballistic", "pass"), ("rigid/torque-free", "known defect")],
        )
        self.assertNotIn("exact", [e["engine"] for e in card["engines"]])  # the truth has no score
        flight = bullet["rows"][1]
        self.assertAlmostEqual(flight["error"], 0.04905, 4)
        self.assertEqual(flight["allowed"], "limit 0.05")
        self.assertGreater(bullet["rows"][2]["order"], 0.8)
        page = (self.path / "report" / "scorecard.html").read_text()
        self.assertIn("bullet", page)
        self.assertIn("of the limit", page)
        written = (self.path / "report" / "scorecard.md").read_text()
        self.assertTrue(
            written.startswith(
                "# Acceptance: engines by the limits that any engine must hold\n\nWritten by `tripoint validate "
            ),
            written[:200],
        )
        for words in (
            "| rigid/ballistic | pass |",
            "| rigid/torque-free | known defect: damped-gyroscopic-term (energy: 0.0618) |",
            "- refused: Bullet has no periodic directions: heat/cosine-mode",
        ):
            self.assertIn(words, written)

    def test_an_engine_that_takes_no_scene_is_not_green(self):
        environment = {"CHANGED_INNER": str(executable("exact"))}
        done = self.call(
            "validate",
            "heat/cosine-mode",
            "--profile",
            "acceptance",
            "--engines",
            "bullet",
            "--no-report",
            "--no-history",
            **environment,
        )
        self.assertEqual(done.returncode, 4, done.stdout)
        self.assertIn("bullet was asked for and ran no case; it refuses the one case", done.stdout)
        self.assertIn("verdict REFUSED exit 4", done.stdout)

    def test_the_page_names_each_case_of_the_profile_and_no_other(self):
        page = (SOURCE / "docs" / "acceptance.md").read_text()
        named = re.findall(r"`([a-z]+/[a-z0-9-]+)`", page[page.index("## The cases") :])
        self.assertEqual(sorted(named), sorted(profile()))  # each once
        self.assertIn("tripoint validate --profile acceptance --out report-acceptance", page)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
