// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/on_plane.hpp"
#include "validation/references/resting.hpp"

namespace tripoint {
namespace {

/// Height above the place of touch and speed, upward [m], [m/s].
struct Flight {
  double height = 0.0, speed = 0.0;
};

/// Parabolas between hits, each hit turning the speed round by the restitution. Numbers: touch_time, of the
/// first hit [s].
class Bouncing : public Reference {
 public:
  Bouncing(BoxOnFloor scene, Flight start, double gravity, double restitution)
      : scene_(std::move(scene)), start_(start), gravity_(gravity), restitution_(restitution) {}
  [[nodiscard]] Snapshot at(double time) const override {
    const auto now = flight(time);
    Snapshot out;
    out.time = time;
    out.bodies = scene_.start;
    auto& box = out.bodies[scene_.block];
    box.position[scene_.axis] = scene_.rest + scene_.up * now.height;
    box.velocity[scene_.axis] = scene_.up * now.speed;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = scene_.axis}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "touch_time") return until_touch(start_);
    return {};
  }

 private:
  [[nodiscard]] double until_touch(const Flight& f) const {
    return (f.speed + std::sqrt(f.speed * f.speed + 2.0 * gravity_ * f.height)) / gravity_;
  }
  [[nodiscard]] Flight flight(double time) const {
    auto f = start_;
    double left = time;
    for (double touch = until_touch(f); left > touch; touch = until_touch(f)) {
      left -= touch;
      f = {0.0, restitution_ * (gravity_ * touch - f.speed)};
      if (f.speed * f.speed < 1e-18 * gravity_ * start_.height) return {};  // hits without end: it lies
    }
    return {f.height + f.speed * left - 0.5 * gravity_ * left * left, f.speed - gravity_ * left};
  }

  BoxOnFloor scene_;
  Flight start_;
  double gravity_, restitution_;
};

std::unique_ptr<Reference> make_bouncing(const ReferenceInput& in) {
  auto scene = box_on_floor(in, "bouncing");
  const auto& box = in.job.bodies[scene.block];
  const Vec3 along =
      box.velocity - box.velocity[scene.axis] * Vec3{scene.axis == 0 ? 1.0 : 0.0, scene.axis == 1 ? 1.0 : 0.0,
                                                     scene.axis == 2 ? 1.0 : 0.0};
  if (norm(along) > 0.0 || norm(box.angular_velocity) > 0.0)
    throw InputError("bouncing holds for a box that falls straight and does not turn");
  const double of_scene = law_of_contact(in.job, "restitution").value_or(1.0);
  const double restitution = in.args.number("restitution").value_or(of_scene);
  if (restitution < 0.0 || restitution > 1.0) throw InputError("bouncing: the restitution lies from 0 to 1");
  const Flight start{scene.up * (box.properties.centre[scene.axis] - scene.rest),
                     scene.up * box.velocity[scene.axis]};
  if (!(start.height > 0.0)) throw InputError("bouncing: the box must start above the floor");
  return std::make_unique<Bouncing>(std::move(scene), start, norm(in.job.scene.gravity), restitution);
}

}  // namespace

ReferenceEntry bouncing_entry() {
  return {{"bouncing",
           "analytic",
           "Newton: parabolas between hits; each hit turns the speed round by the restitution",
           "a ball, or a box that falls flat, on a fixed floor: it bounces",
           {{"restitution", "1",
             "speed after a hit over that before it; default that of all engines' settings, 1 where they say "
             "none"}}},
          make_bouncing};
}

}  // namespace tripoint
