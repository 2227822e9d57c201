// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/elliptic_drop.hpp"

#include <cmath>

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// Numbers: half_length, b at the end of the run [m]; axis: the long one.
class EllipticDrop : public LiquidReference {
 public:
  EllipticDrop(const ReferenceInput& in, const Vec3& centre, double rate, double radius, double density)
      : LiquidReference(in.job, in.initial),
        centre_(centre),
        rate_(rate),
        radius_(radius),
        density_(density),
        end_(in.job.scene.end_time) {}
  [[nodiscard]] Measuring measuring() const override { return {.axis = 1}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "half_length") return elliptic_drop(rate_, radius_, end_).b;
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double time, std::size_t) const override {
    if (time != time_) {
      now_ = elliptic_drop(rate_, radius_, time);
      time_ = time;
    }
    const Vec3 d = place - centre_;
    LiquidState s;
    s.velocity = {-now_.rate * d.x, now_.rate * d.y, 0.0};
    const double change =
        now_.rate * now_.rate * (now_.a * now_.a - now_.b * now_.b) / (now_.a * now_.a + now_.b * now_.b);
    const double inside = now_.a * now_.a - d.x * d.x - d.y * d.y * now_.a * now_.a / (now_.b * now_.b);
    s.pressure = std::max(0.0, 0.5 * density_ * (now_.rate * now_.rate - change) * inside);
    return s;
  }

 private:
  Vec3 centre_;
  double rate_, radius_, density_, end_;
  mutable DropState now_;
  mutable double time_ = not_a_number;
};

std::unique_ptr<Reference> make_drop(const ReferenceInput& in) {
  const auto liquid = only_liquid(in.job, "elliptic_drop");
  const auto& body = in.job.scene.bodies.at(liquid);
  const auto& g = body.velocity.gradient;
  const bool drawn = body.velocity.kind == VelocityField::Kind::linear && g[0].x == -g[1].y && g[1].y > 0.0 &&
                     g[0].y == 0.0 && g[1].x == 0.0 && g[2] == Vec3{};
  if (body.shape.kind != Shape::Kind::cylinder || is_turned(body.shape) || !drawn)
    throw InputError(
        "elliptic_drop needs a cylinder of liquid along z with the velocity (-A x, A y, 0), A > 0");
  return std::make_unique<EllipticDrop>(in, body.velocity.centre, g[1].y, body.shape.radius,
                                        material_of_body(in.job, liquid).density);
}

}  // namespace

DropState elliptic_drop(double rate, double radius, double time) {
  DropState s{rate, radius, radius};
  const auto slope = [&](double A, double a) {
    const double b = radius * radius / a;
    return std::pair{A * A * (a * a - b * b) / (a * a + b * b), -A * a};
  };
  const int steps = std::max(1, static_cast<int>(std::ceil(time * rate / 1e-3)));
  const double h = time / steps;
  for (int n = 0; n < steps; ++n) {
    const auto [k1, l1] = slope(s.rate, s.a);
    const auto [k2, l2] = slope(s.rate + 0.5 * h * k1, s.a + 0.5 * h * l1);
    const auto [k3, l3] = slope(s.rate + 0.5 * h * k2, s.a + 0.5 * h * l2);
    const auto [k4, l4] = slope(s.rate + h * k3, s.a + h * l3);
    s.rate += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    s.a += h / 6.0 * (l1 + 2.0 * (l2 + l3) + l4);
  }
  s.b = radius * radius / s.a;
  return s;
}

ReferenceEntry elliptic_drop_entry() {
  return {
      {"elliptic_drop",
       "analytic",
       "Monaghan, Simulating free surface flows with SPH, 1994: ordinary differential equations of the axes",
       "a round drop drawn out to an ellipse, without gravity",
       {}},
      make_drop};
}

}  // namespace tripoint
