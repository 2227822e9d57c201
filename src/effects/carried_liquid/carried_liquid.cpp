// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/carried_liquid.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/matrix3.hpp"
#include "effects/carried_liquid/blended_inverse.hpp"
#include "effects/carried_liquid/elastic_faces.hpp"
#include "effects/carried_liquid/fields.hpp"
#include "effects/carried_liquid/hydrostatic_start.hpp"
#include "effects/carried_liquid/numbers.hpp"
#include "effects/carried_liquid/owned_columns.hpp"
#include "effects/carried_liquid/phase_density.hpp"
#include "effects/carried_liquid/scheme.hpp"
#include "effects/carried_liquid/shift.hpp"
#include "effects/carried_liquid/solid_pressure.hpp"
#include "effects/carried_liquid/sound_terms.hpp"
#include "effects/carried_liquid/surface_fill.hpp"
#include "liquids/changes.hpp"
#include "liquids/groups.hpp"
#include "liquids/interface_weight.hpp"
#include "liquids/predicted_velocities.hpp"
#include "liquids/pressing_gravity.hpp"
#include "pairs/alone.hpp"
#include "scene/effect_rule.hpp"
#include "state/body_table.hpp"
#include "state/fill.hpp"
#include "state/free_rows.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::carried_liquid {
namespace {

constexpr StepNumber kick_length{"carried_half_step", 0.0};            ///< length of the last kick [s]
constexpr EnergyAccount compression_released{"compression_released"};  ///< as the effect of pressure has it
constexpr EnergyAccount start_compression{"start_compression"};        ///< the same
/// Steps that have taken the present gradients, -1: none are there
constexpr StepNumber held_for{"carried_steps_held", -1.0};
/// Of the compression of the start, the share that the places lack still, and the time in which it falls by e
/// [s]
constexpr StepNumber lacking{"carried_compression_lacking", 0.0},
    lacking_for{"carried_compression_time", 0.0};
constexpr double not_measured = -1.0;  ///< share that the places lack, before the first sums
/// That time over the time that sound takes down the liquid: so slow that nothing swings
constexpr double slow = 30.0;
constexpr EnergyAccount taken_by_diffusion{"taken_by_diffusion"}, taken_by_shift{"taken_by_shift"};
constexpr double viscous_share = 0.1;                    ///< of dx^2/nu that a step takes
constexpr double full_rank = 0.5, own_full_rank = 0.02;  ///< determinant below which an inverse is blended
constexpr double rarest = 0.95;         ///< over the rest density, that the tie asks for at a free surface
constexpr double exposed_below = 0.75;  ///< mean of the moment over directions, at a free surface

/// Inverse of a moment, of which nothing is known along y in the plane.
Symmetric blended(Symmetric moment, double full, double rest, bool planar) {
  if (!planar) return blended_inverse(moment, full, rest);
  moment.yy = 1.0;
  return blended_inverse(moment, std::cbrt(full * full), rest);
}

Rows all_rows(const State& state) { return {0, state.particles.size()}; }

class CarriedLiquid : public Effect {
 public:
  explicit CarriedLiquid(const Scene& scene)
      : numbers_(numbers_of(scene)),
        kernels_(kernels_of(scene, numbers_)),
        scheme_(scheme_of(scene)),
        fill_(scene.support_ratio, scene.space()),
        equation_{numbers_.stiffness * numbers_.reference, scene.clamps()},
        solids_meet_(calls_for(scene, "pressure")),
        elastic_(calls_for(scene, "elastic")),
        interfaces_(scene, interface_share(scene)) {}
  void load(State&, const InitialState&) override;
  void kick(State& state, double dt) override {
    drifted_ = 0.0;
    state.step_numbers[kick_length] = dt;
  }
  void drift(State& state, double dt) override;
  void start_sums(State& state, PassName pass, const Rows& rows) override {
    if (pass != PassName::density) return;
    set_volumes(state);
    for (const Field<double>* f : Moments::adds::list)
      fill(part(state.particles[*f], rows), 0.0, state.threads);
  }
  void state(State&, const Rows&) override;
  void bonds(State&, const Rows&) override;
  void adopt(State&) override;
  void renumber(State&) override { interfaces_.clear(); }
  void happen(State& state, const Happening&) override {
    interfaces_.clear();
    set_groups(state);
    state.step_numbers[held_for] = -1.0;
  }
  void lose(State&, std::span<const std::size_t> rows) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State&, Ledger&) const override;
  [[nodiscard]] PairWork pair_work(const Scene&) const override {
    PairWork work{{pair_term<Moments>}};
    work.where_it_acts = true;
    if (!solids_meet_) work.kernels = &kernels_;
    return work;
  }

