# SPDX-License-Identifier: BSD-3-Clause
"""A script that opens the frames in ParaView: `pvpython view.py picture.png`, or Tools, Python Shell, Run Script."""

from __future__ import annotations

import numpy as np

from . import vtk_files
from .files import whole

SCRIPT = """# Opens frames.pvd beside this file, coloured by {colour}; with a file's name as argument it saves the \
last frame as a picture.
#   pvpython view.py picture.png
import os
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetAnimationScene, GetColorTransferFunction, PVDReader, \
Render,
                             ResetCamera, SaveScreenshot, Show)

folder = os.path.dirname(os.path.abspath(__file__))
particles = PVDReader(registrationName="particles", FileName=os.path.join(folder, "frames.pvd"))
animation = GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
animation.GoToLast()
view = GetActiveViewOrCreate("RenderView")
shown = Show(particles, view)
shown.SetRepresentationType("Point Gaussian")
shown.GaussianRadius = {radius!r}  # half a spacing [m]
ColorBy(shown, ("POINTS", {colour!r}))
GetColorTransferFunction({colour!r}).RescaleTransferFunction({low!r}, {high!r})
shown.SetScalarBarVisibility(view, True)
view.CameraParallelProjection = 1
view.CameraPosition = {eye!r}
view.CameraFocalPoint = {centre!r}
view.CameraViewUp = {up!r}
ResetCamera(view)
Render(view)
if len(sys.argv) > 1:
    SaveScreenshot(sys.argv[1], view, ImageResolution=[1600, 1000])
"""


def write(run, out, frames):
    """view.py, and the frames that it opens."""
    made = vtk_files.write(run, out, frames)
    numbers = list(range(len(run))) if frames is None else list(frames)
    colour = "temperature" if "temperature" in run.fields else "velocity"
    least, greatest = ends_of([run.field(colour, number) for number in {*numbers[:1], *numbers[-1:]}])
    low, high, _ = run.box()
    centre, size = (low + high) / 2, float(np.linalg.norm(high - low)) or 1.0
    up = up_of(run)
    thinnest = np.argmin(np.where(np.abs(up) > 0.5, np.inf, high - low))  # direction that is not up
    aside = np.eye(3)[int(thinnest)]
    spacing = (run.job.get("resolution") or {}).get("spacing") or size / 50
    script = out / "view.py"
    with whole(script) as file:
        file.write(
            SCRIPT.format(
                colour=colour,
                radius=float(spacing) / 2,
                low=least,
                high=greatest if greatest > least else least + 1.0,
                eye=(centre - aside * 2 * size + up * 0.3 * size).tolist(),
                centre=centre.tolist(),
                up=up.tolist(),
            )
        )
    return [script, *made]


def ends_of(columns):
    """Least and greatest number of some columns, of vectors their lengths."""
    values = [np.linalg.norm(v, axis=1) if v.ndim == 2 else v for v in columns]
    finite = np.concatenate([np.zeros(0), *(v[np.isfinite(v)] for v in values)])
    return (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)


def up_of(run):
    gravity = np.array(run.scene().get("gravity") or [0.0, 0.0, 0.0], dtype=float)
    size = np.linalg.norm(gravity)
    return -gravity / size if size > 0 else np.array([0.0, 0.0, 1.0])
