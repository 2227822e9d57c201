# SPDX-License-Identifier: BSD-3-Clause
"""docs/trajectory.md and docs/results.md against files of real runs, both ways: files_test.py TRIPOINT SOURCE [unittest
arguments].

What a run writes must be on the page with its type, unit and attributes; what the page says must be in a run. Where a
thing is rare (an engine that is not installed, an event that seldom happens) the program's own writer must name it."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
PAGE = (SOURCE / "docs" / "trajectory.md").read_text()
CASE_FILE = (SOURCE / "docs" / "case-file.md").read_text()
FAMILIES = {"energy_": "TERM", "heat_": "BODY", "count_": "WHAT"}
RUNS = {  # between them they write every element
    "melt": ["phase/melt-rigid", "--until", "0.06"],
    "split": ["phase/split-by-melting"],
    "liquid": [
        "fluid/taylor-green",
        "--until",
        "0.004",
        "--set",
        "scene.output_interval=0.001",
        "--set",
        "scene.on_failure=recover",
    ],
    "throw": ["rigid/ballistic"],
}
WRITTEN_ELSEWHERE = {"/particles/all/temperature_error": "LAMMPS walkers"}


def rows(page, heading):
    """Cells of the table below a heading, without backquotes."""
    text = page.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in text.splitlines() if line.startswith("| `")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def names(cell):
    return re.findall(r"`([^`]+)`", cell)


def general(path):
    """/observables/energy_kinetic as the page has it: /observables/energy_TERM."""
    group, _, name = path.rpartition("/")
    for prefix, word in FAMILIES.items():
        if group == "/observables" and name.startswith(prefix):
            return f"{group}/{prefix}{word}"
    return path


class Trajectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint-files-")
        cls.path = Path(cls.folder.name)
        cls.documented = {
            names(row[0])[0]: row[1:]
            for heading in ("Particles", "Bodies", "Observables")
            for row in rows(PAGE, heading)
            if row[0].startswith("`/")
        }
        cls.files = []
        for name, words in RUNS.items():
            done = subprocess.run(
                [TRIPOINT, "run", *words, "--quiet", "--out", cls.path / name],
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
            )
            assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
            cls.files += [
                h5py.File(cls.path / name / file, "r", locking=False) for file in ("trajectory.h5", "particles.h5")
            ]

    @classmethod
    def tearDownClass(cls):
        for file in cls.files:
            file.close()
        cls.folder.cleanup()

    def elements(self):
        """(file, path, group) of each group that has values."""
        for file in self.files:
            found = []
            file.visititems(
                lambda path, node: (
                    found.append("/" + path) if isinstance(node, h5py.Group) and "value" in node else None
                )
            )
            yield from ((file, path, file[path]) for path in found)

    def test_each_element_of_a_run_is_on_the_page(self):
        for file, path, node in self.elements():
            with self.subTest(file.filename, path=path):
                kind, shape, unit = self.documented[general(path)][:3]
                value = node["value"]
                self.assertEqual(str(value.dtype), kind)
                self.assertEqual(value.ndim, shape.count(" x ") + 1)
                if shape[-1].isdigit():
                    self.assertEqual(value.shape[-1], int(shape[-1]))
                self.assertEqual(value.attrs.get("unit", ""), unit.strip("`"))
                self.assertLessEqual(set(value.attrs), {"unit"})
                self.assertTrue(value.fletcher32)
                self.assertIsNone(value.compression)
                if general(path) != "/particles/all/source":
                    self.assertEqual(set(node), {"value", "step", "time"})
                    self.assertEqual(node["time"].attrs["unit"], "s")
                    self.assertEqual(node["time"], file["particles/all/position/time"])  # one dataset, many links
                    self.assertEqual(len(value), len(node["time"]))

    def test_each_element_of_the_page_is_in_a_run(self):
        found = {general(path) for _, path, _ in self.elements()}
        writer = (SOURCE / "src" / "files" / "trajectory_writer.cpp").read_text()
        for path in self.documented:
            if path in WRITTEN_ELSEWHERE and path not in found:
                self.assertIn(f'"{path.rpartition("/")[2]}"', writer)
            else:
                self.assertIn(path, found)

    def test_groups_and_attributes(self):
        documented = {}
        for row in rows(PAGE, "Groups and attributes"):
            documented.setdefault(names(row[0])[0], {}).update({name: row[2] for name in names(row[1])})
        for file in self.files:
            groups = {}
            file.visititems(
                lambda path, node: (
                    groups.update({"/" + path: set(node.attrs)})
                    if isinstance(node, h5py.Group) and "value" not in node
                    else None
                )
            )
            self.assertEqual({path: set(words) for path, words in documented.items()}, groups, file.filename)
            self.assertEqual(list(file["h5md"].attrs["version"]), [1, 1])
            self.assertEqual(list(file["h5md/modules/units"].attrs["version"]), [1, 0])
            for path, words in documented.items():
                for name, value in words.items():
                    if names(value) and name != "boundary":
                        self.assertEqual(file[path].attrs[name], names(value)[0])
            self.assertEqual(file["particles/all/box"].attrs["dimension"], 3)
            boundary = list(file["particles/all/box"].attrs["boundary"])
            self.assertEqual(len(boundary), 3)
            self.assertLessEqual(set(boundary), {"periodic", "none"})

    def test_edges_are_those_of_the_periodic_domain(self):
        file = h5py.File(self.path / "liquid" / "trajectory.h5", "r", locking=False)
        scene = json.loads((self.path / "liquid" / "job.json").read_text())["scene"]
        self.assertEqual(
            [word == "periodic" for word in file["particles/all/box"].attrs["boundary"]],
            [axis in scene["periodic"] for axis in "xyz"],
        )
        edges = file["particles/all/box/edges/value"][:]
        for axis, name in enumerate("xyz"):
            if name in scene["periodic"]:
                np.testing.assert_array_equal(edges[:, axis], scene["max"][axis] - scene["min"][axis])
        file.close()

    def test_codes_and_sentinels(self):
        seen = set()
        for file in self.files:
            particles = file["particles/all"]
            alive = particles["id/value"][:] >= 0
            np.testing.assert_array_equal(
                particles["id/value"][:][alive], np.broadcast_to(np.arange(alive.shape[1]), alive.shape)[alive]
            )
            for name in particles:
                values = particles[name].get("value") if name not in ("box", "source") else None
                if values is None:
                    continue
                values = values[:].reshape(*alive.shape, -1)
                dead, living = values[~alive], values[alive]
                self.assertTrue((np.isnan(dead) if dead.dtype.kind == "f" else dead == -1).all(), name)
                self.assertTrue(np.isfinite(living).all() if name != "temperature_error" else True, name)
            phases, bodies = particles["phase/value"][:], particles["body/value"][:]
            self.assertLessEqual(set(np.unique(phases)), {-1, 0, 1, 2})
            seen |= set(np.unique(phases[alive]))
            self.assertTrue((bodies[alive & (phases == 0)] == -1).all())
            if file.filename.endswith("trajectory.h5"):
                self.assertLess(bodies.max(), file["particles/bodies/position/value"].shape[1])
                self.assertTrue((bodies[alive & (phases != 0)] >= 0).all())
                turned = file["particles/bodies/orientation/value"][0]
                sound = np.isfinite(turned).all(axis=1)
                np.testing.assert_allclose(
                    np.abs(turned[sound]), np.broadcast_to([1.0, 0.0, 0.0, 0.0], turned[sound].shape), atol=1e-15
                )
        self.assertLessEqual({0, 2}, seen)

    def test_terms_of_the_ledger_are_those_of_the_program(self):
        told = words("TERM", "holds", page=CASE_FILE)
        code = "".join(file.read_text() for file in (SOURCE / "src").rglob("*.cpp"))
        known = set(re.findall(r'energy\["(\w+)"\]', code)) | set(re.findall(r'\.entry = "(\w+)"', code))
        known |= set(re.findall(r'const char\* \w+ = "(\w+)"', (SOURCE / "src/scene/ledger_entry.hpp").read_text()))
        self.assertEqual(told, known)
        written = {path.rpartition("energy_")[2] for _, path, _ in self.elements() if "/energy_" in path}
        self.assertLessEqual(written, told)
        self.assertGreater(len(written), 8)

    def test_counts_are_those_of_the_program(self):
        code = "".join(file.read_text() for file in (SOURCE / "adapters").rglob("*.cpp"))
        self.assertEqual(words("WHAT", "counts"), set(re.findall(r'counts\["(\w+)"\]', code)))


def words(*head, page=None):
    """First cells of the page's table with this head; of the page of trajectories where none is given."""
    text = (page or PAGE).split(f"| {' | '.join(head)} |\n", 1)[1].split("\n\n", 1)[0]
    return {names(line)[0] for line in text.splitlines() if line.startswith("| `")}


