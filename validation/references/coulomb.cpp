// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/coulomb.hpp"

#include <cmath>
#include <limits>

#include "files/job.hpp"
#include "validation/references/contact_entries.hpp"
#include "validation/references/on_plane.hpp"

namespace tripoint {

CoulombMotion::CoulombMotion(const Plane& plane, const Contact& contact, double speed, double spin)
    : plane_(plane), contact_(contact), start_{0.0, speed, 0.0, spin} {
  const double slip = speed - spin * contact.radius * (contact.share > 0.0 ? 1.0 : 0.0);
  if (slip == 0.0) {
    first_ = after();
    return;
  }
  const double direction = slip > 0.0 ? 1.0 : -1.0;
  first_ = slipping(direction);
  const double rate = plane.pull - plane.grip * direction * (1.0 + contact.share);
  end_ = slip * rate < 0.0 ? -slip / rate : std::numeric_limits<double>::infinity();
}

CoulombMotion::Phase CoulombMotion::slipping(double direction) const {
  return {plane_.pull - plane_.grip * direction, plane_.grip * direction * contact_.share / contact_.radius};
}

/// Slip is 0: friction of pull/(1 + share) keeps it so, where the plane can give it.
CoulombMotion::Phase CoulombMotion::after() const {
  if (std::abs(plane_.pull) / (1.0 + contact_.share) > plane_.grip)
    return slipping(plane_.pull > 0.0 ? 1.0 : -1.0);
  const double a = plane_.pull * contact_.share / (1.0 + contact_.share);
  return {a, contact_.share > 0.0 ? a / contact_.radius : 0.0};
}

CoulombMotion::State CoulombMotion::at(double time) const {
  const auto go = [](const State& s, const Phase& p, double t) {
    return State{s.way + s.speed * t + 0.5 * p.acceleration * t * t, s.speed + p.acceleration * t,
                 s.angle + s.spin * t + 0.5 * p.spin_rate * t * t, s.spin + p.spin_rate * t};
  };
  if (end_ == 0.0 || time <= end_) return go(start_, first_, time);
  return go(go(start_, first_, end_), after(), time - end_);
}

namespace {

/// Numbers: event_time, when slip ends [s]; axis, of the motion where it is along one.
class OnPlane : public Reference {
 public:
  OnPlane(BodyOnPlane scene, const CoulombMotion& motion) : scene_(std::move(scene)), motion_(motion) {}
  [[nodiscard]] Snapshot at(double time) const override {
    const auto now = motion_.at(time);
    Snapshot out;
    out.time = time;
    out.bodies = scene_.start;
    out.bodies[scene_.plane].position += time * scene_.plane_velocity;
    out.bodies[scene_.plane].velocity = scene_.plane_velocity;
    auto& body = out.bodies[scene_.body];
    body.position += time * scene_.plane_velocity + now.way * scene_.along;
    body.velocity = scene_.plane_velocity + now.speed * scene_.along;
    body.angular_velocity = now.spin * cross(scene_.up, scene_.along);
    body.orientation = from_rotation_vector(now.angle * cross(scene_.up, scene_.along));
    return out;
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "event_time" && std::isfinite(motion_.slip_ends())) return motion_.slip_ends();
    return {};
  }
  [[nodiscard]] Measuring measuring() const override {
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(scene_.along[k]) == 1.0) return {.axis = k};
    return {};
  }

 private:
  BodyOnPlane scene_;
  CoulombMotion motion_;
};

std::unique_ptr<Reference> make_sliding(const ReferenceInput& in) {
  auto scene = body_on_plane(in, "sliding");
  if (scene.shape != Shape::Kind::box || scene.spin != 0.0)
    throw InputError("sliding holds for a box that lies on its face and does not turn");
  const CoulombMotion::Plane plane{scene.pull, scene.friction * scene.press};
  if (scene.friction * scene.height > scene.half_length)
    throw InputError(
        "sliding: friction times the height of its centre is more than half its length: the box would tip");
  return std::make_unique<OnPlane>(scene, CoulombMotion(plane, {}, scene.speed, 0.0));
}

std::unique_ptr<Reference> make_rolling(const ReferenceInput& in) {
  auto scene = body_on_plane(in, "rolling");
  if (scene.shape != Shape::Kind::sphere) throw InputError("rolling holds for a ball");
  const auto& p = in.job.bodies[scene.body].properties;
  if (p.principal_inertia.z - p.principal_inertia.x > 1e-6 * p.principal_inertia.z)
    throw InputError(
        "rolling: the ball's particles have three different moments: put its centre on the lattice");
  const CoulombMotion::Plane plane{scene.pull, scene.friction * scene.press};
  const CoulombMotion::Contact contact{p.mass * scene.height * scene.height / p.principal_inertia.z,
                                       scene.height};
  return std::make_unique<OnPlane>(scene, CoulombMotion(plane, contact, scene.speed, scene.spin));
}

const ReferenceArgument friction{
    "friction", "1",
    "coefficient of Coulomb's friction; default that of all engines' settings, none where they say none"};

}  // namespace

ReferenceEntry sliding_entry() {
  return {{"sliding",
           "analytic",
           "Coulomb's law of friction: g (sin a - mu cos a) downhill, v0^2/(2 mu g) to rest. No motion "
           "where tan a <= mu",
           "a box that sticks or slides on a plane. Gravity may be tilted, and the plane may move",
           {friction}},
          make_sliding};
}

ReferenceEntry rolling_entry() {
  return {{"rolling",
           "analytic",
           "Coulomb's law of friction and Euler's law of rotation: a ball rolls at v0/(1 + I/(m r^2)), a "
           "solid one at 5/7 v0",
           "a ball that slips or rolls on a plane, with the moment of its particles. Gravity may be tilted, "
           "and the plane may move",
           {friction}},
          make_rolling};
}

}  // namespace tripoint
