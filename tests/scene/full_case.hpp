// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace tripoint::test {

/// A case that says every key of the contract once.
inline const std::string full_case = R"toml(format = 1
[case]
id = "test/full"
title = "Everything at once"
requirement = "reads all"
claims = "every key is read"
kind = "comparison"
profiles = ["commit", "nightly"]
tags = ["all"]
expect = "pass"
modes = ["corrected", "paper"]

[scene]
end_time = "2 s"
gravity = [0, 0, -9.81]
spacing = "5 cm"
support_ratio = 2.6
mode = "corrected"
modes.heat = "paper"
time_step = "1 ms"
seed = 11
jitter = 0.1
min = [0, 0, 0]
max = [2, 2, 2]
periodic = ["x"]
output_interval = 0.1
viscosity_form = "laplacian"
transport_velocity = false
clamp = false
merge_distance = 1.6
hourglass = 0.5
bending = 0.5
bulk_viscosity = 0.1
surface_weight = 0.4
isotropic_shear = 0.5
core_reach = 0.6
contact_stiffness = 3
contact_step = 0.5
face_pressure = 1
interface_weight = 1
mean_pressure = 1
sound_damping = 0.2
surface_exchange = 0
contact_viscosity = 0.1
on_failure = "recover"
unguarded = ["escape", "ledger"]

[[material]]
name = "goo"
density = "1.1 g/cm3"
viscosity = 2
sound_speed = 20
young_modulus = "2 MPa"
poisson_ratio = 0.3
conductivity = 0.5
heat_capacity = "3 kJ/kg/K"
t_melt = 330
t_solid = 320
latent_heat = 1e5
solid = "elastic"
softens = true
elastic_limit = 0.01
plastic_limit = 0.5
fracture_stretch = 1.5
fracture_distance = 2.5
source = "invented for this test"

[[material]] # as printed, heat knows one phase: no body is of this
name = "slush"
density = 900
conductivity = 0.5
heat_capacity = "4 kJ/kg/K"
solid_conductivity = 2.2
surface_temperature = 280
solid_heat_capacity = "2 kJ/kg/K"
t_melt = 273
latent_heat = 3e5

[[body]]
name = "pool"
material = "goo"
phase = "liquid"
shape = {kind = "box", min = [0, 0, 0], max = [2, 2, 0.5]}
velocity = {kind = "linear", centre = [1, 1, 0], gradient = [[1, 0, 0], [0, -1, 0], [0, 0, 0]]}
angular_velocity = [0, 0, "10 deg/s"]
temperature = {kind = "cosine", mean = 350, amplitude = 5, wave_vector = [3.14, 0, 0], phase = 0.5}

[[body]]
name = "plate"
material = "goo"
phase = "rigid"
shape = {kind = "difference", from = {kind = "cylinder", base = [1, 1, 0.6], axis = [0, 0, 2], length = 0.3, radius = 0.5}, minus = {kind = "half_space", point = [1, 1, 0.7], normal = [0, 0, 1]}}
motion = "prescribed"
keyframes = [{time = 0, position = [1, 1, 0.8]}, {time = 2, position = [1, 1, 1], rotation = [0.7071067811865476, 0, 0, 0.7071067811865476]}]
temperature = {kind = "step", point = [1, 1, 0.8], normal = [1, 0, 0], behind = 300, ahead = 310}
temperature_held = true
slip = "free"
jitters = false
joins = true

[[body]]
name = "beam"
material = "goo"
phase = "elastic"
shape = {kind = "box", min = [0.5, 0.9, 1.0], max = [1.5, 1.1, 1.2]}
velocity = {kind = "cosine", mean = [0, 0, 0], amplitude = [0, 0, 0.1], wave_vector = [6.28, 0, 0]}
temperature = 300
joined_to = ["plate"]

[[body]]
name = "drop"
material = "goo"
phase = "liquid"
shape = {kind = "union", of = [{kind = "sphere", centre = [0.5, 0.5, 1.5], radius = 0.2}, {kind = "sphere", centre = [0.7, 0.5, 1.5], radius = 0.2}]}
velocity = {kind = "expression", value = ["-y", "x", "0"]}
temperature = {kind = "expression", value = "340 + 5*sin(pi*x)"}

[[body]]
name = "swirl"
material = "goo"
phase = "liquid"
shape = {kind = "box", min = [1.5, 1.5, 1.5], max = [1.9, 1.9, 1.9]}
velocity = {kind = "taylor_green", speed = 1, wavelength = 0.4}
temperature = "80 degC"

[[event]]
time = 0.5
kind = "merge"
bodies = ["beam", "plate"]
[[event]]
time = 0.6
kind = "split"
name = "half"
region = {kind = "half_space", point = [1, 1, 1], normal = [1, 0, 0]}
[[event]]
time = 0.7
kind = "heat"
bodies = ["pool"]
temperature = 400
until = 0.9
[[event]]
time = 0.8
kind = "hold"
bodies = ["drop"]
until = 1.0
[[event]]
time = 1.0
kind = "release"
bodies = ["drop"]
[[event]]
time = 1.1
kind = "grip"
name = "hand"
region = {kind = "sphere", centre = [1, 1, 1], radius = 0.3}
keyframes = [{time = 1.1, position = [1, 1, 1]}, {time = 1.5, position = [1, 1, 1.5]}]

[[inflow]]
material = "goo"
shape = {kind = "cylinder", base = [1, 1, 1.9], length = 0.1, radius = 0.1}
velocity = [0, 0, -1]
temperature = 350
start = 0.1
stop = 1.5
rate = "2 L/min"

[engines.bullet]
required = true
preset = ["default", "impact"]
[engines.lammps]
preset = "walkers"
settings = {walkers = 1000, conduction = "walkers", fast = true, weights = [1, 2]}

[reference]
kind = "analytic"
function = "cosine_mode"
args = {wave_number = 1, note = "x"}
source = "Carslaw and Jaeger 1959"
uncertainty = 0.01

[[metric]]
name = "error"
quantity = "temperature"
norm = "L2"
body = "pool"
at = "end"
window = [0.5, 2]
scale = 5
unit = "of the amplitude"
[[metric]]
name = "drift"
quantity = "ledger.thermal"
reference = {kind = "bound", source = "conservation", uncertainty = 1e-12}

[[study]]
axis = "spacing"
levels = ["10 cm", 0.05, 0.025]
jitter = 0.1
seeds = 3
engine = "lammps"
mode = "corrected"
expect = "asymptotic"
order = 2
metric = "error"

[[gate]]
metric = "error"
engine = "lammps"
mode = "corrected"
preset = "walkers"
limit = 0.01
level = 0.05
reason = "twice the measured error"
by = "A. Tester"
date = "2026-01-01"
[[gate]]
metric = "error.order"
band = [1.8, 2.2]
reason = "second order"
[[gate]]
metric = "drift"
at_least = -1e-12
reason = "round-off"

[[defect]]
name = "heat.conductivity"
size = 0.05
killed_by = "error"

[[harmless]]
name = "order"
)toml";

}  // namespace tripoint::test
