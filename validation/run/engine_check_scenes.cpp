// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/engine_check.hpp"

namespace tripoint {
namespace {

/// Test for every engine: gravity, and the units of velocity, time and length.
constexpr const char* flight_case = R"(format = 1
[case]
title = "A cube thrown with a spin"
[scene]
end_time = 0.5
gravity = [0.0, 0.0, -9.81]
spacing = 0.1
time_step = 0.005
output_interval = 0.05
[[material]]
name = "stuff"
density = 1000.0
[[body]]
name = "cube"
material = "stuff"
phase = "rigid"
shape = { kind = "box", min = [0.0, 0.0, 0.0], max = [0.3, 0.3, 0.3] }
velocity = [1.0, 0.5, 2.0]
angular_velocity = [0.0, 0.0, 2.0]
[reference]
kind = "analytic"
function = "ballistic"
source = "the parabola"
[[metric]]
name = "position"
quantity = "position"
norm = "max"
[[gate]]
metric = "position"
limit = 0.1
reason = "units: a tenth of a second's flight"
)";

/// Test for engines that conduct heat: temperatures of a body that stands still.
constexpr const char* conduction_case = R"(format = 1
[case]
title = "Half a cosine of temperature in a bar"
[scene]
end_time = 5.0
spacing = 0.001
output_interval = 1.0
min = [-0.005, 0.0, 0.0]
max = [0.025, 0.004, 0.004]
periodic = ["y", "z"]
[[material]]
name = "stuff"
density = 1000.0
conductivity = 1.0
heat_capacity = 1000.0
[[body]]
name = "bar"
material = "stuff"
phase = "rigid"
motion = "fixed"
shape = { kind = "box", min = [0.0, 0.0, 0.0], max = [0.02, 0.004, 0.004] }
temperature = { kind = "step", point = [0.01, 0.0, 0.0], normal = [1.0, 0.0, 0.0], behind = 310.0, ahead = 300.0 }
[reference]
kind = "analytic"
function = "step_insulated"
source = "error functions and their images"
[[metric]]
name = "temperature"
quantity = "temperature"
norm = "L2"
at = "end"
scale = 10.0
[[gate]]
metric = "temperature"
limit = 0.2
reason = "units: a fifth of the step"
)";

/// Test for engines of elastic bodies: a modulus, and a body that is clamped.
constexpr const char* elasticity_case = R"(format = 1
[case]
title = "A bar clamped at one end, let go under gravity along it"
[scene]
end_time = 0.0252982 # 2 L/c: the tip is at its lowest
gravity = [9.81, 0.0, 0.0]
spacing = 0.025
output_interval = 0.00316228
[[material]]
name = "band"
density = 1000.0
young_modulus = 1e6
poisson_ratio = 0.0
[[body]]
name = "bar"
material = "band"
phase = "elastic"
shape = { kind = "box", min = [0.0, -0.05, -0.05], max = [0.4, 0.05, 0.05] }
joined_to = ["clamp"]
[[body]]
name = "clamp"
material = "band"
phase = "rigid"
motion = "fixed"
shape = { kind = "box", min = [-0.075, -0.05, -0.05], max = [0.0, 0.05, 0.05] }
[reference]
kind = "bound"
function = "stated"
source = "d'Alembert: the tip falls to rho g L^2/E, twice its rest"
args = { point = [0.4, 0.0, 0.0], axis = "x", value = 0.0015696 }
[[metric]]
name = "tip"
quantity = "displacement"
norm = "final"
body = "bar"
scale = 0.0015696
[[gate]]
metric = "tip"
limit = 0.2
reason = "units: a fifth of the way"
)";

/// Test for engines of liquids: the fall of a block that nothing touches.
constexpr const char* liquid_case = R"(format = 1
[case]
title = "A block of liquid falls freely"
[scene]
end_time = 0.1
gravity = [0.0, 0.0, -9.81]
spacing = 0.02
output_interval = 0.02
[[material]]
name = "water"
density = 1000.0
sound_speed = 10.0
[[body]]
name = "water"
material = "water"
phase = "liquid"
shape = { kind = "box", min = [0.0, 0.0, 1.0], max = [0.1, 0.1, 1.1] }
[reference]
kind = "bound"
function = "stated"
source = "the parabola"
args = { axis = "z", value = 1.00095 }
[[metric]]
name = "height"
quantity = "centre"
norm = "final"
body = "water"
scale = 0.04905
[[gate]]
metric = "height"
limit = 0.2
reason = "units: a fifth of the fall"
)";

}  // namespace

const std::vector<CheckScene>& check_scenes() {
  static const std::vector<CheckScene> scenes{{"flight", flight_case, ""},
                                              {"conduction", conduction_case, "heat"},
                                              {"elasticity", elasticity_case, "elastic"},
                                              {"liquid", liquid_case, "liquid"}};
  return scenes;
}

}  // namespace tripoint
