// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/rigid.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "effects/rigid/adopt.hpp"
#include "effects/rigid/applied_force.hpp"
#include "effects/rigid/bodies.hpp"
#include "effects/rigid/fields.hpp"
#include "effects/rigid/joints.hpp"
#include "effects/rigid/merge_split.hpp"
#include "effects/rigid/rotation.hpp"
#include "effects/rigid/springs.hpp"
#include "effects/rigid/terms.hpp"
#include "scene/geometry.hpp"
#include "scene/ledger_entry.hpp"
#include "scene/motion.hpp"
#include "solids/body_forces.hpp"
#include "solids/grip.hpp"

namespace tripoint::rigid {
namespace {

class RigidBodies : public Effect {
 public:
  explicit RigidBodies(const Scene& scene)
      : turns_as_printed_(scene.mode_of(term::rotation) == Mode::paper) {}
  void load(State&, const InitialState&) override;
  void kick(State&, double dt) override;
  void drift(State&, double dt) override;
  void happen(State&, const Happening&) override;
  void adopt(State& state) override { adopt_members(state); }
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State&, Ledger&) const override;

 private:
  void push_free(State&, double dt);

  std::vector<BodyForces> forces_;  ///< memory that is used again from kick to kick
  bool turns_as_printed_;
};

/// Greatest angle of a step [rad]: a choice that guards accuracy, since the splitting stays bounded at any
/// angle. At it a tumbling body keeps its energy to a thousandth (RotationBound, tests/step/bounds_test.cpp).
constexpr double most_turn = 0.5;
/// The same where the step is ours to choose: a tumbling body is then within 0.005 rad after two turns.
constexpr double chosen_turn = 0.1;

/// L of a body that turns about one axis only must lie along it. @throws InputError naming the body
void refuse_blocked_spin(const State& state, std::size_t b) {
  const Vec3 turns = state.bodies[field::body_turns][b], w = state.bodies[field::body_angular_velocity][b];
  const Vec3 L = state.bodies[field::body_angular_momentum][b];
  if (!is_free(state, b)) return;
  // Round-off of the particles' sums is of the size of m v dx also where nothing turns.
  const double dx = state.scene.spacing, speed = norm(state.bodies[field::body_velocity][b]);
  const double size = state.bodies[field::body_mass][b] * dx * (1e-300 + speed + dx * norm(w));
  for (std::size_t a = 0; a < 3; ++a) {
    if (turns[a] != 0.0 || std::abs(L[a]) <= 1e-9 * size) continue;
    throw InputError(
        "the rigid body " + state.body_names[b] +
        " reaches through a periodic direction and would turn across it: " +
        "make that direction not periodic, or the body shorter, or let it turn about that axis only");
  }
}

/// A gripped body at a time: carried from where it was when the grip took it.
PrescribedState gripped_state(const State& state, std::size_t b, double time) {
  const Columns& t = state.bodies;
  PrescribedState s = carried(state.scene.events[static_cast<std::size_t>(t[field::body_grip][b] - 1)],
                              t[field::body_grip_centre][b], time);
  s.rotation = s.rotation * t[field::body_grip_orientation][b];
  return s;
}

/// A driven body at a time: its keyframes, or constant velocity and angular velocity for ever.
PrescribedState driven_state(const State& state, std::size_t b, double time) {
  const Columns& t = state.bodies;
  if (t[field::body_grip][b] > 0) return gripped_state(state, b, time);
  const auto source = t[field::body_source][b];
  static const std::vector<Keyframe> none;
  const auto& keyframes = source >= 0 ? state.scene.bodies[static_cast<std::size_t>(source)].keyframes : none;
  return prescribed_state(keyframes, t[field::body_start_centre][b], t[field::body_start_velocity][b],
                          t[field::body_start_spin][b], time);
}

void drive(State& state, std::size_t b, double time) {
  Columns& t = state.bodies;
  const PrescribedState s = driven_state(state, b, time);
  const Vec3 lever = rotate(s.rotation, t[field::body_offset][b]);
  t[field::body_orientation][b] = s.rotation;
  t[field::body_centre][b] = s.position + lever;
  t[field::body_angular_velocity][b] = s.angular_velocity;
  t[field::body_velocity][b] = s.velocity + cross(s.angular_velocity, lever);
  t[field::body_angular_momentum][b] = spin_momentum(state, b);
}

/// Of a body that is alive and rigid.
Motion motion_now(const State& state, std::size_t b) {
  return static_cast<Motion>(state.bodies[field::body_motion][b]);
}

bool at_rest(const State& state, std::size_t b) {
  return state.bodies[field::body_velocity][b] == Vec3{} &&
         state.bodies[field::body_angular_momentum][b] == Vec3{};
}

/// Turns a free body by its angular momentum; the one that reaches through a periodic box about that axis.
Quaternion turned(const State& state, std::size_t b, double dt, bool as_printed) {
  const Columns& t = state.bodies;
  const Vec3 L = t[field::body_angular_momentum][b];
  const Quaternion orientation = t[field::body_orientation][b];
  if (L == Vec3{}) return orientation;
  if (t[field::body_turns][b] != Vec3{1.0, 1.0, 1.0})
    return normalised(from_rotation_vector(dt * t[field::body_angular_velocity][b]) * orientation);
  const Quaternion q = principal_to_world(state, b);
  const Vec3 I = t[field::body_inertia][b];
  const auto rotated = [&] {
    if (as_printed) return rotated_paper(q, I, L, dt);
    return state.axis_order ? rotated_no_squish(q, I, L, dt, *state.axis_order)
                            : rotated_corrected(q, I, L, dt);
  };
  return rotated() * conjugate(t[field::body_axes][b]);
}

void turn(State& state, std::size_t b, double dt, bool as_printed) {
  Columns& t = state.bodies;
  if (t[field::body_angular_momentum][b] == Vec3{}) return;
  t[field::body_orientation][b] = turned(state, b, dt, as_printed);
  if (t[field::body_turns][b] == Vec3{1.0, 1.0, 1.0}) update_spin(state, b);
}

/// v += dt (F/m + g), L += dt tau (18)-(19); the work of each force is accumulated by its own formula
/// (model 8.11).
void push(State& state, std::size_t b, const BodyForces& f, const Vec3& g, double dt) {
  Columns& t = state.bodies;
  Vec3& v = t[field::body_velocity][b];
  const double m = t[field::body_mass][b];
  const Vec3 v_before = v, omega_before = t[field::body_angular_velocity][b];
  v += dt * (f.force() / m + g);
  t[field::body_angular_momentum][b] += dt * f.torque();
  update_spin(state, b);
  t[field::body_acceleration][b] = (1.0 / dt) * (v - v_before);
  t[field::body_angular_acceleration][b] = (1.0 / dt) * (t[field::body_angular_velocity][b] - omega_before);
  if (!state.reports(b)) return;
  const Vec3 mean = 0.5 * (v_before + v), spin = 0.5 * (omega_before + t[field::body_angular_velocity][b]);
  for (std::size_t k = 0; k < state.forces.size(); ++k)
    if (state.forces[k].feels == Feels::all)
      state.accumulated[state.forces[k].work] += dt * (dot(f.forces[k], mean) + dot(f.torques[k], spin));
  state.accumulated[account::gravity_work] += dt * m * dot(g, mean);
}

/// The work of forces on a driven body goes to its driver. Half a kick works along the drift beside it. At a
/// keyframe the half kick before goes with the old velocity, and the one after with the new.
void accumulate_wall_work(State& state, std::size_t b, const std::vector<BodyForces>& forces, double dt) {
  if (forces.empty() || !state.reports(b)) return;
  const bool ends_step = state.time == state.next_time;
  const PrescribedState s = driven_state(state, b, ends_step ? state.time - dt : state.time + dt);
  const Vec3 omega = s.angular_velocity,
             v = s.velocity + cross(omega, rotate(s.rotation, state.bodies[field::body_offset][b]));
  const BodyForces& f = forces[b];
  for (std::size_t k = 0; k < state.forces.size(); ++k)
    if (state.forces[k].feels == Feels::all)
      state.accumulated[work_on_driven(state.forces[k])] +=
          dt * (dot(f.forces[k], v) + dot(f.torques[k], omega));
}

void RigidBodies::load(State& state, const InitialState& initial) {
  const std::vector<std::vector<std::size_t>> rows = members_of_all(state);
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    if (!is_rigid(state, b)) continue;
    Columns& t = state.bodies;
    const Body& body = state.scene.bodies[static_cast<std::size_t>(t[field::body_source][b])];
    measure(state, b, rows[b]);
    t[field::body_offset][b] = {};
    t[field::body_start_centre][b] = t[field::body_centre][b];
    t[field::body_start_spin][b] = body.angular_velocity;
    if (body.motion == Motion::fixed) continue;
    Vec3 P, L;
    for (const std::size_t i : rows[b]) {
      const auto id = static_cast<std::size_t>(state.particles[field::id][i]);
      P += initial.mass[id] * initial.velocity[id];
      L += initial.mass[id] * cross(initial.position[id] - t[field::body_centre][b], initial.velocity[id]);
    }
    if (!is_alive(state, b)) continue;
    t[field::body_velocity][b] = t[field::body_start_velocity][b] = P / t[field::body_mass][b];
    t[field::body_angular_momentum][b] = L;
    update_spin(state, b);
    refuse_blocked_spin(state, b);
    if (body.motion == Motion::prescribed) drive(state, b, state.time);
  }
  if (!state.scene.joints.empty()) check_joints_at_start(state);
  give_velocities(state);
}

