# SPDX-License-Identifier: BSD-3-Clause
"""Limits of the shell, signals and broken engines end with a sentence; schemas fit the files: limits_test.py
TRIPOINT."""

import json
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT = sys.argv[1]


KINDS = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
    "null": type(None),
}


def fits(schema, value, root, at="job"):
    """What does not fit the part of JSON Schema that these schemas use."""
    if "$ref" in schema:
        schema = root["$defs"][schema["$ref"].removeprefix("#/$defs/")]
    if "anyOf" in schema:
        tried = [fits(one, value, root, at) for one in schema["anyOf"]]
        return [] if [] in tried else min(tried, key=len)
    if "const" in schema or "enum" in schema:
        return [] if value in schema.get("enum", [schema.get("const")]) else [f"{at} = {value!r}"]
    if "type" in schema and not isinstance(value, KINDS[schema["type"]]):
        return [f"{at} is no {schema['type']}: {value!r}"]
    if isinstance(value, dict) and "properties" in schema:
        return members_that_fit_not(schema, value, root, at)
    return items_that_fit_not(schema, value, root, at) if isinstance(value, list) else []


def members_that_fit_not(schema, value, root, at):
    known = schema["properties"]
    wrong = [f"{at} lacks {key}" for key in schema.get("required", []) if key not in value]
    wrong += [f"{at}.{key} is not in the schema" for key in value if key not in known]
    return wrong + [w for key in known if key in value for w in fits(known[key], value[key], root, f"{at}.{key}")]


def items_that_fit_not(schema, value, root, at):
    least, most = schema.get("minItems", 0), schema.get("maxItems", len(value))
    wrong = [] if least <= len(value) <= most else [f"{at} has {len(value)} items"]
    items = schema.get("items", {})
    return wrong + [w for n, part in enumerate(value) for w in fits(items, part, root, f"{at}[{n}]")]


class Limits(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)

    def call(self, *words, shell=""):
        command = ["bash", "-c", shell + 'exec "$@"', "bash", TRIPOINT, *map(str, words)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False, timeout=120)

    def test_a_file_beyond_its_limit_is_a_sentence(self):
        for limit, more in ((8, []), (100, ["--set", "scene.output_interval=0.0005"])):  # of the harness, of the engine
            done = self.call("run", "rigid/ballistic", "--out", "run", *more, shell=f"ulimit -f {limit}; ")
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("ulimit -f unlimited", done.stdout + done.stderr)

    def test_a_text_that_cannot_be_printed_has_its_own_reason(self):
        for shell, words in (
            ("ulimit -f 1; exec > table; ", "ulimit -f unlimited"),
            ("exec > /dev/full; ", "No space left on device"),
            ("exec >&-; ", "standard output is closed"),
        ):
            done = self.call("schema", shell=shell)
            self.assertEqual(done.returncode, 2)
            self.assertIn("could not be written: ", done.stderr)
            self.assertIn(words, done.stderr)

    def test_a_small_stack_is_a_sentence_or_made_greater(self):
        done = self.call("run", "rigid/ballistic", "--out", "run", shell="ulimit -s 100; ")
        self.assertEqual(done.returncode, 2)
        self.assertIn("ulimit -s 8192", done.stderr)
        done = self.call("run", "rigid/ballistic", "--out", "run", shell="ulimit -S -s 100; ")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_signal_is_called_by_its_name(self):
        for which, name in ((signal.SIGTERM, "SIGTERM"), (signal.SIGINT, "Ctrl-C")):
            engine = self.folder / "engine-slow"
            engine.write_text(f"""#!/bin/sh
case $1 in --info) echo '{{"contract": 1, "name": "slow", "version": "1", "capabilities": [], "presets": ["default"], \
"deterministic": true}}';;
--check) echo '{{"can": true, "reason": ""}}';; --run) touch "{self.folder}/begun"; exec sleep 30;; esac
""")
            engine.chmod(0o755)
            run = subprocess.Popen(
                [TRIPOINT, "run", "rigid/ballistic", "--engine", engine, "--out", "run"],
                cwd=self.folder,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
            while not (self.folder / "begun").exists():
                time.sleep(0.02)
            (self.folder / "begun").unlink()
            run.send_signal(which)
            out, err = run.communicate(timeout=60)
            self.assertEqual(run.returncode, 130, err)
            self.assertIn(f"was stopped by {name}", out + err)

    def test_check_runs_nothing(self):
        begun = time.monotonic()
        done = self.call("check", "fluid/still-water-settled")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("nothing is run here", done.stderr)
        self.assertNotIn("scene.settle = true lets it down", done.stderr)
        self.assertLess(time.monotonic() - begun, 20.0)

    def test_an_engine_that_cannot_say_who_it_is_is_quoted(self):
        engine = self.folder / "engine-broken"
        engine.write_text("#!/usr/bin/python3\nimport no_such_module\n")
        engine.chmod(0o755)
        done = self.call("run", "rigid/ballistic", "--engine", engine, "--out", "run")
        self.assertEqual(done.returncode, 4)
        self.assertIn("exited with code 1; its last words: ModuleNotFoundError", done.stderr)

    def test_the_schemas_fit_what_is_written(self):
        for case, more in (
            ("rigid/ballistic", []),
            ("heat/cosine-mode", ["--until", "1"]),
            ("contact/slope-slip", ["--until", "0.01", "--engine", "bullet"]),
            ("phase/melt-rigid", ["--until", "0.01"]),
        ):
            self.call("run", case, "--out", self.folder / "run", *more)
            for name in ("job", "result"):
                file = self.folder / "run" / f"{name}.json"
                schema = json.loads(self.call("schema", f"--{name}").stdout)
                if not file.exists():
                    self.fail(f"{case} left no {file}")
                self.assertEqual(fits(schema, json.loads(file.read_text()), schema, name), [], case)
        schema = json.loads(self.call("schema", "--job").stdout)
        job = json.loads((self.folder / "run/job.json").read_text())
        for key, wrong in (("seed", "1"), ("times", None), ("scene", [])):
            self.assertNotEqual(fits(schema, {**job, key: wrong}, schema), [], key)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
