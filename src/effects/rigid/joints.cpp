// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/errors.hpp"
#include "effects/rigid/applied_force.hpp"
#include "effects/rigid/bodies.hpp"

namespace tripoint::rigid {
namespace {

constexpr double share_of_joint_swing = 0.1;  ///< of 1/omega that a step takes [1]
constexpr double rank = 1e-11;                ///< of the largest pivot: below it a row says what others say
constexpr double closed = 1e-13;  ///< gap of a joint over its distance from the origin and its size [1]
constexpr double open = 1e-9;     ///< gap at which a step has failed, in the same measure
constexpr int most_passes = 30;

/// A point of a body or a direction of it, or of the world: it turns by cross(spin, arm).
struct Mark {
  Vec3 value, arm;
  long body = -1;      ///< row of a free body; -1: it stays
  bool point = false;  ///< moves with the centre too
};

/// Where a body is, in place of its row: the end of a drift.
struct Pose {
  Vec3 centre;
  Quaternion turn;
};
using Poses = std::vector<Pose>;

/// One constraint: its value, and what changes it by velocity and spin of at most two free bodies.
struct Row {
  struct End {
    long body = -1;
    Vec3 linear, angular;
  };
  double value = 0.0;
  std::array<End, 2> ends;
};

Poses present_poses(const State& state) {
  const Columns& t = state.bodies;
  Poses poses(t.size());
  for (std::size_t b = 0; b < t.size(); ++b)
    poses[b] = {t[field::body_centre][b], t[field::body_orientation][b]};
  return poses;
}

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

void add_to(Row& row, const Mark& mark, const Vec3& other, double sign) {
  if (mark.body < 0) return;
  for (Row::End& end : row.ends) {
    if (end.body >= 0 && end.body != mark.body) continue;
    end.body = mark.body;
    if (mark.point) end.linear += sign * other;
    end.angular += sign * cross(mark.arm, other);
    return;
  }
}

/// The way between the points along a direction of the second body or of the world.
Row along(const Sides& s, const Mark& direction, double target) {
  Row row;
  row.value = dot(s.way(), direction.value) - target;
  add_to(row, s.on_a, direction.value, 1.0);
  add_to(row, s.on_b, direction.value, -1.0);
  add_to(row, direction, s.way(), 1.0);
  return row;
}

/// The cosine of two directions.
Row cosine(const Mark& x, const Mark& y) {
  Row row;
  row.value = dot(x.value, y.value);
  add_to(row, x, y.value, 1.0);
  add_to(row, y, x.value, 1.0);
  return row;
}

void add_rows(std::vector<Row>& rows, const State& state, const Poses& poses, const Joint& j) {
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

std::vector<Row> rows_of(const State& state, const Poses& poses) {
  std::vector<Row> rows;
  for (const Joint& j : state.scene.joints) add_rows(rows, state, poses, j);
  return rows;
}

Vec3 spin_of(const State& state, std::size_t b, const Vec3& L) {
  const Quaternion q = principal_to_world(state, b);
  Vec3 w = rotate_back(q, L);
  const Vec3 I = state.bodies[field::body_inertia][b];
  for (std::size_t k = 0; k < 3; ++k) w[k] = I[k] > 0.0 ? w[k] / I[k] : 0.0;
  return rotate(q, w);
}

/// left M^-1 right', with the inertia of the present places.
Eigen::MatrixXd mobility(const State& state, const std::vector<Row>& left, const std::vector<Row>& right) {
  Eigen::MatrixXd A =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(left.size()), static_cast<Eigen::Index>(right.size()));
  for (std::size_t n = 0; n < right.size(); ++n)
    for (const Row::End& of : right[n].ends) {
      if (of.body < 0) continue;
      const auto b = static_cast<std::size_t>(of.body);
      const Vec3 v = of.linear / state.bodies[field::body_mass][b], w = spin_of(state, b, of.angular);
      for (std::size_t m = 0; m < left.size(); ++m)
        for (const Row::End& end : left[m].ends)
          if (end.body == of.body)
            A(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) +=
                dot(end.linear, v) + dot(end.angular, w);
    }
  return A;
}

/// Solution of least norm: rows that say the same share it.
Eigen::VectorXd least(const Eigen::MatrixXd& A, const Eigen::VectorXd& right) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(rank);
  solver.compute(A);
  return solver.solve(right);
}

Eigen::VectorXd rates(const State& state, const std::vector<Row>& rows) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (const Row::End& end : rows[n].ends) {
      if (end.body < 0) continue;
      const BodyMotion m = motion_of(state, static_cast<std::size_t>(end.body));
      out[static_cast<Eigen::Index>(n)] += dot(end.linear, m.velocity) + dot(end.angular, m.omega);
    }
  return out;
}

