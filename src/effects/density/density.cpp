// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>

#include "effects/density/density_terms.hpp"
#include "effects/effect.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/scene_numbers.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "state/body_table.hpp"
#include "state/rows_loop.hpp"

/// Density, which pressure, viscosity and the heat of the paper divide by: (4), or corrected by the number
/// density (model 8.2).
namespace tripoint::density {
namespace {

/// Heat alone takes (4) as printed.
bool is_printed(const Scene& scene) {
  return !liquid::carries_density(scene) &&
         (scene.mode_of(term::density) == Mode::paper || !calls_for(scene, "pressure"));
}

class Density : public Effect {
 public:
  explicit Density(const Scene& scene)
      : flows_(calls_for(scene, "pressure")),
        printed_(is_printed(scene)),
        of_solids_(liquid::carries_density(scene)),
        kernels_(flows_ ? liquid::pair_kernels(scene)
                        : PairKernels(scene.support_ratio * scene.spacing, scene.space())),
        scale_(printed_ ? 1.0 : 1.0 / liquid::numbers_of(scene).lattice_density) {}
  void load(State&, const InitialState&) override;
  void start_sums(State&, PassName, const Rows&) override;
  void densities(State&, const Rows&) override;
  void settle(State&) override;
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_own_density(State&, std::size_t row) const;

  bool flows_, printed_;
  bool of_solids_;  ///< liquids carry theirs
  PairKernels kernels_;
  double scale_;  ///< 1/S0 of the kernel
};

void Density::load(State& state, const InitialState&) {
  for (std::size_t i = 0; i < state.particles.size(); ++i) set_own_density(state, i);
}

/// Sum that the excluded pairs of a particle add to its number density, once and for all (model 8.2).
void Density::set_own_density(State& state, std::size_t row) const {
  if (!state.particles.has(field::own_density)) return;
  double sum = 0.0;
  for (const ExcludedPair& pair :
       std::as_const(state.own).of(static_cast<std::size_t>(state.particles[field::id][row])))
    sum += pair.weight;
  state.particles[field::own_density][row] = sum;
}

/// When all that looks at the densities before the change has seen them.
void Density::settle(State& state) {
  for (const std::uint32_t id : state.change.relisted) set_own_density(state, state.particles.row(id));
}

/// Each particle's own share of the sum.
void Density::start_sums(State& state, PassName pass, const Rows& rows) {
  if (pass != PassName::density) return;
  Particles& p = state.particles;
  if (printed_) {
    const auto rho = p[field::density], m = p[field::mass];
    const double self = kernels_.poly6.value(0.0);
    for_rows(rows, state.threads, [&](std::size_t i) { rho[i] = m[i] * self; });
    return;
  }
  const auto delta = p[field::number_density];
  const double self = kernels_.wendland.value(0.0);
  if (!p.has(field::own_density))
    return for_rows(rows, state.threads, [&](std::size_t i) { delta[i] = self; });
  const auto own = p[field::own_density];
  for_rows(rows, state.threads, [&](std::size_t i) { delta[i] = self + own[i]; });
}

void Density::densities(State& state, const Rows& rows) {
  Particles& p = state.particles;
  const auto rho = p[field::density], m = p[field::mass], V = p[field::volume];
  if (!printed_) {
    const auto delta = p[field::number_density];
    const auto body = p[field::body];
    for_rows(rows, state.threads, [&, scale = scale_, of_solids = of_solids_](std::size_t i) {
      if (!of_solids || body[i] >= 0) rho[i] = m[i] * (delta[i] * scale);
    });
  }
  for_rows(rows, state.threads, [&](std::size_t i) { V[i] = m[i] / rho[i]; });
}

PairWork Density::pair_work(const Scene&) const {
  PairWork work{{printed_     ? pair_term<DensityPaper>
                 : of_solids_ ? pair_term<SolidNumberDensity>
                              : pair_term<NumberDensity>}};
  work.where_it_acts = flows_;
  work.leaves_excluded_pairs = !printed_;
  return work;
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  const bool printed = is_printed(scene);
  EffectSpec s{"density",
               printed ? Mode::paper : Mode::corrected,
               {field::density, field::volume},
               {field::id, field::mass, field::body}};
  if (liquid::carries_density(scene)) s.reads.emplace_back(field::group);
  if (!printed) s.owns.push_back(field::number_density);
  if (!printed && can_have_deformable_bodies(scene)) s.owns.push_back(field::own_density);
  s.guards = {{field::density, "density", Written::density}};
  s.positive = {field::density};
  s.skips_sleeping = calls_for(scene, "pressure");
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Density>(scene); }

}  // namespace tripoint::density