 private:
  void set_material(State&, std::size_t) const;
  void set_groups(State&) const;
  void set_volumes(State&) const;
  void run(State&, const PairTerm&, const Rows&, std::span<const double> where = {}) const;
  void add(State&, const PairTerm&, const Rows&, std::span<const double> where = {}) const;
  void correct_gradients(State&, bool fresh) const;
  void correct_velocity_gradients(State&) const;
  void move_density(State&) const;
  void set_pressure(State&) const;
  void set_stress(State&) const;

  Numbers numbers_;
  PairKernels kernels_;
  Scheme scheme_;
  SurfaceFill fill_;
  CarriedState equation_;
  bool solids_meet_;  ///< another effect has their forces, and the columns that both write to
  bool elastic_;      ///< solids are elastic
  ElasticFaces faces_;
  liquid::InterfaceWeight interfaces_;
  double drifted_ = 0.0;  ///< since the last forces, within a step [s]
};

void CarriedLiquid::set_material(State& state, std::size_t i) const {
  Particles& p = state.particles;
  const Material& m = state.material_of(i);
  const bool liquid = p[field::body][i] < 0;
  const auto source = static_cast<std::size_t>(p[field::source][i]);
  p[field::liquid_rest_density][i] = m.density;
  p[field::impedance][i] = liquid ? std::sqrt(m.density * numbers_.stiffness * numbers_.reference) : 0.0;
  p[field::liquid_viscosity][i] = liquid ? m.viscosity : 0.0;
  triple(p, field::pull).set(i, liquid ? Vec3{} : liquid::pressing_gravity(state.scene));
  p[field::slips][i] =
      !liquid && source < state.scene.bodies.size() && state.scene.bodies[source].free_slip ? 1.0 : 0.0;
}

void CarriedLiquid::set_groups(State& state) const {
  if (solids_meet_) return;
  const auto group = state.particles[field::group];
  const liquid::Groups group_of(state);
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = group_of(i);
}

void CarriedLiquid::load(State& state, const InitialState&) {
  Particles& p = state.particles;
  for (std::size_t i = 0; i < p.size(); ++i) set_material(state, i);
  set_groups(state);
  const std::vector<double> pressure = hydrostatic_start(state);
  double greatest = 0.0;  // g H/c^2
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double share =
        p[field::body][i] < 0 ? pressure[i] / (numbers_.stiffness * numbers_.reference) : 0.0;
    p[field::compression_at_start][i] = share;
    greatest = std::max(greatest, share);
    p[field::density][i] = p[field::liquid_rest_density][i] * (1.0 + share);
    if (p[field::body][i] < 0)
      p[field::carried_pressure][i] =
          equation_.pressure(p[field::density][i], p[field::liquid_rest_density][i]);
  }
  if (greatest == 0.0) return;
  state.step_numbers[lacking] = not_measured;
  state.step_numbers[lacking_for] =
      slow * greatest * numbers_.sound_speed / norm(liquid::pressing_gravity(state.scene));
}

