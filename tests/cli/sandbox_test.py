# SPDX-License-Identifier: BSD-3-Clause
"""A third-party engine under --sandbox: it answers as it does outside, and reaches neither the network, nor the user's
files, nor a token, nor another run."""

import ctypes
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT = sys.argv[1]

# What a hostile engine tries as it runs; each line of tried.txt is a deed that worked.
DEEDS = """
import glob, os, socket, subprocess
def tried(what, deed):
    try:
        deed()
    except OSError:
        return
    with open("tried.txt", "a") as file:
        file.write(what + "\\n")
def write(path):
    with open(path, "w") as file:
        file.write("x")
def connect():
    socket.create_connection(("127.0.0.1", PORT), timeout=2.0).close()
def token():
    os.environ["SOME_TOKEN"] if "SOME_TOKEN" in os.environ else os.stat("/no/such/file")
def token_of_a_process():
    for file in glob.glob("/proc/[0-9]*/environ") + glob.glob("/proc/[0-9]*/cmdline"):
        try:
            if b"SOME_TOKEN" in open(file, "rb").read():
                return
        except OSError:
            pass
    os.stat("/no/such/file")
if sys.argv[1] == "--run":
    tried("write outside", lambda: write("OUTSIDE/written"))
    tried("read outside", lambda: open("OUTSIDE/secret").close())
    tried("network", connect)
    tried("token", token)
    tried("token of a process", token_of_a_process)
    tried("password file", lambda: open("/etc/passwd").close())
    tried("other runs", lambda: os.stat("../../../ballistic/exact"))
    tried("another process", lambda: os.stat("/proc/PARENT"))
    subprocess.Popen(["/bin/sleep", "300"], start_new_session=True)
"""


def namespaces_are_allowed():
    words = [
        "/usr/bin/bwrap",
        "--unshare-all",
        "--unshare-user",
        "--ro-bind",
        "/usr",
        "/usr",
        "--symlink",
        "usr/lib",
        "/lib",
        "--symlink",
        "usr/lib64",
        "/lib64",
        "/usr/bin/true",
    ]
    return os.path.exists(words[0]) and subprocess.run(words, capture_output=True, check=False).returncode == 0


def one_folder_can_be_shown():
    """Landlock, without which nothing of a third party is read under --sandbox. 444: landlock_create_ruleset, asked for
    its version."""
    return ctypes.CDLL(None, use_errno=True).syscall(444, None, ctypes.c_size_t(0), ctypes.c_uint(1)) > 0


QUIETLY = ["--no-report", "--no-history"]


