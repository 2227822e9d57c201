// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "core/machine.hpp"
#include "effects/fluid/bulk_viscosity.hpp"
#include "effects/fluid/contact_bound.hpp"
#include "effects/fluid/face_pressure.hpp"
#include "effects/fluid/fields.hpp"
#include "effects/fluid/fluid_ledger.hpp"
#include "effects/fluid/fluid_state.hpp"
#include "effects/fluid/interface_weight.hpp"
#include "effects/fluid/laid_walls.hpp"
#include "effects/fluid/phase_jump.hpp"
#include "effects/fluid/solid_viscosity.hpp"
#include "effects/fluid/stored_compression.hpp"
#include "effects/fluid/transport.hpp"
#include "effects/fluid/viscous_bound.hpp"
#include "effects/fluid/viscous_form.hpp"
#include "effects/fluid/walls.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "sph/density_term.hpp"
#include "sph/pass.hpp"
#include "world/body_table.hpp"
#include "world/fill.hpp"
#include "world/free_rows.hpp"

namespace tripoint::fluid {
namespace {

// Share of h/(c + |v|) that a step of sound takes [1]. With these both forms take 0.47 to 0.52 of the longest stable step, as
// measured (docs/guards.md).
constexpr double courant_printed = 0.7, courant_corrected = 0.45;
/// The background pressure of the transport velocity adds half to the stiffness: 0.45/sqrt(1.5) = 0.37, rounded down.
constexpr double courant_transported = 0.35;

/// The group of each row (field::group).
class Groups {
 public:
  explicit Groups(const World& world) : body_(world.particles[field::body]) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
      const bool free = world.bodies[field::body_motion][b] == static_cast<int>(Motion::free);
      of_.push_back(!is_rigid(world, b) ? deformable_group : free ? 1.0 + static_cast<double>(b) : wall_group);
    }
  }
  [[nodiscard]] double operator()(std::size_t row) const {
    return body_[row] < 0 ? liquid_group : of_[static_cast<std::size_t>(body_[row])];
  }

 private:
  std::span<const int> body_;
  std::vector<double> of_;  ///< members of each body
};

/// Whether a body is held or driven, or an event can make it so.
bool can_have_walls(const Scene& scene) {
  const auto is_wall = [](const Body& b) { return b.phase != Phase::liquid && b.motion != Motion::free; };
  const auto makes_one = [](const Event& e) { return e.kind == Event::Kind::hold || e.kind == Event::Kind::grip; };
  return std::ranges::any_of(scene.bodies, is_wall) || std::ranges::any_of(scene.events, makes_one);
}

/// Whether viscous pairs see walls by the mirrored velocity (model 8.4).
bool mirrors_velocities(const Scene& scene) { return scene.mode_of(term::walls) == Mode::corrected && can_have_walls(scene); }

/// Energy of compression that changes of phase and of own pairs let go [J].
constexpr Account compression_released{"compression_released"};

class Fluid : public Effect {
 public:
  explicit Fluid(const Scene& scene)
      : numbers_(numbers_of(scene)),
        kernels_(pair_kernels(scene)),
        transports_(uses_transport_velocity(scene)),
        damps_(numbers_.bulk_viscosity > 0.0),
        mirrors_(mirrors_velocities(scene)),
        averages_(numbers_.averages_walls && can_have_walls(scene)),
        lays_walls_(averages_ && has_laid_walls(scene)),
        faces_(scene),
        interfaces_(scene),
        solid_viscosity_(scene) {}
  void load(World&, const InitialState&) override;
  void kick(World&, double dt) override;
  void drift(World&, double dt) override;
  void clear(World&, PassName) override;
  void state(World&) override;
  void bonds(World&) override;
  void form_fixed(World&) override;
  void happen(World& world, const Happening&) override {
    if (numbers_.contact_step > 0.0) forget_time_to_touch(world);
    set_groups(world);
    clear_walls();
  }
  void renumber(World&) override {
    walls_.renumber();
    clear_pairs();
  }
  void adopt(World&) override;
  void check(const World& world) const override { refuse_overlap(world, numbers_); }
  [[nodiscard]] TimeStepBound max_dt(const World&) const override;
  void add_to(const World& world, Ledger& ledger) const override {
    if (stores_compression(world.scene)) add_fluid(world, numbers_, kernels_, interfaces_, ledger);
    if (damps_) ledger.energy["bulk_viscous"] += world.booked[taken_by_bulk_viscosity];
  }
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_material(World&, std::size_t row) const;
  void set_own_density(World&, std::size_t row) const;
  void set_groups(World&);
  void clear_walls() {
    walls_.clear();
    clear_pairs();
  }
  void clear_pairs() {
    laid_.clear();
    faces_.clear();
    interfaces_.clear();
  }
  void follow_temperature(World&) const;

