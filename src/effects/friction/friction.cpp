// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "effects/effect.hpp"
#include "effects/friction/fields.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"
#include "liquids/let_out.hpp"
#include "liquids/predicted_velocities.hpp"
#include "liquids/scene_numbers.hpp"
#include "scene/contact_law.hpp"
#include "scene/geometry.hpp"
#include "state/body_table.hpp"
#include "state/fill.hpp"

/// Coulomb's friction and Newton's law of impact of solids that touch, by pairs of materials (model 8.18).
namespace tripoint::friction {
namespace {

/// Stiffness of the spring of a particle that sticks, over k rho_ref dx [1]: half the frequency of sound in
/// it, so that no step is shorter by it.
constexpr double spring_share = 0.25;
constexpr double spring_damping = 0.5;  ///< over the critical one of a particle [1]
/// Speed of parting from which on a contact loses its share in full: over the speed of sound, and over what
/// gravity gives in a step of sound [1]. Below it what rests does not tremble.
constexpr double parting_of_sound = 2e-4, parting_of_fall = 2.0;

double parting_of(const Scene& scene, const liquid::SceneNumbers& n) {
  const double step = n.courant * scene.support_ratio * scene.spacing / n.contact_speed;
  return std::max(parting_of_sound * n.contact_speed, parting_of_fall * norm(scene.gravity) * step);
}

struct Law {
  double friction = 0.0;  ///< mu
  double returned = 1.0;  ///< e^2: share of the energy of a hit
};

/// Where the face of a body looks at a particle: the slope of the kernel sum S over the body, which points
/// out of it. Edges and corners look askew, and S is smaller there: its power leaves the word to what is
/// flat.
struct Outward {
  double sum = 0.0;
  Vec3 slope;
  void add(const PairKernels& kernels, const Vec3& d, double r) {
    sum += kernels.wendland.value(r);
    slope += kernels.wendland.derivative_over_r(r) * d;
  }
  /// @param whole  S within a body
  [[nodiscard]] Vec3 direction(double whole) const {
    const double share2 = (sum / whole) * (sum / whole);
    return (share2 * share2 * share2) * slope;
  }
};

/// Speeds of parting over the step whose kicks the present forces make [m/s].
struct Parting {
  double start = 0.0;  ///< ahead of the step
  double end = 0.0;    ///< at its end, if nothing is lost
};

/// A pair of solids that press each other.
struct Contact {
  std::uint32_t other;
  Vec3 d, force;  ///< r_j - r_i, the force on i
  Law law;
  double part = 0.0;  ///< of the force that presses, along the normal of i [N]
  Parting speed = {};
};

bool are_rigid(const State& state, std::size_t i, std::size_t j) {
  const auto body = state.particles[field::body];
  return is_rigid(state, static_cast<std::size_t>(body[i])) &&
         is_rigid(state, static_cast<std::size_t>(body[j]));
}

std::pair<int, int> bodies_of(const State& state, std::size_t i, std::size_t j) {
  const auto body = state.particles[field::body];
  return std::minmax(static_cast<int>(body[i]), static_cast<int>(body[j]));
}

/// What the contacts between two rigid bodies give back, in all and those that part alone [W].
struct Returned {
  double all = 0.0, parting = 0.0;
};

class Friction : public Effect {
 public:
  explicit Friction(const Scene&);
  void drift(State&, double dt) override { drifted_ = dt; }
  void state(State&, const Rows&) override;
  void bonds(State&, const Rows&) override;
  void adopt(State&) override;

 private:
  void find(State&, std::size_t row, std::vector<Contact>&) const;
  void press(State&, std::size_t row) const;
  void share(State&, std::size_t row) const;
  void weigh(State&, std::size_t row);
  void set_accelerations(const State&);
  [[nodiscard]] Vec3 acceleration(const State&, std::size_t row) const;
  void set_partings(const State&, std::size_t row);
  void set_returned(const State&);
  [[nodiscard]] double share_returned(const State&, std::size_t row, const Contact&) const;

