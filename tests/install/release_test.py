# SPDX-License-Identifier: BSD-3-Clause
"""tools/release.sh signs only what is whole, by a key that the checkout names; tools/debian_snapshot.sh turns a Debian
image's sources to its date.   release_test.py SOURCE"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
# As Debian's image writes it, but for the names of the hosts.
SOURCES = """Types: deb
# http://old.example/archive/debian/20250520T000000Z
URIs: http://new.example/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg

Types: deb
# http://old.example/archive/debian-security/20250520T000000Z
URIs: http://new.example/debian-security
Suites: bookworm-security
Components: main
"""


@unittest.skipUnless(shutil.which("ssh-keygen"), "no ssh-keygen here")
class Release(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name) / "checkout"
        (self.folder / "tools").mkdir(parents=True)
        (self.folder / ".github").mkdir()
        shutil.copy(SOURCE / "tools/release.sh", self.folder / "tools/release.sh")
        self.write("CMakeLists.txt", "project(tripoint VERSION 0.2.0 LANGUAGES CXX)\n")
        self.write("CITATION.cff", "version: 0.2.0\n")
        self.write("CHANGELOG.md", "# Changelog\n\n## [0.2.0] - 2026-01-31\n")
        self.keys = {}
        for name in ("ours", "stranger"):
            self.keys[name] = Path(place.name) / name
            subprocess.run(
                ["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-C", name, "-f", self.keys[name]], check=True
            )
        self.write(".github/allowed_signers", "maintainer@example.org " + Path(f"{self.keys['ours']}.pub").read_text())
        self.git("init", "--quiet", "--initial-branch", "main")
        self.commit()

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def git(self, *words):
        return subprocess.run(
            ["git", "-C", self.folder, "-c", "user.name=t", "-c", "user.email=t@example.org", *words],
            capture_output=True,
            text=True,
            check=True,
        ).stdout

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "all")

    def release(self, key="ours", version="0.2.0"):
        environment = {
            **os.environ,
            "GIT_CONFIG_GLOBAL": "/dev/null",
            "GIT_COMMITTER_NAME": "t",
            "GIT_COMMITTER_EMAIL": "t@example.org",
            "GIT_CONFIG_COUNT": "1",
            "GIT_CONFIG_KEY_0": "user.signingkey",
            "GIT_CONFIG_VALUE_0": str(self.keys[key]),
        }
        return subprocess.run(
            [self.folder / "tools/release.sh", version], capture_output=True, text=True, check=False, env=environment
        )

    def refused(self, done, words):
        self.assertNotEqual(done.returncode, 0, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(self.git("tag", "--list"), "")

    def test_what_is_whole_is_signed_and_anybody_can_verify_it(self):
        done = self.release()
        self.assertEqual(done.returncode, 0, done.stderr)
        verify = [
            "-c",
            "gpg.format=ssh",
            "-c",
            "gpg.ssh.allowedSignersFile=.github/allowed_signers",
            "verify-tag",
            "v0.2.0",
        ]
        self.git(*verify)
        self.git("tag", "--force", "--annotate", "--message", "forged", "v0.2.0")
        with self.assertRaises(subprocess.CalledProcessError):
            self.git(*verify)

    def test_another_key_leaves_no_tag(self):
        self.refused(self.release(key="stranger"), "the tag is removed")

    def test_a_version_that_a_file_does_not_say_is_refused(self):
        self.refused(self.release(version="0.3.0"), "CMakeLists.txt says another version")
        for name, text in (("CITATION.cff", "version: 0.1.0\n"), ("CHANGELOG.md", "## [Unreleased]\n")):
            kept = (self.folder / name).read_text()
            self.write(name, text)
            self.commit()
            self.refused(self.release(), name)
            self.write(name, kept)
            self.commit()

    def test_changes_and_missing_signers_are_refused(self):
        self.write("CITATION.cff", "version: 0.2.0\n# more\n")
        self.refused(self.release(), "not committed")
        self.git("rm", "--quiet", ".github/allowed_signers")
        self.commit()
        self.refused(self.release(), "nobody could verify")


class Snapshot(unittest.TestCase):
    def turned(self, text):
        with tempfile.NamedTemporaryFile("w+", suffix=".sources") as file:
            file.write(text)
            file.flush()
            done = subprocess.run(
                [SOURCE / "tools/debian_snapshot.sh", file.name], capture_output=True, text=True, check=False
            )
            return done, Path(file.name).read_text()

    def test_every_place_becomes_that_of_the_date(self):
        done, text = self.turned(SOURCES)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("new.example", text)
        self.assertEqual(
            [line for line in text.splitlines() if line.startswith("URIs")],
            [
                "URIs: http://old.example/archive/debian/20250520T000000Z",
                "URIs: http://old.example/archive/debian-security/20250520T000000Z",
            ],
        )
        self.assertEqual(text.count("Check-Valid-Until: no"), 2)
        self.assertEqual(text.count("Suites:"), 2)

    def test_a_file_without_a_date_is_left_alone(self):
        text = SOURCES.replace("# http", "# see http").replace("Z\n", "\n")
        done, after = self.turned(text)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(after, text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