class Sandbox(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.folder = Path(self.place.name).resolve()
        (self.folder / "secret").write_text("mine")
        subprocess.run(
            [TRIPOINT, "engine", "new", "mine", "--lang", "python"], cwd=self.folder, check=True, capture_output=True
        )
        self.engine = next((self.folder / "mine").glob("engine-*"))

    def tearDown(self):
        self.place.cleanup()

    def judged(self):
        """The command that judges our engine in a flight; what follows it says by the side of whom, and where."""
        return [TRIPOINT, "validate", "rigid/ballistic", "--engine", self.engine]

    def run_in(self, command, **more):
        return subprocess.run(
            command, **{"cwd": self.folder, "capture_output": True, "text": True, "check": False, **more}
        )

    def validate(self, *words):
        done = self.run_in(
            [*self.judged(), "--engines", "mine,exact", "--out", self.folder / "out", *QUIETLY, *words],
            env={**os.environ, "SOME_TOKEN": "secret"},
        )
        return done, json.loads((self.folder / "out/results.json").read_text()) if (
            self.folder / "out/results.json"
        ).exists() else None

    def errors(self, results):
        runs = [run for engine in results["cases"][0]["engines"] if engine["name"] == "mine" for run in engine["runs"]]
        self.assertTrue(runs and all(run["status"] == "ok" for run in runs), runs)
        return [run["metrics"] for run in runs]

    def insert(self, deeds):
        """Has the engine do this before anything else."""
        lines = self.engine.read_text().split("\n")
        at = next(n for n, line in enumerate(lines) if line.startswith("import "))
        self.engine.write_text("\n".join(lines[:at] + ["import sys"] + deeds.split("\n") + lines[at:]))

    def make_hostile(self):
        import socket

        self.door = socket.socket()
        self.door.bind(("127.0.0.1", 0))
        self.door.listen(8)
        self.addCleanup(self.door.close)
        deeds = (
            DEEDS.replace("PORT", str(self.door.getsockname()[1]))
            .replace("OUTSIDE", str(self.folder))
            .replace("PARENT", str(os.getpid()))
        )
        self.insert(deeds)

    def deeds(self):
        return sorted(
            set("\n".join(file.read_text() for file in (self.folder / "out").rglob("tried.txt")).split("\n")) - {""}
        )

    def test_an_honest_engine_answers_as_it_does_outside(self):
        outside = self.errors(self.validate()[1])
        inside = self.errors(self.validate("--sandbox")[1])
        self.assertEqual(inside, outside)

    def test_a_hostile_one_reaches_nothing(self):
        self.make_hostile()
        self.errors(self.validate()[1])
        self.assertEqual(
            len(self.deeds()), 7, self.deeds()
        )  # the deeds are real: without a sandbox each works, but for other runs, which come later
        self.assertTrue((self.folder / "written").exists())
        (self.folder / "written").unlink()
        subprocess.run(["rm", "-r", self.folder / "out"], check=True)
        self.errors(self.validate("--sandbox")[1])
        self.assertLessEqual(set(self.deeds()), {"write outside"})  # to a /tmp of its own, which is gone with it
        self.assertFalse((self.folder / "written").exists())

    def test_it_changes_no_setting_of_the_kernel_and_cannot_multiply(self):
        """As root and as another user. Files are opened for writing, and nothing is written."""
        self.insert("""
import os, sys
if sys.argv[1] == "--run":
    told = []
    for path in ("/proc/sys/kernel/core_pattern", "/proc/sys/vm/drop_caches", "/proc/sys/kernel/hostname", \
"/proc/sysrq-trigger", "/sys/power/state", "/sys/kernel/mm/ksm/run", "/dev/mem"):
        try:
            os.close(os.open(path, os.O_WRONLY))
            told.append(path)
        except OSError:
            pass
    open("told.txt", "w").write(repr((os.getuid() == 0, told)))
    children = []
    while len(children) < 2000:
        try:
            child = os.fork()
        except OSError:
            break
        if child == 0:
            os.read(0, 1)
            import time
            time.sleep(60)
            os._exit(0)
        children.append(child)
    for child in children:
        os.kill(child, 9)
        os.waitpid(child, 0)
    open("children.txt", "w").write(str(len(children)))
""")
        for user in [0, 1000] if os.geteuid() == 0 else [os.geteuid()]:
            with tempfile.TemporaryDirectory() as out:
                os.chown(out, user, -1)
                os.chmod(self.folder, 0o755)
                done = subprocess.run(
                    [TRIPOINT, "run", "rigid/ballistic", "--engine", self.engine, "--sandbox", "--out", out + "/run"],
                    cwd="/",
                    capture_output=True,
                    text=True,
                    check=False,
                    user=user,
                )
                if done.returncode == 0:  # it was quicker than a look at its processes
                    self.assertLess(int(Path(out, "run/children.txt").read_text()), 1024)
                else:
                    self.assertIn("more than 512 processes", done.stdout + done.stderr)
                told = Path(out, "run/told.txt")
                self.assertEqual(told.read_text(), "(False, [])", user)
                self.assertEqual(told.stat().st_uid, user)  # what the sandbox's user wrote is the caller's again

    def test_root_says_which_engine_its_sandbox_cannot_read(self):
        if os.geteuid() != 0:
            self.skipTest("only root runs engines as nobody")
        self.engine.parent.chmod(0o700)
        done = self.validate("--sandbox")[0]
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("chmod -R o+rX", done.stdout + done.stderr)

    def test_an_engine_in_the_project_sees_neither_report_nor_repository(self):
        project, out = self.engine.parent, self.engine.parent / "report"
        (project / ".git").mkdir()
        (project / ".git/config").write_text("a token")
        out.mkdir()
        (out / "of-another-run").write_text("an answer")
        self.insert(f"""
if sys.argv[1] == "--run":
    seen = []
    for name in ("report/of-another-run", ".git/config"):
        try:
            seen.append(open("{project}/" + name).read(1))
        except OSError:
            pass
    open("seen.txt", "w").write(str(len(seen)))
""")
        for words, seen in (([], "2"), (["--sandbox"], "0")):
            done = self.run_in([*self.judged(), "--engines", "mine", "--out", out, *QUIETLY, *words], cwd=project)
            self.assertEqual({file.read_text() for file in out.rglob("seen.txt")}, {seen}, done.stderr)

    def test_who_draws_the_page_changes_no_result_and_sees_no_other_file(self):
        """A program in place of Python's does what code in a third-party trajectory would; then it draws the page."""
        python = self.folder / "python/bin/python3"
        python.parent.mkdir(parents=True)
        out = self.folder / "out"
        python.write_text(f"""#!/bin/sh
try() {{ echo "$1" >>"{out}/deeds.txt"; }}
cat "{self.folder}/secret" >/dev/null 2>&1 && try "read outside"
echo x 2>/dev/null >"{self.folder}/written"
cat /etc/passwd >/dev/null 2>&1 && try "password file"
[ -n "$SOME_TOKEN" ] && try token
echo '{{}}' 2>/dev/null >"{out}/results.json" && try "wrote results"
rm -f "{out}/summary.md" 2>/dev/null && try "removed the summary"
mv "{out}/runs" "{out}/others" 2>/dev/null && mv "{out}/others" "{out}/runs" && try "moved runs"
echo x 2>/dev/null >>"{out}/kept.txt" && try "wrote into another file of the folder"
exec /usr/bin/python3 "$@"
""")
        python.chmod(0o755)
        words = [
            TRIPOINT,
            "validate",
            "rigid/ballistic",
            "--engine",
            self.engine,
            "--engines",
            "mine,exact",
            "--out",
            out,
            "--no-history",
        ]
        for more, deeds in (([], 7), (["--sandbox"], 0)):
            subprocess.run(["rm", "-rf", out, self.folder / "written"], check=True)
            out.mkdir()
            (out / "kept.txt").write_text("mine")
            done = subprocess.run(
                [*words, *more],
                cwd=self.folder,
                capture_output=True,
                text=True,
                check=False,
                env={**os.environ, "SOME_TOKEN": "secret", "TRIPOINT_PYTHON": str(python)},
            )
            told = (out / "deeds.txt").read_text().splitlines() if (out / "deeds.txt").exists() else []
            self.assertEqual(len(told), deeds, told)
            self.assertEqual((self.folder / "written").exists(), not more)
            if more:
                self.assertTrue(
                    (out / "index.html").exists(), done.stdout + done.stderr + (out / "report.log").read_text()
                )
                self.assertTrue((out / "case/rigid+ballistic.html").exists() or list((out / "case").glob("*.html")))
                self.assertTrue(json.loads((out / "results.json").read_text())["cases"])

    def test_no_link_that_somebody_left_in_the_report_is_followed(self):
        out, mine = self.folder / "out", self.folder / "mine-too"
        for planted in ("case", "history.jsonl"):
            subprocess.run(["rm", "-rf", out, mine], check=True)
            mine.mkdir()
            (mine / "page.html").write_text("mine")
            out.mkdir()
            (out / planted).symlink_to(mine if planted == "case" else mine / "made")
            done = subprocess.run(
                [TRIPOINT, "validate", "rigid/ballistic", "--engines", "exact", "--out", out, "--no-report"],
                cwd=self.folder,
                capture_output=True,
                text=True,
                check=False,
            )
            self.assertEqual(sorted(file.name for file in mine.iterdir()), ["page.html"], planted)
            results = json.loads((out / "results.json").read_text())
            if planted == "history.jsonl":  # the numbers are kept, and nobody believes that all went well
                self.assertEqual(done.returncode, 4, done.stdout)
                self.assertIn("the history could not be written", results["problems"][0])

    def test_a_python_that_links_lead_to_draws_the_page(self):
        versions = self.folder / "versions"
        (versions / "3.11.2/bin").mkdir(parents=True)
        (versions / "3.11.2/bin/python3.11").symlink_to("/usr/bin/python3")
        (versions / "3.11").symlink_to("3.11.2")
        environment = self.folder / "environment/bin"
        environment.mkdir(parents=True)
        (environment / "python").symlink_to(versions / "3.11/bin/python3.11")
        for python in (environment / "python", Path("environment/bin/python")):
            done = self.run_in(
                [*self.judged(), "--engines", "mine", "--out", "out", "--sandbox"],
                env={**os.environ, "TRIPOINT_PYTHON": str(python)},
            )
            self.assertTrue((self.folder / "out/index.html").exists(), done.stdout + done.stderr)

    def test_a_home_is_no_folder_of_an_engine(self):
        done = self.run_in(
            [*self.judged(), "--sandbox", "--out", self.folder / "out", "--no-report"],
            env={**os.environ, "HOME": str(self.engine.parent)},
        )
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("holds your home", done.stdout + done.stderr)

    def test_no_record_that_an_engine_leaves_is_believed(self):
        self.errors(self.validate("--sandbox")[1])
        records = {file.name: file.read_text() for file in (self.folder / "out").rglob("outcome-*.json")}
        self.assertTrue(any("mine" in str(file) for file in (self.folder / "out").rglob("outcome-*.json")))
        subprocess.run(["rm", "-r", self.folder / "out"], check=True)
        self.insert(f"""
import atexit, os, time
def forge():
    for name, text in {records!r}.items():
        for path in ("outcome.json", "../../particles/" + name):
            try:
                open(path, "w").write(text)
            except OSError:
                pass
    time.sleep(60)
if sys.argv[1] == "--run":
    atexit.register(forge)
""")
        for again in ([], ["--resume"]):
            done, results = self.validate("--sandbox", "--time-limit", "2", *again)
            self.assertEqual(done.returncode, 4, done.stdout)
            self.assertEqual(
                {
                    run["status"]
                    for engine in results["cases"][0]["engines"]
                    if engine["name"] == "mine"
                    for run in engine["runs"]
                },
                {"timeout"},
            )

    def test_its_limits_are_set_before_it_begins(self):
        self.insert("""
import os, resource
if sys.argv[1] == "--run":
    told = [resource.getrlimit(what)[1] for what in (resource.RLIMIT_DATA, resource.RLIMIT_AS, resource.RLIMIT_FSIZE, \
resource.RLIMIT_NPROC, resource.RLIMIT_CPU)]
    for folder in ("/tmp", "/dev/shm"):
        room = os.statvfs(folder)
        told.append(room.f_blocks * room.f_frsize)
    open("limits.txt", "w").write(" ".join(str(number) for number in told))
""")
        self.errors(self.validate("--sandbox")[1])
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        for file in (self.folder / "out").rglob("limits.txt"):
            told = [int(word) for word in file.read_text().split()]
            self.assertEqual(told[:4], [memory, 4 * memory, 16 << 30, 1024])
            self.assertTrue(0 < told[4] < 100000, told)
            self.assertEqual(told[5:], [1 << 30, 1 << 30])

    def ended(self, deeds):
        """How a run ends whose engine does this, and the seconds that it takes."""
        self.insert('import os, sys\nif sys.argv[1] == "--run":\n' + deeds)
        begun = time.monotonic()
        done, results = self.validate("--sandbox")
        reasons = [e["reason"] for e in results["cases"][0]["engines"] if e["name"] == "mine"]
        return reasons[0], time.monotonic() - begun

    def test_many_small_files_in_memory_end_it(self):
        said, seconds = self.ended("""
    for n in range(2000000):
        if n % 1000 == 0:
            os.mkdir(f"/tmp/{n}")
        open(f"/tmp/{n // 1000 * 1000}/{n}", "w").close()
""")
        self.assertIn("more than 20000 files in memory", said)
        self.assertLess(seconds, 60.0)

    def test_many_at_once_share_the_memory(self):
        """500 at once have some 30 MB each."""
        self.insert(
            'import sys\nif sys.argv[1] == "--run":\n    m = b"x" * (200 << 20)\n    import time\n    time.sleep(3)\n'
        )
        for jobs, killed in (("1", False), ("500", True)):
            results = self.validate("--sandbox", "--jobs", jobs)[1]
            reasons = [e["reason"] for e in results["cases"][0]["engines"] if e["name"] == "mine"]
            self.assertEqual("MB of memory" in reasons[0], killed, reasons)

    def test_folders_that_nest_without_end_end_it_and_go(self):
        self.insert('import os, sys\nwhile sys.argv[1] == "--run":\n    os.mkdir("d")\n    os.chdir("d")')
        done = self.run_in([TRIPOINT, "run", "rigid/ballistic", "--engine", self.engine, "--sandbox", "--out", "out"])
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("the sandbox has folders more than 64 deep", done.stdout + done.stderr)
        self.assertLess(len(list((self.folder / "out").iterdir())), 20)

    def test_its_memory_is_a_share_of_what_its_group_has_free(self):
        """The machine is not asked for more than 300 MB."""
        group = Path("/sys/fs/cgroup/memory/tripoint-test")
        try:
            group.mkdir(exist_ok=True)
            (group / "memory.limit_in_bytes").write_text(str(400 << 20))
        except OSError:
            self.skipTest("no control group of version 1 can be made here")
        self.addCleanup(group.rmdir)
        own = "/sys/fs/cgroup/memory" + next(
            line.split(":", 2)[2] for line in Path("/proc/self/cgroup").read_text().splitlines() if ":memory:" in line
        )
        (group / "cgroup.procs").write_text(str(os.getpid()))
        try:
            said, _ = self.ended("    import time\n    m = b'x' * (330 << 20)\n    time.sleep(5)\n")
        finally:
            Path(own, "cgroup.procs").write_text(str(os.getpid()))
        self.assertRegex(said, r"the sandbox has (more than )?\d+ MB of memory")

    def test_it_starts_where_the_caller_has_lower_limits(self):
        words = [
            "sh",
            "-c",
            'ulimit -f 2000000 && ulimit -v 8000000 && exec "$@"',
            "sh",
            *self.judged(),
            "--engines",
            "mine",
            "--out",
            self.folder / "out",
            *QUIETLY,
            "--sandbox",
        ]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False)
        self.errors(json.loads((self.folder / "out/results.json").read_text()))
        self.assertIn("verdict", done.stdout)

    def test_what_it_costs_is_counted_inside_too(self):
        self.insert("""
import time
if sys.argv[1] == "--run":
    taken = bytearray(200 << 20)
    while time.process_time() < 0.5:
        pass
""")
        results = self.validate("--sandbox")[1]
        self.errors(results)
        for run in (
            run for engine in results["cases"][0]["engines"] if engine["name"] == "mine" for run in engine["runs"]
        ):
            self.assertGreater(run["cost"]["cpu_s"], 0.5)
            self.assertGreater(run["cost"]["peak_bytes"], 200 << 20)

    def test_where_no_namespace_can_be_made_nothing_is_run(self):
        if os.geteuid() != 0:
            self.skipTest("only root can hide a program")
        words = [
            "unshare",
            "--mount",
            "sh",
            "-c",
            f"mount --bind /bin/false /usr/bin/bwrap && exec {TRIPOINT} validate rigid/ballistic --engine "
            f"{self.engine} --sandbox --out {self.folder}/none",
        ]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("--sandbox: this machine lets bubblewrap make no namespaces", done.stderr)
        self.assertFalse((self.folder / "none/results.json").exists())


if __name__ == "__main__":
    if not namespaces_are_allowed() or not one_folder_can_be_shown():
        print("skipped: no bubblewrap here, or it may make no namespaces, or there is no Landlock")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
