# SPDX-License-Identifier: BSD-3-Clause
"""The bill of materials names all that a build holds, loads and fetches: sbom_test.py BUILD SOURCE"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])


class Materials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint-sbom-")
        out = Path(cls.folder.name) / "bill.json"
        subprocess.run(
            [SOURCE / "tools" / "sbom.py", BUILD, "--out", out], check=True, stdout=subprocess.DEVNULL
        )  # why it failed is shown
        cls.bill = json.loads(out.read_text(encoding="utf-8"))
        cls.named = {(row["name"], row["versionInfo"]) for row in cls.bill["packages"]}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_identifiers_are_unique_and_every_package_has_a_relation(self):
        identifiers = [row["SPDXID"] for row in self.bill["packages"]]
        self.assertEqual(len(identifiers), len(set(identifiers)))
        self.assertGreater(len(identifiers), 50)
        ends = {end for r in self.bill["relationships"] for end in (r["spdxElementId"], r["relatedSpdxElement"])}
        self.assertEqual(ends, {*identifiers, "SPDXRef-DOCUMENT"})
        for identifier in identifiers:
            self.assertRegex(identifier, r"^SPDXRef-[A-Za-z0-9.-]+$")

    def test_every_pin_is_there_with_its_hash(self):
        sums = {row["name"]: {c["checksumValue"] for c in row.get("checksums", [])} for row in self.bill["packages"]}
        pins = 0
        for file in (SOURCE / "tools").glob("requirements-*.txt"):
            for name, version in re.findall(
                r"^([A-Za-z0-9_.-]+)(?:\[[^\]]*\])?==(\S+)", file.read_text(encoding="utf-8"), re.M
            ):
                self.assertIn((name.lower(), version), self.named)
                self.assertTrue(sums[name.lower()], name)
                pins += 1
        self.assertGreater(pins, 20)

    def test_what_the_programs_load_and_what_they_hold_is_there(self):
        names = {name for name, _ in self.named}
        self.assertLessEqual(
            {
                "libc6",
                "libhdf5-103-1",
                "libgomp1",
                "libeigen3-dev",
                "tabulator-tables",
                "three",
                "mujoco",
                "rapier3d-f64",
            },
            names,
        )

    def test_a_vendored_file_that_nobody_names_is_an_error(self):
        copy = Path(self.folder.name) / "copy"
        for part in ("tools", "reports/vendor", "adapters/vendors"):
            shutil.copytree(SOURCE / part, copy / part)
        (copy / "reports" / "vendor" / "stranger.js").write_text("//\n")
        said = subprocess.run(
            [copy / "tools" / "sbom.py", BUILD, "--out", copy / "bill.json"],
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertNotEqual(said.returncode, 0)
        self.assertIn("stranger.js", said.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
