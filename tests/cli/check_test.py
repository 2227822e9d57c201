# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint check` finds before a run what the run would be refused or spoilt by, and scenes that once ran wrong in
silence run right: check_test.py TRIPOINT [unittest arguments]."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT = sys.argv[1]
BALL = '[[material]]\nname = "gum"\ndensity = 1000.0\nyoung_modulus = 1e6\npoisson_ratio = 0.3\n'
SUM = '[model]\npressure = "conservative"\n'  # liquid that sums its density
STONE = '[[material]]\nname = "stone"\ndensity = 1000.0\n'
WARM = STONE + "conductivity = 1.0\nheat_capacity = 1000.0\n"
INVARIANT = '[reference]\nkind = "invariant"\n'
LEDGER = '[[metric]]\nname = "ledger"\nquantity = "ledger.residual"\nnorm = "drift"\n'
ICE = (
    '[[material]]\nname = "frost"\ndensity = 1000.0\nconductivity = 2.0\nheat_capacity = 1000.0\nt_melt = '
    '273.0\nlatent_heat = 1e5\nsolid = "rigid"\n'
)


def scene(keys):
    return f"format = 1\n[scene]\nspacing = 0.1\n{keys}\n"


def body(name, material, low, high, more=""):
    return (
        f'[[body]]\nname = "{name}"\nmaterial = "{material}"\nshape = {{ kind = "box", min = {low}, max = {high} '
        f"}}\n{more}\n"
    )


def metric(quantity, norm="max", more=""):
    return f'[[metric]]\nname = "m"\nquantity = "{quantity}"\nnorm = "{norm}"\n{more}\n'


