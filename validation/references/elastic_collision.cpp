// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"

namespace tripoint {
namespace {

/// Two free boxes that meet face to face and centre to centre, without friction or loss. Paths are straight,
/// and at touch the velocities along the line of centres change as those of points. Numbers: event_time of
/// the touch [s], axis.
class ElasticCollision : public Reference {
 public:
  ElasticCollision(const ReferenceInput& in, std::size_t axis, double touch)
      : job_(in.job), initial_(in.initial), axis_(axis), touch_(touch) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    for (const auto& body : job_.bodies) {
      BodyState s;
      const Vec3 after = after_touch(body);
      s.velocity = time < touch_ ? body.velocity : after;
      s.position = body.properties.centre + std::min(time, touch_) * body.velocity +
                   std::max(0.0, time - touch_) * after;
      s.mass = body.properties.mass;
      out.bodies.push_back(s);
    }
    for (std::size_t i = 0; i < initial_.size(); ++i) {
      const auto b = static_cast<std::size_t>(initial_.source[i]);
      out.position.push_back(initial_.position[i] +
                             (out.bodies[b].position - job_.bodies[b].properties.centre));
      out.velocity.push_back(out.bodies[b].velocity);
    }
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "event_time" || quantity == "touch_time") return touch_;
    return {};
  }

 private:
  /// v' = 2 v_mean - v along the axis, v_mean that of the common centre of mass.
  [[nodiscard]] Vec3 after_touch(const JobBody& body) const {
    const auto &a = job_.bodies[0], &b = job_.bodies[1];
    const double ma = a.properties.mass, mb = b.properties.mass;
    const double mean = (ma * a.velocity[axis_] + mb * b.velocity[axis_]) / (ma + mb);
    Vec3 v = body.velocity;
    v[axis_] = 2.0 * mean - v[axis_];
    return v;
  }
  Job job_;
  InitialState initial_;
  std::size_t axis_;
  double touch_;
};

std::unique_ptr<Reference> make_collision(const ReferenceInput& in) {
  const auto& bodies = in.job.bodies;
  if (bodies.size() != 2 || norm(in.job.scene.gravity) > 0.0)
    throw InputError("elastic_collision holds for two bodies without gravity");
  const Vec3 approach = bodies[0].velocity - bodies[1].velocity;
  const auto axis = axis_of(approach, "elastic_collision: the bodies' relative velocity");
  for (const auto& b : bodies)
    if (b.motion != Motion::free || b.phase == Phase::liquid || norm(b.angular_velocity) > 0.0)
      throw InputError("elastic_collision: body `" + b.name + "` must be a free rigid body without spin");
  for (std::size_t k = 0; k < 3; ++k)
    if (k != axis && std::abs(bodies[0].properties.centre[k] - bodies[1].properties.centre[k]) >
                         1e-9 * in.job.scene.spacing)
      throw InputError("elastic_collision: an off-centre hit has no exact path");
  const auto a = body_along(axis, 0, in.job, in.initial), b = body_along(axis, 1, in.job, in.initial);
  const bool ahead = a.low < b.low;
  const double gap = ahead ? b.low - a.high : a.low - b.high,
               speed = ahead ? approach[axis] : -approach[axis];
  if (!(gap > 0.0) || !(speed > 0.0))
    throw InputError("elastic_collision: the bodies must start apart and approach each other");
  return std::make_unique<ElasticCollision>(in, axis, gap / speed);
}

}  // namespace

ReferenceEntry elastic_collision_entry() {
  return {{"elastic_collision",
           "analytic",
           "momentum and energy of two bodies: v' = 2 v_mean - v along the line of centres",
           "central, face to face, loss-free collision of two free boxes",
           {}},
          make_collision};
}

}  // namespace tripoint
