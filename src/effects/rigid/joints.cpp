// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "effects/rigid/applied_force.hpp"
#include "effects/rigid/bodies.hpp"
#include "effects/rigid/joint_rows.hpp"

namespace tripoint::rigid {
namespace {

constexpr double share_of_joint_swing = 0.1;    ///< of 1/omega that a step takes [1]
constexpr double share_of_joint_damping = 0.2;  ///< of m/c that a step takes [1]
constexpr double closed = 1e-13;  ///< gap of a joint over its distance from the origin and its size [1]
constexpr double open = 1e-9;     ///< gap at which a step has failed, in the same measure
constexpr int most_passes = 30;
constexpr double at_limit = 1e-9;     ///< from its limit, a joint touches it [rad] or [m]
constexpr double past_limit = 1e-12;  ///< beyond its limit, a joint has hit it [rad] or [m]
constexpr int most_parts = 200;       ///< of a step, by hits of limits
constexpr int most_halvings = 80;     ///< in the search for a hit
constexpr double endless = std::numeric_limits<double>::infinity();

/// The coordinates at which joints stay through a drift; none where they move.
using Held = std::vector<std::optional<double>>;

double kinetic_of_all(const State& state) {
  double sum = 0.0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    if (is_free(state, b)) sum += kinetic_energy(state, b);
  return sum;
}

/// Impulses in half a step of dt. Rows along coordinates do work; what the others change of the kinetic
/// energy is an error of the step.
void push_bodies(State& state, const JointRows& rows, const Eigen::VectorXd& impulse, double dt) {
  Columns& t = state.bodies;
  const auto v = t[field::body_velocity], w = t[field::body_angular_velocity];
  const std::vector<Vec3> v_before(v.begin(), v.end()), w_before(w.begin(), w.end());
  const double before = kinetic_of_all(state);
  const bool works = std::ranges::any_of(rows, [](const JointRow& row) { return row.joint >= 0; });
  const Eigen::VectorXd rate_before = works ? rates(state, rows) : Eigen::VectorXd();
  give(state, rows, impulse);
  for (std::size_t b = 0; b < t.size(); ++b) {
    if (!is_free(state, b)) continue;
    t[field::body_acceleration][b] += (1.0 / dt) * (v[b] - v_before[b]);
    t[field::body_angular_acceleration][b] += (1.0 / dt) * (w[b] - w_before[b]);
  }
  double work = 0.0;
  if (works) {
    const Eigen::VectorXd mean = 0.5 * (rate_before + rates(state, rows));
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const auto at = static_cast<Eigen::Index>(n);
      if (rows[n].joint >= 0) work += impulse[at] * mean[at];
    }
    state.accumulated[account::applied_work] += work;
  }
  state.accumulated[account::rotation_drift] += kinetic_of_all(state) - before - work;
}

/// Where a drift of dt leads with these impulses before it.
/// @param state put back as it was
Poses after_drift(State& state, const JointRows& rows, const Eigen::VectorXd& impulse, double dt,
                  const JointDrift& how) {
  const auto v = state.bodies[field::body_velocity], L = state.bodies[field::body_angular_momentum];
  const auto w = state.bodies[field::body_angular_velocity];
  const std::vector<Vec3> v0(v.begin(), v.end()), L0(L.begin(), L.end()), w0(w.begin(), w.end());
  give(state, rows, impulse);
  Poses poses = present_poses(state);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    if (!is_free(state, b)) continue;
    poses[b].centre += dt * v[b];
    poses[b].turn = how.turned(state, b, dt, how.as_printed);
  }
  std::ranges::copy(v0, v.begin());
  std::ranges::copy(L0, L.begin());
  std::ranges::copy(w0, w.begin());
  return poses;
}

/// Gaps over the size of the scene about the origin.
double worst_of(const JointRows& rows, const State& state) {
  double size = 1.0, worst = 0.0;
  for (const Joint& j : state.scene.joints) size = std::max(size, norm(j.point));
  for (const JointRow& row : rows) worst = std::max(worst, std::abs(row.value));
  return worst / size;
}

