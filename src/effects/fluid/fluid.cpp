// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "effects/fluid/fluid_terms.hpp"
#include "effects/fluid/material_numbers.hpp"
#include "effects/fluid/viscous_bound.hpp"
#include "effects/fluid/walls.hpp"

namespace tripoint::fluid {
namespace {

Triple<double> pressure_forces(Particles& p) { return triple(p, field::force_x, field::force_y, field::force_z); }
Triple<double> viscous_forces(Particles& p) { return triple(p, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z); }

void clear_columns(Particles& p, std::initializer_list<const Field<double>*> fields) {
  for (const Field<double>* f : fields) std::ranges::fill(p[*f], 0.0);
}

bool is_liquid(const Particles& p, std::size_t row) { return p[field::body][row] < 0; }

/// -1 for liquids, 0 for all walls, 1 + body for free bodies: members of one group exert nothing on each other.
double group_of(const World& world, std::size_t row) {
  const int body = world.particles[field::body][row];
  if (body < 0) return -1.0;
  const bool free = world.bodies[field::body_motion][static_cast<std::size_t>(body)] == static_cast<int>(Motion::free);
  return free ? 1.0 + body : 0.0;
}

class Fluid : public Effect {
 public:
  explicit Fluid(const Scene& scene) : numbers_(numbers_of(scene)), kernels_(pair_kernels(scene)) {}
  void load(World&, const InitialState&) override;
  void kick(World&, double dt) override;
  void drift(World&, double dt) override;
  void clear(World&, PassName) override;
  void state(World&) override;
  void happen(World& world, const Happening&) override { set_groups(world); }
  [[nodiscard]] TimeStepBound max_dt(const World&) const override;
  void add_to(const World&, Ledger&) const override;

 private:
  static void set_groups(World&);
  void set_density(World&) const;
  void set_pressure(World&) const;
  void predict_velocities(World&) const;

  SceneNumbers numbers_;
  PairKernels kernels_;
  ViscousBound viscous_bound_;
  double half_step_ = 0.0;  ///< of the last kick: velocities lag the rates' time by it [s]
};

void Fluid::load(World& world, const InitialState&) {
  Particles& p = world.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Body& body = world.scene.bodies.at(static_cast<std::size_t>(p[field::source][i]));
    p[field::rest_density][i] = world.material_of(i).density;
    p[field::solid][i] = is_liquid(p, i) ? 0.0 : 1.0;
    p[field::viscosity][i] = is_liquid(p, i) ? world.material_of(i).viscosity : world.scene.contact_viscosity;
    p[field::stick][i] = body.free_slip ? 0.0 : 1.0;
  }
  set_groups(world);
}

void Fluid::set_groups(World& world) {
  const auto group = world.particles[field::group];
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = group_of(world, i);
}

/// v += dt (F/m + g) for liquids; bodies take the same forces in the rigid effect. The work of each force is booked by its own
/// formula, dt F.(v- + v+)/2, which sums to the change of kinetic energy to round-off (model 8.11).
void Fluid::kick(World& world, double dt) {
  Particles& p = world.particles;
  const auto v = velocities(p);
  const auto F = pressure_forces(p), D = viscous_forces(p);
  const auto m = p[field::mass];
  static const double heavier = 1.0 + defect_size("fluid.gravity");
  const Vec3 g = heavier * world.scene.gravity;
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (!is_liquid(p, i)) continue;
    const Vec3 before = v.at(i);
    const Vec3 after = before + (dt / m[i]) * (F.at(i) + D.at(i)) + dt * g;
    const Vec3 mean = 0.5 * (before + after);
    world.booked.pressure_work += dt * dot(F.at(i), mean);
    world.booked.viscous_work += dt * dot(D.at(i), mean);
    world.booked.gravity_work += dt * m[i] * dot(g, mean);
    v.set(i, after);
  }
  half_step_ = dt;
}

void Fluid::drift(World& world, double dt) {
  Particles& p = world.particles;
  const auto r = positions(p), v = velocities(p);
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t i = 0; i < p.size(); ++i)
    if (is_liquid(p, i)) r.set(i, r.at(i) + dt * v.at(i));
  world.moved = true;
}

void Fluid::clear(World& world, PassName pass) {
  Particles& p = world.particles;
  if (pass == PassName::rates) {
    clear_columns(p, {&field::force_x, &field::force_y, &field::force_z, &field::viscous_force_x, &field::viscous_force_y, &field::viscous_force_z});
  } else if (world.scene.mode_of(Term::density) == Mode::corrected) {
    std::ranges::fill(p[field::number_density], kernels_.wendland.value(0.0));
  } else {
    const auto rho = p[field::density], m = p[field::mass];
    for (std::size_t i = 0; i < rho.size(); ++i) rho[i] = m[i] * kernels_.poly6.value(0.0);
  }
}

/// rho and V from the pass: delta = sum W / S0, rho = m delta (model 8.2), or (4) as printed.
void Fluid::set_density(World& world) const {
  Particles& p = world.particles;
  const auto rho = p[field::density], m = p[field::mass], V = p[field::volume];
  if (world.scene.mode_of(Term::density) == Mode::corrected) {
    const auto delta = p[field::number_density];
    static const double denser = 1.0 + defect_size("fluid.density");
    const double scale = denser / numbers_.lattice_density;
    for (std::size_t i = 0; i < rho.size(); ++i) rho[i] = m[i] * (delta[i] * scale);
  }
  for (std::size_t i = 0; i < rho.size(); ++i) V[i] = m[i] / rho[i];
}

