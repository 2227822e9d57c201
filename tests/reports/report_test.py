# SPDX-License-Identifier: BSD-3-Clause
"""What the page must do, on the example of make_example.py: python3 report_test.py"""

import base64
import contextlib
import hashlib
import html
import html.parser
import io
import json
import re
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
REPORT = HERE.parents[1] / "reports" / "report.py"
sys.path[:0] = [str(HERE), str(REPORT.parent)]
import make_example
import report

VENDOR = {
    "tabulator.min.css": "8a7431ff86fa6aa02943b70470df77fa7094e7eac9f2420b6780c6970c7345eb",
    "tabulator.min.js": "e952272c3b2afa4ebb60cef5db8cbe9cbaabaa52b50c3cd3d22993ca5215a6ff",
    "three.module.min.js": "08fd7545d13d2c7fb65ab691530a802dafefd638596501854f267d0fb13c39e7",
}

# Runs the report with the named libraries made impossible to import, as on a machine without them.
BLOCKED = """
import runpy, sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {names!r}:
            raise ImportError("blocked: " + name)
sys.meta_path.insert(0, Blocker())
sys.path.insert(0, {folder!r})
sys.argv = {argv!r}
runpy.run_path({script!r}, run_name="__main__")
"""


def write_report(results, out, without=()):
    argv = [str(REPORT), str(results), "--out", str(out)]
    command = [sys.executable, "-B", *argv]
    if without:
        command = [
            sys.executable,
            "-B",
            "-c",
            BLOCKED.format(names=set(without), folder=str(REPORT.parent), argv=argv, script=str(REPORT)),
        ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=400, cwd="/")
    page = Path(out, "index.html")
    return done, page.read_text(encoding="utf-8") if page.exists() else ""


def pages_of(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.html"))
    }


