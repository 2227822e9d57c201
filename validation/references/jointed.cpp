// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <mutex>

#include "files/scene_json.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/jointed_motion.hpp"

namespace tripoint {
namespace {

/// Metrics of a run ask for the same motion one after another: the last ones are kept.
class KeptMotion {
 public:
  explicit KeptMotion(const Job& job) : motion_(job) {}
  [[nodiscard]] std::vector<BodyState> at(double time) const {
    const std::lock_guard lock(one_at_a_time_);
    return motion_.at(time);
  }

 private:
  JointedMotion motion_;
  mutable std::mutex one_at_a_time_;
};

/// All that the motion depends on.
std::string question(const Job& job) {
  std::string text;
  const auto add = [&](std::initializer_list<double> values) {
    for (const double v : values) text += fmt::format("{} ", v);
  };
  const auto point = [&](const Vec3& v) { add({v.x, v.y, v.z}); };
  point(job.scene.gravity);
  for (const JobBody& b : job.bodies) {
    const MassProperties& p = b.properties;
    text += b.name + fmt::format(" {} ", static_cast<int>(b.motion));
    add({p.mass, p.principal_axes.w, p.principal_axes.x, p.principal_axes.y, p.principal_axes.z});
    for (const Vec3& v : {p.centre, p.principal_inertia, b.velocity, b.angular_velocity}) point(v);
  }
  for (const Joint& j : job.scene.joints) {
    text += fmt::format("{} {} {} ", static_cast<int>(j.kind), j.bodies[0], j.bodies[1]);
    for (const auto& v : {std::optional(j.point), j.other_point, j.axis, j.other_axis})
      point(v.value_or(Vec3{}));
    add({j.friction, j.restitution, j.limits ? (*j.limits)[0] : 1e99, j.limits ? (*j.limits)[1] : 1e99});
    add({j.damping, j.spring ? j.spring->stiffness : 0.0, j.spring ? j.spring->rest : 0.0,
         j.motor ? j.motor->effort.value_or(0.0) : 0.0, j.motor ? j.motor->speed.value_or(1e99) : 0.0});
  }
  for (const AppliedForce& f : job.scene.forces) {
    text += f.body + " ";
    for (const Vec3& v : {f.value, f.torque, f.point.value_or(Vec3{})}) point(v);
    add({f.point ? 1.0 : 0.0});
  }
  for (const Spring& s : job.scene.springs) {
    text += s.body + " " + s.other + " ";
    point(s.point);
    point(s.other_point);
    add({s.stiffness, s.damping, s.length.value_or(-1.0)});
  }
  return text;
}

std::shared_ptr<const KeptMotion> motion_for(const Job& job) {
  constexpr std::size_t most = 8;
  static std::vector<std::pair<std::string, std::shared_ptr<const KeptMotion>>> kept;
  static std::mutex one_at_a_time;
  const std::string asked = question(job);
  const std::lock_guard lock(one_at_a_time);
  for (const auto& [known, motion] : kept)
    if (known == asked) return motion;
  if (kept.size() == most) kept.erase(kept.begin());
  kept.emplace_back(asked, std::make_shared<KeptMotion>(job));
  return kept.back().second;
}

class Jointed : public Reference {
 public:
  Jointed(const Job& job, const InitialState& initial) : initial_(initial), motion_(motion_for(job)) {
    for (const JobBody& b : job.bodies) centres_.push_back(b.properties.centre);
  }
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    out.bodies = motion_->at(time);
    out.body = initial_.body;
    out.phase = initial_.phase;
    for (std::size_t i = 0; i < initial_.size(); ++i) {
      const BodyState& b = out.bodies[static_cast<std::size_t>(initial_.body[i])];
      const Vec3 arm = rotate(b.orientation,
                              initial_.position[i] - centres_[static_cast<std::size_t>(initial_.source[i])]);
      out.position.push_back(b.position + arm);
      out.velocity.push_back(b.velocity + cross(b.angular_velocity, arm));
    }
    return out;
  }

 private:
  InitialState initial_;
  std::vector<Vec3> centres_;
  std::shared_ptr<const KeptMotion> motion_;
};

}  // namespace

ReferenceEntry jointed_entry() {
  return {{"jointed",
           "analytic",
           "equations of Newton and Euler with constraints, by extrapolation [Hairer, Norsett & Wanner 1993, "
           "II.9]",
           "rigid bodies with joints and their laws, springs and constant forces, as the scene has them, to "
           "1e-10; "
           "no contact",
           {}},
          [](const ReferenceInput& in) -> std::unique_ptr<Reference> {
            return std::make_unique<Jointed>(in.job, in.initial);
          }};
}

}  // namespace tripoint
