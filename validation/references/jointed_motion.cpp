// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/jointed_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace tripoint {
namespace {

constexpr double rank = 1e-11;                 ///< of the largest pivot: below it a row says what others say
constexpr double step_error = 1e-12;           ///< of place and motion in a step [m], [rad], [m/s], [rad/s]
constexpr int columns = 8;                     ///< of the extrapolation: order 16
constexpr double most_between_events = 0.005;  ///< step of a motion that has events [s]
constexpr double half_turn = std::numbers::pi;

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec(const Eigen::VectorXd& v, Eigen::Index at) { return {v[at], v[at + 1], v[at + 2]}; }

/// Two unit vectors across the axis.
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 least = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = cross(axis, least) / norm(cross(axis, least));
  return {u, cross(axis, u)};
}

}  // namespace

/// The two sides of a joint, and the way between its points.
struct JointedMotion::Ends {
  int a, b;
  Mark on_a, on_b;
  [[nodiscard]] Sum way() const { return {{1.0, on_a}, {-1.0, on_b}}; }
};

JointedMotion::JointedMotion(const Job& job) : job_(job) {
  State start{Vector(0), Vector(0)};
  for (std::size_t n = 0; n < job_.bodies.size(); ++n) {
    const JobBody& b = job_.bodies[n];
    if (b.phase != Phase::rigid || b.motion == Motion::prescribed)
      throw InputError("jointed knows rigid bodies that are free or fixed, and `" + b.name + "` is not");
    if (b.motion != Motion::free) continue;
    free_.push_back({n, b.properties.mass, b.properties.principal_inertia, b.properties.principal_axes});
    const Vec3 c = b.properties.centre, v = b.velocity, w = b.angular_velocity;
    start.place.conservativeResize(start.place.size() + 7);
    start.place.tail<7>() << c.x, c.y, c.z, 1.0, 0.0, 0.0, 0.0;
    start.motion.conservativeResize(start.motion.size() + 6);
    start.motion.tail<6>() << v.x, v.y, v.z, w.x, w.y, w.z;
  }
  if (!job_.scene.events.empty()) throw InputError("jointed knows no events");
  for (const AppliedForce& f : job_.scene.forces)
    if (f.is_timed()) throw InputError(f.place, "jointed knows forces that act from the start to the end");
  for (const Joint& j : job_.scene.joints)
    if (j.kind == Joint::Kind::hinge && j.limits && std::max(-(*j.limits)[0], (*j.limits)[1]) >= half_turn)
      throw InputError(j.place, "jointed: joint `" + j.name + "` has limits of half a turn or more");
  for (const Joint& j : job_.scene.joints) {
    const double rate = j.friction > 0.0 ? coordinate(start, j).rate : 0.0;
    modes_.push_back({rate > 0.0 ? 1 : rate < 0.0 ? -1 : 0, 0});
  }
  project(start);
  if (has_events()) pass_event(start);
  known_[0.0] = {start, modes_};
}

int JointedMotion::number_of(const std::string& body) const {
  for (std::size_t n = 0; n < free_.size(); ++n)
    if (job_.bodies[free_[n].job_row].name == body) return static_cast<int>(n);
  return -1;
}

Quaternion JointedMotion::turn(const State& s, int body) const {
  const Eigen::Index at = 7 * body + 3;
  return normalised({s.place[at], s.place[at + 1], s.place[at + 2], s.place[at + 3]});
}

JointedMotion::Mark JointedMotion::direction(const State& s, int body, const Vec3& at_start) const {
  Mark m;
  m.value = at_start;
  if (body < 0) return m;
  const Vec3 w = vec(s.motion, 6 * body + 3);
  m.body = body;
  m.value = m.arm = rotate(turn(s, body), at_start);
  m.rate = cross(w, m.value);
  m.bias = cross(w, m.rate);
  return m;
}

JointedMotion::Mark JointedMotion::point(const State& s, int body, const Vec3& at_start) const {
  if (body < 0) return direction(s, body, at_start);
  const Vec3 centre = job_.bodies[free_[static_cast<std::size_t>(body)].job_row].properties.centre;
  Mark m = direction(s, body, at_start - centre);
  m.moves = true;
  m.value += vec(s.place, 7 * body);
  m.rate += vec(s.motion, 6 * body);
  return m;
}