/// What is born has its density before the energies of a change are taken.
void CarriedLiquid::adopt(State& state) {
  interfaces_.clear();
  state.step_numbers[held_for] = -1.0;
  const Change& change = state.change;
  for (const std::uint32_t id : change.born) set_material(state, state.particles.row(id));
  take_pressure_around(state, equation_, kernels_, change.born);
  const std::vector<std::size_t> touched = touched_rows(state, change.regrouped);
  const double before = energy_of(state, equation_, interfaces_, kernels_, touched, 0.5 * drifted_);
  for (const std::uint32_t id : change.regrouped) {
    const std::size_t i = state.particles.row(id);
    const bool was_liquid = state.particles[field::impedance][i] != 0.0;
    set_material(state, i);
    keep_pressure(state, equation_, i, was_liquid);
  }
  set_groups(state);
  if (!touched.empty())
    state.accumulated[compression_released] +=
        before - energy_of(state, equation_, interfaces_, kernels_, touched, 0.5 * drifted_);
  set_pressure(state);
  std::vector<std::size_t> born;
  for (const std::uint32_t id : change.born) born.push_back(state.particles.row(id));
  const double brought = energy_of(state, equation_, interfaces_, kernels_, born, 0.5 * drifted_);
  state.accumulated[account::inflow] += brought;
  state.accumulated[start_compression] += brought;
}

void CarriedLiquid::lose(State& state, std::span<const std::size_t> rows) {
  const double taken =
      energy_of(state, equation_, interfaces_, kernels_, {rows.begin(), rows.end()}, 0.5 * drifted_);
  state.accumulated[account::outflow] += taken;
  state.accumulated[start_compression] -= taken;
}

/// The shift of the last rates acts in this drift.
void CarriedLiquid::drift(State& state, double dt) {
  drifted_ = dt;
  const auto w = triple(std::as_const(state.particles), field::shift);
  const auto m = state.particles[field::mass];
  std::vector<std::array<double, 1>> blocks;
  const Vec3 g = state.scene.gravity;
  const auto work = ordered_sums(
      state, blocks, [&](std::size_t i, std::array<double, 1>& sum) { sum[0] += m[i] * dot(g, w.at(i)); });
  state.accumulated[taken_by_shift] += dt * work[0];
  if (double& left = state.step_numbers[lacking]; left > 0.0)
    left *= std::exp(-dt / state.step_numbers[lacking_for]);
}

/// Sums of a term over the clusters of these rows. @param where  0 in rows whose sums are 0; empty: nowhere
void CarriedLiquid::run(State& state, const PairTerm& term, const Rows& formed,
                        std::span<const double> where) const {
  Particles& p = state.particles;
  const PassFunction pass = alone_pass(state, term);
  const fields::List both = shared();
  for (const Field<double>* f : pass.adds())
    if (!solids_meet_ || std::ranges::find(both, FieldInfo(*f)) == both.end())
      fill(part(p[*f], formed), 0.0, state.threads);
  add(state, term, formed, where);
}

/// The same, added to what is there.
void CarriedLiquid::add(State& state, const PairTerm& term, const Rows& formed,
                        std::span<const double> where) const {
  const PassFunction pass = alone_pass(state, term);
  const Clusters& c = state.neighbours->clusters();
  ChosenClusters chosen{c.listed, {}};
  std::erase_if(chosen.clusters, [&](std::uint32_t k) {
    if (c.first[k] < formed.from || c.first[k] >= formed.to) return true;
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      if (state.owns(i) && (where.empty() || where[i] != 0.0)) return false;
    return true;
  });
  PairKernels kernels = kernels_;
  kernels.half_step = 0.5 * drifted_;
  add_alone(state, pass, kernels, chosen);
}

