# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build into an empty folder, moves it, and builds a project on it: install_test.py BUILD SOURCE"""

import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
ENDBR64 = bytes.fromhex("f30f1efa")  # where a jump may land
PROBE = bytes.fromhex("48830c2400")  # how g++ touches a page of a great frame
CONSUMER = """cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
enable_testing()
find_package(tripoint 0.1 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
add_executable(engine-mine mine/engine-mine.cpp)
target_link_libraries(engine-mine PRIVATE nlohmann_json::nlohmann_json)
tripoint_validate_test(flight ENGINE engine-mine CASES rigid/ballistic)
tripoint_validate_test(too-strict ENGINE engine-mine CASES ${CMAKE_CURRENT_SOURCE_DIR}/strict.toml EXIT_CODE 1)
"""


def run(*words, **more):
    return subprocess.run(
        list(map(str, words)), **({"capture_output": True, "text": True, "timeout": 600} | more), check=False
    )


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint-install-")
        cls.path = Path(cls.folder.name)
        done = run("cmake", "--install", BUILD, "--prefix", cls.path / "first")
        assert done.returncode == 0, done.stdout + done.stderr
        (cls.path / "first").rename(cls.path / "moved here")  # no file may know where it was put
        cls.prefix = cls.path / "moved here"
        cls.program = cls.prefix / "bin" / "tripoint"
        cls.files = {
            path: path.read_bytes() for path in cls.prefix.rglob("*") if path.is_file()
        }  # before anything runs: Python keeps what it compiles

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_no_file_holds_a_path_of_the_machine(self):
        words = [str(path).encode() for path in (SOURCE, BUILD, self.path)]
        self.assertGreater(len(self.files), 300)
        for path, held in self.files.items():
            self.assertFalse(path.is_symlink(), path)
            self.assertFalse("__pycache__" in path.parts, path)
            self.assertFalse(any(word in held for word in words), path)

    def test_every_program_is_hardened(self):
        built = re.search(r"^CMAKE_BUILD_TYPE:STRING=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.M).group(1)
        programs = [path for path, held in self.files.items() if held.startswith(b"\x7fELF")]
        self.assertGreaterEqual(len(programs), 6)  # the program, four engines, a module
        for path in programs:
            told = run("readelf", "--wide", "--file-header", "--segments", "--dynamic", "--dyn-syms", path)
            self.assertEqual(told.returncode, 0, told.stderr)
            wanted = {
                "GNU_RELRO": "its tables can be written to",
                r"\((FLAGS|FLAGS_1)\).*\b(BIND_NOW|NOW)\b": "its table of functions can be written to",
                r"GNU_STACK .* RW +0x": "its stack can be run",
                "__stack_chk_fail": "no guard stands before return addresses",
            }
            if path.suffix != ".so":
                wanted[r"\(FLAGS_1\).*\bPIE\b"] = "it lies at the same address in each run"
            if built in ("Release", "RelWithDebInfo"):
                wanted[r"__\w+_chk@GLIBC"] = "no call of the C library is held to the size of its buffer"
            for words, fault in wanted.items():
                self.assertTrue(re.search(words, told.stdout), f"{path.name}: {fault}")

    @unittest.skipUnless(platform.machine() == "x86_64", "marks and probes are looked for in the code of x86-64")
    def test_every_program_marks_where_a_jump_may_land_and_leaps_over_no_page(self):
        # readelf -n shows the property of a program that is checked; Debian 12's start-up code has none, so that the
        # code itself is looked at.
        for path, held in self.files.items():
            if held.startswith(b"\x7fELF"):
                self.assertGreater(
                    held.count(ENDBR64), 20, f"{path.name}: its functions have no marks (-fcf-protection)"
                )
        compiler = next((BUILD / "CMakeFiles").glob("*/CMakeCXXCompiler.cmake")).read_text()
        if 'COMPILER_ID "GNU"' in compiler:
            engine = (
                self.prefix / "libexec" / "tripoint" / "engine-tripoint"
            )  # what reads checkpoints has a frame of 64 KiB
            self.assertIn(PROBE, self.files[engine], "no great frame is probed (-fstack-clash-protection)")

    def test_every_engine_of_the_build_is_there(self):
        built = {path.name for path in (BUILD / "libexec" / "tripoint").glob("engine-*") if path.is_file()}
        installed = {path.name for path in (self.prefix / "libexec" / "tripoint").iterdir()}
        self.assertEqual(
            installed, built - {"engine-tripoint-mpi"}
        )  # made for the wheel in the checkout, and under a licence of its own
        told = run(self.program, "engines", cwd=self.path)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("bullet", told.stdout)

    def test_it_validates_exports_and_draws_from_any_folder(self):
        done = run(
            self.program,
            "validate",
            "rigid/ballistic",
            "--engines",
            "tripoint,bullet,exact",
            "--out",
            self.path / "report",
            cwd=self.path,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.path / "report" / "index.html").is_file())
        done = run(self.program, "export", self.path / "report", "--csv", "--out", self.path / "tables", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = run(
            self.program,
            "run",
            "contact/mesh-slope",
            "--engine",
            "bullet",
            "--until",
            "0.05",
            "--set",
            "scene.output_interval=0.01",
            "--out",
            self.path / "mesh",
            cwd=self.path,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)  # its module for meshes is found

    def test_a_project_finds_it_and_gates_its_engine(self):
        project = self.path / "consumer"
        project.mkdir()
        done = run(self.program, "engine", "new", "mine", "--lang", "cpp", cwd=project)
        self.assertEqual(done.returncode, 0, done.stderr)
        (project / "CMakeLists.txt").write_text(CONSUMER)
        strict = (SOURCE / "cases" / "rigid" / "ballistic.toml").read_text()
        strict += (
            '\n[[gate]]\nmetric = "position"\nat_least = 1.0\nreason = "an error that nobody has: this test '
            'wants to see a gate close"\n'
        )
        (project / "strict.toml").write_text(strict)
        done = run(
            "cmake",
            "-S",
            project,
            "-B",
            project / "build",
            f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_BUILD_TYPE=Release",
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = run("cmake", "--build", project / "build")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = run(
            "ctest", "--test-dir", project / "build", "--output-on-failure", env=dict(os.environ, HOME=str(self.path))
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("2 tests passed" if "2 tests passed" in done.stdout else "100% tests passed", done.stdout)
        self.assertIn("out of 2", done.stdout)
        shutil.rmtree(project)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