bool keeps_speed(const Joint& j) { return j.motor && j.motor->speed; }
bool pulls(const Joint& j) { return j.spring || (j.motor && j.motor->effort.value_or(0.0) != 0.0); }
bool has_ranges(const State& state) {
  return std::ranges::any_of(state.scene.joints, [](const Joint& j) { return j.limits || j.friction > 0.0; });
}

/// Calls visit(joint, number) for each that has it.
template <class Has, class Visit>
void each_joint(const State& state, Has has, Visit visit) {
  const auto& joints = state.scene.joints;
  for (std::size_t n = 0; n < joints.size(); ++n)
    if (has(joints[n])) visit(joints[n], n);
}

/// Constraints, and the coordinates that motors lead or that stay: their values at a time.
JointRows held_rows(const State& state, const Poses& poses, const Held& held, double time) {
  JointRows rows = rows_of(state, poses);
  each_joint(state, keeps_speed, [&](const Joint& j, std::size_t n) {
    rows.push_back(coordinate_row(state, poses, n, *j.motor->speed * time));
  });
  for (std::size_t n = 0; n < held.size(); ++n)
    if (held[n]) rows.push_back(coordinate_row(state, poses, n, *held[n]));
  return rows;
}

/// Constraints and motors that keep a speed, as rates.
JointRows led_rows(const State& state, const Poses& poses) {
  JointRows rows = rows_of(state, poses);
  each_joint(state, keeps_speed, [&](const Joint& j, std::size_t n) {
    rows.push_back(coordinate_row(state, poses, n));
    rows.back().target = *j.motor->speed;
  });
  return rows;
}

/// Adds joints that touch a limit: an impulse of one sign, after which they do not go beyond it.
void add_touched(JointRows& rows, const State& state, const Poses& poses) {
  each_joint(
      state, [](const Joint& j) { return j.limits.has_value(); },
      [&](const Joint& j, std::size_t n) {
        JointRow row = coordinate_row(state, poses, n);
        const auto [low, high] = *j.limits;
        if (row.value > low + at_limit && row.value < high - at_limit) return;
        (row.value <= low + at_limit ? row.low : row.high) = 0.0;
        rows.push_back(row);
      });
}

/// Adds friction, at most its impulse in dt.
void add_friction(JointRows& rows, const State& state, const Poses& poses, double dt) {
  each_joint(
      state, [](const Joint& j) { return j.friction > 0.0; },
      [&](const Joint& j, std::size_t n) {
        rows.push_back(coordinate_row(state, poses, n));
        rows.back().high = j.friction * dt;
        rows.back().low = -rows.back().high;
      });
}

bool is_limit(const JointRow& row) { return row.low == 0.0 || row.high == 0.0; }
bool rubs(const JointRow& row) { return !is_limit(row) && std::isfinite(row.high); }
double limit_of(const State& state, const JointRow& row) {
  return (*state.scene.joints[static_cast<std::size_t>(row.joint)].limits)[row.low == 0.0 ? 0 : 1];
}

/// Impulses after which each row has its rate. @return them
Eigen::VectorXd settle(State& state, const JointRows& rows, double dt) {
  const Eigen::VectorXd impulse = ranged(mobility(state, rows, rows), rates(state, rows), rows);
  push_bodies(state, rows, impulse, dt);
  return impulse;
}

/// Friction of the first half step. @return the joints that it holds, and those that a limit may hold
Held hold_joints(State& state, double dt) {
  Held held(state.scene.joints.size());
  if (!has_ranges(state)) return held;
  const Poses poses = present_poses(state);
  JointRows rows = led_rows(state, poses);
  add_friction(rows, state, poses, dt);
  add_touched(rows, state, poses);
  Eigen::VectorXd impulse = ranged(mobility(state, rows, rows), rates(state, rows), rows);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const JointRow& row = rows[n];
    double& size = impulse[static_cast<Eigen::Index>(n)];
    const bool inside = size > row.low && size < row.high;
    const auto joint = static_cast<std::size_t>(row.joint);
    if (row.joint >= 0 && inside && rubs(row)) held[joint] = row.value;
    if (row.joint >= 0 && inside && is_limit(row)) held[joint] = limit_of(state, row);
    if (!rubs(row)) size = 0.0;  // the drift finds it
  }
  push_bodies(state, rows, impulse, dt);
  return held;
}