/// @param fresh  there is no correction of the start of the drift
void CarriedLiquid::correct_gradients(State& state, bool fresh) const {
  Particles& p = state.particles;
  const auto m = symmetric_columns(p, field::moment), b = symmetric_columns(p, field::correction),
             halfway = symmetric_columns(p, field::correction_halfway);
  const auto z = p[field::impedance], exposed = p[field::exposed];
  const bool planar = state.scene.is_planar();
  const double least_trace = exposed_below * number_of(state.scene.space());
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    Symmetric inverse;
    exposed[i] = 0.0;
    if (z[i] == 0.0) {
      inverse = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    } else {
      const Symmetric moment = m.at(i);
      inverse = blended(moment, full_rank, 1.0, planar);
      exposed[i] = trace(moment) < least_trace ? 1.0 : 0.0;
    }
    halfway.set(i, fresh ? inverse : 0.5 * (b.at(i) + inverse));
    b.set(i, inverse);
  }
}

void CarriedLiquid::correct_velocity_gradients(State& state) const {
  Particles& p = state.particles;
  const auto n = symmetric_columns(p, field::own_moment);
  const auto a = matrix_columns(p, field::velocity_gradient);
  const auto strain = symmetric_columns(p, field::strain_rate);
  const auto slope = triple(p, field::pressure_gradient);
  const auto z = p[field::impedance];
  const bool planar = state.scene.is_planar();
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (z[i] == 0.0) continue;
    const Symmetric inverse = blended(n.at(i), own_full_rank, 0.0, planar);
    const Matrix3 gradient = a.at(i) * inverse;
    a.set(i, gradient);
    strain.set(i, symmetric_part(gradient));
    slope.set(i, inverse * slope.at(i));
  }
}

/// The density at the end of the drift, to second order.
void CarriedLiquid::move_density(State& state) const {
  Particles& p = state.particles;
  const auto slope = triple(p, field::pressure_gradient);
  const auto w = triple(std::as_const(p), field::shift);
  const auto sum_slope = triple(p, field::summed_slope);
  const auto share = p[field::wall_share];
  const auto z = p[field::impedance], rho = p[field::density], rest = p[field::liquid_rest_density],
             mass = p[field::mass], divergence = p[field::divergence], diffused = p[field::diffused],
             near = p[field::exposed_near], exposed = p[field::exposed], summed = p[field::summed_density];
  const double h = 0.5 * state.support(), c = numbers_.sound_speed, dt = drifted_;
  const bool limited = scheme_.damping == Damping::limited;
  const double diffusion = limited ? scheme_.delta : 2.0 * scheme_.delta * h * c / equation_.modulus;
  const double relax = scheme_.relax * c / state.support(), own = kernels_.wendland.value(0.0);
  const bool measures = state.step_numbers[lacking] == not_measured;
  if (measures) state.step_numbers[lacking] = 1.0;
  const double lacks = state.step_numbers[lacking];
  const auto compression = p[field::compression_at_start];
  std::vector<std::array<double, 1>> blocks;
  const auto wall_rate = p[field::wall_rate], displaced = p[field::displaced], weighed = p[field::weighed];
  const auto taken = ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    if (z[i] == 0.0) {
      sum[0] += dt * displaced[i] * weighed[i];
      share[i] = summed[i] = 0.0;  // which solids are looked at here depends on the clusters
      sum_slope.set(i, {});
      return;
    }
    const double half = 0.5 * dt * (divergence[i] + wall_rate[i]);
    const double carried = std::clamp((1.0 - half) / (1.0 + half), 0.5, 2.0) * rho[i];
    const double kernels = summed[i] + own;
    const double by_places = mass[i] * kernels / numbers_.lattice.density;
    // Places may have it already, as where the liquid has settled
    if (measures) compression[i] = std::clamp(rho[i] / by_places - 1.0, 0.0, compression[i]);
    const double sum_now = by_places * (1.0 + lacks * compression[i]);
    const bool at_surface = exposed[i] != 0.0 || near[i] != 0.0;
    double tied_to = sum_now;
    if (at_surface && sum_now < carried) {
      // There the tie may take pressure away and make none
      const double steep = state.support() * norm(sum_slope.at(i)) / kernels;
      tied_to = std::min(carried, std::max(sum_now / fill_(steep), rarest * rest[i]));
    }
    double extra = dt * diffusion * diffused[i] * (limited ? rho[i] : rest[i]);
    if (scheme_.follows) extra += dt * dot(w.at(i), slope.at(i)) * rest[i] / equation_.modulus;
    if (scheme_.tie == Tie::relaxed) extra += dt * relax * (tied_to - carried);
    if (scheme_.tie == Tie::summed && drifted_ > 0.0) extra += 0.2 * (tied_to - carried);
    const double next = std::max(carried + extra, 0.5 * rest[i]);
    sum[0] += equation_.added(mass[i], rest[i], {rho[i], carried, next});
    rho[i] = next;
  });
  state.accumulated[taken_by_diffusion] -= taken[0];
}

