# SPDX-License-Identifier: BSD-3-Clause
"""What a reader meets in a browser: python3 browser_test.py. Exit 77 where there is no Chromium."""

import shutil
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "reports")]
import make_example
from browser import Browser
from report_test import write_report

SECONDS = 2.0  # of the page's thread, so that others who use the machine do not count
ROWS = (
    "[...document.querySelectorAll('.tabulator-row:not(.tabulator-group)')].map(r => "
    "r.querySelector('a').getAttribute('href'))"
)
HERE_IS = "document.querySelector('.tabulator-row.here a')?.getAttribute('href') ?? ''"
CONTRAST = """[...document.querySelectorAll('.badge, .soft, a, td, th, p, .chip')].filter(e => e.textContent.trim() && \
e.offsetParent && +getComputedStyle(e).opacity === 1).map(e => {
  const light = c => { const [r, g, b] = c.match(/[\\d.]+/g).map(v => { v /= 255; return v <= 0.03928 ? v / 12.92 : \
((v + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  let back = e; while (back.parentElement && /, 0\\)|transparent/.test(getComputedStyle(back).backgroundColor)) back = \
back.parentElement;
  const [a, b] = [light(getComputedStyle(e).color), light(getComputedStyle(back).backgroundColor)];
  return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), e.className + ': ' + e.textContent.trim().slice(0, 40)];
}).filter(([ratio]) => ratio < 4.5).slice(0, 5)"""


class InABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="report ü ")
        out = Path(cls.folder.name, "out")
        done, _ = write_report(make_example.make_example(Path(cls.folder.name, "in")), out)
        assert done.returncode == 0, done.stderr
        cls.front, cls.pages = out / "index.html", sorted(out.rglob("*.html"))
        cls.browser = Browser()
        cls.browser.open(cls.front)  # the first page of a browser waits for the browser

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def test_every_page_opens_from_the_disk_without_complaint_or_network_in_time_and_does_not_scroll_sideways(self):
        one_a_kind = {(path.parent, path.name.rstrip(".html0123456789-")): path for path in self.pages}.values()
        for path in one_a_kind:
            for width in (1400, 390):
                with self.subTest(page=path.name, width=width):
                    self.browser.open(path, width, 844)
                    self.assertEqual(self.browser.complaints(), [])
                    self.assertEqual(self.browser.requests(), [])
                    self.assertLess(self.browser.spent, SECONDS)
                    self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)

    def test_the_verdict_panels_and_questions_fit_one_screen(self):
        self.browser.open(self.front)
        self.assertLess(self.browser.run("document.querySelector('header').getBoundingClientRect().bottom"), 900)

    def open_front(self):
        self.browser.open(self.front)
        self.browser.run(
            "new Promise(done => { const look = () => document.getElementById('tools').hidden || "
            "!document.querySelector('.tabulator-row') ? setTimeout(look, 20) : done(); look(); })"
        )

    def test_search_verdict_and_subject_filter_the_list(self):
        self.open_front()
        every = self.browser.run(ROWS)
        self.assertGreater(len(every), 2)
        found = self.browser.run(
            "(box = document.getElementById('find'), box.value = 'flight', box.dispatchEvent(new Event('input')), "
            + ROWS
            + ")"
        )
        self.assertTrue(0 < len(found) < len(every))
        self.assertTrue(all("flight" in link for link in found), found)
        self.assertEqual(
            self.browser.run(
                "(box.value = 'flight no-such-word', box.dispatchEvent(new Event('input')), " + ROWS + ")"
            ),
            [],
        )
        red = self.browser.run(
            "(box.value = '', verdict = document.getElementById('word'), verdict.value = 'FAIL', "
            "verdict.dispatchEvent(new Event('input')), " + ROWS + ")"
        )
        self.assertTrue(0 < len(red) < len(every))
        self.assertIn("of", self.browser.run("document.getElementById('shown').textContent"))

    def test_a_click_on_a_head_sorts_and_fold_hides_the_rows(self):
        self.open_front()
        click = "document.querySelector('.tabulator-col[tabulator-field=cpu]').click()"
        seconds = (
            "[...document.querySelectorAll('.tabulator-group')].length && "
            "[...document.querySelectorAll('.tabulator-row:not(.tabulator-group) "
            ".tabulator-cell[tabulator-field=cpu]')].map(c => +c.textContent)"
        )
        self.browser.run(click)
        down = self.browser.run("new Promise(done => setTimeout(() => done(" + seconds + "), 200))")
        self.assertEqual(len(down), len(self.browser.run(ROWS)))
        self.browser.run("document.getElementById('fold').click()")
        self.assertEqual(self.browser.run("new Promise(done => setTimeout(() => done(" + ROWS + ".length), 200))"), 0)

    def key(self, key):
        for kind in ("keyDown", "keyUp"):
            self.browser.ask(
                "Input.dispatchKeyEvent",
                type=kind,
                key=key,
                **(
                    {"text": key}
                    if len(key) == 1 and kind == "keyDown"
                    else {"windowsVirtualKeyCode": 13}
                    if key == "Enter"
                    else {}
                ),
            )

    def test_keys_search_walk_and_open(self):
        self.open_front()
        rows = self.browser.run(ROWS)
        self.key("j")
        self.key("j")
        self.assertEqual(self.browser.run(HERE_IS), rows[1])
        self.key("k")
        self.assertEqual(self.browser.run(HERE_IS), rows[0])
        self.key("/")
        self.assertEqual(self.browser.run("document.activeElement.id"), "find")
        self.assertEqual(self.browser.run("document.getElementById('find').value"), "")
        self.key("j")
        self.assertEqual(self.browser.run("document.getElementById('find').value"), "j")
        self.key("Escape")
        self.key("j")
        self.key("Enter")
        self.assertTrue(self.browser.arrives(rows[0]))

    def test_text_can_be_read_in_light_and_in_dark(self):
        for scheme in ("light", "dark"):
            self.browser.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            for path in (self.front, next(path for path in self.pages if path.parent.name == "case")):
                self.browser.open(path)
                with self.subTest(page=path.name, scheme=scheme):
                    self.assertEqual(self.browser.run(CONTRAST), [])
        self.browser.ask("Emulation.setEmulatedMedia", features=[])


if __name__ == "__main__":
    if not shutil.which("chromium"):
        print("skipped: chromium is not installed")
        sys.exit(77)
    unittest.main(verbosity=2)