  SceneNumbers numbers_;
  PairKernels kernels_;
  bool transports_;
  double drifted_ = 0.0;  ///< since the last forces, within a step [s]
  bool damps_;            ///< liquids have a numerical bulk viscosity
  bool mirrors_;          ///< viscous pairs see walls by the mirrored velocity
  bool averages_;         ///< walls press by the mean density of a patch of their face
  bool lays_walls_;       ///< liquid feels fixed walls from their lattice
  Walls walls_;
  LaidWalls laid_;
  FacePressure faces_;
  InterfaceWeight interfaces_;
  SolidViscosity solid_viscosity_;
};

void Fluid::load(World& world, const InitialState&) {
  for (std::size_t i = 0; i < world.particles.size(); ++i) {
    set_material(world, i);
    set_own_density(world, i);
  }
  set_groups(world);
}

void Fluid::set_material(World& world, std::size_t row) const {
  Particles& p = world.particles;
  const auto source = static_cast<std::size_t>(p[field::source][row]);
  const bool slips = source < world.scene.bodies.size() && world.scene.bodies[source].free_slip;
  const bool liquid = p[field::body][row] < 0;
  p[field::rest_density][row] = world.material_of(row).density;
  p[field::solid][row] = liquid ? 0.0 : 1.0;
  p[field::viscosity][row] = liquid ? world.material_of(row).viscosity : solid_viscosity_(world, row);
  p[field::stick][row] = slips ? 0.0 : 1.0;
}

/// mu of solids between t_solid and t_melt. The bound of the step is looked at anew where one has changed.
void Fluid::follow_temperature(World& world) const {
  const auto body = world.particles[field::body];
  const auto mu = world.particles[field::viscosity];
  double changed = 0.0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] < 0) continue;
    const double now = solid_viscosity_(world, i);
    if (now != mu[i]) changed = 1.0;
    mu[i] = now;
  }
  if (world.halo) world.halo->add({&changed, 1});
  if (changed > 0.0) world.step_numbers[viscous_age] = 0.0;
}

/// Sum that the own pairs of a particle add to its number density, once and for all (model 8.2).
void Fluid::set_own_density(World& world, std::size_t row) const {
  if (!world.particles.has(field::own_density.name)) return;
  double sum = 0.0;
  for (const OwnPair& pair : std::as_const(world.own).of(static_cast<std::size_t>(world.particles[field::id][row])))
    sum += pair.weight;
  world.particles[field::own_density][row] = sum;
}

void Fluid::adopt(World& world) {
  world.booked[compression_released] -= compression_jump(world, numbers_, kernels_, Groups(world), 0.5 * drifted_);
  for (const std::uint32_t id : world.change.born) set_material(world, world.particles.row(id));
  for (const std::uint32_t id : world.change.regrouped) set_material(world, world.particles.row(id));
  for (const std::uint32_t id : world.change.relisted) set_own_density(world, world.particles.row(id));
  const bool same_solids = world.change.regrouped.empty() && world.change.bodies.empty();
  set_groups(world);
  if (numbers_.contact_step > 0.0) forget_time_to_touch(world);
  if (!same_solids) clear_walls();
}

void Fluid::set_groups(World& world) {
  const auto group = world.particles[field::group];
  const Groups group_of(world);
#pragma omp parallel for schedule(static) num_threads(world.threads) if (group.size() > worth_threads)
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = group_of(i);
  world.step_numbers[viscous_age] = 0.0;
}

void Fluid::kick(World& world, double dt) {
  drifted_ = 0.0;
  world.step_numbers[half_step] = dt;
}

void Fluid::drift(World& world, double dt) {
  drifted_ = dt;
  if (transports_) set_shift(world, dt);
}

