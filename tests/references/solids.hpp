// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "references/liquids.hpp"

/// Scenes with elastic solids for the tests of references and metrics, made by hand.
namespace tripoint::test {

struct Elasticity {
  double young = 2e6, poisson_ratio = 0.3;
};

inline void make_elastic(Prepared& s, std::size_t material, const Elasticity& e) {
  s.job.scene.materials.at(material).young_modulus = e.young;
  s.job.scene.materials.at(material).poisson_ratio = e.poisson_ratio;
}

/// A beam of 20 x 2 x 2 spacings of 0.01 m along x in plane strain (periodic in y), held at its low end,
/// gravity along -z, a rigid tip if wished.
inline Prepared beam(double gravity, bool tip = false) {
  Prepared s;
  const double dx = 0.01;
  s.job.scene.spacing = dx;
  s.job.scene.gravity = {0, 0, -gravity};
  add_matter(s, "beam", Phase::elastic, {{20, 2, 2}, dx, {}, 1.0}, {}, 1000.0);
  add_matter(s, "clamp", Phase::rigid, {{3, 2, 2}, dx, {-3 * dx, 0, 0}, 1.0}, {}, 1000.0, 0.0, Motion::fixed);
  if (tip) add_matter(s, "tip", Phase::rigid, {{4, 2, 4}, dx, {20 * dx, 0, -dx}, 1.0}, {}, 5000.0);
  make_elastic(s, 0, {2e6, 0.3975});
  close_box(s, {-1, 0, -1}, {1, 2 * dx, 1}, {false, true, false});
  set_times(s, 0.5, 100);
  return s;
}

/// A bar of 20 x 4 x 4 spacings of 0.01 m along x between a fixed and a driven block: out to `stretch` in 1
/// s, back in the next.
inline Prepared driven_bar(double stretch, const std::array<bool, 3>& periodic = {}) {
  Prepared s;
  const double dx = 0.01;
  s.job.scene.spacing = dx;
  add_matter(s, "bar", Phase::elastic, {{20, 4, 4}, dx, {}, 1.0}, {}, 1000.0);
  add_matter(s, "held", Phase::rigid, {{3, 4, 4}, dx, {-3 * dx, 0, 0}, 1.0}, {}, 1000.0, 0.0, Motion::fixed);
  add_matter(s, "pulled", Phase::rigid, {{3, 4, 4}, dx, {20 * dx, 0, 0}, 1.0}, {}, 1000.0, 0.0,
             Motion::prescribed);
  make_elastic(s, 0, {1e7, 0.3});
  const Vec3 start = s.job.bodies[2].properties.centre, far = start + Vec3{20 * dx * (stretch - 1.0), 0, 0};
  s.job.bodies[2].keyframes = {{0.0, start, {}}, {1.0, far, {}}, {2.0, start, {}}};
  close_box(s, {-1, 0, 0}, {1, 4 * dx, 4 * dx}, periodic);
  set_times(s, 2.0, 200);
  return s;
}

}  // namespace tripoint::test
