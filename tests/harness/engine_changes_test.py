# SPDX-License-Identifier: BSD-3-Clause
"""Which limit sees which wrong constant of an engine: each row of engine_changes.toml, against Bullet with that
constant bent.

A row with `known` names the metrics that are a known defect of Bullet as it is.
A row with `engine` is of one that is installed on demand: it is bent under its own name, and left out where it is not
here."""

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


def installed(engine):
    """The executable of an engine that is installed on demand, None where it is not here."""
    home = Path(os.environ.get("TRIPOINT_ENGINES") or HERE.parents[1] / ".venv-engines")
    path = home / engine / f"engine-{engine}"
    return path.resolve() if os.access(path, os.X_OK) else None


def own_gates(name, case, bent, changed_settings=""):
    """@return {preset: {metric: worst verdict}} of the gates on an installed engine that is bent under its own name"""
    with tempfile.TemporaryDirectory() as out:
        home = Path(out) / "engines" / name
        home.mkdir(parents=True)
        (home / f"engine-{name}").symlink_to(HERE / "bent/engine-bent")
        environment = {
            **os.environ,
            "TRIPOINT_ENGINES": str(home.parent),
            "BENT_ENGINE": str(installed(name)),
            "BENT": bent,
            "BENT_SET": changed_settings,
            "BENT_KEEPS_NAME": "1",
        }
        command = [PROGRAM, "validate", case, "--engines", name, "--no-report", "--out", out + "/report"]
        end = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=600, check=False)
        results = json.loads((Path(out) / "report/results.json").read_text(encoding="utf-8"))
        engines = [e for e in results["cases"][0]["engines"] if e["name"] == name]
        assert engines and all(e["status"] == "ok" for e in engines), (case, [e["reason"] for e in engines], end.stderr)
        return {e["preset"]: worst(e["gates"]) for e in engines}


def worst(rows):
    found = {}
    for gate in rows:
        if found.get(gate["metric"]) != "fail":
            found[gate["metric"]] = gate["verdict"]
    return found


def gates(case, preset, bent, changed_settings=""):
    """@return {metric: worst verdict} of the case's gates on an engine that no gate names"""
    with tempfile.TemporaryDirectory() as out:
        environment = {
            **os.environ,
            "BENT_ENGINE": BULLET,
            "BENT_PRESET": preset,
            "BENT": bent,
            "BENT_SET": changed_settings,
            "OMP_NUM_THREADS": "1",
        }
        command = [
            PROGRAM,
            "validate",
            case,
            "--engines",
            "bent",
            "--engine",
            str(HERE / "bent/engine-bent"),
            "--no-report",
            "--out",
            out,
        ]
        end = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)
        results = json.loads((Path(out) / "results.json").read_text(encoding="utf-8"))
        (engine,) = [e for e in results["cases"][0]["engines"] if e["name"] == "bent"]
        assert engine["status"] == "ok", (case, engine["reason"], end.stderr)
        return worst(engine["gates"])


class Changes(unittest.TestCase):
    def test_each_is_seen_by_its_limit_and_without_it_all_limits_are_kept(self):
        sound = {}
        for change in (c for c in CHANGES if "engine" not in c):
            case, preset = change["case"], change.get("preset", "default")
            if (case, preset) not in sound:
                sound[case, preset] = gates(case, preset, "")
                with self.subTest(case=case, change="none"):
                    wrong = {metric for metric, verdict in sound[case, preset].items() if verdict != "pass"}
                    self.assertEqual(wrong, set(change.get("known", [])))
                    self.assertTrue(sound[case, preset], "no limit of the case holds for any engine")
            with self.subTest(**change):
                if "set" in change:
                    seen = gates(case, preset, "", json.dumps(change["set"]))
                else:
                    seen = gates(case, preset, f"{change['what']}={change['by']}")
                self.assertEqual(seen.get(change["seen_by"]), "fail", seen)

    def test_each_of_an_installed_engine_is_seen_by_a_gate_of_its_own(self):
        sound = {}
        for change in (c for c in CHANGES if "engine" in c):
            name, case, preset = change["engine"], change["case"], change["preset"]
            if not installed(name):
                print(f"{name} is not installed: {case} is left out")
                continue
            with self.subTest(case=case, change="none"):
                if (name, case) not in sound:
                    sound[name, case] = own_gates(name, case, "")
                self.assertEqual(sound[name, case][preset].get(change["seen_by"]), "pass")
            with self.subTest(**change):
                bent = "" if "set" in change else f"{change['what']}={change['by']}"
                seen = own_gates(name, case, bent, json.dumps(change["set"]) if "set" in change else "")[preset]
                self.assertEqual(seen.get(change["seen_by"]), "fail", seen)

    def test_every_case_of_contact_has_one(self):
        folder = HERE.parents[1] / "cases/contact"
        self.assertEqual(
            {f"contact/{f.stem}" for f in folder.glob("*.toml")}
            - {change["case"] for change in CHANGES if "engine" not in change},
            {"contact/tumble-elastic-default", "contact/dead-drop", "contact/rough-slope", "contact/three-cubes"},
        )  # the first judges Bullet alone, the others our solver, whose defects the self-test knows


if __name__ == "__main__":
    sys.exit(unittest.main())
