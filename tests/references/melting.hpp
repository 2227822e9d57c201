// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "references/liquids.hpp"

/// Scenes that melt and freeze for the tests of references and metrics, made by hand.
namespace tripoint::test {

struct Heating {
  double wall = 400.0, bar = 300.0;  ///< [K]; the change is at 300 K upwards, 290 K downwards
  bool from_above = false;           ///< the wall stands at the bar's high end
};

/// A bar of 40 x 2 x 2 spacings of 1 mm along x, D = 2e-6 m2/s, L/c_p = 100 K, beside a wall of 3 layers;
/// periodic in y and z.
inline Prepared stefan_bar(const Heating& h) {
  Prepared s;
  const double dx = 1e-3;
  s.job.scene.spacing = dx;
  add_matter(s, "bar", h.wall > h.bar ? Phase::rigid : Phase::liquid, {{40, 2, 2}, dx, {}, 1.0}, {}, 1000.0);
  add_matter(s, "wall", Phase::rigid, {{3, 2, 2}, dx, {h.from_above ? 40 * dx : -3 * dx, 0, 0}, 1.0}, {},
             1000.0, 0.0, Motion::fixed);
  for (auto& m : s.job.scene.materials) {
    m.conductivity = 2.0;
    m.heat_capacity = 1000.0;
  }
  auto& m = s.job.scene.materials[0];
  m.t_melt = 300.0;
  m.t_solid = 290.0;
  m.latent_heat = 1e5;
  m.solid = SolidKind::rigid;
  const double temperature[] = {h.bar, h.wall};
  for (std::size_t b = 0; b < 2; ++b) {
    TemperatureField field;
    field.value = temperature[b];
    s.job.scene.bodies[b].temperature = field;
  }
  s.job.bodies[1].temperature_held = true;
  close_box(s, {-1, 0, 0}, {1, 2 * dx, 2 * dx}, {false, true, true});
  set_times(s, 20.0, 20);
  return s;
}

/// A block that heat events at 1, 2, 3 and 4 s set to 310, 295, 280 and 295 K.
inline Prepared heated_block() {
  Prepared s;
  s.job.scene.spacing = 0.1;
  add_matter(s, "block", Phase::elastic, {{2, 2, 2}, 0.1, {}, 1.0}, {}, 1000.0);
  auto& m = s.job.scene.materials[0];
  m.t_melt = 300.0;
  m.t_solid = 290.0;
  m.solid = SolidKind::elastic;
  const double temperature[] = {310.0, 295.0, 280.0, 295.0};
  for (int n = 0; n < 4; ++n) {
    Event e;
    e.kind = Event::Kind::heat;
    e.time = n + 1.0;
    e.bodies = {"block"};
    e.temperature = temperature[n];
    s.job.scene.events.push_back(e);
  }
  set_times(s, 5.0, 50);
  return s;
}

}  // namespace tripoint::test