void Fluid::set_pressure(World& world) const {
  Particles& p = world.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], pressure = p[field::pressure];
  const bool paper = world.scene.mode_of(Term::state) == Mode::paper;
  static const double stiffer = 1.0 + defect_size("fluid.stiffness");
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const EquationOfState e = state_of(numbers_, rest[i], world.scene.clamp);
    pressure[i] = stiffer * (paper ? pressure_paper(e, rho[i]) : pressure_corrected(e, rho[i]));
  }
}

/// Viscous pairs see liquids at the full step, a half kick with the old rates ahead (model 7, time).
void Fluid::predict_velocities(World& world) const {
  Particles& p = world.particles;
  const auto F = pressure_forces(p), D = viscous_forces(p);
  const auto seen = triple(p, field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z);
  const auto m = p[field::mass];
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    Vec3 v = p.velocity(i);
    if (is_liquid(p, i) && half_step_ > 0.0) v += half_step_ * (world.scene.gravity + (F.at(i) + D.at(i)) / m[i]);
    seen.set(i, v);
  }
}

void Fluid::state(World& world) {
  set_density(world);
  set_pressure(world);
  predict_velocities(world);
  if (world.scene.mode_of(Term::walls) == Mode::corrected) extrapolate_to_walls(world, numbers_, kernels_);
  if (world.scene.mode_of(Term::pressure) == Mode::corrected) {
    Particles& p = world.particles;
    const auto share = p[field::pressure_share], V = p[field::volume], pressure = p[field::pressure];
    for (std::size_t i = 0; i < share.size(); ++i) share[i] = V[i] * V[i] * pressure[i] / numbers_.lattice_density;
  }
  viscous_bound_.update(world, kernels_);
}

/// Sound C h/(c + |v|), C = 0.45 corrected, 0.7 printed; viscosity; acceleration 0.25 sqrt(h/|a|) (model 8.10).
TimeStepBound Fluid::max_dt(const World& world) const {
  const Particles& p = world.particles;
  const auto m = p[field::mass];
  double v2 = 0.0, a2 = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 v = p.velocity(i);
    v2 = std::max(v2, dot(v, v));
    if (!is_liquid(p, i)) continue;
    const Vec3 a = world.scene.gravity + (p.vector(i, field::force_x, field::force_y, field::force_z) + p.vector(i, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z)) / m[i];
    a2 = std::max(a2, dot(a, a));
  }
  const double courant = world.scene.mode_of(Term::pressure) == Mode::paper ? 0.7 : 0.45;
  TimeStepBound bound;
  tighten(bound, courant * world.support() / (numbers_.sound_speed + std::sqrt(v2)), "sound");
  tighten(bound, viscous_bound_.dt(), "viscosity");
  if (a2 > 0.0) tighten(bound, 0.25 * std::sqrt(world.support() / std::sqrt(a2)), "acceleration");
  return bound;
}

/// Core energy of the pairs of i that act, half of each pair [J].
double core_energy(const World& world, const PairKernels& kernels, std::size_t i) {
  const Particles& p = world.particles;
  const auto group = p[field::group];
  double sum = 0.0;
  for (const Entry e : world.neighbours->of(i)) {
    const Vec3 d = (p.position(e.row()) - p.position(i)) + world.neighbours->shift(e.image());
    sum += 0.5 * acts(group[i], group[e.row()]) * kernels.core.energy(norm(d));
  }
  return sum;
}

void Fluid::add_to(const World& world, Ledger& ledger) const {
  const Particles& p = world.particles;
  const bool core = world.scene.mode_of(Term::pressure) == Mode::corrected;
  const auto m = p[field::mass], rho = p[field::density], rest = p[field::rest_density];
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (core) ledger.energy["compression"] += core_energy(world, kernels_, i);
    if (!(p[field::group][i] == 0.0 && numbers_.extrapolates)) ledger.energy["compression"] += compression_energy(state_of(numbers_, rest[i], world.scene.clamp), m[i], rho[i]);
    if (!is_liquid(p, i)) continue;
    const Vec3 r = world.unwrapped(i), v = p.velocity(i);
    ledger.momentum += m[i] * v;
    ledger.angular_momentum += m[i] * cross(r, v);
    ledger.energy["kinetic"] += 0.5 * m[i] * dot(v, v);
    ledger.energy["potential"] -= m[i] * dot(world.scene.gravity, r);
  }
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"fluid",
               scene.mode_of(Term::pressure),
               {field::density, field::volume, field::pressure, field::rest_density, field::viscosity, field::solid, field::stick, field::group,
                field::force_x, field::force_y, field::force_z, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z,
                field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z},
               {field::mass, field::body, field::position_x, field::position_y, field::position_z, field::velocity_x, field::velocity_y, field::velocity_z}};
  const auto own = [&](std::initializer_list<FieldInfo> more) { s.owns.insert(s.owns.end(), more); };
  if (scene.mode_of(Term::density) == Mode::corrected) own({field::number_density});
  if (scene.mode_of(Term::pressure) == Mode::corrected) own({field::pressure_share});
  if (scene.mode_of(Term::walls) == Mode::corrected)
    own({field::wall_weight, field::wall_pressure, field::wall_lever_x, field::wall_lever_y, field::wall_lever_z, field::wall_velocity_x,
         field::wall_velocity_y, field::wall_velocity_z});
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Fluid>(scene); }

std::vector<DefectEntry> defects() {
  return {{"fluid.gravity", "gravity on liquids times 1 + size", "fluid/hydrostatic"},
          {"fluid.density", "number density times 1 + size", "fluid/hydrostatic"},
          {"fluid.stiffness", "pressure of (9) times 1 + size", "fluid/sound-wave"}};
}

}  // namespace tripoint::fluid
