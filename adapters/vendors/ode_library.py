# SPDX-License-Identifier: BSD-3-Clause
"""libode.so.8 by ctypes: the structures and functions that the adapter calls, as ode/contact.h, mass.h and objects.h
have them."""

from __future__ import annotations

from ctypes import CDLL, CFUNCTYPE, POINTER, RTLD_GLOBAL, Structure, c_char_p, c_double, c_int, c_uint, c_void_p
from pathlib import Path
from typing import Any

BOUNCE = 0x004  # dContactBounce
APPROX_1 = 0x7000  # dContactApprox1: friction by the pyramid, bounded by mu times the normal force


class Mass(Structure):
    _fields_ = [("mass", c_double), ("centre", c_double * 4), ("inertia", c_double * 12)]  # three rows of four


class Surface(Structure):
    _fields_ = [("mode", c_int)] + [
        (name, c_double)
        for name in (
            "mu",
            "mu2",
            "rho",
            "rho2",
            "rhoN",
            "bounce",
            "bounce_vel",
            "soft_erp",
            "soft_cfm",
            "motion1",
            "motion2",
            "motionN",
            "slip1",
            "slip2",
        )
    ]


class ContactGeom(Structure):
    _fields_ = [
        ("pos", c_double * 4),
        ("normal", c_double * 4),
        ("depth", c_double),
        ("g1", c_void_p),
        ("g2", c_void_p),
        ("side1", c_int),
        ("side2", c_int),
    ]


class Contact(Structure):
    _fields_ = [("surface", Surface), ("geom", ContactGeom), ("fdir1", c_double * 4)]


Near = CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)  # called with the two geoms that may touch

_V, _D, _I, _R = c_void_p, c_double, c_int, POINTER(c_double)
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {  # name -> result, arguments
    "dInitODE2": (_I, (c_uint,)),
    "dGetConfiguration": (c_char_p, ()),
    "dWorldCreate": (_V, ()),
    "dWorldSetGravity": (None, (_V, _D, _D, _D)),
    "dWorldGetGravity": (None, (_V, _R)),
    "dWorldSetERP": (None, (_V, _D)),
    "dWorldSetCFM": (None, (_V, _D)),
    "dWorldSetQuickStepNumIterations": (None, (_V, _I)),
    "dWorldStep": (_I, (_V, _D)),
    "dWorldQuickStep": (_I, (_V, _D)),
    "dHashSpaceCreate": (_V, (_V,)),
    "dSpaceCollide": (None, (_V, _V, Near)),
    "dJointGroupCreate": (_V, (_I,)),
    "dJointGroupEmpty": (None, (_V,)),
    "dJointCreateContact": (_V, (_V, _V, POINTER(Contact))),
    "dJointAttach": (None, (_V, _V, _V)),
    **{f"dJointCreate{kind}": (_V, (_V, _V)) for kind in ("Hinge", "Ball", "Slider", "Fixed", "DBall", "Universal")},
    **{
        f"dJointSet{what}": (None, (_V, _D, _D, _D))
        for what in (
            "HingeAnchor",
            "HingeAxis",
            "BallAnchor",
            "SliderAxis",
            "DBallAnchor1",
            "DBallAnchor2",
            "UniversalAnchor",
            "UniversalAxis1",
            "UniversalAxis2",
        )
    },
    "dJointSetFixed": (None, (_V,)),
    **{f"dJointSet{kind}Param": (None, (_V, _I, _D)) for kind in ("Hinge", "Slider")},
    **{f"dJointGet{kind}Param": (_D, (_V, _I)) for kind in ("Hinge", "Slider")},
    "dJointAddHingeTorque": (None, (_V, _D)),
    "dJointAddSliderForce": (None, (_V, _D)),
    "dBodyCreate": (_V, (_V,)),
    "dBodySetKinematic": (None, (_V,)),
    "dBodySetMass": (None, (_V, POINTER(Mass))),
    "dBodyGetMass": (None, (_V, POINTER(Mass))),
    "dMassSetParameters": (None, (POINTER(Mass),) + (_D,) * 10),
    "dBodySetPosition": (None, (_V, _D, _D, _D)),
    "dBodySetQuaternion": (None, (_V, _R)),
    "dBodySetLinearVel": (None, (_V, _D, _D, _D)),
    "dBodySetAngularVel": (None, (_V, _D, _D, _D)),
    "dBodySetGyroscopicMode": (None, (_V, _I)),
    "dBodySetFiniteRotationMode": (None, (_V, _I)),
    "dBodyGetPosition": (_R, (_V,)),
    "dBodyGetQuaternion": (_R, (_V,)),
    "dBodyGetLinearVel": (_R, (_V,)),
    "dBodyGetAngularVel": (_R, (_V,)),
    "dBodyAddForce": (None, (_V, _D, _D, _D)),
    "dBodyGetLinearDamping": (_D, (_V,)),
    "dBodyGetAngularDamping": (_D, (_V,)),
    "dCreateBox": (_V, (_V, _D, _D, _D)),
    "dCreateSphere": (_V, (_V, _D)),
    "dCreateCylinder": (_V, (_V, _D, _D)),
    "dCreateCapsule": (_V, (_V, _D, _D)),
    "dCreatePlane": (_V, (_V, _D, _D, _D, _D)),
    "dGeomTriMeshDataCreate": (_V, ()),
    "dGeomTriMeshDataBuildDouble": (None, (_V, _V, _I, _I, _V, _I, _I)),
    "dCreateTriMesh": (_V, (_V,) * 5),
    "dGeomSetBody": (None, (_V, _V)),
    "dGeomGetBody": (_V, (_V,)),
    "dGeomSetPosition": (None, (_V, _D, _D, _D)),
    "dGeomSetQuaternion": (None, (_V, _R)),
    "dGeomSetOffsetPosition": (None, (_V, _D, _D, _D)),
    "dGeomSetOffsetQuaternion": (None, (_V, _R)),
    "dCollide": (_I, (_V, _V, _I, _V, _I)),
}


def reals(values: tuple[float, ...]) -> Any:
    """An array that ODE copies from."""
    return (c_double * len(values))(*values)


def load(folder: Path) -> CDLL:
    """@param folder of libode.so.8 and libccd.so.2. @raise OSError where the library is of single precision"""
    CDLL(str(folder / "libccd.so.2"), mode=RTLD_GLOBAL)
    library = CDLL(str(folder / "libode.so.8"))
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    if b"ODE_double_precision" not in library.dGetConfiguration():
        raise OSError(f"{folder}/libode.so.8 is not of double precision")
    library.dInitODE2(0)
    return library
