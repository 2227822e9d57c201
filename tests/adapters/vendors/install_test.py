# SPDX-License-Identifier: BSD-3-Clause
"""Installing an engine: what is said and asked, what is refused, what is fetched again. No registry is called here."""

import json
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

ADAPTERS = Path(os.environ["TRIPOINT_VENDORS"])
PROGRAM = os.environ.get("TRIPOINT_PROGRAM", "")
sys.path.insert(0, str(ADAPTERS))

from environments import File, InstallError, catalogue, release  # noqa: E402
from packages import fetched, install_npm, unpack  # noqa: E402

CASES = Path(__file__).resolve().parents[3] / "cases"
ABC = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"  # SHA-256 of "abc"


class Home(unittest.TestCase):
    """Each test has an empty folder of environments."""

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)
        os.environ["TRIPOINT_ENGINES"] = self.scratch.name

    def install(self, *words):
        command = [PROGRAM, "engine", "install", *words]
        return subprocess.run(
            command, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=60, check=False
        )


class Catalogue(Home):
    def test_each_release_is_pinned_and_has_an_adapter(self):
        known = catalogue()
        for name, engine in known["engines"].items():
            self.assertIn(engine["default"], engine["versions"])
            for version in engine["versions"]:
                wanted = release(f"{name}@{version}")
                self.assertTrue(wanted.adapter.is_file(), wanted.adapter)
                self.assertTrue(wanted.files)
                self.assertTrue((CASES / wanted.first).is_dir(), wanted.first)  # a subject of the suite
                for file in wanted.files:
                    self.assertRegex(file.sha256, "^[0-9a-f]{64}$")
                    self.assertGreater(file.size, 0)

    def test_the_launcher_of_each_says_how_to_install_it(self):
        answer = subprocess.run([PROGRAM, "engines", "--json"], capture_output=True, text=True, timeout=60, check=True)
        listed = {e["name"]: e for e in json.loads(answer.stdout)["engines"]}
        for name in catalogue()["engines"]:
            self.assertFalse(listed[name]["available"])
            self.assertIn(f"tripoint engine install {name} ", listed[name]["reason"])


class Asking(Home):
    def test_size_and_licence_are_said_and_without_a_terminal_nothing_is_fetched(self):
        end = self.install("mujoco")
        self.assertEqual(end.returncode, 2)
        for word in ("Apache-2.0", "MB to fetch from PyPI", "on the disk", "--yes"):
            self.assertIn(word, end.stderr)
        self.assertEqual(list(self.folder.glob("mujoco*")), [])

    def test_what_also_comes_from_debian_is_said(self):
        self.assertIn("MB to fetch from PyPI and Debian", self.install("splishsplash").stderr)
        self.assertIn("MB to fetch from Debian,", self.install("ode").stderr)

    def test_an_unknown_name_or_version_is_told_what_there_is(self):
        for words, known in (("mojuco", "mujoco"), ("mujoco@0.1", "4.0.0")):
            end = self.install(words, "--yes")
            self.assertEqual(end.returncode, 2)
            self.assertIn(known, end.stderr)


class Fetching(Home):
    def test_a_file_that_is_whole_is_not_fetched_again_and_a_torn_one_is(self):
        asked = []

        def fetch(file, to):
            asked.append(file.name)
            (to / "a.whl").write_bytes(b"abc")

        file = File("a==1", ABC, 3)
        first = fetched(file, self.folder, fetch)
        self.assertEqual(fetched(file, self.folder, fetch), first)
        first.write_bytes(b"ab")
        fetched(file, self.folder, fetch)
        self.assertEqual(asked, ["a==1", "a==1"])

    def test_other_bytes_than_the_pinned_ones_are_refused(self):
        with self.assertRaises(InstallError) as caught:
            fetched(File("a==1", ABC, 3), self.folder, lambda file, to: (to / "a.whl").write_bytes(b"abd"))
        self.assertEqual(caught.exception.code, 4)
        self.assertIn("hash", str(caught.exception))

    def test_an_archive_is_unpacked_into_its_folder_and_nowhere_else(self):
        for name, good in (("package/dist/a.js", True), ("package/../../a.js", False)):
            archive = self.folder / "a.tgz"
            (self.folder / "content").write_bytes(b"abc")
            with tarfile.open(archive, "w:gz") as out:
                out.add(self.folder / "content", arcname=name)
            if good:
                unpack(archive, self.folder / "to")
                self.assertEqual((self.folder / "to/dist/a.js").read_bytes(), b"abc")
            else:
                self.assertRaises(InstallError, unpack, archive, self.folder / "to")

    def test_a_client_that_is_not_here_is_named(self):
        if_absent = {"PATH": str(self.folder)}
        before, os.environ["PATH"] = os.environ["PATH"], if_absent["PATH"]
        try:
            with self.assertRaises(InstallError) as caught:
                install_npm(
                    type("R", (), {"folder": self.folder, "files": (File("a@1", ABC, 3),)})(), self.folder / "downloads"
                )
        finally:
            os.environ["PATH"] = before
        self.assertIn("npm is not installed", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
