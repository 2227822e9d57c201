// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <optional>

#include "core/not_a_number.hpp"
#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "validation/references/contact_entries.hpp"
#include "validation/references/on_plane.hpp"
#include "validation/references/resting.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {
namespace {

/// A box in free flight from a time on.
struct FreeBox {
  double since = 0.0;  ///< [s]
  Vec3 centre, velocity, gravity;
  Quaternion turned;  ///< of the box at that time, from the start of the job
  std::shared_ptr<const TorqueFree> spin;

  [[nodiscard]] Vec3 place(double t) const {
    return centre + (t - since) * velocity + (0.5 * (t - since) * (t - since)) * gravity;
  }
  [[nodiscard]] Vec3 speed(double t) const { return velocity + (t - since) * gravity; }
  [[nodiscard]] Quaternion orientation(double t) const {
    return normalised(spin->rotation(t - since) * turned);
  }
  [[nodiscard]] Vec3 angular_velocity(double t) const { return spin->angular_velocity(t - since); }
};

/// The box and the floor that it falls on.
struct Ground {
  Vec3 up;
  double level = 0.0;         ///< of the floor, along up [m]
  std::vector<Vec3> corners;  ///< from the centre at the start of the job [m]
};

double lowest(const FreeBox& box, const Ground& ground, double t) {
  const Quaternion q = box.orientation(t);
  double least = INFINITY;
  for (const Vec3& c : ground.corners) least = std::min(least, dot(rotate(q, c), ground.up));
  return dot(box.place(t), ground.up) + least - ground.level;
}

/// First time after `from` at which a corner is at the floor; steps below which no corner turns by a tenth of
/// a radian.
std::optional<double> touch(const FreeBox& box, const Ground& ground, double from, double end) {
  const double step = std::min(1e-3, 0.1 / std::max(1e-9, norm(box.angular_velocity(from))));
  for (double t = from; t < end; t += step) {
    if (!(lowest(box, ground, t) > 0.0) || lowest(box, ground, t + step) > 0.0) continue;
    double above = t, below = t + step;
    for (int n = 0; n < 80; ++n)
      (lowest(box, ground, 0.5 * (above + below)) > 0.0 ? above : below) = 0.5 * (above + below);
    return 0.5 * (above + below);
  }
  return {};
}

/// A free box meets a smooth floor with a corner or an edge. An impulse along the normal acts at each corner
/// that touches. It makes the corner's normal velocity -e times the earlier one (Newton). Then free flight
/// follows, known until the next touch. Numbers: event_time, of the touch [s]; next_touch [s].
class Landing : public Reference {
 public:
  Landing(std::vector<BodyState> rows, std::size_t row, FreeBox before, FreeBox after, double touch_time,
          double known_to)
      : rows_(std::move(rows)),
        row_(row),
        before_(std::move(before)),
        after_(std::move(after)),
        touch_(touch_time),
        known_to_(known_to) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    out.bodies = rows_;
    auto& b = out.bodies[row_];
    const FreeBox& now = time <= touch_ ? before_ : after_;
    b.position = now.place(time);
    b.velocity = now.speed(time);
    b.orientation = now.orientation(time);
    b.angular_velocity = now.angular_velocity(time);
    if (time > known_to_) b.position = {not_a_number, not_a_number, not_a_number};
    return out;
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "event_time" || quantity == "touch_time") return touch_;
    if (quantity == "next_touch" && std::isfinite(known_to_)) return known_to_;
    return {};
  }

 private:
  std::vector<BodyState> rows_;
  std::size_t row_;
  FreeBox before_, after_;
  double touch_, known_to_;
};

/// I^-1 in the world, for a turned box.
Vec3 turned_by(const MassProperties& p, const Quaternion& turned, const Vec3& angular_impulse) {
  const Quaternion axes = turned * p.principal_axes;
  Vec3 w = rotate_back(axes, angular_impulse);
  for (std::size_t k = 0; k < 3; ++k) w[k] /= p.principal_inertia[k];
  return rotate(axes, w);
}

