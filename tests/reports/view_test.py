# SPDX-License-Identifier: BSD-3-Clause
"""The page of `tripoint view`: what it holds, and what a reader meets in a browser: python3 view_test.py [TRIPOINT]"""

import base64
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
VIEW = HERE.parents[1] / "reports" / "view.py"
sys.path[:0] = [str(HERE), str(VIEW.parent)]
import view
from browser import Browser

PROGRAM = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else None
FRAMES, TANK, REST = 5, 16, 8
IN_3D = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")  # WebGL without a graphics card


def make_run(folder, frames=FRAMES, times=None, fall=0.0, job=True, many=1, motion="fixed"):
    """A tank that rests, and eight particles above it that fall, warm up and freeze; the last flows in at the end."""
    folder.mkdir(parents=True)
    rows = TANK + REST * many
    position = np.zeros((frames, rows, 3))
    grid = np.array([[x, y, 0.0] for x in range(4) for y in range(4)], float)
    position[:, :TANK] = grid
    for k in range(rows - TANK):
        position[:, TANK + k] = [0.5 + 0.37 * (k % 8), 1.0 + 0.2 * (k % 5), 2.0 + 0.25 * (k % 7)]
    position[:, TANK:, 2] -= np.linspace(0.0, fall, frames)[:, None]
    ids = np.tile(np.arange(rows), (frames, 1))
    ids[:-1, -1] = -1
    position[1:-1, -1] = np.nan  # the first frame says by its id alone that it is not there yet
    phase = np.zeros((frames, rows), int)
    phase[:, :TANK] = 2
    phase[frames // 2 :, TANK] = 2
    body = np.where(np.arange(rows) < TANK, 0, -1) * np.ones((frames, 1), int)
    warm = np.where(np.isfinite(position[..., 0]), 300.0 + 100.0 * position[..., 0], np.nan)
    velocity = np.zeros((frames, rows, 3))
    velocity[:, TANK:] = [0.0, 3.0, -4.0]
    times = np.linspace(0.0, 1.0, frames) if times is None else np.array(times)
    with h5py.File(folder / "trajectory.h5", "w") as file:
        group = file.create_group("particles/all")
        for name, values, unit in (
            ("position", position, "m"),
            ("velocity", velocity, "m s-1"),
            ("temperature", warm, "K"),
            ("id", ids, ""),
            ("phase", phase, ""),
            ("body", body, ""),
            ("material", np.minimum(phase, 1), ""),
        ):
            node = group.create_group(name)
            node.create_dataset("value", data=values).attrs["unit"] = unit
            node.create_dataset("time", data=times)
            node.create_dataset("step", data=np.arange(frames))
        file.create_group("particles/bodies/position").create_dataset("value", data=np.zeros((frames, 1, 3)))
    if job:
        scene = {
            "gravity": [0.0, 0.0, -9.81],
            "mode": "corrected",
            "spacing": 1.0,
            "bodies": [
                {"name": "tank <b>", "index": 0, "motion": motion},
                {"name": "wax", "index": -1, "motion": "free"},
            ],
            "materials": [{"name": "wax"}, {"name": "glass"}],
        }
        (folder / "job.json").write_text(json.dumps({"case": "a/b", "resolution": {"spacing": 1.0}, "scene": scene}))
    return folder


def call(*words, cwd=None):
    command = [str(PROGRAM), "view"] if PROGRAM else [sys.executable, "-B", str(VIEW)]
    return subprocess.run([*command, *map(str, words)], capture_output=True, text=True, timeout=120, cwd=cwd)


class Held:
    """What a page holds, unpacked as its script does it."""

    def __init__(self, page):
        self.html = page.read_text(encoding="utf-8")
        self.told = json.loads(re.search(r'id="told">(.*?)</script>', self.html, re.S)[1])
        self.bytes = base64.b64decode(re.search(r'id="columns">(.*?)</script>', self.html, re.S)[1])

    def column(self, run, at, rows, kind="<u2"):
        return np.frombuffer(self.bytes, kind, rows, at)

    def position(self, run):
        shape = (len(run["times"]), run["particles"], 3)
        parts = self.column(run, run["position"], int(np.prod(shape))).reshape(shape)
        low, high = np.array(run["low"]), np.array(run["high"])
        return np.where(parts == self.told["nothing"], np.nan, low + parts / self.told["steps"] * (high - low))

    def field(self, run, name):
        entry = run["fields"][name]
        frames = 1 if entry["once"] else len(run["times"])
        return self.column(run, entry["at"], frames * run["particles"]).reshape(frames, run["particles"])


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="view ü ")
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def page(self, *runs, words=()):
        done = call(*runs, "--out", self.path / "page.html", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.said = done.stdout
        return Held(self.path / "page.html")


class Data(Folder):
    def test_every_place_is_there_to_a_part_of_the_box_and_what_is_not_alive_is_not(self):
        held = self.page(make_run(self.path / "run", fall=1.5))
        (run,) = held.told["runs"]
        with h5py.File(self.path / "run" / "trajectory.h5") as file:
            truth = file["particles/all/position/value"][()]
            truth[file["particles/all/id/value"][()] < 0] = np.nan
        found = held.position(run)
        self.assertEqual(found.shape, (FRAMES, TANK + REST, 3))
        self.assertTrue((np.isnan(found) == np.isnan(truth)).all())
        size = np.array(run["high"]) - np.array(run["low"])
        self.assertLess(np.nanmax(np.abs(found - truth) / size), 0.51 / held.told["steps"])  # half a part
        self.assertEqual(run["times"], np.linspace(0, 1, FRAMES).tolist())

    def test_fields_ranges_units_and_names_are_those_of_the_run(self):
        held = self.page(make_run(self.path / "run"))
        (run,) = held.told["runs"]
        self.assertEqual(
            held.told["order"], ["phase", "temperature", "speed", "body", "material"]
        )  # no pressure was written
        self.assertEqual(held.told["units"], {"temperature": "K", "speed": "m/s"})
        self.assertAlmostEqual(held.told["spans"]["temperature"][0], 300.0)
        self.assertAlmostEqual(held.told["spans"]["temperature"][1], 609.0)  # of x = 3.09, which flows in at the end
        self.assertEqual(held.told["spans"]["speed"], [0.0, 5.0])  # of (0, 3, -4)
        phase = held.field(run, "phase")
        self.assertEqual(
            [sorted(set(frame.tolist())) for frame in phase], [[0, 1, 3]] * (FRAMES - 1) + [[1, 3]]
        )  # 0: not there; 1: liquid; 3: rigid
        self.assertEqual((phase[:, TANK] - 1).tolist(), [0, 0, 2, 2, 2])
        self.assertEqual(run["labels"]["material"], ["wax", "glass"])
        warm = held.field(run, "temperature")
        self.assertEqual(warm[0, -1], held.told["nothing"])
        self.assertEqual(warm[:, 0].tolist(), [0] * FRAMES)

    def test_walls_are_bodies_that_are_fixed_or_driven_and_up_is_against_gravity(self):
        held = self.page(make_run(self.path / "run"))
        (run,) = held.told["runs"]
        self.assertEqual(held.column(run, run["wall"], TANK + REST, "u1").tolist(), [1] * TANK + [0] * REST)
        self.assertEqual(run["up"], [0.0, 0.0, 1.0])
        for motion, walls in (("prescribed", TANK), ("free", 0)):
            self.assertEqual(self.page(make_run(self.path / motion, motion=motion)).told["runs"][0]["walls"], walls)
        (bare,) = self.page(make_run(self.path / "bare", job=False)).told["runs"]
        self.assertEqual(bare["walls"], 0)
        self.assertGreater(bare["spacing"], 0.1)

    def test_two_runs_share_their_ranges(self):
        held = self.page(
            make_run(self.path / "a", fall=1.0), make_run(self.path / "b", frames=3, times=[0.0, 0.3, 2.0])
        )
        self.assertEqual([len(run["times"]) for run in held.told["runs"]], [FRAMES, 3])
        self.assertEqual(len(held.told["spans"]["temperature"]), 2)
        self.assertIn("5 of 5 frames, 24 of 24 particles", self.said)

    def test_a_large_run_loses_frames_then_particles_and_the_page_says_so(self):
        big = make_run(self.path / "big", frames=40, many=400)
        held = self.page(big, words=["--limit", "1.3"])
        (run,) = held.told["runs"]
        self.assertLess((self.path / "page.html").stat().st_size, 1.3e6)
        self.assertLess(len(run["times"]), 40)
        self.assertEqual((run["times"][0], run["times"][-1]), (0.0, 1.0))
        self.assertLess(run["particles"], TANK + 400 * REST)
        self.assertIn("thinned for the size of this page", held.html)
        self.assertIn(
            f"{len(run['times'])} of 40 frames, {run['particles']} of {TANK + 400 * REST} particles", self.said
        )
        whole = self.page(big, words=["--limit", "20"]).told["runs"][0]
        self.assertEqual((len(whole["times"]), whole["particles"]), (40, TANK + 400 * REST))

    def test_frames_go_before_particles(self):
        self.assertEqual(view.thinned(100, 1000, 2, 1e9), (1, 1))
        frames, particles = view.thinned(100, 1000, 2, 7e5)
        self.assertGreater(frames, 1)
        self.assertEqual(particles, 1)
        self.assertGreater(view.thinned(100, 100_000, 2, 7e5)[1], 1)

    def test_a_page_is_one_file_that_fetches_nothing_and_runs_its_own_script_only(self):
        held = self.page(make_run(self.path / "run"))
        self.assertNotIn('src="', held.html)
        self.assertNotIn("<link", held.html)
        self.assertIn("default-src 'none'", held.html)
        self.assertNotIn("tank <b>", held.html)


class Refusals(Folder):
    def refused(self, code, *words, cwd=None):
        done = call(*words, cwd=cwd)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertNotIn("Traceback", done.stderr)
        return done.stderr

    def test_say_what_is_there_instead(self):
        self.assertIn("there is no such file or folder", self.refused(2, self.path / "none"))
        (self.path / "empty").mkdir()
        self.assertIn(
            "has no trajectory.h5. `tripoint run CASE --out DIR` leaves one", self.refused(2, self.path / "empty")
        )
        (self.path / "empty" / "trajectory.h5").write_text("no HDF5")
        self.assertIn("no readable HDF5", self.refused(2, self.path / "empty"))
        self.assertIn("at most 6", self.refused(2, *[self.path / "none"] * 7))

    def test_a_run_without_frames_or_particles_is_empty(self):
        for name, frames, rows in (("no-frame", 0, 3), ("no-particle", 2, 0)):
            (self.path / name).mkdir()
            with h5py.File(self.path / name / "trajectory.h5", "w") as file:
                for field in ("position", "velocity"):
                    node = file.create_group(f"particles/all/{field}")
                    node.create_dataset("value", data=np.zeros((frames, rows, 3)))
                    node.create_dataset("time", data=np.arange(frames, dtype=float))
                    node.create_dataset("step", data=np.arange(frames))
            self.assertIn("nothing to look at", self.refused(2, self.path / name))

    def test_a_file_without_velocities_is_a_missing_dataset(self):
        (self.path / "half").mkdir()
        with h5py.File(self.path / "half" / "trajectory.h5", "w") as file:
            file["particles/all/position/value"] = np.zeros((1, 1, 3))
        self.assertIn("has no dataset", self.refused(4, self.path / "half"))

    def test_a_run_is_found_by_its_case_and_written_beside_it(self):
        made = make_run(self.path / "runs" / "a" / "b" / "tripoint")
        done = call("a/b", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((made / "view.html").is_file())
        self.assertIn("a/b: tripoint, corrected", (made / "view.html").read_text())


PAINTED = """(() => { const c = document.getElementById('canvas'), copy = document.createElement('canvas'); copy.width \
= c.width; copy.height = c.height; const pen = copy.getContext('2d', { willReadFrequently: true }); pen.drawImage(c, \
0, 0);
  const half = (x) => { const d = pen.getImageData(x, 0, Math.floor(c.width / 2), c.height).data; let n = 0; for (let \
k = 3; k < d.length; k += 4) n += d[k] > 0; return n; }; return [half(0), half(Math.floor(c.width / 2))]; })()"""
SUM = (
    "(() => { const c = document.getElementById('canvas'), copy = document.createElement('canvas'); copy.width = "
    "c.width; copy.height = c.height; const pen = copy.getContext('2d', { willReadFrequently: true }); "
    "pen.drawImage(c, 0, 0); const d = pen.getImageData(0, 0, c.width, c.height).data; let s = 0; for (let k = 0; k < "
    "d.length; ++k) s = (s * 31 + d[k]) % 4294967291; return s; })()"
)
NEXT = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))"