JointedMotion::Ends JointedMotion::ends(const State& s, const Joint& j) const {
  const int a = number_of(j.bodies[0]), b = number_of(j.bodies[1]);
  return {a, b, point(s, a, j.point), point(s, b, j.other_point.value_or(j.point))};
}

/// The row x.y - target: its rate is x'.y + x.y', and its second derivative G a + bias.
void JointedMotion::add_row(Rows& rows, const Sum& x, const Sum& y, double target) const {
  struct Total {
    Vec3 value, rate, bias;
  };
  const auto total = [](const Sum& sum) {
    Total t;
    for (const auto& [sign, mark] : sum) {
      t.value += sign * mark.value;
      t.rate += sign * mark.rate;
      t.bias += sign * mark.bias;
    }
    return t;
  };
  const Total X = total(x), Y = total(y);
  Vector g = Vector::Zero(6 * static_cast<Eigen::Index>(free_.size()));
  const auto gather = [&](const Sum& sum, const Vec3& other) {
    for (const auto& [sign, mark] : sum) {
      if (mark.body < 0) continue;
      if (mark.moves) g.segment<3>(6 * mark.body) += sign * eigen(other);
      g.segment<3>(6 * mark.body + 3) += sign * eigen(cross(mark.arm, other));
    }
  };
  gather(x, Y.value);
  gather(y, X.value);
  rows.value.push_back(dot(X.value, Y.value) - target);
  rows.bias.push_back(dot(X.bias, Y.value) + 2.0 * dot(X.rate, Y.rate) + dot(X.value, Y.bias));
  rows.gradient.push_back(g);
  rows.joint.push_back(-1);
}

void JointedMotion::add_joint(Rows& rows, const State& s, const Joint& j) const {
  using Kind = Joint::Kind;
  const Ends e = ends(s, j);
  const auto on = [&](int body, const Vec3& v) { return Sum{{1.0, direction(s, body, v)}}; };
  const std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  if (j.kind == Kind::distance) {
    const Vec3 d = j.point - *j.other_point;
    return add_row(rows, e.way(), e.way(), dot(d, d));
  }
  if (j.kind == Kind::slider)
    for (const Vec3& u : across(*j.axis)) add_row(rows, e.way(), on(e.b, u), 0.0);
  else
    for (const Vec3& u : world) add_row(rows, e.way(), on(-1, u), 0.0);
  if (j.kind == Kind::hinge)
    for (const Vec3& u : across(*j.axis)) add_row(rows, on(e.a, *j.axis), on(e.b, u), 0.0);
  if (j.kind == Kind::universal) add_row(rows, on(e.a, *j.axis), on(e.b, *j.other_axis), 0.0);
  if (j.kind == Kind::slider || j.kind == Kind::fixed)
    for (std::size_t k = 0; k < 3; ++k) add_row(rows, on(e.a, world[k]), on(e.b, world[(k + 1) % 3]), 0.0);
}

void JointedMotion::add_coordinate(Rows& all, const State& s, std::size_t joint, double speed) const {
  const Joint& j = job_.scene.joints[joint];
  const Ends e = ends(s, j);
  const Mark axis = direction(s, e.b, *j.axis);
  if (j.kind == Joint::Kind::slider) {
    add_row(all, e.way(), {{1.0, axis}}, 0.0);
  } else {
    Vector g = Vector::Zero(6 * static_cast<Eigen::Index>(free_.size()));
    Vec3 turning;
    if (e.a >= 0) {
      g.segment<3>(6 * e.a + 3) += eigen(axis.value);
      turning += vec(s.motion, 6 * e.a + 3);
    }
    if (e.b >= 0) {
      g.segment<3>(6 * e.b + 3) -= eigen(axis.value);
      turning -= vec(s.motion, 6 * e.b + 3);
    }
    all.value.push_back(0.0);
    all.bias.push_back(dot(turning, axis.rate));
    all.gradient.push_back(g);
    all.joint.push_back(-1);
  }
  all.value.back() = -speed;
  all.joint.back() = static_cast<int>(joint);
}