CUBE = body("cube", "stone", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4], "velocity = [1.0, 0.0, 0.0]")
FLIGHT = scene("end_time = 1.0") + STONE + CUBE + '[reference]\nfunction = "ballistic"\n' + metric("velocity")
GATE = '[[gate]]\nmetric = "m"\nlimit = 1e-3\nreason = "for this test"\n'
BAR = (
    ICE
    + body("bar", "frost", [0.0, 0.0, 0.0], [0.8, 0.4, 0.4], 'phase = "rigid"\nmotion = "fixed"\ntemperature = 272.0')
    + body(
        "plate",
        "frost",
        [-0.4, 0.0, 0.0],
        [0.0, 0.4, 0.4],
        'phase = "rigid"\nmotion = "fixed"\ntemperature = 300.0\ntemperature_held = true',
    )
)
# a text of another program -> words of the answer
FOREIGN = {
    '<?xml version="1.0"?>\n<!-- a scene -->\n<mujoco model="x"><worldbody/></mujoco>': ["(MJCF)", "tripoint import"],
    '<robot name="x"><link name="base"/></robot>': ["(URDF)", "tripoint import"],
    '<?xml version="1.0" ?>\n<sdf version="1.9"><world name="x"/></sdf>': ["(SDF)"],
    '<?xml version="1.0"?>\n<case app="x">\n<casedef><constantsdef/></casedef></case>': ["DualSPHysics"],
    '{ "Configuration": { "particleRadius": 0.025 }, "FluidBlocks": [] }': ["SPlisHSPlasH"],
    '{ "RigidBodies": [ { "geometryFile": "box.obj" } ] }': ["SPlisHSPlasH"],
    "# a melt\nunits lj\natom_style atomic\npair_style lj/cut 2.5\nrun 100\n": ["LAMMPS"],
    "dimension 3\nunits si\nlattice fcc 0.8442\nregion box block 0 10 0 10 0 10\n": ["LAMMPS"],
}
# what is wrong -> (case, words of the error that check must give)
WRONG = {
    "a periodic width too small for bonds": (
        scene('end_time = 0.1\nmin = [0.0, 0.0, 0.0]\nmax = [0.4, 2.0, 2.0]\nperiodic = ["x"]')
        + BALL
        + body("bar", "gum", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4]),
        ["0.4", "wide", "bonds"],
    ),
    "a reference argument of the wrong type": (
        scene("end_time = 0.1")
        + STONE
        + CUBE
        + metric("overlap", more='reference = { kind = "bound", function = "stated", args = { value = "zero" } }'),
        ["`value`", "must be a number"],
    ),
    "an unknown argument": (
        scene("end_time = 0.1")
        + STONE
        + CUBE
        + metric("overlap", more='reference = { kind = "bound", function = "stated", args = { valu = 0.0 } }'),
        ["no argument `valu`"],
    ),
    "a bar that is too short": (
        scene("end_time = 1e7") + BAR + '[reference]\nfunction = "stefan"\n' + metric("front_position"),
        ["the bar is 0.8", "it must be", "m or longer"],
    ),
    "a ratio at a start that is 0": (
        scene("end_time = 1.0") + BAR + '[reference]\nfunction = "stefan"\n' + metric("front_ratio"),
        ["the front has not started"],
    ),
    "a norm that is none": (
        scene("end_time = 0.1") + STONE + CUBE + metric("velocity", "larges"),
        ["is none of: L1", "larges"],
    ),
    "a quantity that is none": (
        scene("end_time = 0.1") + STONE + CUBE + metric("velocty"),
        ["no quantity", "`velocity`"],
    ),
    "a time that is no output time": (
        scene("end_time = 1.0\noutput_interval = 0.1")
        + STONE
        + CUBE
        + '[reference]\nfunction = "ballistic"\n'
        + metric("velocity", "Linf", 'at = "0.123"'),
        ["no output time"],
    ),
    "a window between output times": (
        scene("end_time = 1.0\noutput_interval = 0.5")
        + STONE
        + CUBE
        + LEDGER
        + metric("velocity", "max", "window = [0.1, 0.2]")
        + '[reference]\nfunction = "ballistic"\n',
        ["no output time lies"],
    ),
    "a reference that does not fit": (
        scene("end_time = 1.0") + STONE + CUBE + '[reference]\nfunction = "couette"\n' + metric("velocity"),
        ["liquid"],
    ),
    "a step above a bound": (
        scene("end_time = 10.0\ntime_step = 1.0\ngravity = [0.0, 0.0, -9.81]")
        + STONE.replace("1000.0", "1000.0\nviscosity = 1.0")
        + body("pool", "stone", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4]),
        ["bound of", "[engines.tripoint] settings = { force_time_step = true }"],
    ),
    "a setting that nobody reads": (
        scene("end_time = 1.0") + STONE + CUBE + "[engines.tripoint]\nsettings = { force_time_stp = true }\n",
        ["no setting is named force_time_stp", "force_time_step"],
    ),
    "a step that needs a sound without end": (
        scene("end_time = 1.0")
        + STONE.replace("1000.0", "1000.0\nstiffness = 1e30\nviscosity = 1.0")
        + body("pool", "stone", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4]),
        ["steps"],
    ),
    "a liquid that is joined": (
        scene("end_time = 1.0\ngravity = [0.0, 0.0, -9.81]")
        + BALL
        + '[[material]]\nname = "oil"\ndensity = 900.0\nviscosity = 1.0\n'
        + body("pool", "oil", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4])
        + body("bar", "gum", [0.4, 0.0, 0.0], [0.8, 0.4, 0.4], 'joined_to = ["pool"]'),
        ["pool", "liquid"],
    ),
}


def call(verb, text, folder, *more):
    case = Path(folder) / "case.toml"
    case.write_text(text)
    return subprocess.run([TRIPOINT, verb, str(case), *map(str, more)], capture_output=True, text=True, timeout=300)


