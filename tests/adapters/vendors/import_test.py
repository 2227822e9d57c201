# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint import`: what it says where MuJoCo is missing, and, where it is installed, that imported models move as
MuJoCo's own run of the same file does, and that the examples run in four engines."""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

VENDORS = os.environ["TRIPOINT_VENDORS"]
sys.path.insert(0, VENDORS)
PROGRAM = os.environ["TRIPOINT_PROGRAM"]
EXAMPLES = Path(VENDORS).parent.parent / "examples" / "models"

from environments import home  # noqa: E402

PYTHON = home() / "mujoco" / "bin" / "python"
INSTALLED = {name for name in ("mujoco", "ode", "rapier") if (home() / name / f"engine-{name}").exists()}

# Two bodies in free flight, one of them with its centre of mass beside its origin, and a third that hangs on a joint.
FLYING = """<mujoco model="flying"><option timestep="0.002" integrator="RK4" gravity="0.5 0 -9.81"/><worldbody>
<body name="plate" pos="0 0 3" euler="20 30 40"><freejoint/><geom type="box" size="0.2 0.1 0.03"/></body>
<body name="club" pos="2 0 3"><freejoint/><geom type="capsule" size="0.03 0.2"/>
<geom type="sphere" size="0.08" pos="0.05 0 0.25" density="3000"/>
<body name="grip" pos="0 0 -0.3"><geom type="cylinder" size="0.04 0.06" euler="90 0 0"/></body></body>
<body name="door" pos="0 3 0"><joint name="hinge" axis="0 0 1"/><geom type="box" size="0.3 0.05 0.3"/></body>
</worldbody><keyframe>
<key qpos="0 0 3 0.9 0.1 0.3 0.3  2 0 3 1 0 0 0  0" qvel="1 2 3 4 0.5 6  0 0 2 3 4 5  0"/>
</keyframe></mujoco>"""

# An arm with spring and damper, a pole on a cart, a bob on a ball, a body on a universal joint. Nothing touches.
JOINTED = """<mujoco model="jointed"><option timestep="0.001" integrator="RK4"/><default>
<geom contype="0" conaffinity="0"/></default><worldbody>
<body name="upper" pos="0 0 2"><joint name="shoulder" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.04"/>
<body name="lower" pos="0.4 0 0"><joint name="elbow" axis="0 1 0" stiffness="0.5" springref="10" damping="0.02"/>
<geom type="capsule" fromto="0 0 0 0.3 0 0.1" size="0.03"/></body></body>
<body name="cart" pos="0 2 1"><joint name="rail" type="slide" axis="1 0 0"/><geom type="box" size="0.2 0.1 0.1"/>
<body name="pole"><joint name="pivot" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 -0.12 0.05 0 -0.6" size="0.03"/></body></body>
<body name="bob" pos="0 4 2"><joint name="cone" type="ball"/>
<geom type="box" pos="0.3 0 0" size="0.1 0.05 0.08"/></body>
<body name="cross" pos="0 6 2"><joint name="first" axis="1 0 0"/><joint name="second" axis="0 1 0"/>
<geom type="box" pos="0 0.1 -0.3" size="0.05 0.05 0.3"/></body></worldbody></mujoco>"""

OWN_RUN = """
import json, sys
import mujoco
model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
if model.nkey:
    mujoco.mj_resetDataKeyframe(model, data, 0)
steps, frames, rows = int(sys.argv[2]), int(sys.argv[3]), []
for frame in range(frames + 1):
    mujoco.mj_forward(model, data)
    rows.append({model.body(b).name: [*data.subtree_com[b], *data.xquat[b]] for b in range(1, model.nbody)})
    if frame < frames:
        mujoco.mj_step(model, data, steps)
print(json.dumps(rows))
"""