void Fluid::clear(World& world, PassName pass) {
  Particles& p = world.particles;
  if (pass == PassName::again) return;
  if (pass == PassName::rates) {
    for (const Field<double>* f : {&field::force_x, &field::force_y, &field::force_z, &field::viscous_force_x,
                                   &field::viscous_force_y, &field::viscous_force_z})
      fill(part(p[*f], world.formed()), 0.0, world.threads);
  } else if (world.scene.mode_of(term::density) == Mode::corrected) {
    const Rows rows = world.forms_fixed ? Rows{p.awake(), p.size()} : Rows{0, p.awake()};
    const auto delta = part(p[field::number_density], rows);
    fill(delta, kernels_.wendland.value(0.0), world.threads);
    if (!p.has(field::own_density.name)) return;
    const auto own = part(p[field::own_density], rows);
#pragma omp parallel for schedule(static) num_threads(world.threads) if (delta.size() > worth_threads)
    for (std::size_t i = 0; i < delta.size(); ++i) delta[i] += own[i];
  } else {
    const auto rho = awake(p, field::density), m = p[field::mass];
#pragma omp parallel for schedule(static) num_threads(world.threads) if (rho.size() > worth_threads)
    for (std::size_t i = 0; i < rho.size(); ++i) rho[i] = m[i] * kernels_.poly6.value(0.0);
  }
}

void Fluid::state(World& world) {
  if (world.moved) {
    if (lays_walls_) laid_.lay_densities(world, kernels_);
    if (faces_.acts()) faces_.add_densities(world, kernels_);
    set_density(world, numbers_);
    if (averages_) walls_.average_density(world, numbers_, kernels_);
    if (numbers_.contact_step > 0.0) update_time_to_touch(world, numbers_);
  }
  if (solid_viscosity_.follows_temperature()) follow_temperature(world);
  set_pressure(world, numbers_);
  if (damps_ && world.moved) set_bulk_pressure(world, numbers_);
  predict_velocities(world);
  if (mirrors_) walls_.mirror_velocities(world, kernels_);
  if (transports_) set_transport_forces(world, numbers_, kernels_);
  if (world.scene.mode_of(term::pressure) == Mode::corrected) set_pressure_shares(world, numbers_);
  if (averages_) walls_.hand_down_shares(world);
  update_viscous_bound(world, kernels_);
}

/// Once the pass has summed the pressure of all pairs from where they are.
void Fluid::bonds(World& world) {
  if (lays_walls_) laid_.lay_forces(world, kernels_);
  if (faces_.acts()) faces_.add_forces(world);
  if (interfaces_.acts()) interfaces_.add_forces(world, kernels_);
}

void Fluid::form_fixed(World& world) {
  if (!damps_) return;
  Particles& p = world.particles;
  const Rows fixed = world.formed();
  std::ranges::copy(part(p[field::number_density], fixed), part(p[field::number_density_before], fixed).begin());
}

/// Sound C h/(c + |v|), C of the form; viscosity, and the numerical bulk viscosity, which binds above its default alone
/// (model 8.10).
TimeStepBound Fluid::max_dt(const World& world) const {
  const auto v = velocities(world.particles);
  const FreeLoops loops = free_loops(world.forces.size());
  const double v2 = greatest_of_blocks(world.particles.moving(), world.threads, [&](std::size_t from, std::size_t to) {
    return loops.greatest_speed2({v.x.data(), v.y.data(), v.z.data()}, from, to);
  });
  const bool printed = world.scene.mode_of(term::pressure) == Mode::paper;
  const double courant = printed ? courant_printed : transports_ ? courant_transported : courant_corrected;
  TimeStepBound bound = sound_bound(world, numbers_, courant * world.support(), std::sqrt(v2));
  if (damps_)
    tighten(bound, bulk_viscous_step(numbers_.bulk_viscosity) * world.support() / (numbers_.sound_speed + std::sqrt(v2)),
            "bulk viscosity");
  if (numbers_.sound_damping > 0.0)  // the background pressure adds to the stiffness here too
    tighten(bound,
            courant / courant_corrected * bulk_viscous_step(numbers_.sound_damping) * world.support() /
                (numbers_.sound_speed + std::sqrt(v2)),
            "bulk viscosity");
  tighten(bound, world.step_numbers[viscous_step], "viscosity");
  return bound;
}

