# SPDX-License-Identifier: BSD-3-Clause
"""Hostile engines: each is the fake engine of tests/harness/fake with one deed before or after it. None of them may
pass, and none harms the host.

A deed is Python that the engine carries out in its folder. AT says when: "info", "check", "run" (before it runs) or
"after" it has written its answer. Where `needs` is true, only a sandbox stops the deed, so without one it is not
tried."""

import shutil
from dataclasses import dataclass
from pathlib import Path

FAKE = Path(__file__).resolve().parents[2] / "harness" / "fake"


@dataclass(frozen=True)
class Hostile:
    name: str
    at: str
    deed: str
    needs: bool = False  # a sandbox
    wrong: str = "nothing"  # what FAKE says for the answer
    page: bool = False  # the report is drawn too: its words are to end there


# The fake engine answers itself, wrongly where FAKE says so; `run` has it answer within this process.
HEAD = """#!/usr/bin/python3
import json, os, runpy, signal, socket, subprocess, sys, time
from pathlib import Path
HERE, OUTSIDE, DOOR = Path(__file__).resolve().parent, Path({outside!r}), {door}
os.environ["FAKE_NAME"] = "evil"
def answer(wrong={wrong!r}):
    os.environ["FAKE"] = wrong
    runpy.run_path(str(HERE / "engine.py"), run_name="__main__")
def says(**changes):
    print(json.dumps({{"contract": 1, "name": "evil", "version": "1", "build": "b", "library": {{"path": "", "hash": \
""}}, "capabilities": ["rigid-free-flight", "gravity"],
                      "presets": ["default"], "settings": {{}}, "deterministic": True}} | changes))
    sys.exit(0)
def rewrite(**changes):
    Path("result.json").write_text(json.dumps(json.loads(Path("result.json").read_text()) | changes))
def deed():
{deed}
at = sys.argv[1].removeprefix("--")
if at != "run":
    if at == {at!r}: deed()
    answer()
    sys.exit(0)
sys.argv[2] = str(Path(sys.argv[2]).resolve())
os.chdir(Path(sys.argv[2]).parent)
if {at!r} == "run": deed()
try:
    answer()
except SystemExit:
    pass
if {at!r} == "after": deed()
"""