/// Impulses before a drift, and where it leads.
struct Closing {
  JointRows rows;
  Eigen::VectorXd impulse;
  Poses poses;
};

Closing closing_of(State& state, double dt, double end, const Held& held, const JointDrift& how) {
  Closing c{held_rows(state, present_poses(state), held, state.time), {}, {}};
  c.impulse = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(c.rows.size()));
  double gap = endless;
  for (int pass = 0; pass < most_passes; ++pass) {
    c.poses = after_drift(state, c.rows, c.impulse, dt, how);
    const JointRows then = held_rows(state, c.poses, held, end);
    const double before = gap;
    gap = worst_of(then, state);
    if (gap <= closed || (gap < open && gap >= 0.5 * before)) break;
    Eigen::VectorXd values(c.impulse.size());
    for (std::size_t n = 0; n < then.size(); ++n) values[static_cast<Eigen::Index>(n)] = -then[n].value;
    c.impulse += least(dt * mobility(state, then, c.rows), values);
  }
  if (!(gap <= open))
    throw Diverged(-1, -1, "position", "joints", state.time,
                   "no impulses close the joints in this step: take a smaller time step");
  return c;
}

/// Lets go of the joints that their limit would have to pull through a drift.
void release(State& state, double dt, Held& held, const JointDrift& how) {
  for (std::size_t left = held.size(); left > 0; --left) {
    const Closing c = closing_of(state, dt, state.next_time, held, how);
    bool any = false;
    for (std::size_t n = 0; n < c.rows.size() && !any; ++n) {
      if (c.rows[n].joint < 0) continue;
      const auto joint = static_cast<std::size_t>(c.rows[n].joint);
      const auto& limits = state.scene.joints[joint].limits;
      if (!held[joint] || !limits) continue;
      const double size = c.impulse[static_cast<Eigen::Index>(n)];
      any = (*held[joint] == (*limits)[0] && size < 0.0) || (*held[joint] == (*limits)[1] && size > 0.0);
      if (any) held[joint].reset();
    }
    if (!any) return;
  }
}

/// How far a joint is beyond its nearer limit [rad] or [m].
double beyond(const State& state, const Poses& poses, std::size_t joint) {
  const double value = coordinate_row(state, poses, joint).value;
  const auto [low, high] = *state.scene.joints[joint].limits;
  return std::max(low - value, value - high);
}

/// Time in a drift of dt, which ends at `end`, at which the first joint hits a limit; dt if none does.
/// @param passed joints that hit in this step and were let go
double first_hit(State& state, double dt, double end, const Held& held, const std::vector<bool>& passed,
                 const JointDrift& how, const Poses& poses) {
  double first = dt;
  each_joint(
      state, [](const Joint& j) { return j.limits.has_value(); },
      [&](const Joint&, std::size_t n) {
        double far_off = beyond(state, poses, n);
        if (held[n] || passed[n] || far_off <= past_limit) return;
        double near = 0.0, far = dt, near_off = beyond(state, present_poses(state), n);
        if (near_off >= -past_limit) near_off = far = 0.0;
        for (int k = 0; k < most_halvings && near < far && far_off > past_limit; ++k) {
          const double share = k % 4 == 3 ? 0.5 : near_off / (near_off - far_off);
          const double middle = near + share * (far - near);
          const double off = beyond(state, closing_of(state, middle, end - dt + middle, held, how).poses, n);
          if (off >= -past_limit) {
            far = middle;
            far_off = off;
          } else {
            near = middle;
            near_off = off;
          }
        }
        first = std::min(first, far);
      });
  return first;
}

