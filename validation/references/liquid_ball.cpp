// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// A liquid in rigid rotation feels no viscous torque; the printed (8) brakes it. Numbers: spin_rate, the
/// rate at which the angular momentum falls [1/s]: 0, or 5 nu/R^2 for a ball in the printed form.
class LiquidBall : public LiquidReference {
 public:
  LiquidBall(const ReferenceInput& in, const Vec3& centre, const Vec3& spin, double rate)
      : LiquidReference(in.job, in.initial), centre_(centre), spin_(spin), rate_(rate) {}
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "spin_rate") return rate_;
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double time, std::size_t) const override {
    LiquidState s;
    if (time <= 0.0) s.velocity = cross(spin_, place - centre_);  // later the ball disperses
    return s;
  }

 private:
  Vec3 centre_, spin_;
  double rate_;
};

std::unique_ptr<Reference> make_ball(const ReferenceInput& in) {
  const auto liquid = only_liquid(in.job, "liquid_ball");
  const auto& body = in.job.scene.bodies.at(liquid);
  if (body.shape.kind != Shape::Kind::sphere) throw InputError("liquid_ball holds for a sphere of liquid");
  if (norm(body.angular_velocity) == 0.0) throw InputError("liquid_ball: the liquid does not turn");
  const bool printed = in.args.form(Mode::corrected) == Mode::paper;
  const double rate =
      printed ? 5.0 * kinematic_viscosity(in.job, liquid) / (body.shape.radius * body.shape.radius) : 0.0;
  return std::make_unique<LiquidBall>(in, body.shape.centre, body.angular_velocity, rate);
}

}  // namespace

ReferenceEntry liquid_ball_entry() {
  return {{"liquid_ball",
           "analytic",
           "rigid rotation has no rate of strain; the printed form: 1/2 sum_ij of (8)'s torques over a "
           "homogeneous ball, 5 nu/R^2",
           "a free ball of liquid set in rigid rotation",
           {{"form", "", "corrected (no torque) or paper (the printed form's own braking); default corrected",
             ArgumentType::word}}},
          make_ball};
}

}  // namespace tripoint