class Check(unittest.TestCase):
    def test_a_friction_of_0_is_what_contact_of_ours_does(self):
        for friction, code in ((0.0, 0), (0.3, 4)):
            with tempfile.TemporaryDirectory() as folder:
                text = (
                    scene("end_time = 0.1") + STONE + CUBE + f"[engines.all]\nsettings = {{ friction = {friction} }}\n"
                )
                done = call("run", text, folder, "--out", Path(folder) / "out")
                self.assertEqual(done.returncode, code, done.stderr)

    def test_it_finds_what_a_run_or_its_judgement_would_stop_at(self):
        for name, (text, words) in WRONG.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = call("check", text, folder)
                self.assertEqual(done.returncode, 2, f"{name}: {done.stdout}{done.stderr}")
                for word in words:
                    self.assertIn(word, done.stderr, name)
                self.assertIn("case.toml", done.stderr, name)

    def test_it_finds_nothing_in_what_is_right(self):
        with tempfile.TemporaryDirectory() as folder:
            done = call("check", FLIGHT + GATE, folder)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual([line for line in done.stderr.splitlines() if not line.startswith("note: ")], [])

    def test_it_says_that_nothing_judges_a_case(self):
        of_nothing = scene("end_time = 1.0") + STONE + CUBE
        # what is said where nothing judges it; a case that is judged without a gate of its own is told nothing
        for name, text, words in (
            ("a metric", FLIGHT, 'a [[gate]] with metric = "m"'),
            ("nothing", of_nothing, "a [[metric]], and a [[gate]]"),
            ("it diverges", FLIGHT + '[case]\nexpect = "diverges"\n', None),
            ("a gate", FLIGHT + GATE, None),
        ):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = call("check", text, folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stderr.count("no gate judges this case"), 0 if words is None else 1, done.stderr)
                self.assertIn(words or "", done.stderr)

    def test_it_says_that_still_liquid_on_a_lattice_will_stir(self):
        tank = body("floor", "stone", [0.0, 0.0, -0.3], [0.6, 0.6, 0.0], 'motion = "fixed"')
        domain = (
            'end_time = 0.1\nmin = [0.0, 0.0, -0.5]\nmax = [0.6, 0.6, 2.0]\nperiodic = ["x", "y"]\ngravity = '
            "[0.0, 0.0, -9.81]\n"
        )
        thin, thick = ('[[material]]\nname = "oil"\ndensity = 900.0\nviscosity = ' + mu for mu in ("1e-3\n", "50.0\n"))
        pool, stream = (
            body("pool", "oil", [0.0, 0.0, 0.0], [0.6, 0.6, 0.6], how) for how in ("", "velocity = [1.0, 0.0, 0.0]")
        )
        block = body("block", "stone", [0.0, 0.0, 1.0], [0.4, 0.4, 1.4])
        told = {
            "still": (True, scene(domain) + SUM + thin + STONE + pool + tank),
            "under its weight": (False, scene(domain) + thin + STONE + pool + tank),
            "settled": (False, scene(domain + "settle = true") + SUM + thin + STONE + pool + tank),
            "held back": (False, scene(domain) + SUM + thick + STONE + pool + tank),
            "moves": (False, scene(domain) + SUM + thin + STONE + stream + tank),
            "with a free block": (False, scene(domain) + SUM + thin + STONE + pool + tank + block),
            "weightless": (
                False,
                scene(domain.replace("-9.81", "0.0")) + thin + "stiffness = 200.0\n" + STONE + pool + tank,
            ),
            "along a channel": (
                False,
                scene(domain.replace("[0.0, 0.0, -9.81]", "[9.81, 0.0, 0.0]")) + thin + STONE + pool + tank,
            ),
        }
        for name, (wanted, text) in told.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = call("check", text, folder)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(
                    "some 0.07 m/s rms" in done.stderr and "scene.settle = true" in done.stderr, wanted, done.stderr
                )
                self.assertEqual("lattice" in done.stderr, wanted, done.stderr)

    def test_it_knows_the_entries_of_the_ledger(self):
        known = ("bulk_viscous", "transport", "kinetic", "time_integration", "residual", "fracture")
        for entry, warned in [*((entry, False) for entry in known), ("frictoin", True)]:
            with self.subTest(entry), tempfile.TemporaryDirectory() as folder:
                done = call(
                    "check",
                    scene("end_time = 1.0") + STONE + CUBE + INVARIANT + metric(f"ledger.{entry}", "drift"),
                    folder,
                )
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(f'the ledger has no term "{entry}"' in done.stderr, warned, done.stderr)

    def test_it_leaves_nothing_behind(self):
        with tempfile.TemporaryDirectory() as folder:
            before = {p.name for p in Path(tempfile.gettempdir()).glob("tripoint-check-*")}
            call("check", scene("end_time = 1.0") + STONE + CUBE, folder)
            self.assertEqual([p.name for p in Path(folder).iterdir()], ["case.toml"])
            self.assertLessEqual({p.name for p in Path(tempfile.gettempdir()).glob("tripoint-check-*")}, before)