class Results(unittest.TestCase):
    """Real results are as the schema says, which the page is made of (written_test.py)."""

    @classmethod
    def setUpClass(cls):
        printed = subprocess.run([TRIPOINT, "schema", "--results"], capture_output=True, text=True, check=True).stdout
        cls.schema = json.loads(printed)
        with tempfile.TemporaryDirectory(prefix="tripoint-results-") as folder:
            words = ["rigid/ballistic", "--engines", "tripoint,bullet,exact", "--timing", "2"]
            done = subprocess.run(
                [TRIPOINT, "validate", *words, "--no-report", "--out", folder],
                capture_output=True,
                text=True,
                timeout=400,
                check=False,
            )
            assert done.returncode == 0, done.stdout + done.stderr
            cls.document = json.loads((Path(folder) / "results.json").read_text())

    def test_results_are_as_the_schema_says(self):
        self.assertEqual(list(faults(self.document, self.schema, "")), [])

    def test_a_fault_is_named(self):
        run = self.document["cases"][0]["engines"][0]["runs"][0]
        for change, where in (
            (lambda: run.update(colour="red"), "colour: not in the schema"),
            (lambda: run["cost"].pop("steps"), "cost.steps: missing"),
            (lambda: run.update(folder=1.0), "folder: 1.0"),
            (lambda: run.update(status="tired"), "status: 'tired'"),
        ):
            kept = json.dumps(run)
            change()
            with self.subTest(where):
                [fault] = faults(self.document, self.schema, "")
                self.assertIn(where, fault)
            run.clear()
            run.update(json.loads(kept))


TYPES = {"string": str, "boolean": bool, "number": (int, float), "array": list, "object": dict, "null": type(None)}


def fits(value, schema):
    if "anyOf" in schema:
        return any(fits(value, one) for one in schema["anyOf"])
    if "enum" in schema:
        return value in schema["enum"]
    return "type" not in schema or isinstance(value, TYPES[schema["type"]])


def faults(value, schema, path):
    """Places of a document that are not as its schema says."""
    if not fits(value, schema):
        yield f"{path}: {value!r}"
        return
    schema = schema.get("anyOf", [schema])[0]
    if isinstance(value, list):
        for inner in value:
            yield from faults(inner, schema["items"], f"{path}[]")
    if not isinstance(value, dict):
        return
    known = schema.get("properties", {})
    yield from (f"{path}.{key}: missing" for key in schema.get("required", []) if key not in value)
    for key, inner in value.items():
        one = known.get(key, schema.get("additionalProperties"))
        if one is None:
            yield f"{path}.{key}: not in the schema"
        else:
            yield from faults(inner, one, f"{path}.{key}")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
