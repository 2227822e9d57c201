// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "files/job.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// Steady flow between two cylinders about z: u_theta = A r + B/r. Numbers: torque, on the inner one about z
/// [N m].
class CouetteCylinders : public LiquidReference {
 public:
  CouetteCylinders(const ReferenceInput& in, const Vec3& centre, double A, double B, double torque)
      : LiquidReference(in.job, in.initial), centre_(centre), A_(A), B_(B), torque_(torque) {}
  [[nodiscard]] Measuring measuring() const override { return {.axis = 2}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "torque") return torque_;
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double, std::size_t) const override {
    const double x = place.x - centre_.x, y = place.y - centre_.y, r2 = x * x + y * y;
    LiquidState s;
    s.velocity = (A_ + B_ / r2) * Vec3{-y, x, 0.0};
    return s;
  }

 private:
  Vec3 centre_;
  double A_, B_, torque_;
};

std::unique_ptr<Reference> make_cylinders(const ReferenceInput& in) {
  const auto liquid = only_liquid(in.job, "couette_cylinders"),
             inner = solid_body(in, Motion::prescribed, "couette_cylinders");
  const auto inner_radius = in.args.number("inner_radius"), outer_radius = in.args.number("outer_radius");
  if (!inner_radius || !outer_radius || !(*outer_radius > *inner_radius))
    throw InputError("couette_cylinders needs inner_radius below outer_radius");
  if (!in.job.scene.periodic[2] || !in.job.scene.min)
    throw InputError("couette_cylinders is periodic in z, along the cylinders");
  const double a2 = *inner_radius * *inner_radius, b2 = *outer_radius * *outer_radius,
               spin = in.job.bodies[inner].angular_velocity.z;
  const double A = -spin * a2 / (b2 - a2), B = spin * a2 * b2 / (b2 - a2);
  const double length = in.job.scene.max->z - in.job.scene.min->z;
  const double torque = -4.0 * std::numbers::pi * material_of_body(in.job, liquid).viscosity * B * length;
  return std::make_unique<CouetteCylinders>(in, in.job.bodies[inner].properties.centre, A, B, torque);
}

}  // namespace

ReferenceEntry couette_cylinders_entry() {
  return {{"couette_cylinders",
           "analytic",
           "Landau & Lifshitz, Fluid Mechanics, section 18: u = A r + B/r, torque 4 pi mu B a unit of length",
           "steady flow between a turning inner and a fixed outer cylinder about z",
           {{"inner_radius", "m", "of the turning cylinder; needed"},
            {"outer_radius", "m", "of the fixed one; needed"},
            {"body", "", "the turning cylinder; default the only prescribed body", ArgumentType::word}}},
          make_cylinders};
}

}  // namespace tripoint
