// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "effects/fluid/fluid_ledger.hpp"
#include "effects/fluid/fluid_state.hpp"
#include "effects/fluid/transport.hpp"
#include "effects/fluid/viscous_bound.hpp"
#include "effects/fluid/walls.hpp"
#include "effects/ordered_sum.hpp"
#include "sph/pass.hpp"

namespace tripoint::fluid {
namespace {

template <class P>
auto pressure_forces(P& p) {
  return triple(p, field::force_x, field::force_y, field::force_z);
}
template <class P>
auto viscous_forces(P& p) {
  return triple(p, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z);
}

/// -1 for liquids, 0 for all walls, 1 + body for free bodies: members of one group exert nothing on each other.
double group_of(const World& world, std::size_t row) {
  const int body = world.particles[field::body][row];
  if (body < 0) return -1.0;
  const bool free = world.bodies[field::body_motion][static_cast<std::size_t>(body)] == static_cast<int>(Motion::free);
  return free ? 1.0 + body : 0.0;
}

class Fluid : public Effect {
 public:
  explicit Fluid(const Scene& scene)
      : numbers_(numbers_of(scene)),
        kernels_(pair_kernels(scene)),
        transports_(uses_transport_velocity(scene)),
        splits_(numbers_.extrapolates && scene.mode_of(Term::pressure) == Mode::corrected) {}
  void load(World&, const InitialState&) override;
  void kick(World&, double dt) override;
  void drift(World&, double dt) override;
  void clear(World&, PassName) override;
  void state(World&) override;
  void happen(World& world, const Happening&) override { set_groups(world); }
  [[nodiscard]] TimeStepBound max_dt(const World&) const override;
  void add_to(const World& world, Ledger& ledger) const override {
    add_fluid(world, numbers_, kernels_, ledger);
    if (transports_) ledger.energy["transport"] -= world.booked.transport_work;
  }

 private:
  enum Work : std::size_t { by_pressure, by_viscosity, by_gravity, by_wall_pressure, by_transport, works };
  void set_groups(World&);
  void book_driven_walls(World&, double dt) const;

  SceneNumbers numbers_;
  PairKernels kernels_;
  bool transports_;
  bool splits_;  ///< the work of the walls' borrowed pressure is booked
  Walls walls_;
  std::vector<std::array<double, works>> blocks_;
};

void Fluid::load(World& world, const InitialState&) {
  Particles& p = world.particles;
  const auto body = p[field::body];
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Body& source = world.scene.bodies.at(static_cast<std::size_t>(p[field::source][i]));
    const bool liquid = body[i] < 0;
    p[field::rest_density][i] = world.material_of(i).density;
    p[field::solid][i] = liquid ? 0.0 : 1.0;
    p[field::viscosity][i] = liquid ? world.material_of(i).viscosity : world.scene.contact_viscosity;
    p[field::stick][i] = source.free_slip ? 0.0 : 1.0;
  }
  set_groups(world);
}

void Fluid::set_groups(World& world) {
  const auto group = world.particles[field::group];
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = group_of(world, i);
  walls_.forget();
  world.lagged.viscous_age = 0;
}

/// v += dt (F/m + g) for liquids; bodies take the same forces in the rigid effect. The work of each force is booked by its own
/// formula, dt F.(v- + v+)/2, which sums to the change of kinetic energy to round-off (model 8.11).
void Fluid::kick(World& world, double dt) {
  Particles& p = world.particles;
  const auto v = velocities(p);
  const auto F = pressure_forces(p), D = viscous_forces(p);
  const auto T = transports_ ? triple(p, field::transport_force_x, field::transport_force_y, field::transport_force_z) : Triple<double>{};
  const auto E = splits_ ? triple(p, field::wall_force_x, field::wall_force_y, field::wall_force_z) : Triple<double>{};
  const auto m = p[field::mass];
  const auto body = p[field::body];
  static const double heavier = 1.0 + defect_size("fluid.gravity");
  const Vec3 g = heavier * world.scene.gravity;
  const auto sums = ordered_sums(p.size(), world.threads, blocks_, [&](std::size_t i, std::array<double, works>& work) {
    if (body[i] >= 0) return;
    const Vec3 stress = transports_ ? T.at(i) : Vec3{}, before = v.at(i);
    const Vec3 after = before + (dt / m[i]) * (F.at(i) + D.at(i) + stress) + dt * g;
    const Vec3 way = (0.5 * dt) * (before + after);
    work[by_pressure] += dot(F.at(i), way);
    work[by_viscosity] += dot(D.at(i), way);
    work[by_gravity] += m[i] * dot(g, way);
    if (splits_) work[by_wall_pressure] += dot(E.at(i), way);
    if (transports_) work[by_transport] += dot(stress, way);
    v.set(i, after);
  });
  world.booked.pressure_work += sums[by_pressure];
  world.booked.viscous_work += sums[by_viscosity];
  world.booked.gravity_work += sums[by_gravity];
  world.booked.extrapolated_work += sums[by_wall_pressure];
  world.booked.transport_work += sums[by_transport];
  if (splits_) book_driven_walls(world, dt);
  world.lagged.half_step = dt;
}

/// The walls' side of the work of the pressure that they borrow.
void Fluid::book_driven_walls(World& world, double dt) const {
  if (world.bodies.size() == 0 || std::ranges::none_of(world.bodies[field::body_motion], [](int motion) { return motion == static_cast<int>(Motion::prescribed); })) return;
  const Particles& p = world.particles;
  const auto E = triple(p, field::wall_force_x, field::wall_force_y, field::wall_force_z);
  const auto v = velocities(p);
  const auto body = p[field::body];
  double work = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (body[i] >= 0) work += dt * dot(E.at(i), v.at(i));
  world.booked.extrapolated_work += work;
}

void Fluid::drift(World& world, double dt) {
  Particles& p = world.particles;
  if (transports_) set_shift(world, dt);
  const auto r = positions(p), v = velocities(p);
  const auto w = transports_ ? triple(p, field::shift_x, field::shift_y, field::shift_z) : Triple<double>{};
  const auto body = p[field::body];
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t i = 0; i < p.size(); ++i)
    if (body[i] < 0) r.set(i, r.at(i) + dt * (transports_ ? v.at(i) + w.at(i) : v.at(i)));
  world.moved = true;
}