void RigidBodies::kick(State& state, double dt) {
  const bool first = state.time < state.next_time, joined = !state.scene.joints.empty();
  if (joined && first) damp_joints(state, dt);
  const Vec3 g = state.scene.gravity;
  forces_on_moving_bodies(state, forces_);
  static const BodyForces none;
  const bool pushes = !state.scene.forces.empty();
  bool any = false;
  each_kept_body(state, [&](std::size_t b) {
    if (!is_alive(state, b) || !is_rigid(state, b) || motion_now(state, b) == Motion::fixed) return;
    any = true;
    motion_now(state, b) == Motion::free ? push(state, b, forces_.empty() ? none : forces_[b], g, dt)
                                         : accumulate_wall_work(state, b, forces_, dt);
    if (pushes && motion_now(state, b) == Motion::free) push_by_applied_forces(state, b, dt);
  });
  if (!state.scene.springs.empty()) pull_by_springs(state, dt);
  if (joined) pull_by_joint_laws(state, dt);
  if (joined && !first) still_joints(state, dt);
  if (any) give_velocities(state);
}

/// Free bodies by their velocities. @return whether any moved
bool move_free(State& state, double dt, bool as_printed) {
  Columns& t = state.bodies;
  bool any = false;
  each_kept_body(state, [&](std::size_t b) {
    if (!is_alive(state, b) || !is_rigid(state, b) || !is_free(state, b) || at_rest(state, b)) return;
    t[field::body_centre][b] += dt * t[field::body_velocity][b];
    const double before = kinetic_energy(state, b);
    turn(state, b, dt, as_printed);
    if (state.reports(b)) state.accumulated[account::rotation_drift] += kinetic_energy(state, b) - before;
    any = true;
  });
  return any;
}