class Explain(unittest.TestCase):
    def idle(self, text, folder):
        """Keys of the scene that change nothing, and why, by `explain`."""
        decisions = json.loads(call("explain", text, folder, "--json").stdout)["decisions"]
        return {d["key"]: d["changes_nothing"] for d in decisions if "changes_nothing" in d}

    def test_it_says_which_defaults_change_nothing_and_why(self):
        bar = body("bar", "gum", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4])
        pool = body("pool", "stone", [2.0, 0.0, 0.0], [2.4, 0.4, 0.4], 'phase = "liquid"')
        falls = "end_time = 0.1\ngravity = [0.0, 0.0, -9.81]"
        warm = 'temperature = 300.0\nmotion = "fixed"'
        frozen = body("frozen", "frost", [5.0, 0.0, 0.0], [5.4, 0.4, 0.4], warm.replace("300", "250"))
        hot = body("hot", "frost", [5.4, 0.0, 0.0], [5.8, 0.4, 0.4], warm + '\nphase = "liquid"')
        heat = "conductivity = 1.0\nheat_capacity = 1000.0\n"
        wet = pool.replace("phase", "temperature = 300.0\nphase")
        with tempfile.TemporaryDirectory() as folder:
            alone = self.idle(scene(falls) + BALL + bar + INVARIANT + LEDGER, folder)
            water = self.idle(scene(falls) + SUM + STONE + pool + INVARIANT + LEDGER, folder)
            ice = self.idle(scene(falls) + SUM + STONE + heat + ICE + wet + frozen + hot + INVARIANT + LEDGER, folder)
        self.assertNotIn("model.elasticity", alone)
        self.assertIn("model.bulk_viscosity", alone)
        self.assertEqual(water["model.elasticity"], "nothing is elastic")
        self.assertNotIn("model.bulk_viscosity", water)
        self.assertIn("melts or freezes", ice["model.bulk_viscosity"])


