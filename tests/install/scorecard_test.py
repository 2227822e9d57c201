# SPDX-License-Identifier: BSD-3-Clause
"""tools/scorecard.py passes on this checkout, and each of its checks fails where what it asks for is gone.
scorecard_test.py SOURCE"""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
READ = (
    ".github",
    ".ci",
    "tools",
    "examples",
    "tests/fuzz",
    "adapters/vendors",
    "Makefile",
    "Dockerfile",
    "LICENSE",
    "SECURITY.md",
)


def replaced(name, old, new):
    def change(root):
        text = (root / name).read_text()
        assert old in text, f"{name} no longer says {old!r}"
        (root / name).write_text(text.replace(old, new, 1))

    return change


def added(name, content):
    def change(root):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(content)

    return change


def gone(name):
    return lambda root: shutil.rmtree(root / name) if (root / name).is_dir() else (root / name).unlink()


CI, IMAGE, EXAMPLE = (
    ".github/workflows/ci.yml",
    ".github/workflows/image.yml",
    "examples/gated-engine/.github/workflows/accuracy.yml",
)
CHANGES = (
    ("Binary-Artifacts", added("tools/helper", b"\x7fELF\x02\x01\x01\0"), "tools/helper is a program"),
    ("CI-Tests", replaced(CI, ".ci/run", "true"), "no workflow runs the tests"),
    ("CI-Tests", replaced(".ci/run", "make test", "make build"), "runs no tests"),
    (
        "Dangerous-Workflow",
        replaced(CI, "  pull_request:\n", "  pull_request_target:\n"),
        "runs on pull_request_target",
    ),
    (
        "Dangerous-Workflow",
        replaced(CI, "cd tripoint && .ci/run", "echo ${{ github.event.pull_request.title }}; .ci/run"),
        "a script is given the text of others",
    ),
    (
        "Dangerous-Workflow",
        replaced(
            "examples/gated-engine/.github/workflows/accuracy-comment.yml",
            "run: |\n",
            'run: |\n          git checkout "$COMMIT"\n',
        ),
        "checks out code",
    ),
    ("Fuzzing", gone("tests/fuzz/corpus/mesh"), "mesh.cpp has no corpus"),
    ("License", gone("LICENSE"), "LICENSE is not there"),
    ("Packaging", replaced(IMAGE, "docker push", "true"), "no workflow publishes"),
    (
        "Pinned-Dependencies",
        replaced(EXAMPLE, "@bbbca2ddaa5d8feaa63e36b76fdaad77386f024f", "@v7"),
        "is pinned by no commit",
    ),
    ("Pinned-Dependencies", replaced("tools/docs.sh", "--require-hashes", ""), "pip without --require-hashes"),
    ("Pinned-Dependencies", added("tools/more.sh", b"curl -s https://example.org/x | sh\n"), "piped into a shell"),
    ("Pinned-Dependencies", added("tools/requirements-more.txt", b"numpy==2.4.6\n"), "without hash"),
    ("Pinned-Dependencies", gone("adapters/vendors/rapier_f64/Cargo.lock"), "has no Cargo.lock"),
    (
        "Pinned-Dependencies: images",
        replaced("Dockerfile", "ARG DEBIAN=debian:12", "ARG DEBIAN=ubuntu:24.04"),
        "ubuntu:24.04 has no digest",
    ),
    ("SAST", replaced(CI, "asan-ubsan, ", ""), "no workflow runs tools/checks.sh asan-ubsan"),
    ("SAST", replaced("tools/checks.sh", "  tsan)", "  threads)"), "knows no tsan"),
    ("SBOM", gone("tools/sbom.py"), "no tool writes an SPDX document"),
    ("Security-Policy", replaced("SECURITY.md", "Report it privately", "Tell us"), "has no a way to report"),
    ("Signed-Releases", gone("tools/release.sh"), "no script signs a tag"),
    ("Signed-Releases", replaced(IMAGE, "verify-tag", "show"), "does not ask for its signature"),
    ("Token-Permissions", replaced(CI, "contents: read", "contents: write"), "permissions of the whole workflow"),
    (
        "Token-Permissions",
        replaced(
            IMAGE, "    timeout-minutes: 60\n", "    timeout-minutes: 60\n    permissions:\n      packages: write\n"
        ),
        "may write packages",
    ),
)


def scorecard(root):
    done = subprocess.run([SOURCE / "tools/scorecard.py", "--root", root], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class Scorecard(unittest.TestCase):
    def test_this_checkout_fails_in_nothing(self):
        code, said = scorecard(SOURCE)
        self.assertEqual(code, 0, said)

    def test_each_check_sees_what_it_is_there_for(self):
        for name, change, words in CHANGES:
            with self.subTest(check=name, words=words), tempfile.TemporaryDirectory() as folder:
                root = Path(folder)
                for part in READ:
                    (shutil.copytree if (SOURCE / part).is_dir() else shutil.copy2)(SOURCE / part, root / part)
                change(root)
                code, said = scorecard(root)
                self.assertEqual(code, 1, said)
                failed = [line for line in said.splitlines() if line.startswith("FAIL")]
                self.assertTrue(any(name in line and words in line for line in failed), said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