/// Driven bodies to the end of the step. @return whether there are any
bool move_driven(State& state) {
  bool any = false;
  each_kept_body(state, [&](std::size_t b) {
    if (!is_alive(state, b) || !is_rigid(state, b) || motion_now(state, b) == Motion::fixed ||
        is_free(state, b))
      return;
    const double kinetic = kinetic_energy(state, b), potential = potential_energy(state, b);
    drive(state, b, state.next_time);
    const double raised = potential_energy(state, b) - potential;
    if (state.reports(b)) {
      state.accumulated[account::driven_potential] += raised;
      state.accumulated[account::walls] -= kinetic_energy(state, b) - kinetic + raised;
    }
    any = true;
  });
  return any;
}

/// All forces but those of joints, which stay as they were at the last kick.
void RigidBodies::push_free(State& state, double dt) {
  static const BodyForces none;
  each_kept_body(state, [&](std::size_t b) {
    if (!is_alive(state, b) || !is_rigid(state, b) || !is_free(state, b)) return;
    push(state, b, forces_.empty() ? none : forces_[b], state.scene.gravity, dt);
    if (!state.scene.forces.empty()) push_by_applied_forces(state, b, dt);
  });
  if (!state.scene.springs.empty()) pull_by_springs(state, dt);
}

void RigidBodies::drift(State& state, double dt) {
  bool any = state.body_owners.any();  // this process does not know whether another has one that moves
  const auto move = [&](double part) { any = move_free(state, part, turns_as_printed_) || any; };
  if (state.scene.joints.empty())
    move(dt);
  else
    drift_with_joints(state, dt,
                      {turned, turns_as_printed_, [&](double part) { push_free(state, part); }, move});
  any = move_driven(state) || any;
  if (!any) return;
  place_members(state);
  state.moved = true;
}

