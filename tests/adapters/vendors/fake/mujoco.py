# SPDX-License-Identifier: BSD-3-Clause
"""Stands in for MuJoCo where it is not installed: free bodies without contact, by semi-implicit Euler, with a constant
spin.

It reads the same MJCF and has the same arrays, so that the adapter's own part is tested: what it says, and how it reads
states back."""

import xml.etree.ElementTree as Xml
from types import SimpleNamespace


def _numbers(text):
    return [float(word) for word in text.split()]


class MjModel:
    @staticmethod
    def from_xml_string(text):
        root = Xml.fromstring(text)
        option = root.find("option")
        bodies = root.findall("worldbody/body")
        model = MjModel()
        model.opt = SimpleNamespace(
            timestep=float(option.get("timestep")),
            gravity=_numbers(option.get("gravity")),
            integrator=option.get("integrator"),
        )
        model.body_mass = [0.0] + [float(b.find("inertial").get("mass")) for b in bodies]
        model.body_inertia = [[0.0, 0.0, 0.0]] + [_numbers(b.find("inertial").get("diaginertia")) for b in bodies]
        model.number(bodies)
        model.ngeom = len(root.findall(".//geom"))
        geoms = [[geom.get("friction") for geom in b.findall("geom")] for b in bodies]
        model.geom_friction = [_numbers(words) for own in geoms for words in own]
        model.body_geomadr = [-1] + [sum(map(len, geoms[:n])) if own else -1 for n, own in enumerate(geoms)]
        model.start = [number for b in bodies for number in _numbers(b.get("pos")) + _numbers(b.get("quat"))]
        return model

    def number(self, bodies):
        """Joints of MuJoCo's own numbering: each body has a free one."""
        ids = {b.get("name"): number + 1 for number, b in enumerate(bodies)}
        self.body = lambda name: SimpleNamespace(id=ids[name])
        self.body_dofadr = [-1] + [6 * number for number in range(len(bodies))]
        self.body_jntadr = [-1] + list(range(len(bodies)))
        self.jnt_qposadr = [7 * number for number in range(len(bodies))]
        self.jnt_dofadr = [6 * number for number in range(len(bodies))]


class mjtWarning:
    mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC = 4, 5, 6


class MjData:
    def __init__(self, model):
        self.warning = [SimpleNamespace(number=0) for _ in range(8)]
        self.qpos = list(model.start)
        self.qvel = [0.0] * (6 * (len(model.body_mass) - 1))
        self.ncon = 0


def _turn(q, w, dt):
    """q times exp(w dt / 2), to first order and normalised. w in the body frame."""
    a, (x, y, z) = q, [0.5 * dt * c for c in w]
    q = [
        a[0] - a[1] * x - a[2] * y - a[3] * z,
        a[1] + a[0] * x + a[2] * z - a[3] * y,
        a[2] + a[0] * y + a[3] * x - a[1] * z,
        a[3] + a[0] * z + a[1] * y - a[2] * x,
    ]
    size = sum(c * c for c in q) ** 0.5
    return [c / size for c in q]


def mj_step(model, data, nstep=1):
    dt = model.opt.timestep
    for _ in range(nstep):
        for body in range(len(model.body_mass) - 1):
            v, x = 6 * body, 7 * body
            for axis in range(3):
                data.qvel[v + axis] += dt * model.opt.gravity[axis]
                data.qpos[x + axis] += dt * data.qvel[v + axis]
            data.qpos[x + 3 : x + 7] = _turn(data.qpos[x + 3 : x + 7], data.qvel[v + 3 : v + 6], dt)
        if max(map(abs, data.qvel)) > 1e10:  # MuJoCo, too, goes back to its reference state, at rest, and counts it
            data.qpos, data.qvel = list(model.start), [0.0] * len(data.qvel)
            data.warning[mjtWarning.mjWARN_BADQVEL].number += 1