/// Adds impulses; a row's multiplier is theirs along it.
void give(State& state, const std::vector<Row>& rows, const Eigen::VectorXd& impulse) {
  Columns& t = state.bodies;
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (const Row::End& end : rows[n].ends) {
      if (end.body < 0) continue;
      const auto b = static_cast<std::size_t>(end.body);
      const double size = impulse[static_cast<Eigen::Index>(n)];
      t[field::body_velocity][b] += size / t[field::body_mass][b] * end.linear;
      t[field::body_angular_momentum][b] += size * end.angular;
    }
  for (std::size_t b = 0; b < t.size(); ++b)
    if (is_free(state, b)) update_spin(state, b);
}

double kinetic_of_all(const State& state) {
  double sum = 0.0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    if (is_free(state, b)) sum += kinetic_energy(state, b);
  return sum;
}

/// Impulses in half a step of dt. What they change of the kinetic energy is an error of the step: a joint
/// does no work.
void push_bodies(State& state, const std::vector<Row>& rows, const Eigen::VectorXd& impulse, double dt) {
  Columns& t = state.bodies;
  const auto v = t[field::body_velocity], w = t[field::body_angular_velocity];
  const std::vector<Vec3> v_before(v.begin(), v.end()), w_before(w.begin(), w.end());
  const double before = kinetic_of_all(state);
  give(state, rows, impulse);
  for (std::size_t b = 0; b < t.size(); ++b) {
    if (!is_free(state, b)) continue;
    t[field::body_acceleration][b] += (1.0 / dt) * (v[b] - v_before[b]);
    t[field::body_angular_acceleration][b] += (1.0 / dt) * (w[b] - w_before[b]);
  }
  state.accumulated[account::rotation_drift] += kinetic_of_all(state) - before;
}

/// Where a drift of dt leads with these impulses before it.
/// @param state put back as it was
Poses after_drift(State& state, const std::vector<Row>& rows, const Eigen::VectorXd& impulse, double dt,
                  Turned turned, bool as_printed) {
  const auto v = state.bodies[field::body_velocity], L = state.bodies[field::body_angular_momentum];
  const auto w = state.bodies[field::body_angular_velocity];
  const std::vector<Vec3> v0(v.begin(), v.end()), L0(L.begin(), L.end()), w0(w.begin(), w.end());
  give(state, rows, impulse);
  Poses poses = present_poses(state);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    if (!is_free(state, b)) continue;
    poses[b].centre += dt * v[b];
    poses[b].turn = turned(state, b, dt, as_printed);
  }
  std::ranges::copy(v0, v.begin());
  std::ranges::copy(L0, L.begin());
  std::ranges::copy(w0, w.begin());
  return poses;
}

/// Gaps over the size of the scene about the origin.
double worst_of(const std::vector<Row>& rows, const State& state) {
  double size = 1.0, worst = 0.0;
  for (const Joint& j : state.scene.joints) size = std::max(size, norm(j.point));
  for (const Row& row : rows) worst = std::max(worst, std::abs(row.value));
  return worst / size;
}

/// Angle or way of a joint with a coordinate, the row that it changes by, and the force along it.
struct Law {
  double coordinate = 0.0;
  Row row;
};

