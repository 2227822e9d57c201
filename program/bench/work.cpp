// SPDX-License-Identifier: BSD-3-Clause
#include "program/bench/work.hpp"

#include <fmt/format.h>

#include "sampling/sample.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint::bench {
namespace {

/// The tank and the liquid of figure 12 two spacings of 10 mm wider, three times as fine: 40,000 particles.
const std::vector<std::string> wider_figure_12{
    "scene.spacing=0.0033333333333333335",
    R"(body.tank.shape={kind="difference",from={kind="box",min=[-0.07,-0.07,-0.02],max=[0.07,0.07,0.06]},minus={kind="box",min=[-0.05,-0.05,0.0],max=[0.05,0.05,0.07]}})",
    R"(body.cream.shape={kind="box",min=[-0.05,-0.05,0.0],max=[0.05,0.05,0.05]})"};
/// Figure 9 on a wider ground, and in larger blocks, three times as fine.
const std::vector<std::string> finer_figure_9{
    "scene.spacing=0.0033333333333333335",
    R"(body.ground.shape={kind="box",min=[-0.12,-0.08,-0.02],max=[0.12,0.08,0.0]})",
    R"(body."rigid block".shape={kind="box",min=[-0.08,-0.03,0.0],max=[-0.01,0.03,0.08]})",
    R"(body."elastic block".shape={kind="box",min=[0.01,-0.03,0.0],max=[0.08,0.03,0.08]})"};

/// The body and its copies, x fastest: boxes only, moved by whole pitches.
void copy_bodies(Scene& scene, const Work& work) {
  const int copies = work.copies;
  const double middle = 0.5 * (copies - 1);
  const std::vector<Body> once = std::move(scene.bodies);
  scene.bodies.clear();
  for (int n = 0; n < copies * copies * copies; ++n) {
    const Vec3 place{static_cast<double>(n % copies), static_cast<double>(n / copies % copies),
                     static_cast<double>(n / copies / copies)};
    const Vec3 by = work.pitch * place;
    for (Body b : once) {
      b.name += fmt::format(" {}", n);
      b.shape.min += by;
      b.shape.max += by;
      b.velocity.value = work.closing * work.pitch * (Vec3{middle, middle, middle} - place);
      scene.bodies.push_back(std::move(b));
    }
  }
}

}  // namespace

Work liquid_heat(int across, Mode mode) {
  Work w;
  w.name = "liquid-heat";
  w.case_id = "speed/liquid-heat";
  w.mode = mode;
  w.set = {fmt::format("scene.spacing={}", 0.34 / across), fmt::format("scene.time_step={}", 0.017 / across)};
  w.has_limit = true;
  return w;
}

const std::vector<Work>& standard_work() {
  static const std::vector<Work> list = [] {
    std::vector<Work> all;
    const auto named = [&](std::string_view name, Work w) {
      w.name = name;
      all.push_back(std::move(w));
    };
    named("liquid-heat-40k", liquid_heat(34, Mode::paper));
    named("liquid-heat-200k", liquid_heat(58, Mode::paper));
    named("liquid-heat-40k-corrected", liquid_heat(34, Mode::corrected));
    named("elastic-40k", {{}, "speed/elastic", Mode::corrected, {}});
    named("figure-9-paper", {{}, "paper/fig-09", Mode::paper, finer_figure_9});
    named("figure-9-corrected", {{}, "paper/fig-09", Mode::corrected, finer_figure_9});
    named("figure-12-paper", {{}, "paper/fig-12", Mode::paper, wider_figure_12});
    named("figure-12-corrected", {{}, "paper/fig-12", Mode::corrected, wider_figure_12});
    named("rigid-1000", {{}, "speed/rigid", Mode::corrected, {}, 10, 0.045, 2.0});
    return all;
  }();
  return list;
}

Start prepare(const Work& work) {
  const CaseReading reading = read_case(case_path(std::string(work.case_id)), work.set);
  RunChoice choice;
  choice.mode = work.mode;
  Start start{scene_for(reading.value, choice), {}};
  if (work.copies > 1) copy_bodies(start.scene, work);
  start.particles = sample(start.scene);
  return start;
}

}  // namespace tripoint::bench
