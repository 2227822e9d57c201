# SPDX-License-Identifier: BSD-3-Clause
"""From an empty repository to a red merge, by examples/gated-engine/README.md alone: empty_repository_test.py TRIPOINT
SOURCE.

Every line of every block is typed by the shell in an empty folder, block by block. A line must end 0, or as its comment
says ("exit 1"). Commands are counted and timed: a newcomer has fifteen minutes."""

import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
PAGE = SOURCE / "examples" / "gated-engine" / "README.md"
MOST_SECONDS, MOST_COMMANDS = 15 * 60, 27
AUTHOR = {
    f"GIT_{who}_{what}": f"nobody{'' if what == 'NAME' else '@localhost'}"
    for who in ("AUTHOR", "COMMITTER")
    for what in ("NAME", "EMAIL")
}


def lines(page):
    """(number, command, exit code that the page states) of each line that is indented by four spaces."""
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if line.startswith("    ") and line.strip():
            command, _, comment = line.strip().partition("  #")
            stated = re.search(r"\bexit (\d+)\b", comment)
            yield number, command.strip(), int(stated[1]) if stated else 0


class EmptyRepository(unittest.TestCase):
    def test_the_page_leads_to_a_red_merge_and_back(self):
        environment = dict(
            os.environ,
            PATH=f"{TRIPOINT.parent}:{os.environ['PATH']}",
            NO_COLOR="1",
            HOME="/nonexistent",
            TRIPOINT=str(SOURCE),
            **AUTHOR,
        )
        began, count, red = time.monotonic(), 0, 0
        with tempfile.TemporaryDirectory(prefix="tripoint-empty-") as folder:
            for number, command, expected in lines(PAGE):
                at = time.monotonic()
                done = subprocess.run(
                    ["bash", "-c", command],
                    cwd=folder,
                    env=environment,
                    stdin=subprocess.DEVNULL,
                    capture_output=True,
                    text=True,
                    timeout=MOST_SECONDS,
                    check=False,
                )
                print(f"{time.monotonic() - at:6.1f} s  {command}")
                self.assertEqual(
                    done.returncode,
                    expected,
                    f"README.md:{number}: {command}\n{done.stdout[-3000:]}{done.stderr[-2000:]}",
                )
                count += 1
                red += expected in (1, 4)
            self.assertTrue((Path(folder) / "baselines").is_dir())
        spent = time.monotonic() - began
        print(f"{count} commands, {spent:.0f} s")
        self.assertGreaterEqual(red, 4)  # restitution, friction, gyroscopic term, and a limit that was loosened
        self.assertLessEqual(count, MOST_COMMANDS)
        self.assertLess(spent, MOST_SECONDS)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
