# SPDX-License-Identifier: BSD-3-Clause
"""An engine that lacks a physics has no rank in any case in which that physics matters: ranks_test.py TRIPOINT SOURCE
[unittest arguments].

One engine lacks contact and the gyroscopic term, and with them friction and restitution. Bullet without friction, or
without restitution, lacks one alone."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
BULLET = TRIPOINT.parent.parent / "libexec" / "tripoint" / "engine-bullet"
TOYS = SOURCE / "tests" / "cli" / "toy"
GYROSCOPIC = ("rigid/torque-free", "rigid/precession", "rigid/flip-time", "rigid/hundred-turns", "rigid/long-spin")
FRICTION = (
    "contact/slide-to-rest",
    "contact/slope-stick",
    "contact/slope-slip",
    "contact/slope-threshold",
    "contact/roll-down-slope",
    "contact/slip-to-roll",
)
RESTITUTION = (
    "contact/ball-restitution-050",
    "contact/ball-restitution-090",
    "contact/ball-restitution-100",
    "contact/box-restitution-050",
    "contact/box-restitution-100",
    "contact/tumble-elastic",
)
MERGES = ("rigid/merge-in-flight", "rigid/merge-three", "rigid/split-in-flight")
TOUCHLESS = (
    "contact/conveyor",
    "contact/moving-board",
    "contact/mesh-rest",
    "contact/mesh-groove",
    "contact/mesh-slope",
)  # the toy takes no prescribed body and no mesh


def contacts():
    done = subprocess.run(
        [TRIPOINT, "list", "--profile", "acceptance", "--json"], capture_output=True, text=True, timeout=60, check=True
    )
    return [case["id"] for case in json.loads(done.stdout)["cases"] if case["id"].startswith("contact/")]


class Ranks(unittest.TestCase):
    def scores(self, cases, engine, *others, **environment):
        """{case: row} of the engine, judged beside others."""
        with tempfile.TemporaryDirectory(prefix="tripoint ranks ") as folder:
            name = engine.name.removeprefix("engine-")
            done = subprocess.run(
                [
                    TRIPOINT,
                    "validate",
                    *cases,
                    "--profile",
                    "acceptance",
                    "--engine",
                    engine,
                    "--engines",
                    ",".join([name, "exact", *others]),
                    "--no-report",
                    "--no-history",
                    "--out",
                    folder,
                ],
                capture_output=True,
                text=True,
                timeout=900,
                check=False,
                env=os.environ | environment,
            )
            self.assertTrue((Path(folder) / "scorecard.json").is_file(), done.stdout[-2000:] + done.stderr[-2000:])
            card = json.loads((Path(folder) / "scorecard.json").read_text())
            return {row["case"]: row for e in card["engines"] if e["engine"] == name for row in e["rows"]}

    def has_no_rank(self, rows, cases):
        for case in cases:
            with self.subTest(case):
                self.assertEqual((rows[case]["verdict"], rows[case]["rank"]), ("fail", 0), rows[case])

    def test_an_engine_without_gyroscopic_term(self):
        rows = self.scores(GYROSCOPIC, TOYS / "engine-drifter", "bullet")
        self.has_no_rank(rows, GYROSCOPIC)
        self.assertIn("without gyroscopic term", rows["rigid/torque-free"]["cause"])
        self.assertIn("without gyroscopic term", rows["rigid/precession"]["cause"])

    def test_an_engine_without_contact(self):
        cases = [case for case in contacts() if case not in TOUCHLESS]
        rows = self.scores(cases, TOYS / "engine-drifter")
        self.has_no_rank(rows, [case for case in cases if rows[case]["verdict"] not in ("refused", "crashed")])
        self.assertGreater(
            sum(row["verdict"] == "fail" for row in rows.values()),
            15,
            {case: (row["verdict"], row["reason"]) for case, row in rows.items()},
        )

    def test_an_engine_without_friction(self):
        self.has_no_rank(
            self.scores(FRICTION, TOYS / "engine-changed", CHANGED_INNER=str(BULLET), CHANGED="friction 0"), FRICTION
        )

    def test_an_engine_without_restitution(self):
        self.has_no_rank(
            self.scores(
                RESTITUTION,
                TOYS / "engine-changed",
                CHANGED_INNER=str(BULLET),
                CHANGED="restitution 0",
                CHANGED_PRESET="impact",
            ),
            RESTITUTION,
        )

    def test_an_engine_whose_bodies_never_merge_or_split(self):
        rows = self.scores(MERGES, TOYS / "engine-changed", CHANGED_INNER=str(BULLET), CHANGED="events 0")
        self.has_no_rank(rows, MERGES)

    def test_the_same_engine_unchanged_has_ranks(self):
        for cases, preset in ((FRICTION, "default"), (RESTITUTION, "impact"), (MERGES, "default")):
            rows = self.scores(cases, TOYS / "engine-changed", CHANGED_INNER=str(BULLET), CHANGED_PRESET=preset)
            for case in cases:
                self.assertGreater(rows[case]["rank"], 0, rows[case])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
