// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/joint_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects/rigid/bodies.hpp"

namespace tripoint::rigid {
namespace {

constexpr double rank = 1e-11;       ///< of the largest pivot: below it a row says what others say
constexpr double round_off = 1e-13;  ///< of rates that a row leaves, of the greatest

/// A point of a body or a direction of it, or of the world: it turns by cross(spin, arm).
struct Mark {
  Vec3 value, arm;
  long body = -1;      ///< row of a free body; -1: it stays
  bool point = false;  ///< moves with the centre too
};

long free_row(const State& state, const std::string& body) {
  if (body == "world") return -1;
  const std::size_t b = body_row(state, body);
  return is_free(state, b) ? static_cast<long>(b) : -1;
}

Mark direction_of(const Poses& poses, long body, const Vec3& at_start) {
  if (body < 0) return {at_start, {}, -1, false};
  const Vec3 now = rotate(poses[static_cast<std::size_t>(body)].turn, at_start);
  return {now, now, body, false};
}

Mark point_of(const State& state, const Poses& poses, long body, const Vec3& at_start) {
  if (body < 0) return {at_start, {}, -1, false};
  const auto b = static_cast<std::size_t>(body);
  const Vec3 arm = rotate(poses[b].turn, at_start - state.bodies[field::body_start_centre][b]);
  return {poses[b].centre + arm, arm, body, true};
}

/// Two unit vectors across an axis.
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 least = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = cross(axis, least) / norm(cross(axis, least));
  return {u, cross(axis, u)};
}

/// The two sides of a joint.
struct Sides {
  long a, b;
  Mark on_a, on_b;
  [[nodiscard]] Vec3 way() const { return on_a.value - on_b.value; }
};

Sides sides_of(const State& state, const Poses& poses, const Joint& j) {
  const long a = free_row(state, j.bodies[0]), b = free_row(state, j.bodies[1]);
  return {a, b, point_of(state, poses, a, j.point),
          point_of(state, poses, b, j.other_point.value_or(j.point))};
}

void add_to(JointRow& row, const Mark& mark, const Vec3& other, double sign) {
  if (mark.body < 0) return;
  for (JointRow::End& end : row.ends) {
    if (end.body >= 0 && end.body != mark.body) continue;
    end.body = mark.body;
    if (mark.point) end.linear += sign * other;
    end.angular += sign * cross(mark.arm, other);
    return;
  }
}

/// The way between the points along a direction of the second body or of the world.
JointRow along(const Sides& s, const Mark& direction, double target) {
  JointRow row;
  row.value = dot(s.way(), direction.value) - target;
  add_to(row, s.on_a, direction.value, 1.0);
  add_to(row, s.on_b, direction.value, -1.0);
  add_to(row, direction, s.way(), 1.0);
  return row;
}

/// The cosine of two directions.
JointRow cosine(const Mark& x, const Mark& y) {
  JointRow row;
  row.value = dot(x.value, y.value);
  add_to(row, x, y.value, 1.0);
  add_to(row, y, x.value, 1.0);
  return row;
}

void add_rows(JointRows& rows, const State& state, const Poses& poses, const Joint& j) {
  using Kind = Joint::Kind;
  const Sides s = sides_of(state, poses, j);
  const std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto on = [&](long body, const Vec3& v) { return direction_of(poses, body, v); };
  if (j.kind == Kind::distance) {  // along the line of the points
    const double length = norm(s.way());
    rows.push_back(along(s, {s.way() / length, {}, -1, false}, norm(j.point - *j.other_point)));
    return;
  }
  if (j.kind == Kind::slider)
    for (const Vec3& u : across(*j.axis)) rows.push_back(along(s, on(s.b, u), 0.0));
  else
    for (const Vec3& u : world) rows.push_back(along(s, on(-1, u), 0.0));
  if (j.kind == Kind::hinge)
    for (const Vec3& u : across(*j.axis)) rows.push_back(cosine(on(s.a, *j.axis), on(s.b, u)));
  if (j.kind == Kind::universal) rows.push_back(cosine(on(s.a, *j.axis), on(s.b, *j.other_axis)));
  if (j.kind == Kind::slider || j.kind == Kind::fixed)
    for (std::size_t k = 0; k < 3; ++k)
      rows.push_back(cosine(on(s.a, world[k]), on(s.b, world[(k + 1) % 3])));
}

Vec3 spin_of(const State& state, std::size_t b, const Vec3& L) {
  const Quaternion q = principal_to_world(state, b);
  Vec3 w = rotate_back(q, L);
  const Vec3 I = state.bodies[field::body_inertia][b];
  for (std::size_t k = 0; k < 3; ++k) w[k] = I[k] > 0.0 ? w[k] / I[k] : 0.0;
  return rotate(q, w);
}

}  // namespace

Poses present_poses(const State& state) {
  const Columns& t = state.bodies;
  Poses poses(t.size());
  for (std::size_t b = 0; b < t.size(); ++b)
    poses[b] = {t[field::body_centre][b], t[field::body_orientation][b]};
  return poses;
}

JointRows rows_of(const State& state, const Poses& poses, const Joint& j) {
  JointRows rows;
  add_rows(rows, state, poses, j);
  return rows;
}