/// Velocity and angular velocity after the impulses at the corners `arms` (from the centre).
std::pair<Vec3, Vec3> hit(const MassProperties& p, const FreeBox& box, double t,
                          const std::vector<Vec3>& arms, const Vec3& up, double restitution) {
  const auto n = static_cast<Eigen::Index>(arms.size());
  const Quaternion turned = box.orientation(t);
  const Vec3 v = box.speed(t), w = box.angular_velocity(t);
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3& at = arms[static_cast<std::size_t>(i)];
    b[i] = -(1.0 + restitution) * dot(v + cross(w, at), up);
    for (Eigen::Index j = 0; j < n; ++j)
      A(i, j) = 1.0 / p.mass +
                dot(cross(turned_by(p, turned, cross(arms[static_cast<std::size_t>(j)], up)), at), up);
  }
  const Eigen::VectorXd impulse = A.completeOrthogonalDecomposition().solve(b);
  Vec3 dv, dw;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (impulse[i] < -1e-9 * impulse.cwiseAbs().maxCoeff())
      throw InputError(
          "landing: two corners touch at once, and one would be pulled down: turn the box otherwise");
    dv += (impulse[i] / p.mass) * up;
    dw += turned_by(p, turned, impulse[i] * cross(arms[static_cast<std::size_t>(i)], up));
  }
  return {v + dv, w + dw};
}

std::vector<Vec3> corners_of(const Shape& s, const Vec3& centre) {
  std::vector<Vec3> list;
  for (int k = 0; k < 8; ++k)
    list.push_back(Vec3{k & 1 ? s.max.x : s.min.x, k & 2 ? s.max.y : s.min.y, k & 4 ? s.max.z : s.min.z} -
                   centre);
  return list;
}

std::unique_ptr<Reference> make_landing(const ReferenceInput& in) {
  const auto scene = box_on_floor(in, "landing");
  const auto& box = in.job.bodies[scene.block];
  const Shape& shape = in.job.scene.body(box.name).shape;
  if (!is_upright_box(shape)) throw InputError("landing holds for a box that is not turned at the start");
  if (law_of_contact(in.job, "friction").value_or(0.0) > 0.0)
    throw InputError(
        "landing holds without friction: a corner that sticks and slips in one hit has no closed form");
  const double restitution =
      in.args.number("restitution").value_or(law_of_contact(in.job, "restitution").value_or(1.0));
  Ground ground;
  ground.up[scene.axis] = scene.up;
  ground.corners = corners_of(shape, box.properties.centre);
  ground.level = scene.up * scene.rest - 0.5 * (shape.max[scene.axis] - shape.min[scene.axis]);
  const auto flight = [&](double since, const Vec3& centre, const Vec3& velocity, const Quaternion& turned,
                          const Vec3& w) {
    return FreeBox{since,
                   centre,
                   velocity,
                   in.job.scene.gravity,
                   turned,
                   std::make_shared<TorqueFree>(box.properties.principal_inertia,
                                                turned * box.properties.principal_axes, w)};
  };
  const double end = in.job.scene.end_time;
  const auto before = flight(0.0, box.properties.centre, box.velocity, {}, box.angular_velocity);
  const auto time = touch(before, ground, 0.0, end);
  if (!time) throw InputError("landing: the box does not reach the floor before the end");
  std::vector<Vec3> arms;
  for (const Vec3& c : ground.corners) {
    const Vec3 arm = rotate(before.orientation(*time), c);
    if (std::abs(dot(before.place(*time) + arm, ground.up) - ground.level) < 1e-9 * norm(c))
      arms.push_back(arm);
  }
  if (arms.size() > 2) throw InputError("landing holds for a corner or an edge, not for a face");
  const auto [v, w] = hit(box.properties, before, *time, arms, ground.up, restitution);
  const auto after = flight(*time, before.place(*time), v, before.orientation(*time), w);
  const double known_to = touch(after, ground, *time + 1e-6, end + 1.0).value_or(INFINITY);
  return std::make_unique<Landing>(scene.start, scene.block, before, after, *time, known_to);
}

}  // namespace

ReferenceEntry landing_entry() {
  return {
      {"landing",
       "analytic",
       "Newton's law of impact at each corner that touches, Euler's equations of the free top before and "
       "after",
       "a box that hits a smooth floor with a corner or edge: flight, hit, and flight until the next touch",
       {{"restitution", "1",
         "normal speed of the corner after the hit over that before it; default that of all engines' "
         "settings, 1 where they "
         "say none"}}},
      make_landing};
}

}  // namespace tripoint
