# SPDX-License-Identifier: BSD-3-Clause
"""Hostile case files: each must be refused with a sentence, in bounds of time and memory. make(folder) writes one and
gives its path."""

import os
import struct
from dataclasses import dataclass
from typing import Callable

SCENE = '[scene]\nend_time = "1 s"\nspacing = "0.1 m"\n'
BOX = '{kind="box",min=[0,0,0],max=[1,1,1]}'
JUDGED = '[reference]\nfunction="ballistic"\n[[metric]]\nname="p"\nquantity="position"\n'
CUBE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
SIDES = (
    (1, 3, 2),
    (1, 4, 3),
    (5, 6, 7),
    (5, 7, 8),
    (1, 2, 6),
    (1, 6, 5),
    (2, 3, 7),
    (2, 7, 6),
    (3, 4, 8),
    (3, 8, 7),
    (4, 1, 5),
    (4, 5, 8),
)


def text(scene=SCENE, more="", material="", body="", shape=BOX, name="b", end="", head="format = 1\n"):
    return (
        f'{head}{scene}{more}[[material]]\nname = "m"\ndensity = 1000\n{material}'
        f'[[body]]\nname = "{name}"\nmaterial = "m"\nphase = "rigid"\nshape = {shape}\n{body}{end}'
    )


@dataclass(frozen=True)
class Hostile:
    name: str
    content: str | bytes | None = None  # of case.toml
    beside: Callable | None = None  # writes the file that the case names, or the case itself

    def make(self, folder):
        if self.beside:
            self.beside(folder)
        path = folder / "case.toml"
        if self.content is not None:
            path.write_bytes(self.content.encode() if isinstance(self.content, str) else self.content)
        return path


def mesh(name, write, file="m.obj", more=""):
    return Hostile(
        f"mesh: {name}",
        text(shape=f'{{kind="mesh",file="{file}"{more}}}'),
        lambda folder: write(folder / file.rpartition("/")[2]),
    )


def obj(corners=CUBE, sides=SIDES, end=b""):
    return (
        "".join("v {} {} {}\n".format(*c) for c in corners).encode()
        + "".join("f {} {} {}\n".format(*s) for s in sides).encode()
        + end
    )


def holds(content):
    return lambda path: path.write_bytes(content)


def sparse(size):
    def write(path):
        with path.open("wb") as file:
            file.truncate(size)

    return write


def leads_to(target):
    return lambda path: os.symlink(target, path)


def measured(name, write):
    """A case whose reference is a file of measurements."""
    end = '[reference]\nkind="experiment"\nfunction="experiment"\nfile="f.ref.csv"\n'
    end += '[[metric]]\nname="f"\nquantity="front_lead"\n'
    return Hostile(f"reference: {name}", text(end=end), lambda folder: write(folder / "f.ref.csv"))


def keyed(line):
    """A scene with one hostile value."""
    return Hostile(line, text(more=line + "\n"))


def shaped(name, shape):
    return Hostile(name, text(shape=shape))