Law law_of(const State& state, const Joint& j) {
  const Poses poses = present_poses(state);
  const Sides s = sides_of(state, poses, j);
  const Mark axis = direction_of(poses, s.b, *j.axis);
  Law law;
  if (j.kind == Joint::Kind::slider) {
    law.row = along(s, axis, 0.0);
    law.coordinate = law.row.value;
    return law;
  }
  const Vec3 u = across(*j.axis)[0], a = direction_of(poses, s.a, u).value,
             b = direction_of(poses, s.b, u).value;
  law.coordinate = std::atan2(dot(cross(b, a), axis.value), dot(a, b));
  law.row.ends[0] = {s.a, {}, axis.value};
  law.row.ends[1] = {s.b, {}, -axis.value};
  return law;
}

bool has_law(const Joint& j) { return j.spring || (j.motor && j.motor->effort.value_or(0.0) != 0.0); }

}  // namespace

void check_joints_at_start(const State& state) {
  double fastest = 1.0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    fastest = std::max(fastest, norm(state.bodies[field::body_velocity][b]) +
                                    norm(state.bodies[field::body_angular_velocity][b]));
  for (const Joint& j : state.scene.joints) {
    std::vector<Row> rows;
    add_rows(rows, state, present_poses(state), j);
    if (const double rate = rates(state, rows).cwiseAbs().maxCoeff(); rate > open * fastest)
      throw InputError(
          j.place,
          fmt::format("the velocities at the start break joint \"{}\" at {:.3g} m/s or rad/s: give both "
                      "bodies velocities that it allows",
                      j.name, rate));
  }
}

void pull_by_joint_laws(State& state, double dt) {
  for (const Joint& j : state.scene.joints) {
    if (!has_law(j)) continue;
    const Law law = law_of(state, j);
    const double effort = j.motor ? j.motor->effort.value_or(0.0) : 0.0;
    const double pull = j.spring ? -j.spring->stiffness * (law.coordinate - j.spring->rest) : 0.0;
    const double before = rates(state, {law.row})[0];
    give(state, {law.row}, Eigen::VectorXd::Constant(1, dt * (pull + effort)));
    const double way = dt * 0.5 * (before + rates(state, {law.row})[0]);
    state.accumulated[account::gravity_work] += pull * way;
    if (effort != 0.0) state.accumulated[account::applied_work] += effort * way;
  }
}

void close_joints(State& state, double dt, Turned turned, bool as_printed) {
  const std::vector<Row> now = rows_of(state, present_poses(state));
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(now.size()));
  double gap = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::vector<Row> then = rows_of(state, after_drift(state, now, impulse, dt, turned, as_printed));
    const double before = gap;
    gap = worst_of(then, state);
    if (gap <= closed || (gap < open && gap >= 0.5 * before)) break;
    Eigen::VectorXd values(impulse.size());
    for (std::size_t n = 0; n < then.size(); ++n) values[static_cast<Eigen::Index>(n)] = -then[n].value;
    impulse += least(dt * mobility(state, then, now), values);
  }
  if (!(gap <= open))
    throw Diverged(-1, -1, "position", "joints", state.time,
                   "no impulses close the joints in this step: take a smaller time step");
  push_bodies(state, now, impulse, 0.5 * dt);
}

void still_joints(State& state, double dt) {
  const std::vector<Row> now = rows_of(state, present_poses(state));
  push_bodies(state, now, least(mobility(state, now, now), -rates(state, now)), dt);
}

double joint_energy(const State& state) {
  double sum = 0.0;
  for (const Joint& j : state.scene.joints) {
    if (!j.spring) continue;
    const double stretch = law_of(state, j).coordinate - j.spring->rest;
    sum += 0.5 * j.spring->stiffness * stretch * stretch;
  }
  return sum;
}

double joint_step(const State& state) {
  double least_step = std::numeric_limits<double>::infinity();
  for (const Joint& j : state.scene.joints) {
    if (!j.spring) continue;
    const std::vector<Row> row{law_of(state, j).row};
    least_step = std::min(
        least_step, share_of_joint_swing / std::sqrt(j.spring->stiffness * mobility(state, row, row)(0, 0)));
  }
  return least_step;
}

bool has_joint_effort(const Scene& scene) {
  return std::ranges::any_of(scene.joints,
                             [](const Joint& j) { return j.motor && j.motor->effort.value_or(0.0) != 0.0; });
}

}  // namespace tripoint::rigid