void Fluid::clear(World& world, PassName pass) {
  Particles& p = world.particles;
  if (pass == PassName::rates) {
    for (const Field<double>* f : {&field::force_x, &field::force_y, &field::force_z, &field::viscous_force_x, &field::viscous_force_y, &field::viscous_force_z})
      std::ranges::fill(p[*f], 0.0);
  } else if (world.scene.mode_of(Term::density) == Mode::corrected) {
    std::ranges::fill(p[field::number_density], kernels_.wendland.value(0.0));
  } else {
    const auto rho = p[field::density], m = p[field::mass];
    for (std::size_t i = 0; i < rho.size(); ++i) rho[i] = m[i] * kernels_.poly6.value(0.0);
  }
}

void Fluid::state(World& world) {
  if (world.moved) set_density(world, numbers_);
  set_pressure(world, numbers_);
  predict_velocities(world);
  if (world.scene.mode_of(Term::walls) == Mode::corrected) walls_.extrapolate(world, numbers_, kernels_);
  if (world.scene.mode_of(Term::pressure) == Mode::corrected) set_pressure_shares(world, numbers_);
  if (splits_) walls_.split_forces(world, kernels_);
  if (transports_) set_transport_forces(world, numbers_, kernels_);
  update_viscous_bound(world, kernels_);
}

/// Sound C h/(c + |v|), C = 0.45 corrected, 0.35 with transport velocity (its background pressure adds half to the stiffness),
/// 0.7 printed; viscosity; acceleration 0.25 sqrt(h/|a|) (model 8.10).
TimeStepBound Fluid::max_dt(const World& world) const {
  const Particles& p = world.particles;
  const auto v = velocities(p);
  const auto F = pressure_forces(p), D = viscous_forces(p);
  const auto m = p[field::mass];
  const auto body = p[field::body];
  const Vec3 g = world.scene.gravity;
  double v2 = 0.0, a2 = 0.0;
#pragma omp parallel for schedule(static) num_threads(world.threads) reduction(max : v2, a2)
  for (std::size_t i = 0; i < p.size(); ++i) {
    v2 = std::max(v2, dot(v.at(i), v.at(i)));
    if (body[i] >= 0) continue;
    const Vec3 a = g + (F.at(i) + D.at(i)) / m[i];
    a2 = std::max(a2, dot(a, a));
  }
  const double courant = world.scene.mode_of(Term::pressure) == Mode::paper ? 0.7 : transports_ ? 0.35 : 0.45;
  TimeStepBound bound;
  tighten(bound, courant * world.support() / (numbers_.sound_speed + std::sqrt(v2)), "sound");
  tighten(bound, world.lagged.viscous_step, "viscosity");
  if (a2 > 0.0) tighten(bound, 0.25 * std::sqrt(world.support() / std::sqrt(a2)), "acceleration");
  return bound;
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
         field::wall_velocity_y, field::wall_velocity_z, field::wall_force_x, field::wall_force_y, field::wall_force_z});
  if (uses_transport_velocity(scene))
    own({field::shift_x, field::shift_y, field::shift_z, field::background_x, field::background_y, field::background_z, field::transport_force_x,
         field::transport_force_y, field::transport_force_z});
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Fluid>(scene); }

std::vector<DefectEntry> defects() {
  return {{"fluid.gravity", "gravity on liquids times 1 + size", "fluid/hydrostatic"},
          {"fluid.density", "number density times 1 + size", "fluid/hydrostatic"},
          {"fluid.paper.density", "density (4) times 1 + size", "fluid/hydrostatic"},
          {"fluid.pressure", "corrected pressure force times 1 + size", "fluid/hydrostatic"},
          {"fluid.paper.pressure", "pressure force (7) times 1 + size", "fluid/hydrostatic"},
          {"fluid.core", "reach of the core of pairs times 1 + size", "fluid/hydrostatic"},
          {"walls.pressure", "extrapolated pressure of walls times 1 - size", "fluid/hydrostatic"},
          {"fluid.state", "scaled pressure of (9) times 1 + size", "fluid/sound-wave"},
          {"fluid.paper.state", "pressure (9) as printed times 1 + size", "fluid/sound-wave"},
          {"fluid.viscosity.laplacian", "laplacian viscous force times 1 + size", "fluid/poiseuille"},
          {"fluid.paper.viscosity", "viscous force (8) times 1 + size", "fluid/poiseuille"},
          {"walls.velocity", "part of the extrapolated velocity of walls left out", "fluid/poiseuille"},
          {"fluid.viscosity.central", "part of the central viscous force along the velocity, not the line of centres", "fluid/liquid-ball"},
          {"fluid.transport_velocity", "background pressure and stress of the transport velocity times 1 - size", "fluid/taylor-green"},
          {"bodies.force", "forces of liquids and contact on bodies times 1 - size", "coupling/floating-block-050"},
          {"bodies.torque", "torques of liquids and contact on bodies times 1 - size", "coupling/oblique"}};
}

}  // namespace tripoint::fluid