/// Dampers and friction by the present rates.
void lose(State& state, double dt, bool rub) {
  JointRows rows;
  each_joint(
      state, [&](const Joint& j) { return j.damping > 0.0 || (rub && j.friction > 0.0); },
      [&](const Joint&, std::size_t n) { rows.push_back(coordinate_row(state, present_poses(state), n)); });
  if (rows.empty()) return;
  const Eigen::VectorXd rate = rates(state, rows);
  Eigen::VectorXd impulse(rate.size());
  for (Eigen::Index k = 0; k < rate.size(); ++k) {
    const Joint& j = state.scene.joints[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)].joint)];
    const double direction = rate[k] > 0.0 ? 1.0 : rate[k] < 0.0 ? -1.0 : 0.0;
    impulse[k] = -dt * (j.damping * rate[k] + (rub ? j.friction * direction : 0.0));
  }
  push_bodies(state, rows, impulse, dt);
}

/// What happened to each joint in a step: it has hit its limit, and was let go after.
struct Hits {
  std::vector<bool> hit, passed;
};

/// All forces for a time.
void push_all(State& state, double dt, const JointDrift& how) {
  if (dt == 0.0) return;
  how.kick(dt);
  pull_by_joint_laws(state, dt);
  lose(state, dt, true);
}

/// Joints that touch a limit hit it: their rate turns by the restitution, once in a step. Forces act until
/// the time of the hit, and take it back after.
/// @param left of the step of dt
/// @param still nothing has moved since the last hit: what touches a limit stays there
void hit_limits(State& state, double dt, double left, bool still, const JointDrift& how, Held& held,
                Hits& hits) {
  const double lead = 0.5 * dt - left;
  push_all(state, lead, how);
  const Poses poses = present_poses(state);
  JointRows rows = led_rows(state, poses);
  settle(state, rows, endless);
  add_touched(rows, state, poses);
  const Eigen::VectorXd rate = rates(state, rows);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    JointRow& row = rows[n];
    const double before = rate[static_cast<Eigen::Index>(n)];
    if ((row.low != 0.0 || before >= 0.0) && (row.high != 0.0 || before <= 0.0)) continue;
    const auto joint = static_cast<std::size_t>(row.joint);
    if (!hits.hit[joint]) row.target = -state.scene.joints[joint].restitution * before;
    hits.hit[joint] = true;
  }
  const Eigen::VectorXd impulse = settle(state, rows, endless);
  held.assign(held.size(), {});
  for (std::size_t n = 0; n < rows.size(); ++n)
    if (is_limit(rows[n]) && rows[n].target == 0.0 && (still || impulse[static_cast<Eigen::Index>(n)] != 0.0))
      held[static_cast<std::size_t>(rows[n].joint)] = limit_of(state, rows[n]);
  if (still) return push_all(state, -lead, how);
  const Held before = held;
  push_all(state, 0.5 * left, how);
  release(state, left, held, how);
  for (std::size_t n = 0; n < held.size(); ++n) hits.passed[n] = hits.passed[n] || (before[n] && !held[n]);
  push_all(state, -lead - 0.5 * left, how);
}

}  // namespace

void check_joints_at_start(const State& state) {
  double fastest = 1.0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    fastest = std::max(fastest, norm(state.bodies[field::body_velocity][b]) +
                                    norm(state.bodies[field::body_angular_velocity][b]));
  const Poses poses = present_poses(state);
  for (std::size_t n = 0; n < state.scene.joints.size(); ++n) {
    const Joint& j = state.scene.joints[n];
    double rate = rates(state, rows_of(state, poses, j)).cwiseAbs().maxCoeff();
    if (keeps_speed(j))
      rate = std::max(rate, std::abs(rates(state, {coordinate_row(state, poses, n)})[0] - *j.motor->speed));
    if (rate > open * fastest)
      throw InputError(
          j.place,
          fmt::format("the velocities at the start break joint \"{}\" at {:.3g} m/s or rad/s: give both "
                      "bodies velocities that it allows",
                      j.name, rate));
  }
}