HOSTILE = (
    # the file itself
    Hostile("100,000 brackets", "v = " + "[" * 100000),
    Hostile("50,000 tables in each other", "v = " + "{a=" * 50000 + "1" + "}" * 50000),
    Hostile("a key of 200,000 parts", "a." * 200000 + "b = 1\n"),
    Hostile("[,]: the parser's unreachable point", "v = [,]\n"),
    Hostile("v=[1,}: its other one", "v=[1,}"),
    Hostile("4 MB of comment", text() + "#" * 4000000),
    Hostile("a text without end", text(end='[case]\ntitle = "' + "x" * 200000)),
    Hostile("UTF-16", text().encode("utf-16")),
    Hostile("a byte 0", text().encode() + b"\0"),
    Hostile("overlong UTF-8", text().encode().replace(b'"b"', b'"\xc0\xaf"')),
    Hostile("empty", ""),
    Hostile("a folder as case", beside=lambda folder: (folder / "case.toml").mkdir()),
    Hostile("a pipe as case", beside=lambda folder: os.mkfifo(folder / "case.toml")),
    Hostile("/dev/zero as case", beside=lambda folder: leads_to("/dev/zero")(folder / "case.toml")),
    Hostile("the environment as case", beside=lambda folder: leads_to("/proc/self/environ")(folder / "case.toml")),
    Hostile("extends /etc/passwd", text(head='format = 1\nextends = "/etc/passwd"\n')),
    Hostile("extends itself", text(head='format = 1\nextends = "case.toml"\n')),
    Hostile("a key twice", text(more="spacing = 0.2\n")),
    Hostile("an unknown key", text(more="colour = 1\n")),
    Hostile("another format", text(head="format = 999\n")),
    # numbers
    *(
        Hostile(f"end_time = {value}", text(scene=f"[scene]\nend_time = {value}\nspacing = 0.1\n"))
        for value in ("nan", "inf", "-1", "1e400", '"1 kg"', "[]")
    ),
    *(
        Hostile(f"spacing = {value}", text(scene=f"[scene]\nend_time = 1\nspacing = {value}\n"))
        for value in ("nan", "1e-9", "5e-324", '"1 m*m*m"')
    ),
    *(
        keyed(line)
        for line in (
            "time_step = 1e-320",
            "output_interval = 1e-300",
            "support_ratio = 1e9",
            "seed = 99999999999999999999",
            "gravity = [0,0,1e400]",
            "gravity = [0,0,nan]",
        )
    ),
    Hostile("a unit of 8,000 factors", text(scene='[scene]\nend_time = 1\nspacing = "1 {}m"\n'.format("m*" * 8000))),
    Hostile("density = 1e308", text().replace("density = 1000", "density = 1e308")),
    Hostile("poisson_ratio = 0.5", text(material="poisson_ratio = 0.5\n")),
    # formulas and names
    Hostile(
        "a formula of 400 brackets",
        text(body='velocity = {kind="expression",value=["%sx%s","0","0"]}\n' % ("(" * 400, ")" * 400)),
    ),
    Hostile(
        "a formula that overflows", text(body='velocity = {kind="expression",value=["exp(exp(exp(9)))","0","0"]}\n')
    ),
    Hostile(
        "a formula that calls a shell",
        text(body='velocity = {kind="expression",value=["__import__(\'os\').system(\'id\')","0","0"]}\n'),
    ),
    Hostile("a name with a line break and a forged error", text(name="b\\nfile.toml:1: error: forged")),
    Hostile("a name with escape codes", text(name="\\u001b[2J\\u001b]0;pwned\\u0007")),
    Hostile("case id ../../../outside/pwn", text(head='format = 1\n[case]\nid = "../../../outside/pwn"\n')),
    Hostile("a joint to a body that is not there", text(body='joined_to = ["nobody"]\n')),
    # shapes
    shaped("a box of 1e27 particles", '{kind="box",min=[0,0,0],max=[1e9,1e9,1e9]}'),
    shaped("a box wider than all numbers", '{kind="box",min=[-1e308,0,0],max=[1e308,1,1]}'),
    shaped("a box inside out", '{kind="box",min=[1,1,1],max=[0,0,0]}'),
    shaped("a sphere of radius nan", '{kind="sphere",centre=[0,0,0],radius=nan}'),
    shaped("a cylinder without direction", '{kind="cylinder",base=[0,0,0],axis=[1e-320,0,0],length=1,radius=1}'),
    shaped("half of all space", '{kind="half_space",point=[0,0,0],normal=[0,0,1]}'),
    shaped("a body less itself", f'{{kind="difference",from={BOX},minus={{kind="box",min=[-1,-1,-1],max=[2,2,2]}}}}'),
    shaped(
        "30 differences in each other",
        '{kind="difference",from=' * 30 + BOX + ',minus={kind="sphere",centre=[0,0,0],radius=0.1}}' * 30,
    ),
    Hostile("1e9 particles", text(scene="[scene]\nend_time = 1\nspacing = 0.001\n")),
    # meshes
    mesh(
        "one polygon of a million corners",
        holds(obj(sides=(), end=b"f " + b" ".join(b"%d" % (1 + i % 8) for i in range(1000000)) + b"\n")),
    ),
    mesh("a corner 2^63", holds(obj(sides=SIDES + ((9223372036854775808, 1, 2),)))),
    mesh("a place that is not a number", holds(obj(corners=(("nan", 0, 0),) + CUBE[1:]))),
    mesh("a hole", holds(obj(sides=SIDES[1:]))),
    mesh("STL that says 2^32 - 1 triangles", holds(b"\0" * 80 + struct.pack("<I", 0xFFFFFFFF) + b"\0" * 600), "m.stl"),
    mesh("8 GB of nothing", sparse(8 << 30), "m.stl"),
    mesh("a pipe", os.mkfifo),
    mesh("/dev/zero", leads_to("/dev/zero")),
    mesh("/etc/passwd", leads_to("/etc/passwd")),
    mesh("a link to itself", leads_to("m.obj")),
    mesh("../../../../etc/passwd", lambda path: None, "../../../../etc/passwd"),
    # what judges
    measured("a pipe", os.mkfifo),
    measured("/dev/zero", leads_to("/dev/zero")),
    measured("/etc/passwd", leads_to("/etc/passwd")),
    measured("3 GB of nothing", sparse(3 << 30)),
    Hostile("limit = nan", text(end=JUDGED + '[[gate]]\nmetric="p"\nlimit=nan\nreason="x"\n')),
    Hostile("limit = inf", text(end=JUDGED + '[[gate]]\nmetric="p"\nlimit=inf\nreason="x"\n')),
    Hostile("a band inside out", text(end=JUDGED + '[[gate]]\nmetric="p"\nband=[1,-1]\nreason="x"\n')),
    Hostile("a gate of no metric", text(end='[[gate]]\nmetric="p"\nlimit=1\nreason="x"\n')),
    Hostile("1e9 seeds", text(end='[[study]]\naxis="spacing"\nlevels=[0.2,0.1]\nseeds=1000000000\n')),
    Hostile("20,000 levels", text(end='[[study]]\naxis="spacing"\nlevels=[{}]\n'.format(",".join(["\n0.1"] * 20000)))),
    Hostile("an event before the start", text(end='[[event]]\ntime=-1\nkind="hold"\nbodies=["b"]\n')),
    Hostile("an event of a body that is not there", text(end='[[event]]\ntime=0.1\nkind="hold"\nbodies=["zz"]\n')),
)