def call(words, folder, **variables):
    return subprocess.run(
        [PROGRAM, *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        env={**os.environ, **variables},
    )


def turned_by(q, start):
    """Angle of the turn that takes `start` to q [rad], and its axis in the world, as a quaternion q start^-1."""
    w, x, y, z = q
    a, b, c, d = start[0], -start[1], -start[2], -start[3]
    return (
        w * a - x * b - y * c - z * d,
        w * b + x * a + y * d - z * c,
        w * c - x * d + y * a + z * b,
        w * d + x * c - y * b + z * a,
    )


class Missing(unittest.TestCase):
    def test_without_mujoco_it_says_which_command_installs_it(self):
        with tempfile.TemporaryDirectory() as folder:
            end = call(["import", str(EXAMPLES / "cube.urdf")], folder, TRIPOINT_ENGINES=folder)
            self.assertEqual(end.returncode, 4, end.stderr)
            self.assertIn("tripoint engine install mujoco", end.stderr)
            self.assertEqual(os.listdir(folder), [])


@unittest.skipUnless("mujoco" in INSTALLED, "MuJoCo is not installed: tripoint engine install mujoco")
class Imported(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = Path(held.name)

    def imported(self, model, *options):
        end = call(["import", str(model), "--out", "case.toml", *options], self.folder)
        self.assertEqual(end.returncode, 0, end.stderr)
        return end.stdout

    def run_in(self, engine):
        """@return frames: name of the body -> place and turn since the start"""
        end = call(["run", "case.toml", "--engine", engine, "--out", f"in-{engine}"], self.folder)
        self.assertIn(end.returncode, (0, 3), f"{engine}: {end.stdout}{end.stderr}")
        files = list((self.folder / f"in-{engine}").rglob("trajectory.csv"))
        if not files:
            return []
        job = json.loads(next((self.folder / f"in-{engine}").rglob("job.json")).read_text(encoding="utf-8"))
        names = {body["index"]: body["name"] for body in job["scene"]["bodies"]}
        frames = {}
        with open(files[0], encoding="ascii") as table:
            for row in csv.DictReader(table):
                state = [float(row[key]) for key in ("x", "y", "z", "qw", "qx", "qy", "qz")]
                frames.setdefault(float(row["time"]), {})[names[int(float(row["body"]))]] = state
        return [frames[at] for at in sorted(frames)]

    def own_run(self, model, steps):
        end = subprocess.run(
            [str(PYTHON), "-c", OWN_RUN, str(model), str(steps), "50"], capture_output=True, text=True, check=True
        )
        return json.loads(end.stdout)

    def compare(self, runs, names, way, angle):
        """@param runs  frames of the case and of MuJoCo's own run
        @param way, angle  most that places [m] and turns [rad] may differ by"""
        ours, own = runs
        self.assertEqual(len(ours), len(own))
        for frame, (a, b) in enumerate(zip(ours, own)):
            for name in names:
                self.assertLess(math.dist(a[name][:3], b[name][:3]), way, f"{name} in frame {frame}")
                since = turned_by(b[name][3:], own[0][name][3:])
                same = min(1.0, abs(sum(p * q for p, q in zip(a[name][3:], since))))
                self.assertLess(2.0 * math.acos(same), angle, f"{name} in frame {frame}")

    def test_bodies_that_fall_and_spin_move_as_in_mujoco(self):
        model = self.folder / "flying.xml"
        model.write_text(FLYING, encoding="utf-8")
        said = self.imported(model)
        self.assertIn("3 free and 0 fixed bodies, 1 joints", said)
        self.assertIn('kind = "hinge"', (self.folder / "case.toml").read_text(encoding="utf-8"))
        # The integrator has other axes of the bodies, and an error of its own below 1e-9
        self.compare((self.run_in("mujoco"), self.own_run(model, 10)), ["plate", "club"], 1e-8, 1e-6)

    def test_boxes_that_slide_with_friction_and_a_ball_that_rolls_move_as_in_mujoco(self):
        model = EXAMPLES / "sliding-boxes.xml"
        self.imported(model)
        runs = self.run_in("mujoco"), self.own_run(model, 10)
        self.compare(runs, ["slow", "fast"], 1e-5, 1e-4)
        self.compare(runs, ["ball"], 1e-4, 1e-3)  # it hops, which lets rounding grow

    def test_bodies_on_joints_move_as_in_mujoco(self):
        model = self.folder / "jointed.xml"
        model.write_text(JOINTED, encoding="utf-8")
        said = self.imported(model)
        self.assertIn("6 free and 0 fixed bodies, 6 joints", said)
        runs = self.run_in("mujoco"), self.own_run(model, 20)
        self.compare(runs, ["lower", "bob", "cross", "pole"], 1e-6, 1e-5)

    def test_joints_that_are_not_kept_are_named(self):
        model = self.folder / "flying.xml"
        model.write_text(FLYING, encoding="utf-8")
        self.assertIn("left out: joint hinge: hinge between door and world", self.imported(model, "--joints", "free"))

    def test_a_locked_joint_holds_what_it_connects(self):
        model = self.folder / "flying.xml"
        model.write_text(FLYING, encoding="utf-8")
        self.assertIn("2 free and 1 fixed bodies", self.imported(model, "--joints", "lock"))

    def test_nothing_that_exists_is_written_over_and_other_files_are_refused(self):
        (self.folder / "case.toml").write_text("mine", encoding="utf-8")
        end = call(["import", str(EXAMPLES / "cube.urdf"), "--out", "case.toml"], self.folder)
        self.assertEqual(end.returncode, 2)
        self.assertEqual((self.folder / "case.toml").read_text(encoding="utf-8"), "mine")
        for text, words in (("<sdf/>", "(SDF)"), ("<mujoco><worldbody><geom size='-1'/>", "MuJoCo's parser says")):
            (self.folder / "other.xml").write_text(text, encoding="utf-8")
            end = call(["import", "other.xml"], self.folder)
            self.assertEqual(end.returncode, 2, end.stderr)
            self.assertIn(words, end.stderr)

    def test_the_examples_run_in_four_engines(self):
        for model in sorted(EXAMPLES.iterdir()):
            self.imported(model, "--end", "0.2", "--joints", "free")  # few engines take joints where bodies touch
            for engine in sorted(INSTALLED | {"bullet"}):
                with self.subTest(f"{model.name} in {engine}"):
                    self.run_in(engine)
            for file in self.folder.iterdir():
                if file.is_file():
                    file.unlink()


if __name__ == "__main__":
    unittest.main()