/// Of the liquids.
void CarriedLiquid::set_pressure(State& state) const {
  Particles& p = state.particles;
  const auto z = p[field::impedance], rho = p[field::density], rest = p[field::liquid_rest_density],
             pressure = p[field::pressure], carried = p[field::carried_pressure],
             share = p[field::wall_share], out = p[field::wall_pressure];
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    out[i] = 0.0;
    if (z[i] == 0.0) continue;
    pressure[i] = carried[i] = equation_.pressure(rho[i], rest[i]);
    out[i] = equation_.modulus * std::max(share[i] - inside_wall, 0.0) * rho[i] / rest[i];
  }
}

void CarriedLiquid::set_stress(State& state) const {
  Particles& p = state.particles;
  const auto pressure = p[field::carried_pressure], V = p[field::carried_volume];
  const auto b = symmetric_columns(p, field::correction), stress = symmetric_columns(p, field::stress);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) stress.set(i, (pressure[i] * V[i]) * b.at(i));
}

/// Moments, rates and forces of one state take the same volumes: those before the step.
void CarriedLiquid::set_volumes(State& state) const {
  Particles& p = state.particles;
  const auto rho = p[field::density], m = p[field::mass], V = p[field::carried_volume],
             rest = p[field::liquid_rest_density], z = p[field::impedance];
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) V[i] = m[i] / (z[i] != 0.0 ? rho[i] : rest[i]);
  if (!solids_meet_) std::ranges::copy(V, p[field::volume].begin());
}

void CarriedLiquid::state(State& state, const Rows&) {
  Particles& p = state.particles;
  double& held = state.step_numbers[held_for];
  const bool fresh = held < 0.0 || drifted_ == 0.0;
  const bool renewed = fresh || held + 1.0 >= scheme_.hold;
  held = renewed ? 0.0 : held + 1.0;
  liquid::velocities_of_way(state, field::predicted);
  correct_gradients(state, fresh);
  if (renewed) {
    run(state, scheme_.gradients, all_rows(state));
    correct_velocity_gradients(state);
  } else {
    run(state, pair_term<SoundRate>, all_rows(state));
  }
  if (elastic_) {
    faces_.set_rates(state, 0.5 * drifted_);
    add(state, pair_term<FaceRate>, all_rows(state), ElasticFaces::where_they_meet(state));
  }
  set_displaced(state);
  run(state, pair_term<WallRate>, all_rows(state), p[field::wall_share]);
  move_density(state);
  set_pressure(state);
  run(state, pair_term<WallPressure>, all_rows(state), p[field::touching]);
  set_solid_pressure(state);
  set_stress(state);
  if (elastic_) {
    run(state, pair_term<FaceLoad>, all_rows(state), p[field::touching]);
    faces_.set_loads(state);
  }
  if (renewed) set_shift(state, scheme_, numbers_.sound_speed);
  liquid::predict_velocities(state, state.step_numbers[kick_length], field::predicted);
  drifted_ = 0.0;
}

