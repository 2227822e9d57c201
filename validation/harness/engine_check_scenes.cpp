// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/engine_check.hpp"

namespace tripoint {

const std::vector<CheckScene>& check_scenes() {
  static const std::vector<CheckScene> scenes{
      {"flight", R"(format = 1
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
)", false},
      {"conduction", R"(format = 1
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
)", true}};
  return scenes;
}

}  // namespace tripoint
