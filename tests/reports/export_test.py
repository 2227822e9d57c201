# SPDX-License-Identifier: BSD-3-Clause
"""tripoint export, from real runs: export_test.py TRIPOINT SOURCE [unittest arguments]. Foreign readers are in
.venv-readers of the checkout, or in TRIPOINT_READERS."""

import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
READERS = Path(os.environ.get("TRIPOINT_READERS") or SOURCE / ".venv-readers") / "bin" / "python"
OF_RUNS = "vtp,xdmf,h5md,lammps,xyz,ply,obj,csv,paraview"
RUNS = {
    "melt": ["phase/melt-rigid", "--until", "0.06"],
    "liquid": ["fluid/taylor-green", "--until", "0.004", "--set", "scene.output_interval=0.001"],
    "split": ["phase/split-by-melting"],
}


def call(*words, **more):
    return subprocess.run(
        [TRIPOINT, *map(str, words)], **({"capture_output": True, "text": True, "timeout": 300} | more), check=False
    )


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint export ü ")
        cls.path = Path(cls.folder.name)
        for name, words in RUNS.items():
            done = call("run", *words, "--quiet", "--out", cls.path / name)
            assert done.returncode == 0, done.stdout + done.stderr
        done = call(
            "validate",
            "rigid/ballistic",
            "--engines",
            "tripoint,bullet,exact",
            "--no-report",
            "--out",
            cls.path / "report",
        )
        assert done.returncode == 0, done.stdout + done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def refused(self, code, sentence, *words, **more):
        done = call("export", *words, **more)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertRegex(done.stderr, sentence)
        self.assertNotIn("Traceback", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_no_code_is_loaded_that_a_file_names(self):
        plugins = TRIPOINT.parent.parent / "tests" / "foreign-filter"
        folder = self.path / "filtered"
        shutil.copytree(self.path / "split", folder)
        within = os.environ | {"HDF5_PLUGIN_PATH": str(plugins)}
        again = (
            "import sys, h5py; f = h5py.File(sys.argv[1], 'r+'); g = f['particles/all/position']; x = g['value'][()]; "
            "del g['value']; "
            "g.create_dataset('value', data=x, chunks=x.shape, compression=300, allow_unknown_filter=True)"
        )
        subprocess.run([sys.executable, "-c", again, folder / "trajectory.h5"], env=within, check=True)
        read = subprocess.run(
            [
                sys.executable,
                "-c",
                "import sys, h5py; h5py.File(sys.argv[1])['particles/all/position/value'][()]",
                folder / "trajectory.h5",
            ],
            env=within,
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(read.returncode, 0, "the filter is there: " + read.stderr)
        done = call("export", folder, "--to", "vtp", env=within)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertIn("filter plugins disabled", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_foreign_readers_see_the_same_numbers(self):
        if not READERS.exists():
            self.skipTest("no foreign readers: tools/setup.sh readers installs them into .venv-readers")
        for name in RUNS:
            with self.subTest(name):
                done = call("export", self.path / name, "--to", OF_RUNS)
                self.assertEqual(done.returncode, 0, done.stderr)
                read = subprocess.run(
                    [
                        READERS,
                        "-B",
                        Path(__file__).with_name("foreign_readers.py"),
                        self.path / name,
                        self.path / name / "export",
                    ],
                    capture_output=True,
                    text=True,
                    timeout=300,
                    check=False,
                )
                self.assertEqual(read.returncode, 0, read.stderr[-3000:])
                self.assertIn("numbers are equal", read.stdout)
                print(name, read.stdout.strip())

    def test_frames_are_chosen(self):
        with h5py.File(self.path / "melt" / "trajectory.h5") as file:
            count = len(file["particles/all/position/time"])
        for words, wanted in (("last", [count - 1]), ("1", [1]), ("0:5:2", [0, 2, 4]), ("-2:", [count - 2, count - 1])):
            out = self.path / f"frames {words.replace(':', '-')}"
            self.assertEqual(call("export", self.path / "melt", "--ply", "--out", out, "--frames", words).returncode, 0)
            self.assertEqual(sorted(int(path.stem) for path in (out / "ply").iterdir()), wanted)
        self.refused(2, f"frames 0 to {count - 1}", self.path / "melt", "--to", "ply", "--frames", "999")

    def test_dead_rows_are_left_out(self):
        run = self.path / "dead"
        shutil.copytree(self.path / "melt", run, ignore=shutil.ignore_patterns("export"))
        with h5py.File(run / "trajectory.h5", "r+", locking=False) as file:
            particles = file["particles/all"]
            for name in particles:
                if "value" in particles[name]:
                    values = particles[name]["value"]
                    values[1, 3] = np.nan if values.dtype.kind == "f" else -1
            count = particles["id/value"].shape[1]
        self.assertEqual(call("export", run, "--to", "xyz", "--frames", "0:2").returncode, 0)
        heads = [int(line) for line in (run / "export" / "particles.xyz").read_text().splitlines() if line.isdigit()]
        self.assertEqual(heads, [count, count - 1])

    def test_the_script_for_paraview_is_python_and_names_what_is_there(self):
        self.assertEqual(
            call("export", self.path / "melt", "--to", "paraview", "--out", self.path / "pv").returncode, 0
        )
        script = (self.path / "pv" / "view.py").read_text()
        compile(script, "view.py", "exec")
        self.assertIn("'temperature'", script)
        self.assertTrue((self.path / "pv" / "frames.pvd").exists())
        up = json.loads(re.search(r"CameraViewUp = (\[.*\])", script)[1])
        gravity = json.loads((self.path / "melt" / "job.json").read_text())["scene"]["gravity"]
        self.assertTrue(np.dot(up, gravity) < 0 or not any(gravity))

    def test_a_report_gives_tables_and_figures(self):
        out = self.path / "paper"
        done = call("export", self.path / "report", "--to", "csv,latex,pdf", "--out", out, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            {Path(name) for name in json.loads(done.stdout)["files"]},
            {path for path in out.rglob("*") if path.is_file()},
        )
        results = json.loads((self.path / "report" / "results.json").read_text())
        engines = [(case["id"], engine) for case in results["cases"] for engine in case["engines"]]
        gates = [(case, engine["name"], gate) for case, engine in engines for gate in engine["gates"]]
        self.holds_gates(out / "gates.csv", gates)
        metrics = sum(len(run["metrics"]) for _, engine in engines for run in engine["runs"])
        with open(out / "metrics.csv", encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), metrics)
        self.is_latex(out / "gates.tex", len(gates))
        figures = list((out / "figures").glob("*.pdf"))
        self.assertGreaterEqual(len(figures), 2)
        for figure in figures:
            data = figure.read_bytes()
            width = float(re.search(rb"/MediaBox \[ 0 0 ([\d.]+)", data)[1]) / 72 * 25.4
            self.assertTrue(abs(width - 170) < 1 or abs(width - 84) < 1, f"{figure}: {width} mm")
            self.assertIn(b"/Subtype /Type0", data.replace(b"/Subtype/Type0", b"/Subtype /Type0"), "text stays text")

    def holds_gates(self, path, gates):
        with open(path, encoding="utf-8") as file:
            table = list(csv.DictReader(file))
        self.assertEqual(len(table), len(gates))
        for row, (case, engine, gate) in zip(table, gates):
            self.assertEqual(
                (row["case"], row["engine"], row["metric"], row["verdict"]),
                (case, engine, gate["metric"], gate["verdict"]),
            )
            self.assertEqual(float(row["value"]), gate["value"])
            self.assertEqual(row["limit"], "" if gate["limit"] is None else repr(gate["limit"]))

    def is_latex(self, path, gates):
        latex = path.read_text()
        lines = [line for line in latex.splitlines() if line.endswith(r"\\") and "&" in line]
        self.assertEqual(len(lines), gates + 1)
        self.assertEqual({len(re.findall(r"(?<!\\)&", line)) for line in lines}, {6})
        self.assertEqual(latex.count("{"), latex.count("}"))
        self.assertFalse(re.search(r"(?<!\\)[_#]", latex.replace("\\label{tab:", "")))

    def test_what_cannot_be_is_a_sentence(self):
        self.refused(2, "there is no such file", self.path / "nowhere", "--to", "vtp")
        self.refused(2, "did you mean vtp", self.path / "melt", "--to", "vtpp")
        self.refused(2, "name a format", self.path / "melt")
        self.refused(2, "exported from a results.json", self.path / "melt", "--to", "latex")
        self.refused(2, "exported from a run's folder", self.path / "report", "--to", "vtp")
        self.refused(2, "has no trajectory.h5", self.path, "--to", "vtp")
        (self.path / "taken").write_text("a file")
        self.refused(2, "folder cannot be made", self.path / "melt", "--to", "vtp", "--out", self.path / "taken" / "in")
        (self.path / "torn").mkdir(exist_ok=True)
        (self.path / "torn" / "trajectory.h5").write_bytes((self.path / "melt" / "trajectory.h5").read_bytes()[:3000])
        self.refused(2, "no readable HDF5", self.path / "torn", "--to", "vtp")

    def test_a_dataset_that_is_missing_is_named(self):
        run = self.path / "lacking"
        run.mkdir()
        shutil.copy(self.path / "melt" / "trajectory.h5", run)
        with h5py.File(run / "trajectory.h5", "r+", locking=False) as file:
            del file["particles/all/velocity/value"]
        self.refused(4, "has no dataset /particles/all/velocity/value", run, "--to", "xyz")
        self.assertFalse((run / "export").exists())

    def test_a_full_disk_is_said_and_leaves_no_half_file(self):
        for name in OF_RUNS.split(","):
            with self.subTest(name):
                out = self.path / f"full {name}"
                limited = [
                    "bash",
                    "-c",
                    'ulimit -f 1; trap "" XFSZ; exec "$@"',
                    "-",
                    TRIPOINT,
                    "export",
                    self.path / "melt",
                    "--to",
                    name,
                    "--out",
                    out,
                ]
                done = subprocess.run(limited, capture_output=True, text=True, timeout=120, check=False)
                self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
                self.assertNotIn("Traceback", done.stderr)
                left = (
                    [path for path in out.rglob("*") if path.is_file() and path.stat().st_size >= 1024]
                    if out.exists()
                    else []
                )
                self.assertEqual([path for path in left if path.name.endswith(".part")], [])

    def test_ctrl_c_ends_with_130(self):
        out = self.path / "stopped"
        program = subprocess.Popen(
            [TRIPOINT, "export", self.path / "liquid", "--to", OF_RUNS, "--out", out],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        until = time.monotonic() + 60
        while not (out / "frames" / "00000.vtp").exists() and time.monotonic() < until:  # the first of many files
            time.sleep(0.001)
        program.send_signal(signal.SIGINT)
        _, said = program.communicate(timeout=60)
        self.assertEqual(program.returncode, 130, said)
        self.assertNotIn("Traceback", said)
        self.assertIn("interrupted", said)
        self.assertTrue((out / "frames" / "00000.vtp").exists())
        self.assertFalse((out / "particles.xyz").exists())
        self.assertEqual(list(out.rglob("*.part")), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