JointRows rows_of(const State& state, const Poses& poses) {
  JointRows rows;
  for (const Joint& j : state.scene.joints) add_rows(rows, state, poses, j);
  return rows;
}

JointRow coordinate_row(const State& state, const Poses& poses, std::size_t joint, double origin) {
  const Joint& j = state.scene.joints[joint];
  const Sides s = sides_of(state, poses, j);
  const Mark axis = direction_of(poses, s.b, *j.axis);
  JointRow row;
  if (j.kind == Joint::Kind::slider) {
    row = along(s, axis, origin);
  } else {
    const Vec3 u = across(*j.axis)[0], a = direction_of(poses, s.a, u).value,
               b = direction_of(poses, s.b, u).value;
    const double angle = std::atan2(dot(cross(b, a), axis.value), dot(a, b));
    row.value = std::remainder(angle - origin, 2.0 * std::numbers::pi);
    row.ends[0] = {s.a, {}, axis.value};
    row.ends[1] = {s.b, {}, -axis.value};
  }
  row.joint = static_cast<long>(joint);
  return row;
}

Eigen::MatrixXd mobility(const State& state, const JointRows& left, const JointRows& right) {
  Eigen::MatrixXd A =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(left.size()), static_cast<Eigen::Index>(right.size()));
  for (std::size_t n = 0; n < right.size(); ++n)
    for (const JointRow::End& of : right[n].ends) {
      if (of.body < 0) continue;
      const auto b = static_cast<std::size_t>(of.body);
      const Vec3 v = of.linear / state.bodies[field::body_mass][b], w = spin_of(state, b, of.angular);
      for (std::size_t m = 0; m < left.size(); ++m)
        for (const JointRow::End& end : left[m].ends)
          if (end.body == of.body)
            A(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) +=
                dot(end.linear, v) + dot(end.angular, w);
    }
  return A;
}

Eigen::VectorXd least(const Eigen::MatrixXd& A, const Eigen::VectorXd& right) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(rank);
  solver.compute(A);
  return solver.solve(right);
}

Eigen::VectorXd rates(const State& state, const JointRows& rows) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (const JointRow::End& end : rows[n].ends) {
      if (end.body < 0) continue;
      const BodyMotion m = motion_of(state, static_cast<std::size_t>(end.body));
      out[static_cast<Eigen::Index>(n)] += dot(end.linear, m.velocity) + dot(end.angular, m.omega);
    }
  return out;
}

void give(State& state, const JointRows& rows, const Eigen::VectorXd& impulse) {
  Columns& t = state.bodies;
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (const JointRow::End& end : rows[n].ends) {
      if (end.body < 0) continue;
      const auto b = static_cast<std::size_t>(end.body);
      const double size = impulse[static_cast<Eigen::Index>(n)];
      t[field::body_velocity][b] += size / t[field::body_mass][b] * end.linear;
      t[field::body_angular_momentum][b] += size * end.angular;
    }
  for (std::size_t b = 0; b < t.size(); ++b)
    if (is_free(state, b)) update_spin(state, b);
}

Eigen::VectorXd ranged(const Eigen::MatrixXd& A, const Eigen::VectorXd& rate, const JointRows& rows) {
  const auto size = static_cast<Eigen::Index>(rows.size());
  std::vector<int> at(rows.size(), 0);  // 0: has its target rate; -1, 1: at an end of its range
  Eigen::VectorXd impulse(size);
  Eigen::MatrixXd soft = A;
  Eigen::VectorXd missing(size);
  for (Eigen::Index n = 0; n < size; ++n) {
    const JointRow& row = rows[static_cast<std::size_t>(n)];
    soft(n, n) += row.compliance;
    missing[n] = -(rate[n] - row.target);
  }
  const double slack = size > 0 ? round_off * missing.cwiseAbs().maxCoeff() : 0.0;
  for (Eigen::Index pass = 0; pass < 10 + 4 * size; ++pass) {
    std::vector<Eigen::Index> held;
    for (Eigen::Index n = 0; n < size; ++n) {
      const JointRow& row = rows[static_cast<std::size_t>(n)];
      const int side = at[static_cast<std::size_t>(n)];
      if (side == 0) held.push_back(n);
      impulse[n] = side == 0 ? 0.0 : side < 0 ? row.low : row.high;
    }
    const Eigen::VectorXd rest = held.size() == rows.size() ? missing : missing - soft * impulse;
    impulse(held) = least(soft(held, held), rest(held));
    const Eigen::VectorXd left = missing - soft * impulse;
    bool ends = true;
    for (Eigen::Index n = 0; n < size && ends; ++n) {  // the first that is wrong changes
      const JointRow& row = rows[static_cast<std::size_t>(n)];
      int& side = at[static_cast<std::size_t>(n)];
      const int wanted = side == 0 ? (impulse[n] > row.high) - (impulse[n] < row.low) : 0;
      if (side == 0 ? wanted != 0 : side * left[n] < -slack) {
        side = wanted;
        ends = false;
      }
    }
    if (ends) break;
  }
  return impulse;
}

}  // namespace tripoint::rigid
