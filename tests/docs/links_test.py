# SPDX-License-Identifier: BSD-3-Clause
"""Every link of README and docs that stays in the checkout leads to a file, and to a heading or an anchor of it; every
picture is there; every page of the guide is in its list: links_test.py SOURCE [unittest arguments]"""

import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
PAGES = (
    [SOURCE / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "REFERENCES.md", "SECURITY.md")]
    + sorted((SOURCE / "docs").rglob("*.md"))
    + sorted((SOURCE / "examples").rglob("*.md"))
)
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+(?:\([^()]*\))?)\)")


def text_of(page):
    """Without code, in which brackets are no links."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(page):
    """Of headings as GitHub makes them, and <a id>."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    found = set(re.findall(r'<a (?:id|name)="([^"]+)"', text))
    for heading in re.findall(r"^#{1,6} (.+)$", text, re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        slug = re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-")
        number = 0
        while (slug if not number else f"{slug}-{number}") in found:
            number += 1
        found.add(slug if not number else f"{slug}-{number}")
    return found


class Links(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        count = 0
        for page in PAGES:
            for target in LINK.findall(text_of(page)):
                if re.match(r"[a-z]+:", target):
                    continue
                count += 1
                path, _, anchor = target.partition("#")
                file = (page.parent / path).resolve() if path else page
                with self.subTest(str(page.relative_to(SOURCE)), link=target):
                    self.assertTrue(file.exists(), "no such file")
                    self.assertTrue(file.is_relative_to(SOURCE), "leads out of the checkout")
                    if anchor and file.suffix == ".md":
                        self.assertIn(anchor, anchors(file))
        self.assertGreater(count, 150)

    def test_every_page_is_in_the_guide(self):
        listed = set()
        for block in re.findall(r"```\{toctree\}\n(.*?)```", (SOURCE / "docs" / "index.md").read_text(), re.DOTALL):
            for line in block.splitlines():
                if line and not line.startswith(":"):
                    listed |= {
                        str(path.relative_to(SOURCE / "docs"))
                        for path in (SOURCE / "docs").glob(f"{line}.md" if "*" not in line else line)
                        if path.suffix == ".md"
                    }
        pages = {
            str(path.relative_to(SOURCE / "docs"))
            for path in (SOURCE / "docs").rglob("*.md")
            if path.name != "index.md" and "still-water/" not in str(path)
        }
        self.assertEqual(listed, pages)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