void damp_joints(State& state, double dt) { lose(state, dt, false); }

void pull_by_joint_laws(State& state, double dt) {
  each_joint(state, pulls, [&](const Joint& j, std::size_t n) {
    const JointRow row = coordinate_row(state, present_poses(state), n);
    const double effort = j.motor ? j.motor->effort.value_or(0.0) : 0.0;
    const double pull = j.spring ? -j.spring->stiffness * (row.value - j.spring->rest) : 0.0;
    const double before = rates(state, {row})[0];
    give(state, {row}, Eigen::VectorXd::Constant(1, dt * (pull + effort)));
    const double way = dt * 0.5 * (before + rates(state, {row})[0]);
    state.accumulated[account::gravity_work] += pull * way;
    if (effort != 0.0) state.accumulated[account::applied_work] += effort * way;
  });
}

void drift_with_joints(State& state, double dt, const JointDrift& how) {
  Held held = hold_joints(state, 0.5 * dt);
  Hits hits{std::vector<bool>(held.size(), false), std::vector<bool>(held.size(), false)};
  if (has_ranges(state)) release(state, dt, held, how);
  double left = dt;
  for (int parts = 0; parts < most_parts; ++parts) {
    const double end = state.next_time;
    Closing closing = closing_of(state, left, end, held, how);
    const double part = first_hit(state, left, end, held, hits.passed, how, closing.poses);
    if (part < left && part > 0.0) closing = closing_of(state, part, end - left + part, held, how);
    if (part > 0.0) {
      push_bodies(state, closing.rows, closing.impulse, 0.5 * dt);
      how.move(part);
    }
    if (part == left) return;
    left -= part;
    hit_limits(state, dt, left, part == 0.0, how, held, hits);
  }
  throw Diverged(-1, -1, "position", "joints", state.time,
                 "joints hit their limits without end in this step: take a smaller time step");
}

void still_joints(State& state, double dt) {
  const Poses poses = present_poses(state);
  JointRows rows = led_rows(state, poses);
  each_joint(
      state, [](const Joint& j) { return j.damping > 0.0; },
      [&](const Joint& j, std::size_t n) {
        rows.push_back(coordinate_row(state, poses, n));
        rows.back().compliance = 1.0 / (j.damping * dt);
      });
  add_friction(rows, state, poses, dt);
  add_touched(rows, state, poses);
  settle(state, rows, dt);
}

double joint_energy(const State& state) {
  double sum = 0.0;
  each_joint(
      state, [](const Joint& j) { return j.spring.has_value(); },
      [&](const Joint& j, std::size_t n) {
        const double stretch = coordinate_row(state, present_poses(state), n).value - j.spring->rest;
        sum += 0.5 * j.spring->stiffness * stretch * stretch;
      });
  return sum;
}

double joint_step(const State& state) {
  double least_step = endless;
  each_joint(
      state, [](const Joint& j) { return j.spring || j.damping > 0.0; },
      [&](const Joint& j, std::size_t n) {
        const JointRows row{coordinate_row(state, present_poses(state), n)};
        const double mobile = mobility(state, row, row)(0, 0);
        if (j.spring)
          least_step = std::min(least_step, share_of_joint_swing / std::sqrt(j.spring->stiffness * mobile));
        if (j.damping > 0.0) least_step = std::min(least_step, share_of_joint_damping / (j.damping * mobile));
      });
  return least_step;
}

bool has_joint_work(const Scene& scene) {
  return std::ranges::any_of(scene.joints, [](const Joint& j) {
    return j.limits || j.friction > 0.0 || j.damping > 0.0 || keeps_speed(j) ||
           (j.motor && j.motor->effort.value_or(0.0) != 0.0);
  });
}

}  // namespace tripoint::rigid