/// How the scene says that a body moves; one born by a split is free.
Motion own_motion(const State& state, std::size_t b) {
  const int source = state.bodies[field::body_source][b];
  return source < 0 ? Motion::free : state.scene.bodies[static_cast<std::size_t>(source)].motion;
}

/// Holds bodies still, or lets them go: the change of their energy is accumulated at the walls.
void set_motion(State& state, std::size_t b, Motion motion) {
  Columns& t = state.bodies;
  const double before = kinetic_energy(state, b);
  t[field::body_motion][b] = static_cast<int>(motion);
  t[field::body_acceleration][b] = t[field::body_angular_acceleration][b] = {};
  if (motion == Motion::fixed) {
    t[field::body_velocity][b] = t[field::body_angular_momentum][b] = t[field::body_angular_velocity][b] = {};
  }
  state.accumulated[account::walls] += before - kinetic_energy(state, b);
}

/// Free bodies with most of their members in the region are driven by the grip from now on.
void grip(State& state, const Event& event) {
  const auto inside = inside_region(state.scene, *event.region);
  Columns& t = state.bodies;
  for (std::size_t b = 0; b < t.size(); ++b) {
    if (!is_free(state, b)) continue;
    const std::vector<std::size_t> rows = members(state, b);
    if (2 * std::ranges::count_if(rows, [&](std::size_t i) { return inside(state.unwrapped(i)); }) <=
        std::ssize(rows))
      continue;
    t[field::body_grip][b] = 1 + static_cast<int>(&event - state.scene.events.data());
    t[field::body_grip_centre][b] = t[field::body_centre][b];
    t[field::body_grip_orientation][b] = t[field::body_orientation][b];
    t[field::body_offset][b] = {};
    set_motion(state, b, Motion::prescribed);
  }
}

/// A body that a grip drove goes on freely with its present motion.
void let_go(State& state, const Event& event) {
  Columns& t = state.bodies;
  for (std::size_t b = 0; b < t.size(); ++b) {
    if (!is_alive(state, b) ||
        t[field::body_grip][b] != 1 + static_cast<int>(&event - state.scene.events.data()))
      continue;
    t[field::body_grip][b] = 0;
    set_motion(state, b, Motion::free);
  }
}

bool is_liquid(const Scene& scene, const std::string& name) {
  const auto body = std::ranges::find(scene.bodies, name, &Body::name);
  return body != scene.bodies.end() && body->phase == Phase::liquid;
}

