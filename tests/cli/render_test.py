# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and meshes of a run: render_test.py TRIPOINT [unittest arguments]."""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import h5py
import numpy as np

TRIPOINT = Path(sys.argv[1]).resolve()
SMALL = ("--size", "80x60", "--threads", "2")


def call(*words, **more):
    return subprocess.run([TRIPOINT, *map(str, words)], capture_output=True, text=True, timeout=300, **more)


def pixels(file):
    """(height, width, 3) of an 8-bit RGB PNG without interlace."""
    data, at, body = Path(file).read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        chunk = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", chunk)
            assert (depth, colour, interlace) == (8, 2, 0)
        body += chunk if kind == b"IDAT" else b""
        at += 12 + length
    raw = np.frombuffer(zlib.decompress(body), np.uint8).reshape(height, 3 * width + 1)
    out = np.zeros((height, 3 * width), np.int64)
    for y in range(height):
        above = out[y - 1] if y else np.zeros(3 * width, np.int64)
        filtered, line = raw[y, 1:].astype(np.int64), out[y]
        for x in range(3 * width):
            left, up, corner = (line[x - 3] if x > 2 else 0), above[x], (above[x - 3] if x > 2 else 0)
            near = min(
                (abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner)
            )[2]
            line[x] = (filtered[x] + (0, left, up, (left + up) // 2, near)[raw[y, 0]]) % 256
    return out.reshape(height, width, 3)


def ply(file):
    """(corners, triangles)"""
    head, _, body = Path(file).read_bytes().partition(b"end_header\n")
    corners, triangles = (
        int(next(line for line in head.decode().splitlines() if line.startswith(f"element {what}")).split()[-1])
        for what in ("vertex", "face")
    )
    corner = np.dtype([("place", "<f8", 3), ("temperature", "<f4"), ("phase", "<i4"), ("body", "<i4"), ("part", "<i4")])
    face = np.dtype([("n", "u1"), ("corner", "<i4", 3)])
    return np.frombuffer(body, corner, corners), np.frombuffer(body, face, triangles, corners * corner.itemsize)


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint render ü ")
        cls.path = Path(cls.folder.name)
        for case, until in (("paper/fig-08-elastic", 0.04), ("heat/step-insulated", None), ("paper/fig-12", 0.04)):
            done = call("run", case, "--quiet", *(("--until", until) if until else ()), cwd=cls.path)
            assert done.returncode == 0, done.stderr
        cls.run_folder = cls.path / "runs/paper/fig-08-elastic/tripoint"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def draw(self, *words, run="paper/fig-08-elastic", code=0, out="out", **more):
        done = call(
            "render",
            run,
            "--out",
            self.path / out,
            *(() if "--size" in words else SMALL),
            *words,
            cwd=self.path,
            **more,
        )
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_a_frame_shows_two_blocks_on_their_ground(self):
        done = self.draw("--frames", -1, "--colour", "body")
        file = done.stdout.split("  t =")[0]
        picture = pixels(file)
        self.assertEqual(picture.shape, (60, 80, 3))
        saturated = (picture.max(2) - picture.min(2)) > 60
        self.assertGreater(saturated.sum(), 200)  # blocks
        red, green = (
            (picture[..., 0] > picture[..., 1] + 40) & saturated,
            (picture[..., 1] > picture[..., 0] + 40) & saturated,
        )
        self.assertGreater(min(red.sum(), green.sum()), 60)
        self.assertLess(
            np.argwhere(green)[:, 0].mean(), np.argwhere(red)[:, 0].mean()
        )  # the upper block is above: up is against gravity

    def test_frames_make_a_sheet_and_say_their_times(self):
        done = self.draw("--frames", "0:-1:1", "--particles", out="frames")
        self.assertIn("t = 0.04 s", done.stdout)
        self.assertEqual(
            pixels(self.path / "frames/sheet.png").shape, (60, 248, 3)
        )  # three of 80 x 60 in a row, 4 pixels between
        self.assertTrue((self.path / "frames/frame-0002.png").is_file())

    def test_without_ffmpeg_it_says_so_and_with_it_makes_a_film(self):
        tools = self.path / "tools"
        tools.mkdir(exist_ok=True)
        done = self.draw("--frames", "0:1", "--particles", env=dict(os.environ, PATH=str(tools)))
        self.assertIn("ffmpeg is not installed", done.stderr)
        real = shutil.which("ffmpeg")
        script = tools / "ffmpeg"
        script.write_text(
            f'#!/bin/sh\nexec {real} "$@"\n'
            if real
            else '#!/bin/sh\nfor last; do :; done\n[ -f film.txt ] && /bin/cp film.txt "$last"\n'
        )
        script.chmod(0o755)
        done = self.draw("--frames", "0:1", "--particles", env=dict(os.environ, PATH=f"{tools}"))
        self.assertIn("film.mp4", done.stdout, done.stderr)
        self.assertGreater((self.path / "out/film.mp4").stat().st_size, 0)

    def test_walls_that_hide_the_rest_are_cut_away(self):
        blue = {}
        for walls in ("cut", "show", "hide"):
            picture = pixels(
                self.draw(
                    "--frames",
                    0,
                    "--colour",
                    "phase",
                    "--walls",
                    walls,
                    "--azimuth",
                    35,
                    "--elevation",
                    10,
                    run="paper/fig-12",
                ).stdout.split("  t =")[0]
            )
            blue[walls] = int(((picture[..., 2] > picture[..., 0] + 60) & (picture.max(2) > 60)).sum())
        self.assertGreater(blue["cut"], 3 * blue["show"] + 100)  # the tank hides most of the cream
        self.assertGreater(blue["hide"], blue["cut"])  # and takes room in the picture

    def test_threads_change_no_bit(self):
        files = []
        for threads in (1, 2):
            call(
                "render",
                "paper/fig-08-elastic",
                "--frames",
                1,
                "--out",
                self.path / f"t{threads}",
                "--size",
                "80x60",
                "--threads",
                threads,
                cwd=self.path,
            )
            files.append((self.path / f"t{threads}/frame-0001.png").read_bytes())
        self.assertEqual(*files)

    def test_the_mesh_is_closed_and_has_the_volume_of_its_particles(self):
        done = self.draw("--frames", 0, "--mesh", self.path / "blocks.ply")
        corners, triangles = ply(self.path / "blocks.ply")
        self.assertEqual(sorted(set(corners["body"])), [1, 2])
        self.assertEqual(done.stdout.count("closed"), 2)
        self.assertIn("1 piece, volume", done.stdout)
        for part, exact in ((0, 0.08 * 0.08 * 0.03), (1, 0.04 * 0.04 * 0.04)):
            of = triangles["corner"][corners["part"][triangles["corner"][:, 0]] == part]
            a, b, c = (corners["place"][of[:, n]] for n in range(3))
            volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
            share = volume / exact
            self.assertTrue(
                0.8 < share < 0.92, share
            )  # edges are rounded: 0.896 of a slab of 8 x 8 x 3 spacings, 0.828 of a cube of 4
            edges = np.sort(of[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
            self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())

    def test_temperatures_are_on_the_mesh_and_in_the_colours(self):
        run = next(iter((self.path / "runs/heat/step-insulated").iterdir()))
        with h5py.File(run / "trajectory.h5") as file:
            T = file["particles/all/temperature/value"][()]
        done = self.draw("--frames", 0, "--mesh", self.path / "bar.ply", run=run, out="bar")
        corners, _ = ply(self.path / "bar.ply")
        self.assertGreaterEqual(corners["temperature"].min(), T.min() - 1e-3)
        self.assertLessEqual(corners["temperature"].max(), T.max() + 1e-3)
        self.assertGreater(np.ptp(corners["temperature"]), 0.5 * np.ptp(T[0]))
        self.assertIn(f"{T[0].min():.6g} K dark", done.stderr)

    def test_obj_is_a_mesh_that_a_case_may_use(self):
        self.draw("--frames", 0, "--mesh", self.path / "blocks.obj")
        case = Path(self.path) / "mesh.toml"
        case.write_text(f"""format = 1
[case]
title = "A mesh of a run"
claims = "it is read"
kind = "verification"
[scene]
end_time = 0.01
spacing = 0.005
[[material]]
name = "rubber"
density = 1000.0
young_modulus = 5e4
poisson_ratio = 0.3
[[body]]
name = "blocks"
material = "rubber"
phase = "elastic"
shape = {{ kind = "mesh", file = "{self.path}/blocks.obj", scale = 1.0 }}
[reference]
kind = "invariant"
[[metric]]
name = "ledger"
quantity = "ledger.residual"
norm = "max"
scale = 1.0
[[gate]]
metric = "ledger"
limit = 1.0
reason = "it is read"
""")
        done = call("check", case)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_folder_without_a_job_is_drawn_too(self):
        bare = self.path / "bare"
        bare.mkdir()
        shutil.copy(self.run_folder / "trajectory.h5", bare)
        self.draw("--frames", 0, run=bare, out="bare-pictures")

    def test_mistakes_are_told_what_to_write(self):
        for words, said in (
            (("--frames", 99), "frames 0 to 2"),
            (("--frames", "0:1:1:1"), "FIRST:LAST"),
            (("--frames", "2:1:1"), "behind the last"),
            (("--frames", "a:b"), "FIRST:LAST"),
            (("--size", "640"), "WIDTHxHEIGHT"),
            (("--size", "9x9"), "16x16"),
            (("--mesh", "a.stl"), ".ply"),
            (("--colour", "temperature"), "no temperatures"),
            (("--range", "5"), "COLD:HOT"),
            (("--particles", "--surface"), "give one"),
        ):
            with self.subTest(" ".join(map(str, words))):
                done = self.draw(*words, code=2)
                self.assertIn(said, done.stderr)
                self.assertEqual(done.stdout, "")

    def test_a_run_that_is_not_there_is_told_where_runs_are(self):
        self.assertIn("tripoint run", self.draw(run="no/such", code=2).stderr)
        self.assertIn("fig-08-elastic", self.draw(run=self.path / "runs", code=2).stderr)
        torn = self.path / "torn"
        torn.mkdir()
        (torn / "trajectory.h5").write_bytes(b"no HDF5")
        self.assertIn("trajectory.h5", self.draw(run=torn, code=2).stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