JointedMotion::Rows JointedMotion::rows(const State& s, bool speeds) const {
  Rows all;
  const auto& joints = job_.scene.joints;
  for (const Joint& j : joints) add_joint(all, s, j);
  for (std::size_t n = 0; n < joints.size() && speeds; ++n) {
    const bool led = joints[n].motor && joints[n].motor->speed;
    const bool rubs = joints[n].friction > 0.0 && modes_[n].slides == 0;
    if (led || rubs || modes_[n].limit != 0) add_coordinate(all, s, n, led ? *joints[n].motor->speed : 0.0);
  }
  return all;
}

JointedMotion::Vector JointedMotion::inverse_mass_times(const State& s, const Vector& f) const {
  Vector out(f.size());
  for (std::size_t n = 0; n < free_.size(); ++n) {
    const auto at = 6 * static_cast<Eigen::Index>(n);
    out.segment<3>(at) = f.segment<3>(at) / free_[n].mass;
    const Quaternion q = turn(s, static_cast<int>(n)) * free_[n].axes;
    Vec3 t = rotate_back(q, vec(f, at + 3));
    for (std::size_t k = 0; k < 3; ++k) t[k] = free_[n].inertia[k] > 0.0 ? t[k] / free_[n].inertia[k] : 0.0;
    out.segment<3>(at + 3) = eigen(rotate(q, t));
  }
  return out;
}

void JointedMotion::push(Vector& f, const State& s, int body, const Vec3& value, const Vec3& at) const {
  if (body < 0) return;
  f.segment<3>(6 * body) += eigen(value);
  f.segment<3>(6 * body + 3) += eigen(cross(at - vec(s.place, 7 * body), value));
}

JointedMotion::Coordinate JointedMotion::coordinate(const State& s, const Joint& j) const {
  const Ends e = ends(s, j);
  const Mark axis = direction(s, e.b, *j.axis);
  const auto spin = [&](int body) { return body < 0 ? Vec3{} : vec(s.motion, 6 * body + 3); };
  if (j.kind == Joint::Kind::slider) {
    const Vec3 way = e.on_a.value - e.on_b.value;
    return {dot(way, axis.value), dot(e.on_a.rate - e.on_b.rate, axis.value) + dot(way, axis.rate)};
  }
  const Vec3 u = across(*j.axis)[0], on_a = direction(s, e.a, u).value, on_b = direction(s, e.b, u).value;
  return {std::atan2(dot(cross(on_b, on_a), axis.value), dot(on_a, on_b)),
          dot(spin(e.a) - spin(e.b), axis.value)};
}

/// Spring, damper, friction and motor along the coordinate of a joint.
void JointedMotion::joint_forces(Vector& f, const State& s, std::size_t joint) const {
  const Joint& j = job_.scene.joints[joint];
  const double effort = j.motor ? j.motor->effort.value_or(0.0) : 0.0;
  const double rub = j.friction * modes_[joint].slides;
  if (!j.spring && j.damping == 0.0 && effort == 0.0 && rub == 0.0) return;
  const Ends e = ends(s, j);
  const Coordinate now = coordinate(s, j);
  double force = effort - rub - j.damping * now.rate;
  if (j.spring) force -= j.spring->stiffness * (now.value - j.spring->rest);
  const Vec3 along = force * direction(s, e.b, *j.axis).value;
  if (j.kind == Joint::Kind::slider) {
    push(f, s, e.a, along, e.on_a.value);
    return push(f, s, e.b, -along, e.on_a.value);
  }
  if (e.a >= 0) f.segment<3>(6 * e.a + 3) += eigen(along);
  if (e.b >= 0) f.segment<3>(6 * e.b + 3) -= eigen(along);
}

void JointedMotion::spring_force(Vector& f, const State& s, const Spring& spring) const {
  const int a = number_of(spring.body), b = number_of(spring.other);
  const Mark on_a = point(s, a, spring.point), on_b = point(s, b, spring.other_point);
  const Vec3 way = on_a.value - on_b.value, along = way / norm(way);
  const double stretch = norm(way) - spring.length.value_or(norm(spring.point - spring.other_point));
  const Vec3 force =
      -(spring.stiffness * stretch + spring.damping * dot(on_a.rate - on_b.rate, along)) * along;
  push(f, s, a, force, on_a.value);
  push(f, s, b, -force, on_b.value);
}

