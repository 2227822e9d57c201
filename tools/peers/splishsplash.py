# SPDX-License-Identifier: BSD-3-Clause
"""One timed run of SPlisHSPlasH on the particles of a standard work; prints one JSON line.

    splishsplash.py START.npz METHOD SPACING TIME_STEP WARM STEPS

METHOD: wcsph, or becker (WCSPH with the elasticity of Becker et al. 2009). Runs in the virtual environment that holds
the wheel, which wants the system's libGLdispatch.so.0 in LD_PRELOAD where there is no display. Particles fly freely: no
walls, no gravity."""

import json
import os
import sys
import tempfile
import time

import numpy
import pysplishsplash

WCSPH = 0


def scene(across, spacing, time_step, method):
    """A block of the wanted number of particles; its places and velocities are replaced before the first step."""
    material = {"id": "Fluid", "density0": 1000, "viscosityMethod": 1, "Standard viscosity": {"viscosity": 0.002}}
    if method == "becker":
        material |= {
            "viscosityMethod": 0,
            "elasticityMethod": 1,
            "Becker et al. 2009": {"youngsModulus": 1e5, "poissonsRatio": 0.3, "alpha": 0.0},
        }
    end = [spacing * (n + 1.3) for n in across]
    return {
        "Configuration": {
            "particleRadius": spacing / 2,
            "numberOfStepsPerRenderUpdate": 1,
            "simulationMethod": WCSPH,
            "gravitation": [0, 0, 0],
            "cflMethod": 0,
            "timeStepSize": time_step,
            "WCSPH": {"stiffness": 14285.7, "exponent": 7},
        },  # c2 = 7 stiffness / density
        "Materials": [material],
        "FluidBlocks": [{"denseMode": 0, "start": [0.0, 0.0, 0.0], "end": end}],
    }


def main():
    start, method = numpy.load(sys.argv[1]), sys.argv[2]
    spacing, time_step = float(sys.argv[3]), float(sys.argv[4])
    warm, steps = int(sys.argv[5]), int(sys.argv[6])
    folder = tempfile.mkdtemp()
    path = os.path.join(folder, "scene.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene(start["across"].tolist(), spacing, time_step, method), file)
    base = pysplishsplash.Exec.SimulatorBase()
    base.init(sceneFile=path, useGui=False, initialPause=False, outputDir=folder, useCache=False, stopAt=1e9)
    base.initSimulation()
    simulation = pysplishsplash.Simulation.getCurrent()
    fluid = simulation.getFluidModel(0)
    count = fluid.numActiveParticles()
    if count != len(start["position"]):
        sys.exit(f"SPlisHSPlasH filled the block with {count} particles, not {len(start['position'])}")
    for i, (position, velocity) in enumerate(
        zip(start["position"].astype(numpy.float32), start["velocity"].astype(numpy.float32))
    ):
        if method == "wcsph":  # an elastic body keeps the places that its reference shape was made from
            fluid.setPosition(i, position)
        fluid.setVelocity(i, velocity)
    progress = {"step": 0, "begin": 0.0, "cpu": 0.0}

    def after_step():
        progress["step"] += 1
        if progress["step"] == warm:
            progress.update(begin=time.perf_counter(), cpu=time.process_time())
        if progress["step"] == warm + steps:
            seconds, cpu = (
                (time.perf_counter() - progress["begin"]) / steps,
                (time.process_time() - progress["cpu"]) / steps,
            )
            sample = range(0, count, 37)
            neighbours = sum(simulation.numberOfNeighbors(0, 0, i) for i in sample) / len(sample)
            print(
                "RESULT "
                + json.dumps(
                    {
                        "particles": count,
                        "step_s": seconds,
                        "cpu_s": cpu,
                        "neighbours": neighbours,
                        "rebuilds_per_step": 1.0,
                    }
                ),
                flush=True,
            )
            os._exit(0)

    base.setTimeStepCB(after_step)
    base.runSimulation()


main()
