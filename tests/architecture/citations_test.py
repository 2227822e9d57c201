# SPDX-License-Identifier: BSD-3-Clause
"""Citations: how they are read on texts made up here, and that each of the tree leads somewhere: citations_test.py
SOURCE."""

import sys
import unittest
from collections import Counter
from pathlib import Path

from citations import Targets, anchors_of, citations_of, sources_of

ROOT = Path(sys.argv.pop(1)).resolve()


def texts(*folders, endings):
    """(path, text) of the files under these folders; of this folder none, whose texts are made up."""
    for file in sorted(file for folder in folders for file in (ROOT / folder).rglob("*")):
        if file.suffix in endings and file.parent.name != "architecture":
            yield str(file.relative_to(ROOT)), file.read_text()


def targets_in(text, path="src/a.hpp"):
    return [citation.target for citation in citations_of(path, text)]


class Reader(unittest.TestCase):
    def test_equations_come_from_prose_and_not_from_code(self):
        self.assertEqual(targets_in("int a = f(7);  // pressure (7)\n"), ["eq-7"])
        self.assertEqual(targets_in("/// sqrt(6), O(1) and W(0) are no equations\n"), [])
        self.assertEqual(targets_in("/// liquids, (4) and (7)-(9)\n"), ["eq-4", "eq-7", "eq-8", "eq-9"])
        self.assertEqual(targets_in('auto a = "(21) as printed";\n'), ["eq-21"])
        self.assertEqual(targets_in("auto a = R\"x((21))x\"; char b = '\"'; int c = 1'000;  // (7)\n"), ["eq-7"])

    def test_sections_lists_and_ranges(self):
        self.assertEqual(targets_in("/// walls (model 8.4)\n"), ["8-4"])
        self.assertEqual(targets_in("/// (model 2, 8.7)\n"), ["2", "8-7"])
        self.assertEqual(targets_in("/// (model 8.1-8.5)\n"), ["8-1", "8-5"])
        self.assertEqual(targets_in("/// a step (model 7, time)\n"), ["7"])
        self.assertEqual(targets_in("/// pressure (model 8.3), heat (8.6)\n"), ["8-3", "8-6"])
        self.assertEqual(targets_in("/// as the model\n  /// 8.4 says\n"), ["8-4"], "broken between two lines")

    def test_the_numbers_of_a_source_are_its_own(self):
        both = "/// poly6 [Mueller, Charypar, Gross 2003, (20)], kernel of (4)\n"
        self.assertEqual(targets_in(both), ["source Mueller, Charypar, Gross 2003", "eq-4"])
        self.assertEqual(
            targets_in("# [Horn 1987, 4.A], decision 006\n", "adapters/a.py"), ["source Horn 1987", "decision-6"]
        )
        self.assertEqual(targets_in("a[2003] = 1;  // Fig. 5\n"), ["fig-5"])
        self.assertEqual(targets_in('auto a = "slerp (Shoemake 1985), built 29 Sep 2021";\n'), ["source Shoemake 1985"])

    def test_the_line_is_that_of_the_citation(self):
        (found,) = citations_of("src/a.hpp", "int a;\n/// one\n/// two (7)\n")
        self.assertEqual(found.line, 3)

    def test_a_target_that_is_gone_is_not_held(self):
        all_ = Targets(
            anchors_of('<a id="eq-7"></a><a id="8-1-mass"></a>'), {6}, sources_of("| Horn 1987 | B. Horn |\n")
        )
        held = {"eq-7", "8-1", "decision-6", "source Horn 1987"}
        gone = {"eq-8", "8-10", "8", "decision-7", "source Horn 1988"}
        self.assertEqual({target for target in held | gone if all_.hold(target)}, held)


class Tree(unittest.TestCase):
    TARGETS = Targets(
        anchors_of((ROOT / "docs/model.md").read_text()),
        {int(file.name[:3]) for file in (ROOT / "docs/decisions").glob("[0-9]*.md")},
        sources_of((ROOT / "REFERENCES.md").read_text()),
    )

    def lost(self, citations):
        return [
            f"{c.path}:{c.line}: docs/model.md, docs/decisions and REFERENCES.md have no {c.target}"
            for c in citations
            if not self.TARGETS.hold(c.target)
        ]

    def test_every_citation_leads_somewhere(self):
        rooms = ("src", "adapters", "validation", "program", "tests", "reports", "tools")
        found = [c for text in texts(*rooms, endings=(".cpp", ".hpp", ".py")) for c in citations_of(*text)]
        self.assertEqual(self.lost(found), [])
        kinds = Counter(c.target.split()[0].split("-")[0] for c in found)
        self.assertGreater(kinds["eq"], 50)
        self.assertGreater(kinds["8"], 50)
        self.assertGreater(kinds["source"], 15)

    def test_sources_on_pages_and_in_cases_are_in_the_references(self):
        pages = [*texts("docs", endings=(".md",)), *((file.name, file.read_text()) for file in ROOT.glob("*.md"))]
        cases = [(f"{path}.md", text) for path, text in texts("cases", endings=(".toml",))]  # also in its texts
        found = [c for text in pages + cases if text[0] != "REFERENCES.md" for c in citations_of(*text)]
        self.assertEqual(self.lost(c for c in found if c.target.startswith("source")), [])

    def test_every_equation_of_the_paper_is_on_the_page(self):
        self.assertEqual({f"eq-{n}" for n in range(1, 27)} - self.TARGETS.anchors, set())


if __name__ == "__main__":
    unittest.main()
