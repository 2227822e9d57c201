# SPDX-License-Identifier: BSD-3-Clause
"""Extended XYZ: ASE and OVITO read it. The species is X, since a particle is no atom; material and phase are
columns."""

from __future__ import annotations

from .files import digits, whole
from .lammps_dump import texts


def kind(name, values):
    """The column's entry of the key Properties."""
    return f":{name}:{'I' if values.dtype.kind in 'iu' else 'R'}:{1 if values.ndim == 1 else values.shape[1]}"


def write(run, out, frames):
    low, high, periodic = run.box()
    cell = " ".join(digits(high[i] - low[i] if i == j else 0.0) for i in range(3) for j in range(3))
    path = out / "particles.xyz"
    with whole(path) as file:
        for frame in run.frames(frames):
            names = [name for name in frame.fields if name != "position"]
            kinds = "".join(kind(name, frame[name]) for name in names)
            file.write(f"{len(frame)}\n")
            file.write(
                f'Lattice="{cell}" Origin="{" ".join(map(digits, low))}" '
                f'pbc="{" ".join("FT"[int(p)] for p in periodic)}" Properties=species:S:1:pos:R:3{kinds} '
                f"Time={digits(frame.time)} Step={frame.step}\n"
            )
            columns = [frame["position"][:, axis] for axis in range(3)]
            for name in names:
                columns += [frame[name]] if frame[name].ndim == 1 else list(frame[name].T)
            file.writelines("X " + " ".join(row) + "\n" for row in zip(*map(texts, columns)))
    return [path]
