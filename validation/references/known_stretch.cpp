// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/solid_scene.hpp"

namespace tripoint {
namespace {

/// A body whose stretch along one axis is known, the same at all times. Numbers: bar, axis, stretch.
class KnownStretch : public Reference {
 public:
  KnownStretch(std::size_t bar, std::size_t axis, double stretch)
      : bar_(bar), axis_(axis), stretch_(stretch) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_, .bar = bar_}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "stretch") return stretch_;
    return {};
  }

 private:
  std::size_t bar_, axis_;
  double stretch_;
};

/// (E u')' = -rho w^2 x with free ends: u = rho w^2 (R^2 x - x^3/3)/(2 E), read at the last layer of
/// particles.
std::unique_ptr<Reference> make_rod(const ReferenceInput& in) {
  const auto rod = elastic_body(in, "spinning_rod");
  const auto axis = long_axis(in, rod);
  const auto& body = in.job.bodies[rod];
  const Vec3 w = body.angular_velocity;
  if (norm(w) == 0.0 || std::abs(w[axis]) > 1e-12 * norm(w))
    throw InputError("spinning_rod: the rod must spin across its length");
  const double R = 0.5 * extents(in, rod)[axis], x = R - 0.5 * in.job.scene.spacing;
  const double load =
      in.job.scene.material(body.material).density * dot(w, w) / elastic_constants(in.job, rod).young;
  return std::make_unique<KnownStretch>(rod, axis, 1.0 + 0.5 * load * (R * R - x * x / 3.0));
}

std::unique_ptr<Reference> make_pressed(const ReferenceInput& in) {
  const auto block = elastic_body(in, "pressed_block");
  const auto pressure = in.args.number("pressure");
  if (!pressure) throw InputError("pressed_block needs the argument `pressure`");
  const auto e = elastic_constants(in.job, block);
  return std::make_unique<KnownStretch>(block, long_axis(in, block),
                                        1.0 - *pressure * (1.0 - 2.0 * e.poisson_ratio) / e.young);
}

}  // namespace

ReferenceEntry spinning_rod_entry() {
  return {
      {"spinning_rod",
       "analytic",
       "Timoshenko & Goodier, Theory of Elasticity: rod in rotation, u = rho w^2 (R^2 x - x^3/3)/(2 E)",
       "steady stretch of a slender elastic box that spins about its centre across its length, small strains",
       {{"body", "", "the rod; default the scene's only free elastic body", ArgumentType::word}}},
      make_rod};
}

ReferenceEntry pressed_block_entry() {
  return {{"pressed_block",
           "analytic",
           "Hooke: strain -p (1 - 2 nu)/E under pressure from all sides",
           "stretch of an elastic block under an even pressure, small strains",
           {{"pressure", "Pa", "on all sides; required"},
            {"body", "", "the block; default the scene's only free elastic body", ArgumentType::word}}},
          make_pressed};
}

}  // namespace tripoint