PairWork Fluid::pair_work(const Scene& scene) const {
  const auto printed = [&](const Term& one) { return scene.mode_of(one) == Mode::paper; };
  PairWork work{{printed(term::density) ? pair_term<DensityPaper> : pair_term<NumberDensity>,
                 printed(term::pressure) ? pair_term<PressurePaper> : pair_term<PressureCorrected>,
                 viscous_form_of(scene, kernels_).force}};
  work.where_it_acts = true;
  work.leaves_own_pairs = !printed(term::density);
  work.kernels = &kernels_;
  if (numbers_.averages_walls) work.awake_around = reach_of_patches * scene.spacing;
  return work;
}

/// Pressure, viscosity and, where the scene says so, the stress of the transport velocity, with where their work goes
/// (model 8.11).
std::vector<Force> forces_of(const Scene& scene) {
  Force pressure{field::force_x, field::force_y, field::force_z, {"pressure_work"}, Account{"wall_pressure_work"}};
  if (stores_compression(scene))
    pressure.stored = StoredEnergy{{"compression"}, {"start_compression"}, compression_released, "phase_work"};
  else
    pressure.entry = "pressure_work";
  Force viscous{
      field::viscous_force_x, field::viscous_force_y, field::viscous_force_z, {"viscous_work"}, Account{"wall_viscous_work"}};
  viscous.entry = "viscous";
  if (!uses_transport_velocity(scene)) return {pressure, viscous};
  Force transport{field::transport_force_x, field::transport_force_y, field::transport_force_z, {"transport_work"}};
  transport.entry = "transport";
  transport.feels = Feels::particles;
  return {pressure, viscous, transport};
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{
      "fluid",
      scene.mode_of(term::pressure),
      {field::density, field::volume, field::pressure, field::rest_density, field::viscosity, field::solid, field::stick,
       field::group, field::force_x, field::force_y, field::force_z, field::viscous_force_x, field::viscous_force_y,
       field::viscous_force_z, field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z},
      fields::joined(
          {fields::position(), fields::velocity(), {field::id, field::mass, field::body, field::material, field::source}})};
  s.reads_if_there = fields::joined({fields::image(), {field::liquid_fraction}});
  if (FacePressure(scene).acts()) s.reads = fields::joined({s.reads, fields::deformation()});
  s.sums_forces = true;
  s.skips_sleeping = !scene.transport_velocity;
  const bool damps = bulk_viscosity(scene) > 0.0;
  const auto own = [&](std::initializer_list<FieldInfo> more) { s.owns.insert(s.owns.end(), more); };
  if (scene.mode_of(term::density) == Mode::corrected) own({field::number_density});
  if (scene.mode_of(term::pressure) == Mode::corrected) own({field::pressure_share});
  if (scene.mode_of(term::density) == Mode::corrected && can_have_deformable_bodies(scene)) own({field::own_density});
  if (damps) own({field::number_density_before, field::bulk_pressure});
  const bool looks_ahead = acting_number(scene, "contact_step") > 0.0;
  if (looks_ahead) own({field::solid_density_before});
  if (mirrors_velocities(scene))
    own({field::wall_weight, field::wall_velocity_x, field::wall_velocity_y, field::wall_velocity_z});
  if (uses_transport_velocity(scene))
    own({field::shift_x, field::shift_y, field::shift_z, field::background_x, field::background_y, field::background_z,
         field::transport_force_x, field::transport_force_y, field::transport_force_z});
  if (uses_transport_velocity(scene) && has_transport_means(numbers_of(scene)))
    own({field::pressure_around, field::nearing, field::bulk_pressure});
  s.forces = forces_of(scene);
  s.accounts = {compression_released};
  s.step_numbers = {half_step, viscous_step, viscous_age};
  if (looks_ahead) s.step_numbers.push_back(time_to_touch);
  s.guards = {{field::density, "density", Written::density}};
  s.positive = {field::density};
  s.guarded_entries = {{"viscous", EntryRole::only_takes, "viscous forces, which may only take energy"}};
  if (!stores_compression(scene))
    s.guarded_entries.push_back({"pressure_work", EntryRole::unbacked, "the printed pressure, which no energy stands behind"});
  if (damps) s.numerical = {taken_by_bulk_viscosity};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Fluid>(scene); }

}  // namespace tripoint::fluid
