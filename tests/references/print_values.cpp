// SPDX-License-Identifier: BSD-3-Clause
// Prints values of the references, one a line: name, arguments ..., = value. The NumPy twins in this folder
// compute them again.
#include <cstdio>

#include "validation/references/bar_law.hpp"
#include "validation/references/beam.hpp"
#include "validation/references/cosine_lattice.hpp"
#include "validation/references/neumann.hpp"
#include "validation/references/rigid_body.hpp"
#include "validation/references/step_images.hpp"
#include "validation/references/torque_free.hpp"
#include "validation/references/two_layers.hpp"

using namespace tripoint;

namespace {

void print_torque_free() {
  const Vec3 inertia{1.0 / 24.0, 0.095, 0.67 / 6.0};
  for (const Vec3& w : {Vec3{1, 2, 3}, Vec3{0.01, 5, 0.01}, Vec3{3, -0.5, 0.2}}) {
    const TorqueFree motion(inertia, {}, w);
    for (const double t : {0.7, 4.0, 10.0}) {
      const Quaternion q = motion.rotation(t);
      const Vec3 v = motion.angular_velocity(t);
      std::printf(
          "torque_free %.17g %.17g %.17g %.17g %.17g %.17g %.17g = %.17g %.17g %.17g %.17g %.17g %.17g "
          "%.17g\n",
          inertia.x, inertia.y, inertia.z, w.x, w.y, w.z, t, q.w, q.x, q.y, q.z, v.x, v.y, v.z);
    }
  }
}

void print_lattice() {
  for (const double ratio : {2.0, 2.12, 2.5, 2.6})
    for (const double n : {10.0, 20.0, 40.0})
      for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{1, 2, 0}}) {
        const Vec3 k = (6.283185307179586 / n) * direction;
        std::printf("lattice %.17g %.17g %.17g %.17g = %.17g %.17g\n", ratio, k.x, k.y, k.z,
                    paper_lattice_damping(k, 1.0, ratio), corrected_lattice_damping(k, 1.0, ratio));
      }
}

void print_step() {
  for (const int periodic : {0, 1})
    for (const double t : {0.5, 20.0, 800.0})
      for (const double x : {0.001, 0.013, 0.042})
        for (const double cell : {0.0, 0.002})
          std::printf("step %d %.17g %.17g %.17g = %.17g\n", periodic, t, x, cell,
                      share_of_low_side({{0, 0.0, 0.05, periodic == 1}, 0.017, 2e-6}, x, cell, t));
}

void print_layers() {
  const TwoLayerSolution s(
      {0.007, 0.007, 0.003, 2e-6, 2e-7, 1414.2135623730951, 447.21359549995793, 310.0, 300.0});
  for (const double t : {0.8, 8.0, 60.0})
    for (const double x : {0.0005, 0.0069, 0.0075, 0.0099})
      std::printf("layers %.17g %.17g = %.17g\n", t, x, s.at(x, t));
}

void print_beams() {
  for (const BeamTip& tip : {BeamTip{}, BeamTip{0.02, 0.0, 0.0}, BeamTip{0.5, 2e-4, 0.03}})
    for (const double height : {0.02, 0.05}) {
      const Beam b = rectangular_beam(0.2, height, 0.03, 1000.0, 2e6, 0.3975, true, 0.86);
      const auto sag = beam_sag(b, tip, 9.81, b.length);
      std::printf("beam %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g = %.17g %.17g %.17g\n",
                  b.length, b.bending, b.shear, b.mass, b.rotary, tip.mass, tip.inertia, tip.offset, 9.81,
                  sag.displacement, sag.rotation, beam_frequency(b, tip));
    }
  for (const double nu : {0.0, 0.3, 0.3975}) {
    const Beam b =
        rectangular_beam(10.0, 1.0, 1.0, 1.0, 1.0, nu, true, rectangular_shear_coefficient(nu, true));
    std::printf("plane %.17g %.17g %.17g = %.17g %.17g\n", 10.0, 1.0, nu,
                beam_sag(b, {}, 1.0, b.length).displacement, beam_frequency(b, {}));
  }
}

/// Stretched, let back and stretched again: state at the end of each way.
void print_bars() {
  for (const double ratio : {2.0, 2.12, 2.5, 2.6}) {
    const auto f = elastic_lattice_factors(ratio);
    std::printf("factors %.17g = %.17g %.17g\n", ratio, f.moment, f.volume);
  }
  for (const auto sides : {BarSides::free, BarSides::confined})
    for (const double cap : {1.0, 0.015})
      for (const double form : {0.5, 1.0}) {
        BarLaw law{1e7, 0.3, sides, 0.004, cap, form, form == 0.5 ? 1.0 : 0.9, form == 0.5 ? 1.0 : 0.95};
        BarState s;
        for (const double stretch : {1.03, 0.98, 1.02}) {
          s = stretched(law, s, stretch);
          std::printf("bar %d %.17g %.17g %.17g %.17g %.17g = %.17g %.17g %.17g %.17g\n",
                      sides == BarSides::free ? 0 : 1, cap, form, law.moment, law.volume, stretch, s.plastic,
                      s.force, s.elastic, s.dissipated);
        }
      }
}

void print_fronts() {
  for (const NeumannFront& f : {NeumannFront{1.0, 0.0, 0.0, 1.0, 1.0}, NeumannFront{1.0, 0.0, -0.5, 1.0, 0.5},
                                NeumannFront{-1.0, 0.0, 0.7, 1.0, 2.0}})
    std::printf("front %.17g %.17g %.17g = %.17g\n", f.surface, f.far, f.latent_over_capacity, f.lambda());
}

}  // namespace

int main() {
  print_torque_free();
  print_lattice();
  print_step();
  print_layers();
  print_beams();
  print_bars();
  print_fronts();
}