  liquid::SceneNumbers numbers_;
  PairKernels kernels_;
  std::vector<Law> laws_;  ///< of materials, a row each
  std::size_t materials_;
  double stiffness_, parting_;
  double whole_;                     ///< kernel sum within a body, without the own particle [1/m3]
  double drifted_ = 0.0;             ///< since the last forces, within a step [s]
  std::vector<std::size_t> loaded_;  ///< rows with a load, in order of id
  std::vector<Vec3> accelerations_;  ///< of bodies, by loads and gravity [m/s2]
  std::map<std::pair<int, int>, Returned> returned_;  ///< of pairs of rigid bodies, the lesser number first
  std::vector<std::vector<Contact>> contacts_;        ///< of each row; memory that is used again
};

Friction::Friction(const Scene& scene)
    : numbers_(liquid::numbers_of(scene)),
      kernels_(liquid::pair_kernels(scene)),
      materials_(scene.materials.size()),
      stiffness_(spring_share * numbers_.stiffness * numbers_.reference_density * cell_depth(scene)),
      parting_(parting_of(scene, numbers_)),
      whole_(numbers_.lattice_density / scene.cell() - kernels_.wendland.value(0.0)) {
  for (const Material& a : scene.materials)
    for (const Material& b : scene.materials) {
      Law law;
      if (const ContactLaw* one = contact_law_of(scene, a.name, b.name)) {
        const double e = one->restitution.value_or(0.0);
        law = {one->friction.value_or(0.0), e * e};
      }
      laws_.push_back(law);
    }
}

void Friction::adopt(State& state) {
  for (const std::uint32_t id : state.change.regrouped)
    triple(state.particles, field::slip).set(state.particles.row(id), {});
}

void Friction::state(State& state, const Rows&) {
  kernels_.core.stiffness = liquid::core_share(state, numbers_) * numbers_.core_stiffness;
  liquid::predict_velocities(state, state.step_numbers[liquid::half_step], field::contact_velocity);
}

/// The solids that press on a solid, and where its face looks. The first lists are whole: fixed faces know it
/// from then on.
void Friction::find(State& state, std::size_t i, std::vector<Contact>& found) const {
  const Particles& p = std::as_const(state.particles);
  const auto x = positions(p);
  const auto group = p[field::group], share = p[field::pressure_share];
  const auto body = p[field::body], material = p[field::material];
  found.clear();
  if (group[i] == liquid_group) return;
  const double support2 = state.support() * state.support();
  Outward out;
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (group[j] == liquid_group) continue;
    const Vec3 d = (x.at(j) - x.at(i)) + state.neighbours->shift(e.image());
    const double r2 = dot(d, d);
    if (!(r2 < support2) || r2 == 0.0) continue;
    const double r = std::sqrt(r2);
    if (body[i] == body[j]) {
      out.add(kernels_, d, r);
      continue;
    }
    const double f = (share[i] + share[j]) * kernels_.wendland.derivative_over_r(r) -
                     kernels_.core.force_over_r(r, 1.0 / r2);
    if (!(f < 0.0)) continue;
    found.push_back(
        {static_cast<std::uint32_t>(j), d, f * d,
         laws_[static_cast<std::size_t>(material[i]) * materials_ + static_cast<std::size_t>(material[j])]});
  }
  if (i < state.particles.moving()) triple(state.particles, field::outward).set(i, out.direction(whole_));
}

/// Velocity of a particle less that of another, of both bodies halfway between them.
Vec3 relative_velocity(const State& state, Triple<const double> v, std::size_t i, const Contact& c) {
  const auto body = state.particles[field::body];
  const auto turns = [&](std::size_t row) {
    const auto b = static_cast<std::size_t>(body[row]);
    return is_rigid(state, b) ? cross(state.bodies[field::body_angular_velocity][b], 0.5 * c.d) : Vec3{};
  };
  return (v.at(i) + turns(i)) - (v.at(c.other) - turns(c.other));
}

/// Velocity of the centre of the body that a particle is a member of; its own where that is not rigid.
Vec3 carried_velocity(const State& state, Triple<const double> v, std::size_t i) {
  const auto b = static_cast<std::size_t>(state.particles[field::body][i]);
  return is_rigid(state, b) ? state.bodies[field::body_velocity][b] : v.at(i);
}

/// Part of a pair force that presses.
double part_along(const Contact& c, const Vec3& n) { return std::max(dot(c.force, n), 0.0); }

/// Of the step whose kicks the present forces make, the share in which a contact parts.
/// @param before  speed of parting ahead of the step   @param after  at its end, where nothing is lost
double share_parting(double before, double after) {
  if (before >= 0.0) return 1.0;
  return after > 0.0 ? after / (after - before) : 0.0;
}

/// The normal of the face at a particle, and the load along it.
void Friction::weigh(State& state, std::size_t i) {
  Particles& p = state.particles;
  const auto normal = triple(p, field::contact_normal);
  const auto out = triple(std::as_const(p), field::outward);
  const auto load = p[field::contact_load];
  load[i] = 0.0;
  Vec3 face;
  for (const Contact& c : contacts_[i]) face += norm(c.force) * (out.at(c.other) - out.at(i));
  const double steep = norm(face);
  if (steep == 0.0) return;
  const Vec3 n = (1.0 / steep) * face;
  normal.set(i, n);
  for (Contact& c : contacts_[i]) {
    c.part = part_along(c, n);
    load[i] += c.part;
  }
}

/// Of each rigid body that forces move, by the loads on its particles in order of id, and gravity.
void Friction::set_accelerations(const State& state) {
  const Particles& p = state.particles;
  const auto body = p[field::body];
  const auto load = p[field::contact_load];
  const auto normal = triple(p, field::contact_normal);
  accelerations_.assign(state.bodies.size(), {});
  loaded_.clear();
  for (std::size_t id = 0; id < p.size(); ++id)
    if (const std::size_t i = p.row(id); load[i] > 0.0) loaded_.push_back(i);
  for (const std::size_t i : loaded_)
    if (body[i] >= 0) accelerations_[static_cast<std::size_t>(body[i])] += load[i] * normal.at(i);
  for (std::size_t b = 0; b < accelerations_.size(); ++b) {
    const bool free = state.bodies[field::body_motion][b] == static_cast<int>(Motion::free);
    accelerations_[b] =
        free ? (1.0 / state.bodies[field::body_mass][b]) * accelerations_[b] + state.scene.gravity : Vec3{};
  }
}

/// Of a particle, or of the body that it is a member of.
Vec3 Friction::acceleration(const State& state, std::size_t i) const {
  const Particles& p = state.particles;
  const auto b = static_cast<std::size_t>(p[field::body][i]);
  if (is_rigid(state, b)) return accelerations_[b];
  return (p[field::contact_load][i] / p[field::mass][i]) * triple(p, field::contact_normal).at(i) +
         state.scene.gravity;
}

/// How fast the contacts of a particle part.
void Friction::set_partings(const State& state, std::size_t i) {
  if (!(state.particles[field::contact_load][i] > 0.0)) return;
  const Vec3 n = triple(state.particles, field::contact_normal).at(i);
  const double dt = 2.0 * state.step_numbers[liquid::half_step];
  for (Contact& c : contacts_[i]) {
    const double start = dot(relative_velocity(state, velocities(state.particles), i, c), n);
    c.speed = {start, start + dt * dot(acceleration(state, i) - acceleration(state, c.other), n)};
  }
}

void Friction::set_returned(const State& state) {
  returned_.clear();
  for (const std::size_t i : loaded_)
    for (const Contact& c : contacts_[i]) {
      if (!are_rigid(state, i, c.other)) continue;
      const double power = c.part * c.speed.end;
      Returned& of = returned_[bodies_of(state, i, c.other)];
      of.all += power;
      of.parting += std::max(power, 0.0);
    }
}

/// Share of what parting contacts give that the bodies get: all of it in a hit, and none where one rolls, for
/// as much goes into the contacts ahead.
double Friction::share_returned(const State& state, std::size_t i, const Contact& c) const {
  if (!are_rigid(state, i, c.other)) return 1.0;
  const auto found = returned_.find(bodies_of(state, i, c.other));
  if (found == returned_.end() || !(found->second.parting > 0.0)) return 1.0;
  return std::max(found->second.all / found->second.parting, 0.0);
}

/// The traction of a particle: friction against its slip, and what a parting contact does not give back.
void Friction::press(State& state, std::size_t i) const {
  Particles& p = state.particles;
  const auto slip = triple(p, field::slip), traction = triple(p, field::traction);
  const double size = p[field::contact_load][i];
  traction.set(i, {});
  if (size == 0.0) return slip.set(i, {});
  const Vec3 n = triple(std::as_const(p), field::contact_normal).at(i);
  const auto predicted = triple(std::as_const(p), field::contact_velocity);
  Vec3 sum, u, carried;  // u amid the step whose kicks this force makes
  Law law{0.0, 0.0};
  double start = 0.0, end = 0.0, returned = 0.0;
  for (const Contact& c : contacts_[i]) {
    const double part = c.part;
    sum += c.force;
    u += part * relative_velocity(state, predicted, i, c);
    carried +=
        (part / size) * (carried_velocity(state, predicted, i) - carried_velocity(state, predicted, c.other));
    start += (part / size) * c.speed.start;
    end += (part / size) * c.speed.end;
    returned += (part / size) * share_returned(state, i, c);
    law.friction += part * c.law.friction;
    law.returned += part * c.law.returned;
  }
  u = (1.0 / size) * u;
  law.friction /= size;
  law.returned /= size;
  const double slow = std::clamp((start < 0.0 ? end : start) / parting_, 0.0, 1.0);
  // Where one slips it does not roll, and rubs by what presses it: no bounce of a part is given back
  const Vec3 along = u - dot(u, n) * n, way = carried - dot(carried, n) * n;
  const double slips = norm(along) < norm(way) ? norm(along) / norm(way) : 1.0;
  const double given = returned + (1.0 - returned) * slips;
  const double lost = (1.0 - law.returned) * share_parting(start, end) * given * slow;
  // Faces of particles are rough: what they push along themselves is lost where they part straight alone
  const double straight = dot(u, u) > 0.0 ? dot(u, n) * dot(u, n) / dot(u, u) : 0.0;
  Vec3 T = -lost * (straight * sum + (1.0 - straight) * dot(sum, n) * n);
  if (law.friction > 0.0) {
    Vec3 s = slip.at(i) + drifted_ * along;
    s -= dot(s, n) * n;
    const double damping = 2.0 * spring_damping * std::sqrt(stiffness_ * p[field::mass][i]);
    Vec3 held = -stiffness_ * s - damping * along;
    const double most = law.friction * (1.0 - lost) * size, asked = norm(held);
    if (asked > most) {
      held = (most / asked) * held;
      s = (-1.0 / stiffness_) * held;
    }
    slip.set(i, s);
    T += held;
  } else {
    slip.set(i, {});
  }
  traction.set(i, T);
}

/// The forces of the pairs of a particle: each has half of the tractions of both.
void Friction::share(State& state, std::size_t i) const {
  Particles& p = state.particles;
  const auto force = triple(p, field::friction_force), couple = triple(p, field::friction_couple);
  const auto traction = triple(std::as_const(p), field::traction),
             normal = triple(std::as_const(p), field::contact_normal);
  const auto load = p[field::contact_load];
  Vec3 sum, moment;
  for (const Contact& c : contacts_[i]) {
    const std::size_t j = c.other;
    Vec3 f;
    if (load[i] > 0.0) f += (0.5 * part_along(c, normal.at(i)) / load[i]) * traction.at(i);
    if (load[j] > 0.0) f -= (0.5 * std::max(-dot(c.force, normal.at(j)), 0.0) / load[j]) * traction.at(j);
    sum += f;
    moment += cross(0.5 * c.d, f);
  }
  force.set(i, sum);
  couple.set(i, moment);
}

/// Fixed faces have tractions too: their particles in reach of what moves have lists.
void Friction::bonds(State& state, const Rows& rows) {
  contacts_.resize(std::max(contacts_.size(), state.particles.size()));
  for (const VectorField<double>* f : {&field::friction_force, &field::friction_couple})
    for (const Field<double>* one : columns_of(*f))
      fill(part(state.particles[*one], rows), 0.0, state.threads);
  const Clusters& c = state.neighbours->clusters();
  const auto each = [&](auto visit) {
#pragma omp parallel for schedule(dynamic, 16) num_threads(state.threads)
    for (std::size_t n = 0; n < c.listed.size(); ++n)
      for (std::uint32_t i = c.first[c.listed[n]]; i < c.first[c.listed[n] + 1]; ++i) visit(i);
  };
  const auto formed = [&](std::size_t i) { return i >= rows.from && i < rows.to; };
  if (!state.forms_fixed) {
    each([&](std::size_t i) { find(state, i, contacts_[i]); });
    each([&](std::size_t i) { weigh(state, i); });
    set_accelerations(state);
    each([&](std::size_t i) { set_partings(state, i); });
    set_returned(state);
    each([&](std::size_t i) { press(state, i); });
  } else {
    each([&](std::size_t i) {
      if (formed(i)) find(state, i, contacts_[i]);
    });
  }
  each([&](std::size_t i) {
    if (formed(i)) share(state, i);
  });
  drifted_ = 0.0;
}

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{
      "friction",
      Mode::corrected,
      {field::friction_force, field::friction_couple, field::slip, field::traction, field::outward,
       field::contact_normal, field::contact_load, field::contact_velocity},
      fields::joined({fields::position(),
                      fields::velocity(),
                      {field::mass, field::body, field::material, field::group, field::pressure_share}})};
  s.reads_if_there = fields::image();
  s.sums_forces = true;
  s.skips_sleeping = true;
  Force friction{field::friction_force, {"friction_work"}, EnergyAccount{"wall_friction_work"}};
  friction.entry = "friction";
  friction.couple = field::friction_couple;
  s.forces = {friction};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Friction>(scene); }

}  // namespace tripoint::friction