JointedMotion::Vector JointedMotion::forces(const State& s) const {
  Vector f = Vector::Zero(s.motion.size());
  for (std::size_t n = 0; n < free_.size(); ++n) {
    const auto at = 6 * static_cast<Eigen::Index>(n);
    f.segment<3>(at) = free_[n].mass * eigen(job_.scene.gravity);
    const Quaternion q = turn(s, static_cast<int>(n)) * free_[n].axes;
    const Vec3 w = rotate_back(q, vec(s.motion, at + 3)), I = free_[n].inertia;
    f.segment<3>(at + 3) = -eigen(rotate(q, cross(w, Vec3{I.x * w.x, I.y * w.y, I.z * w.z})));
  }
  for (const AppliedForce& one : job_.scene.forces) {
    const int body = number_of(one.body);
    if (body < 0) continue;
    push(f, s, body, one.value, one.point ? point(s, body, *one.point).value : vec(s.place, 7 * body));
    f.segment<3>(6 * body + 3) += eigen(one.torque);
  }
  for (const Spring& one : job_.scene.springs) spring_force(f, s, one);
  for (std::size_t n = 0; n < job_.scene.joints.size(); ++n) joint_forces(f, s, n);
  return f;
}

JointedMotion::Vector JointedMotion::correction(const State& s, const Rows& rows, const Vector& right,
                                                Vector* lambda) const {
  const auto m = static_cast<Eigen::Index>(rows.gradient.size());
  Matrix G(m, s.motion.size()), MG(s.motion.size(), m);
  for (Eigen::Index k = 0; k < m; ++k) {
    G.row(k) = rows.gradient[static_cast<std::size_t>(k)].transpose();
    MG.col(k) = inverse_mass_times(s, rows.gradient[static_cast<std::size_t>(k)]);
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix> schur;
  schur.setThreshold(rank);
  schur.compute(G * MG);
  const Vector solved = schur.solve(right);
  if (lambda) *lambda = solved;
  return MG * solved;
}

JointedMotion::State JointedMotion::rate(const State& s) const {
  State out{Vector(s.place.size()), inverse_mass_times(s, forces(s))};
  const Rows all = rows(s, true);
  if (!all.gradient.empty()) {
    Vector right(static_cast<Eigen::Index>(all.bias.size()));
    for (Eigen::Index k = 0; k < right.size(); ++k) {
      const auto row = static_cast<std::size_t>(k);
      right[k] = -all.bias[row] - all.gradient[row].dot(out.motion);
    }
    out.motion += correction(s, all, right);
  }
  for (std::size_t n = 0; n < free_.size(); ++n) {
    const auto at = static_cast<Eigen::Index>(n);
    out.place.segment<3>(7 * at) = s.motion.segment<3>(6 * at);
    const Vec3 w = vec(s.motion, 6 * at + 3);
    const Quaternion q{s.place[7 * at + 3], s.place[7 * at + 4], s.place[7 * at + 5], s.place[7 * at + 6]};
    const Quaternion d = Quaternion{0.0, 0.5 * w.x, 0.5 * w.y, 0.5 * w.z} * q;
    out.place.segment<4>(7 * at + 3) << d.w, d.x, d.y, d.z;
  }
  return out;
}

/// Gragg's midpoint rule with an even number of steps.
JointedMotion::State JointedMotion::midpoint(const State& s, const State& rate_of_s, double interval,
                                             int steps) const {
  const double h = interval / steps;
  State before = s, now{s.place + h * rate_of_s.place, s.motion + h * rate_of_s.motion};
  for (int k = 1; k < steps; ++k) {
    const State r = rate(now);
    State next{before.place + 2.0 * h * r.place, before.motion + 2.0 * h * r.motion};
    before = std::move(now);
    now = std::move(next);
  }
  const State r = rate(now);
  return {0.5 * (before.place + now.place + h * r.place), 0.5 * (before.motion + now.motion + h * r.motion)};
}

/// Returns places, then rates, to the constraints by the shortest way in the metric of the masses.
void JointedMotion::project(State& s) const {
  if (job_.scene.joints.empty()) return;
  for (int pass = 0; pass < 3; ++pass) {
    const Rows all = rows(s, false);
    const Vector step = correction(
        s, all, -Eigen::Map<const Vector>(all.value.data(), static_cast<Eigen::Index>(all.value.size())));
    for (std::size_t n = 0; n < free_.size(); ++n) {
      const auto at = static_cast<Eigen::Index>(n);
      s.place.segment<3>(7 * at) += step.segment<3>(6 * at);
      const Quaternion q =
          normalised(from_rotation_vector(vec(step, 6 * at + 3)) * turn(s, static_cast<int>(n)));
      s.place.segment<4>(7 * at + 3) << q.w, q.x, q.y, q.z;
    }
  }
  const Rows all = rows(s, true);
  const std::size_t held = rows(s, false).value.size();
  Vector right(static_cast<Eigen::Index>(all.value.size()));
  for (std::size_t k = 0; k < all.value.size(); ++k)
    right[static_cast<Eigen::Index>(k)] = -all.gradient[k].dot(s.motion) - (k < held ? 0.0 : all.value[k]);
  s.motion += correction(s, all, right);
}

/// Extrapolation of midpoint rules, [Hairer, Norsett & Wanner 1993, II.9].
double JointedMotion::step(State& s, double H) const {
  const State r = rate(s);
  for (;;) {
    std::vector<State> row;
    for (int j = 0; j < columns; ++j) {
      std::vector<State> next{midpoint(s, r, H, 2 * (j + 1))};
      for (int k = 1; k <= j; ++k) {
        const double ratio = double(j + 1) / double(j + 1 - k), factor = 1.0 / (ratio * ratio - 1.0);
        const State &fine = next.back(), &coarse = row[static_cast<std::size_t>(k - 1)];
        next.push_back({fine.place + factor * (fine.place - coarse.place),
                        fine.motion + factor * (fine.motion - coarse.motion)});
      }
      row = std::move(next);
    }
    const State &best = row.back(), &second = row[row.size() - 2];
    const double off = std::max(
        (best.place - second.place).cwiseAbs().maxCoeff(),
        (best.motion - second.motion).cwiseAbs().maxCoeff() / (1.0 + s.motion.cwiseAbs().maxCoeff()));
    if (off <= step_error || H < 1e-7) {
      s = best;
      project(s);
      return H;
    }
    if (!(H > 1e-12)) throw InputError("jointed: the motion has no state that follows");
    H *= 0.5;
  }
}

void JointedMotion::advance(State& s, double interval) const {
  double left = interval;
  const bool events = has_events();
  while (left > 1e-14 * interval) {
    double H = std::min(left, step_ > 0.0 ? step_ : 0.01);
    if (events) H = std::min(H, most_between_events);
    const State before = s;
    const double made = step(s, H);
    if (events && margin(s) < -event_error) {
      s = before;
      left -= to_event(s, made);
      pass_event(s);
      continue;
    }
    left -= made;
    step_ = made < left && made == step_ ? 1.3 * made : made;
  }
}

std::vector<BodyState> JointedMotion::at(double time) const {
  const auto found = std::prev(known_.upper_bound(std::max(0.0, time)));
  State s = found->second.state;
  if (time > found->first) {
    modes_ = found->second.modes;
    advance(s, time - found->first);
    known_[time] = {s, modes_};
  }
  std::vector<BodyState> out;
  for (const JobBody& b : job_.bodies) {
    if (b.index < 0) continue;
    BodyState state;
    state.position = b.properties.centre;
    state.mass = b.properties.mass;
    if (const int n = number_of(b.name); n >= 0) {
      state.position = vec(s.place, 7 * n);
      state.velocity = vec(s.motion, 6 * n);
      state.angular_velocity = vec(s.motion, 6 * n + 3);
      state.orientation = turn(s, n);
    }
    out.push_back(state);
  }
  return out;
}

}  // namespace tripoint
