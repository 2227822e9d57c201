# SPDX-License-Identifier: BSD-3-Clause
"""Which acceptance limit sees which wrong constant of an engine: each row of engine_changes.toml, against Bullet with that constant bent."""
import json
import os
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAM, BULLET = os.environ["TRIPOINT_PROGRAM"], os.environ["TRIPOINT_BULLET"]
CHANGES = tomllib.loads((HERE / "engine_changes.toml").read_text(encoding="utf-8"))["change"]


def gates(case, preset, bent, changed_settings=""):
    """@return {metric: worst verdict} of the case's gates on an engine that no gate names"""
    with tempfile.TemporaryDirectory() as out:
        environment = {**os.environ, "BENT_ENGINE": BULLET, "BENT_PRESET": preset, "BENT": bent, "BENT_SET": changed_settings, "OMP_NUM_THREADS": "1"}
        command = [PROGRAM, "validate", case, "--engines", "bent", "--engine", str(HERE / "bent/engine-bent"), "--no-report", "--out", out]
        end = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)
        results = json.loads((Path(out) / "results.json").read_text(encoding="utf-8"))
        (engine,) = [e for e in results["cases"][0]["engines"] if e["name"] == "bent"]
        assert engine["status"] == "ok", (case, engine["reason"], end.stderr)
        found = {}
        for gate in engine["gates"]:
            if found.get(gate["metric"]) != "fail":
                found[gate["metric"]] = gate["verdict"]
        return found


class Changes(unittest.TestCase):
    def test_each_is_seen_by_its_limit_and_without_it_all_limits_are_kept(self):
        sound = {}
        for change in CHANGES:
            case, preset = change["case"], change.get("preset", "default")
            if (case, preset) not in sound:
                sound[case, preset] = gates(case, preset, "")
                with self.subTest(case=case, change="none"):
                    self.assertEqual({m: v for m, v in sound[case, preset].items() if v != "pass"}, {})
                    self.assertTrue(sound[case, preset], "no limit of the case holds for any engine")
            with self.subTest(**change):
                if "set" in change:
                    seen = gates(case, preset, "", json.dumps(change["set"]))
                else:
                    seen = gates(case, preset, f"{change['what']}={change['by']}")
                self.assertEqual(seen.get(change["seen_by"]), "fail", seen)

    def test_every_case_of_contact_has_one(self):
        folder = HERE.parents[1] / "cases/contact"
        self.assertEqual({f"contact/{f.stem}" for f in folder.glob("*.toml")} - {change["case"] for change in CHANGES}, {"contact/tumble-elastic-default"})  # it judges Bullet alone


if __name__ == "__main__":
    sys.exit(unittest.main())