class Reader(html.parser.HTMLParser):
    """Visible text, tags, ids and links of a page; complains of tags that are left open."""

    VOID = {"meta", "br", "link", "img", "input", "hr"}

    def __init__(self, page):
        super().__init__()
        self.tags, self.ids, self.links, self.words, self.open = set(), [], [], [], []
        self.feed(page)
        self.text = " ".join(" ".join(self.words).split())

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        values = dict(attributes)
        self.ids += [values["id"]] if "id" in values else []
        self.links += [values[key] for key in ("href", "src", "xlink:href") if values.get(key)]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (
            f"</{tag}> closes <{self.open[-1] if self.open else 'nothing'}> at {self.getpos()}"
        )
        self.open.pop()

    def handle_data(self, data):
        if not self.open or self.open[-1] not in ("style", "script"):
            self.words.append(data)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="report ü ")
        cls.root = Path(cls.folder.name)
        cls.results = make_example.make_example(cls.root / "in")
        cls.data = json.loads(cls.results.read_text())
        cls.done, cls.page = write_report(cls.results, cls.root / "out")
        cls.read = Reader(cls.page)
        cls.pages = pages_of(cls.root / "out")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_a_report_that_says_fail_is_still_written_with_exit_0(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual(self.done.stderr, "")
        self.assertIn("<h1>FAIL</h1>", self.page)

    def test_the_pages_need_no_network_and_no_file_that_is_not_there(self):
        for name, text in self.pages.items():
            for words in ('src="http', 'href="http', "@import", "url(http"):
                self.assertNotIn(words, text, name)
            read = Reader(text)
            self.assertFalse({"link", "iframe", "object"} & read.tags, name)
            for link in read.links:
                if not link.startswith(("#", "data:")):
                    target = (self.root / "out" / name).parent / link.split("#")[0]
                    self.assertTrue(target.is_file(), f"{name}: {link}")

    def test_only_the_scripts_of_the_front_page_may_run(self):
        for name, text in self.pages.items():
            scripts = re.findall(r"<script>(.*?)</script>", text, re.S)
            self.assertEqual(len(scripts), 2 if name == "index.html" else 0, name)
            self.assertEqual(text.count("<script"), len(scripts), name)
            policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]+)"', text)[1].replace("&#39;", "'")
            self.assertTrue(policy.startswith("default-src 'none'"), name)
            allowed = {
                "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts
            }
            self.assertEqual(set(re.findall(r"'(sha256-[^']+)'", policy)), allowed)

    def test_the_libraries_are_those_that_were_looked_at(self):
        """npm's tabulator-tables 6.3.1, dist/js/tabulator.min.js and dist/css/tabulator_simple.min.css; three 0.170.0,
        build/three.module.min.js."""
        vendor = REPORT.parent / "vendor"
        self.assertEqual(
            {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in vendor.iterdir()}, VENDOR
        )

    def test_links_inside_the_pages_lead_somewhere_and_ids_are_single(self):
        for name, text in self.pages.items():
            read = Reader(text)
            self.assertEqual(len(read.ids), len(set(read.ids)), name)
            for link in read.links:
                if link.startswith("#"):
                    self.assertIn(link[1:], read.ids, name)
            for used in re.findall(r"url\(#([^)]+)\)", re.sub(r"<script>.*?</script>", "", text, flags=re.S)):
                self.assertIn(used, read.ids, name)

    def test_every_page_is_small(self):
        for name, text in self.pages.items():
            self.assertLess(len(text.encode()), 1_000_000, name)

    def test_every_tag_is_closed(self):
        for name, text in self.pages.items():
            self.assertEqual(Reader(text).open, [], name)

    def test_every_case_engine_and_gate_appears_with_its_verdict_and_reason(self):
        for case in self.data["cases"]:
            section = self.section(case)
            for key in ("id", "title", "claims", "verdict"):
                self.assertIn(" ".join(case[key].split()), self.read.text)
            for key in ("id", "title", "claims", "repeat", "verdict", "file"):
                self.assertIn(" ".join(case[key].split()), section)
            self.assertIn(case["reference"]["source"], section)
            for engine in case["engines"]:
                self.assertIn(engine["name"], section)
                self.assertIn(engine["status"] if engine["status"] != "ok" else engine["name"], section)
                self.assertIn(engine["reason"], section)
            for gate in (gate for engine in case["engines"] for gate in engine["gates"]):
                for key in ("metric", "reason", "why", "physics"):
                    self.assertIn(gate[key], section)
                self.assertIn("gate: as expected" if gate["verdict"] == "PASS" else f"gate: {gate['verdict']}", section)
            rows = section[section.index("Gates engine") : section.index("Engines engine version")].count(
                "gate: as expected"
            )
            self.assertEqual(
                rows, sum(gate["verdict"] == "PASS" for engine in case["engines"] for gate in engine["gates"])
            )

    def section(self, case):
        return Reader(self.pages[f"case/{case['id'].replace('/', '-')}.html"]).text

    def test_a_case_page_shows_first_its_picture_then_its_gates_then_text(self):
        text = self.pages[f"case/{self.data['cases'][0]['id'].replace('/', '-')}.html"]
        places = [text.index(words) for words in ("<figure", 'id="gates"', ">What is asked", ">Repeat<")]
        self.assertEqual(places, sorted(places))

    def test_a_number_that_was_not_finite_is_said(self):
        spoilt = self.section(self.data["cases"][-1])
        self.assertIn("temperature_l2 not finite", spoilt)
        self.assertRegex(spoilt, r"overshoot paper not finite")

    def test_runs_that_failed_are_listed_with_their_reason(self):
        spoilt = self.section(self.data["cases"][-1])
        self.assertIn("temperature of particle 17 is not finite in stage rates at t = 0.004 s", spoilt)
        self.assertIn("signal 9 after 3.1 s", spoilt)

    def test_third_party_text_is_text(self):
        self.assertNotIn("<script>alert", self.page)
        self.assertIn(
            html.escape(make_example.HOSTILE, quote=False).replace('"', "&#34;").replace("'", "&#39;"), self.page
        )

    def test_no_control_character_of_a_third_party_reaches_a_page_or_a_table(self):
        evil = "\x1b[31m \x07 \x85 \x9b \u202e \u200b \ud800 end"
        data = json.loads(json.dumps(self.data))
        case = data["cases"][0]
        for key in ("title", "claims", "requirement", "repeat"):
            case[key] = evil
        case["tags"], case["problems"] = [evil], [evil]
        for engine in case["engines"]:
            engine["reason"] = engine["version"] = evil
            for gate in engine["gates"]:
                gate["reason"] = gate["why"] = evil
        for metric in case["metrics"]:
            metric["unit"] = evil
        results = self.results.with_name("evil.json")
        results.write_text(json.dumps(data))
        for without in ((), ("jinja2", "matplotlib")):
            done, page = write_report(results, self.root / "evil", without)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("?[31m ?", page)
            for name, text in pages_of(self.root / "evil").items():
                found = re.search("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u200b\u202e\ud800]", text)
                self.assertIsNone(found, f"{name}: {text[max(0, found.start() - 60) : found.end()] if found else ''}")

    def test_a_missing_trajectory_gives_a_note(self):
        self.assertRegex(
            self.section(self.data["cases"][-1]),
            r"tripoint \(paper\): no picture and no curves, \S+trajectory.h5 is missing",
        )

    def test_every_figure_is_also_a_file_and_has_a_text_for_those_who_do_not_see_it(self):
        files = sorted(path.stem for path in (self.root / "out" / "figures").glob("*.svg"))
        text = "".join(text for name, text in self.pages.items() if name.startswith("case/"))
        slugs = [case["id"].replace("/", "-") for case in self.data["cases"]]
        files = [name for name in files if name.startswith(tuple(slugs))]
        self.assertEqual(len(files), text.count("<figure"))
        self.assertEqual(len(files), len(re.findall(r'role="img" aria-label="[^"]{20,}"', text)))
        for kind in ("particles", "profile", "bodies", "convergence", "precision", "time"):
            self.assertTrue(any(kind in name for name in files), kind)

    def two_cases(self, name):
        """A copy with the first and the last case, and its report's folder."""
        results = json.loads(self.results.read_text())
        results["cases"] = [results["cases"][0], results["cases"][-1]]
        return results, self.results.with_name(f"{name}.json"), self.root / name

    def again(self, results, path, out):
        path.write_text(json.dumps(results))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(path), "--out", str(out), "--jobs", "1"]), 0)
        return {path.stem: path.stat().st_mtime_ns for path in (out / "figures").glob("*.svg")}

    def test_a_figure_is_drawn_again_only_where_its_inputs_have_changed_and_a_case_that_is_gone_leaves_no_page(self):
        results, path, out = self.two_cases("twice")
        before = self.again(results, path, out)
        for engine in results["cases"][0]["engines"]:
            for run in engine["runs"]:
                run["state_hash"] += "1"
        after = self.again(results, path, out)
        slug, gone = (case["id"].replace("/", "-") for case in results["cases"])
        drawn = {name for name, at in before.items() if after.get(name) != at}
        self.assertIn(f"{slug}-particles", drawn)
        self.assertNotIn(f"{slug}-convergence", drawn)  # its numbers are the same
        self.assertTrue(before.keys() == after.keys() and any(name.startswith(gone) for name in before))
        self.assertEqual([name for name in drawn if name.startswith(gone)], [])
        (out / "case" / "notes.txt").write_text("of the reader's own")
        results["cases"].pop()
        self.assertEqual([name for name in self.again(results, path, out) if name.startswith(gone)], [])
        self.assertFalse((out / "case" / f"{gone}.html").exists())
        self.assertTrue((out / "case" / "notes.txt").exists())

    def test_the_same_results_give_the_same_figures(self):
        write_report(self.results, self.root / "again")
        for path in (self.root / "out" / "figures").glob("*.svg"):
            self.assertEqual(path.read_bytes(), (self.root / "again" / "figures" / path.name).read_bytes(), path.name)

    def test_without_matplotlib_and_h5py_the_tables_are_there_and_the_packages_are_named(self):
        done, page = write_report(self.results, self.root / "plain", ("matplotlib", "h5py"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("python3-matplotlib", page)
        self.assertIn("python3-h5py", page)
        text = "".join(pages_of(self.root / "plain").values())
        for gate in (gate for case in self.data["cases"] for engine in case["engines"] for gate in engine["gates"]):
            self.assertIn(gate["metric"], text)
        self.assertNotIn("<figure", text)

    def test_without_jinja_there_is_a_plain_page(self):
        done, page = write_report(self.results, self.root / "plainer", ("jinja2", "numpy", "matplotlib", "h5py"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("python3-jinja2", page)
        self.assertIn("FAIL, exit code 1", page)
        self.assertNotIn("<script", page)
        for case in self.data["cases"]:
            self.assertIn(html.escape(case["title"]), page)


class Trouble(unittest.TestCase):
    """Results that are broken: a visible note, never a traceback."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def write(self, document):
        path = self.root / "results.json"
        path.write_text(document if isinstance(document, str) else json.dumps(document))
        errors = io.StringIO()  # in this process: much faster than to load matplotlib anew
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            code = report.main([str(path), "--jobs", "1"])
        found = pages_of(self.root)
        return types.SimpleNamespace(returncode=code, stderr=errors.getvalue()), found.get("index.html", "") + "".join(
            text for name, text in found.items() if name.startswith("case/")
        )

    def test_what_is_not_results_ends_2_and_names_the_file(self):
        for document in ("", "{", "[]", '{"format": 1}', "[" * 100_000):
            done, page = self.write(document)
            self.assertEqual(done.returncode, 2)
            self.assertIn("results.json", done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertEqual(page, "")

    def test_missing_keys_are_noted_and_an_empty_suite_is_no_pass(self):
        done, page = self.write({"cases": []})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the file lists no case", page)
        self.assertNotIn("PASS", Reader(page).text)
        done, page = self.write({"cases": [{}]})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("results.json has no reference for this case", page)
        self.assertIn("No gate: nothing here was judged.", page)

    def test_values_of_the_wrong_kind_do_not_stop_the_report(self):
        for wrong in (None, 7, "text", [], {}, [None], [[]], True, 1e999, "$\\frac{"):
            engine = {key: wrong for key in ("version", "preset", "required", "reason", "order")}
            engine.update(
                name="tripoint",
                status="ok",
                runs=[
                    {
                        "knobs": wrong,
                        "metrics": {"m": wrong},
                        "cost": wrong,
                        "series": wrong,
                        "folder": wrong,
                        "levels": wrong,
                    },
                    {
                        "knobs": {"spacing": wrong},
                        "metrics": {"m": {"value": 1.0, "times": wrong, "series": wrong}},
                        "cost": {"cpu_s": 1.0},
                    },
                    wrong,
                ],
                gates=[
                    {
                        "metric": "m",
                        "band": wrong,
                        "value": wrong,
                        "limit": wrong,
                        "uncertainty": wrong,
                        "verdict": wrong,
                    },
                    {"metric": "m", "value": 2.0, "limit": 1.0, "used": 2.0, "verdict": "fail"},
                    {"metric": "m", "used": wrong, "physics": wrong, "defect": wrong},
                ],
                physics=wrong,
            )
            case = {
                key: wrong
                for key in (
                    "title",
                    "kind",
                    "reference",
                    "equivalence",
                    "ledger",
                    "claims",
                    "metrics",
                    "problems",
                    "physics",
                    "unjudged",
                )
            }
            document = {
                "format": wrong,
                "tool": wrong,
                "verdict": wrong,
                "engines": wrong,
                "not_validated": wrong,
                "problems": wrong,
                "cases": [{**case, "id": "a/b", "engines": [engine]}, {"id": "a/b", "engines": wrong}, wrong],
            }
            done, page = self.write(document)
            self.assertEqual(done.returncode, 0, f"{wrong!r}: {done.stderr}")
            self.assertTrue("200 %" in page, f"{wrong!r}")

    def test_third_party_text_is_text_inside_figures_too(self):
        name, metric = "</text><script>alert(1)</script>", '$x_<img src="http://x">'
        runs = [
            {"knobs": {"spacing": dx}, "metrics": {metric: {"value": dx}}, "cost": {"cpu_s": 1 / dx}}
            for dx in (0.1, 0.05)
        ]
        order = {"metric": metric, "axis": "spacing", "value": 1.0, "low": 0.9, "high": 1.1, "class": name}
        gate = {"metric": metric, "value": 0.05, "limit": 0.06, "verdict": "pass", "reason": name, "file": name}
        done, page = self.write(
            {
                "cases": [
                    {
                        "id": name,
                        "engines": [{"name": name, "status": "ok", "runs": runs, "order": [order], "gates": [gate]}],
                    }
                ]
            }
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreaterEqual(page.count("<figure"), 2)
        self.assertNotIn("<img", page)
        self.assertNotIn("<script>alert", page)
        self.assertNotIn("could not be drawn", page)
        self.assertNotIn('src="http', page)

    def test_a_torn_trajectory_and_a_folder_outside_are_noted(self):
        (self.root / "runs").mkdir()
        (self.root / "runs" / "trajectory.h5").write_bytes(b"\x89HDF\r\n\x1a\n torn")
        runs = [
            {"knobs": {"mode": mode}, "folder": folder, "metrics": {}}
            for mode, folder in (("paper", "runs"), ("corrected", "../.."))
        ]
        done, page = self.write(
            {"cases": [{"id": "x", "engines": [{"name": "tripoint", "status": "ok", "runs": runs}]}]}
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("runs/trajectory.h5 cannot be read", page)
        self.assertIn("lies outside the report", page)


if __name__ == "__main__":
    unittest.main(verbosity=2)