/// A body, or all that a grip of that name holds.
void release(State& state, const std::string& name) {
  for (const Event& e : state.scene.events)
    if (e.kind == Event::Kind::grip && e.name == name) return let_go(state, e);
  if (is_liquid(state.scene, name)) return;
  if (const std::size_t b = body_row(state, name); is_rigid(state, b)) set_motion(state, b, Motion::free);
}

void RigidBodies::happen(State& state, const Happening& now) {
  switch (now.event.kind) {
    case Event::Kind::merge:
      merge(state, now.event);
      break;
    case Event::Kind::split:
      split(state, now.event);
      break;
    case Event::Kind::release:
      for (const std::string& name : now.event.bodies) release(state, name);
      break;
    case Event::Kind::hold:
      for (const std::string& name : now.event.bodies) {
        if (is_liquid(state.scene, name)) continue;
        const std::size_t b = body_row(state, name);
        if (is_rigid(state, b)) set_motion(state, b, now.begins ? Motion::fixed : own_motion(state, b));
      }
      break;
    case Event::Kind::grip:
      now.begins ? grip(state, now.event) : let_go(state, now.event);
      break;
    case Event::Kind::heat:
      return;
  }
  for (std::size_t b = 0; b < state.bodies.size(); ++b) refuse_blocked_spin(state, b);
  give_velocities(state);
}

/// |omega| dt <= chosen_turn, and acceleration_step() for what falls (model 8.10).
TimeStepBound RigidBodies::max_dt(const State& state) const {
  TimeStepBound bound;
  const double angle = state.scene.time_step || turns_as_printed_ ? most_turn : chosen_turn;
  const double g = norm(state.scene.gravity);
  each_kept_body(state, [&](std::size_t b) {
    if (!is_free(state, b)) return;
    const double spin = norm(state.bodies[field::body_angular_velocity][b]);
    if (spin > 0.0) tighten(bound, angle / spin, "rotation");
    const double a = state.scene.forces.empty() ? g : g + applied_acceleration(state, b);
    if (a > 0.0) tighten(bound, acceleration_step(state.support(), a), "acceleration");
  });
  if (!state.scene.springs.empty()) tighten(bound, spring_step(state), "spring");
  if (!state.scene.joints.empty()) tighten(bound, joint_step(state), "joint");
  return bound;
}

void RigidBodies::add_to(const State& state, Ledger& ledger) const {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    if (!is_alive(state, b) || !is_rigid(state, b)) continue;
    if (!state.reports(b)) {  // the same entries all the same
      for (const char* entry : {ledger_entry::kinetic, ledger_entry::potential})
        ledger.energy.try_emplace(entry, 0.0);
      continue;
    }
    const BodyMotion m = motion_of(state, b);
    ledger.momentum += m.mass * m.velocity;
    ledger.angular_momentum += m.L + m.mass * cross(m.centre, m.velocity);
    ledger.energy[ledger_entry::kinetic] += kinetic_energy(state, b);
    ledger.energy[ledger_entry::potential] += potential_energy(state, b);
  }
  if (!state.scene.springs.empty()) ledger.energy[ledger_entry::potential] += spring_energy(state);
  if (!state.scene.joints.empty()) ledger.energy[ledger_entry::potential] += joint_energy(state);
  if (state.accumulated.has(account::applied_work))
    ledger.energy["applied_force"] -= state.accumulated[account::applied_work];
  if (state.is_first()) ledger.angular_momentum += state.accumulated.undelivered_spin;
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{
      "rigid",
      scene.mode_of(term::rotation),
      {field::reference},
      fields::joined({fields::position(), fields::velocity(), {field::id, field::mass, field::body}})};
  s.reads_if_there = fields::image();
  s.sums_forces = true;
  s.skips_sleeping = true;
  const bool damps = std::ranges::any_of(scene.springs, [](const Spring& one) { return one.damping > 0.0; });
  if (damps || has_joint_work(scene) || has_forces_without_potential(scene))
    s.accounts = {account::applied_work};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<RigidBodies>(scene); }

}  // namespace tripoint::rigid