/// The diffusion of the last renewal holds until the next.
void CarriedLiquid::bonds(State& state, const Rows& rows) {
  const bool held = state.step_numbers[held_for] > 0.0 && !state.forms_fixed;
  run(state, held ? pair_term<SoundForce> : scheme_.forces, rows);
  if (elastic_) faces_.add_forces(state, rows);
  if (interfaces_.acts()) interfaces_.add_forces(state, kernels_, densities_of_liquids(state), rows);
  if (scheme_.damping != Damping::residue) return;
  const double scale = scheme_.beta * 0.5 * state.support();
  for (const Field<double>* f : columns_of(field::residue_force))
    for (double& one : part(state.particles[*f], rows)) one *= scale;
}

TimeStepBound CarriedLiquid::max_dt(const State& state) const {
  TimeStepBound bound;
  tighten(bound, scheme_.courant * state.support() / (numbers_.sound_speed + liquid::greatest_speed(state)),
          "sound");
  if (numbers_.greatest_nu > 0.0)
    tighten(bound, viscous_share * state.scene.spacing * state.scene.spacing / numbers_.greatest_nu,
            "viscosity");
  return bound;
}

/// m e(rho), de = p/rho^2 drho, from the rest density.
void CarriedLiquid::add_to(const State& state, Ledger& ledger) const {
  const Particles& p = state.particles;
  const auto z = p[field::impedance], m = p[field::mass], rest = p[field::liquid_rest_density],
             share = p[field::wall_share];
  const CompressionEnergy energy(state, equation_);
  const std::vector<double> density =
      interfaces_.acts() ? densities_of_liquids(state) : std::vector<double>{};
  std::vector<std::array<double, 1>> blocks;
  const auto sums = ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
    sum[0] += energy(i);
    if (interfaces_.acts() && i < state.neighbours->rows())
      sum[0] += interfaces_.energy(state, kernels_, density, i);
    if (z[i] != 0.0) sum[0] += equation_.wall_energy(m[i], rest[i], share[i]);
  });
  ledger.energy["compression"] += sums[0];
  ledger.energy["diffusion"] += state.accumulated[taken_by_diffusion];
  ledger.energy["shifting"] += state.accumulated[taken_by_shift];
}

std::vector<Force> forces_of(bool solids_meet) {
  Force pressure{field::force, {"pressure_work"}, EnergyAccount{"wall_pressure_work"}};
  pressure.stored = StoredEnergy{{"compression"}, start_compression, {}, ""};
  Force viscous{field::viscous_force, {"viscous_work"}, EnergyAccount{"wall_viscous_work"}};
  viscous.entry = "viscous";
  Force residue{field::residue_force, {"residue_work"}, EnergyAccount{"wall_residue_work"}};
  residue.entry = "residue";
  return solids_meet ? std::vector{residue} : std::vector{pressure, viscous, residue};
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  const bool solids_meet = calls_for(scene, "pressure");
  EffectSpec s{"carried_liquid", Mode::corrected, owned(solids_meet),
               fields::joined({fields::position(),
                               fields::velocity(),
                               {field::id, field::mass, field::body, field::material, field::source}})};
  s.reads_if_there = fields::joined({fields::image(), {field::driven}});
  if (solids_meet) s.reads = fields::joined({s.reads, shared()});
  if (calls_for(scene, "elastic")) {
    s.owns = fields::joined({s.owns, {field::face_rate, field::face_load}});
    s.reads = fields::joined({s.reads, fields::deformation()});
  }
  s.sums_forces = true;
  s.forces = forces_of(solids_meet);
  s.numerical = {taken_by_diffusion, taken_by_shift};
  s.step_numbers = {kick_length, held_for, lacking, lacking_for};
  if (solids_meet) return s;
  s.guards = {{field::density, "density", Written::density}};
  s.positive = {field::density};
  s.guarded_entries = {{"viscous", EntryRole::only_takes, "viscous forces, which may only take energy"}};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<CarriedLiquid>(scene); }

}  // namespace tripoint::carried_liquid