@unittest.skipUnless(shutil.which("chromium"), "chromium is not installed")
class InABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="view ü ")
        path = Path(cls.folder.name)
        done = call(
            make_run(path / "a", fall=1.5),
            make_run(path / "b", frames=3, times=[0.0, 0.3, 0.6]),
            "--out",
            path / "page.html",
        )
        assert done.returncode == 0, done.stderr
        cls.page, cls.browser = path / "page.html", Browser(*IN_3D)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def setUp(self):
        self.browser.open(self.page)
        self.browser.run(NEXT)

    def key(self, key, code, shift=False):
        for kind in ("keyDown", "keyUp"):
            self.browser.ask(
                "Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, modifiers=8 if shift else 0
            )
        self.browser.run(NEXT)

    def frame(self):
        return self.browser.run("document.getElementById('now').textContent")

    def test_both_panels_show_particles_without_complaint_or_network(self):
        for width, scheme in ((1400, "light"), (390, "dark")):
            self.browser.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            self.browser.open(self.page, width, 844)
            self.browser.run(NEXT)
            left, right = self.browser.run(PAINTED)
            self.assertGreater(min(left, right), 500)
            self.assertEqual(
                [words for words in self.browser.complaints() if "GL Driver Message" not in words], []
            )  # the driver speaks of reading pixels, as this test does
            self.assertEqual(self.browser.requests(), [])
            self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)
        self.browser.ask("Emulation.setEmulatedMedia", features=[])

    def test_the_slider_moves_the_particles_and_a_run_that_has_ended_says_so(self):
        before = self.browser.run(SUM)
        self.browser.run(
            "(s => { s.value = s.max; s.dispatchEvent(new Event('input')); })(document.getElementById('time'))"
        )
        self.browser.run(NEXT)
        self.assertNotEqual(self.browser.run(SUM), before)
        self.assertEqual(self.frame(), "t = 1 s, frame 7 of 7")  # 0, 0.25, 0.3, 0.5, 0.6, 0.75, 1
        names = self.browser.run("[...document.querySelectorAll('.name span')].map(e => e.textContent)")
        self.assertEqual(names, ["t = 1 s, 24 particles", "t = 0.6 s, ended, 24 particles"])

    def test_keys_step_turn_zoom_hide_walls_and_colour(self):
        self.key("ArrowRight", 39)
        self.assertEqual(self.frame(), "t = 0.25 s, frame 2 of 7")
        self.key("Home", 36)
        self.assertIn("frame 1 of", self.frame())
        before = self.browser.run(SUM)
        self.key("ArrowRight", 39, shift=True)
        turned = self.browser.run(SUM)
        self.assertNotEqual(turned, before)
        self.key("0", 48)
        self.assertEqual(self.browser.run(SUM), before)
        self.key("w", 87)
        self.assertIn(
            "7 particles", self.browser.run("document.querySelector('.name span').textContent")
        )  # of eight, one has not flowed in
        self.key("w", 87)
        self.key("c", 67)
        self.assertNotEqual(self.browser.run(SUM), before)

    def test_play_walks_to_the_end_and_stops(self):
        self.key(" ", 32)
        self.assertEqual(self.browser.run("document.getElementById('play').textContent"), "Pause")
        self.assertEqual(
            self.browser.run(
                "new Promise(done => { const look = () => document.getElementById('play').textContent === 'Play' ? "
                "done(document.getElementById('time').value) : setTimeout(look, 50); look(); })"
            ),
            "6",
        )

    def test_the_scale_has_numbers_with_a_unit_or_names(self):
        def scale(name):
            self.browser.run(
                f"(s => {{ s.value = '{name}'; s.dispatchEvent(new Event('change')); "
                f"}})(document.getElementById('colour'))"
            )
            return self.browser.run("document.getElementById('scale').innerText").split("\n")

        self.assertEqual(scale("temperature")[0], "temperature [K]")
        self.assertIn("300 454.5 609", " ".join(scale("temperature")))
        self.assertIn("wall", " ".join(scale("phase")))
        self.assertIn("liquid", " ".join(scale("phase")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