HOSTILE = (
    Hostile("prints without end when it is asked who it is", "info", "while True: os.write(1, b'x' * (1 << 20))"),
    Hostile(
        "answers with an object 400,000 deep",
        "info",
        """start = '{"contract": 1, "name": "evil", "settings": {"q": '
print(start + '{"a":' * 400000 + "1" + "}" * 400000 + "}}"); sys.exit(0)""",
    ),
    Hostile("is called ../../../outside/pwn", "info", 'says(name="../../../outside/pwn")'),
    Hostile(
        "has a name of three lines: ::error::forged, verdict PASS exit 0",
        "info",
        r'says(name="evil\n::error::forged\nverdict PASS exit 0")',
        page=True,
    ),
    Hostile("has a name of 5,000 letters", "info", 'says(name="n" * 5000)'),
    Hostile("refuses with a number as its reason", "check", """print('{"can": false, "reason": 5}'); sys.exit(0)"""),
    Hostile(
        "hangs and ignores SIGTERM",
        "run",
        "for s in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP): signal.signal(s, signal.SIG_IGN)\ntime.sleep(600)",
    ),
    Hostile(
        "starts 200 processes in sessions of their own and hangs",
        "run",
        'for _ in range(200): subprocess.Popen(["/bin/sleep", "600"], start_new_session=True)\ntime.sleep(600)',
    ),
    Hostile(
        "asks for five times the memory of the machine",
        "run",
        'try: taken = bytearray(5 * os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))\nexcept MemoryError: '
        "sys.exit(9)\nsys.exit(0)",
    ),
    Hostile(
        "writes 200 MB of escape codes and forged lines to stderr, then stands still",
        "run",
        r'for _ in range(200): os.write(2, b"\x1b]0;owned\x07\x1b[2Jprogress nan\n::error::forged\n" * 25000)'
        '\nanswer("frozen")\nsys.exit(0)',
    ),
    Hostile(
        "says that it failed, in <script> and escape codes",
        "after",
        r'rewrite(status="error", message="<script>alert(1)</script>\n::error::forged\nverdict PASS exit 0\x1b[31m")',
        page=True,
    ),
    Hostile(
        "leaves a result 400,000 deep",
        "after",
        """file = Path("result.json"); t = file.read_text()
file.write_text(t[:-1] + ', "extra": ' + '{"a":' * 400000 + "1" + "}" * 400000 + "}")""",
    ),
    Hostile("leaves a pipe as trajectory", "after", 'os.remove("trajectory.csv"); os.mkfifo("trajectory.csv")'),
    Hostile(
        "leaves links to /dev/zero and /etc/passwd",
        "after",
        'for name, to in (("trajectory.csv", "/dev/zero"), ("result.json", "/etc/passwd")): os.remove(name); '
        "os.symlink(to, name)",
    ),
    Hostile("leaves a trajectory of 10 GB", "after", 'os.truncate("trajectory.csv", 10 << 30)'),
    Hostile(
        "leaves a trajectory.h5 that is broken within",
        "after",
        'os.remove("trajectory.csv"); Path("trajectory.h5").write_bytes((HERE / "kills-hdf5.h5").read_bytes())',
    ),
    Hostile("says ok, with places that are not numbers", "run", 'answer("not a number")\nsys.exit(0)'),
    Hostile(
        "puts a link to a file of ours in place of its log, then stands still",
        "check",
        '(Path(sys.argv[2]).parent / "log.txt").symlink_to(OUTSIDE / "victim")',
        wrong="frozen",
    ),
    Hostile(
        "puts links to a file of ours where files are about to be written, then stands still",
        "run",
        'for name in ("job.json.part", "result.json.part", "outcome.json.part", "row.json.part", "callgrind"): '
        'Path(name).symlink_to(OUTSIDE / "victim")\nanswer("frozen")\nsys.exit(0)',
    ),
    Hostile(
        "puts a pipe in place of its job, and where its record would be written",
        "after",
        'os.remove("job.json")\nfor name in ("job.json", "outcome.json", "outcome.json.part"): os.mkfifo(name)',
    ),
    Hostile(
        "says that it diverged, and leaves a pipe as trajectory",
        "after",
        'rewrite(status="diverged", message="so it says"); os.remove("trajectory.csv"); os.mkfifo("trajectory.csv")',
    ),
    Hostile("answers with an object of 300,000 keys", "info", 'says(settings={str(n): "" for n in range(300000)})'),
    Hostile("leaves a result of 600,000 keys", "after", "rewrite(extra={str(n): 0 for n in range(600000)})"),
    Hostile(
        "leaves a trajectory of 200,000 times",
        "after",
        'with open("trajectory.csv", "a") as file: file.writelines(f"{1 + n},0,0,0,0,0,0,0,1,0,0,0,0,0,0\\n" for n in '
        "range(200000))",
    ),
    Hostile("says 3 MB in one message", "after", 'rewrite(status="error", message="m" * 3000000)', page=True),
    Hostile("kills its parent", "run", "os.kill(os.getppid(), signal.SIGKILL)\ntime.sleep(1)\nsys.exit(1)", needs=True),
    Hostile(
        "tries for another engine's answer, our secret, our folder, our token, a network",
        "run",
        """
def worked(act):
    try: return act() or True
    except OSError: return False
tried = {"secret": lambda: (OUTSIDE / "secret").read_text(), "folder": lambda: (OUTSIDE / "pwned").write_text("x"), \
"answer": lambda: os.stat("../../exact"),
         "network": lambda: socket.create_connection(("127.0.0.1", DOOR), timeout=2.0).close()}
escaped = [name for name, act in tried.items() if worked(act)] + ["token"] * ("SOME_TOKEN" in os.environ)
sys.stderr.write(f"escaped: {escaped}\\n" if escaped else "nothing is in reach\\n")
sys.exit(8 if escaped else 9)""",
        needs=True,
    ),
    Hostile(
        "shortens the particles that all engines share",
        "run",
        'name = json.loads(Path(sys.argv[2]).read_text())["particles"]\ntry: os.truncate(name, 100)\nexcept OSError: '
        "sys.exit(9)\nsys.exit(8)",
        needs=True,
    ),
)


def make(folder, hostile, outside, door):
    """The engine as an executable in a folder of its own. @return its path"""
    shutil.copy(FAKE / "engine.py", folder / "engine.py")
    shutil.copy(FAKE / "kills-hdf5.h5", folder / "kills-hdf5.h5")
    lines = "\n".join("    " + line for line in hostile.deed.strip().split("\n"))
    engine = folder / "engine-evil"
    engine.write_text(HEAD.format(outside=str(outside), door=door, deed=lines, at=hostile.at, wrong=hostile.wrong))
    engine.chmod(0o755)
    return engine