class Run(unittest.TestCase):
    def run_case(self, text, folder, *more):
        done = call("run", text, folder, "--out", Path(folder) / "out", "--json", *more)
        return done, json.loads(done.stdout) if done.stdout.startswith("{") else None

    def test_files_of_other_programs_are_answered_by_a_sentence(self):
        with tempfile.TemporaryDirectory() as folder:
            for text, words in FOREIGN.items():
                path = Path(folder) / "scene.xml"
                path.write_text(text, encoding="utf-8")
                for command in ("check", "explain", "run"):
                    done = subprocess.run([TRIPOINT, command, path], capture_output=True, text=True, cwd=folder)
                    self.assertEqual(done.returncode, 2, done.stderr)
                    for word in ["scene.xml", *words]:
                        self.assertIn(word, done.stderr, command)

    def test_says_what_check_would_warn_of(self):
        wall = body("wall", "stone", [-0.36, 0.0, 0.0], [0.0, 0.4, 0.4], 'motion = "fixed"')
        oil = '[[material]]\nname = "oil"\ndensity = 900.0\nviscosity = 50.0\n'
        with tempfile.TemporaryDirectory() as folder:
            done, _ = self.run_case(
                scene("end_time = 0.001\ngravity = [0.0, 0.0, -9.81]")
                + oil
                + STONE
                + body("pool", "oil", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4])
                + wall,
                folder,
            )
            self.assertEqual(done.returncode, 0)
            self.assertIn("0.6 of a spacing", done.stderr)

    def test_a_block_on_a_slope_slides_and_does_not_sink(self):
        slope = body("slope", "stone", [-0.4, -0.3, -0.3], [2.0, 0.7, 0.0], 'motion = "fixed"')
        stated = 'reference = { kind = "bound", function = "stated", args = { value = 0.0 } }'
        with tempfile.TemporaryDirectory() as folder:
            _, told = self.run_case(
                scene("end_time = 0.6\ngravity = [3.3552, 0.0, -9.2184]")
                + STONE
                + body("block", "stone", [0.0, 0.0, 0.0], [0.4, 0.4, 0.2])
                + slope
                + INVARIANT
                + metric("overlap", more=stated)
                + LEDGER,
                folder,
            )
            self.assertEqual(told["status"], "ok")
            self.assertLess(told["metrics"]["m"]["value"], 0.2)

    def test_a_failed_reference_spoils_no_metric_that_needs_none(self):
        with tempfile.TemporaryDirectory() as folder:
            _, told = self.run_case(
                scene("end_time = 0.1")
                + STONE
                + CUBE
                + '[reference]\nfunction = "couette"\n'
                + metric("velocity")
                + LEDGER,
                folder,
            )
            self.assertIsNone(told["metrics"]["m"]["value"])
            self.assertEqual(told["metrics"]["ledger"]["value"], 0.0)

    def test_bodies_that_have_not_touched_yet_are_not_frozen(self):
        hot = body("hot", "stone", [0.0, 0.0, 1.0], [0.4, 0.4, 1.4], "temperature = 400.0")
        floor = body("floor", "stone", [-0.4, -0.4, -0.3], [0.8, 0.8, 0.0], 'motion = "fixed"\ntemperature = 300.0')
        with tempfile.TemporaryDirectory() as folder:
            done, told = self.run_case(
                scene("end_time = 0.2\ngravity = [0.0, 0.0, -9.81]") + WARM + hot + floor + INVARIANT + LEDGER, folder
            )
            self.assertEqual((done.returncode, told["status"]), (0, "ok"), told)

    def test_one_frame_a_turn_is_not_frozen(self):
        rod = body("rod", "stone", [-0.5, -0.1, -0.1], [0.5, 0.1, 0.1], "angular_velocity = [0.0, 0.0, 10.0]")
        with tempfile.TemporaryDirectory() as folder:
            done, told = self.run_case(
                scene("end_time = 3.141592653589793\noutput_interval = 0.6283185307179586\ntime_step = 0.005")
                + STONE
                + rod
                + '[reference]\nfunction = "torque_free"\n'
                + metric("shape"),
                folder,
                "--engine",
                "exact",
            )
            self.assertEqual((done.returncode, told["status"]), (0, "ok"), told)

    def test_matter_that_leaks_from_its_scene_is_named(self):
        drop = '[[material]]\nname = "oil"\ndensity = 900.0\nviscosity = 1.0\n' + body(
            "pool", "oil", [0.0, 0.0, 0.0], [0.4, 0.4, 0.4]
        )
        below = body("wall", "stone", [0.0, 0.0, -0.4], [0.4, 0.4, 0.0], 'motion = "fixed"')  # the liquid runs off it
        beside = body("wall", "stone", [2.0, 0.0, -1.0], [2.4, 0.4, 1.0], 'motion = "fixed"')  # it falls freely
        falls = "end_time = 3.0\ngravity = [0.0, 0.0, -9.81]\n"
        with tempfile.TemporaryDirectory() as folder:
            done, told = self.run_case(scene(falls) + STONE + drop + below + INVARIANT + LEDGER, folder)
            self.assertEqual(done.returncode, 7, told)
            self.assertIn("made from the scene: give scene.min", told["reason"])
            unguarded = scene(falls + 'unguarded = ["escape"]')
            for text in (unguarded + STONE + drop + below, scene(falls) + STONE + drop + beside):
                done, told = self.run_case(text + INVARIANT + LEDGER, folder)
                self.assertEqual(done.returncode, 0, told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
