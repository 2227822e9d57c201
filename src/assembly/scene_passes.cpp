// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/scene_passes.hpp"

#include <algorithm>

#include "effects/fluid/material_numbers.hpp"
#include "effects/fluid/walls.hpp"
#include "passes/busy_clusters.hpp"
#include "passes/pair_passes.hpp"
#include "passes/run_pass.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"

namespace tripoint {
namespace {

/// Place of a form in its slot: 0 = off, 1 = as printed, 2 = corrected.
int form_of(const Scene& scene, const std::vector<Active>& effects, std::string_view effect, const Term& one) {
  if (std::ranges::find(effects, effect, &Active::name) == effects.end()) return 0;
  return scene.mode_of(one) == Mode::paper ? 1 : 2;
}

/// Fixed particles may sleep where every effect of the scene skips those that do, and no term works on every pair.
std::optional<double> sleeps_beyond(const Scene& scene, const std::vector<Active>& effects, bool meets_all) {
  const bool all_skip = std::ranges::all_of(effects, [](const Active& a) { return a.spec.skips_sleeping; });
  if (meets_all || scene.transport_velocity || !all_skip) return {};
  return fluid::numbers_of(scene).averages_walls ? fluid::reach_of_patches * scene.spacing : 0.0;
}

}  // namespace

struct Passes::Impl {
  int lanes;
  PassFunction density, rates, heat;
  PairKernels kernels;
  bool meets_all;   ///< a term works on every pair, whatever meets there
  bool leaves_own;  ///< the density leaves own pairs out
  std::optional<double> sleeps_beyond;
  BusyClusters busy{};
};

Passes::Passes(const Scene& scene, const std::vector<Active>& effects, int lanes, bool sums_all) {
  const int heat = equal_temperature(scene) ? 0 : form_of(scene, effects, "heat", term::heat),
            pressure = form_of(scene, effects, "fluid", term::pressure);
  const bool summed = form_of(scene, effects, "density", term::heat) != 0, laplacian = scene.viscosity_form == "laplacian";
  const int density = summed ? 1 : form_of(scene, effects, "fluid", term::density);
  const PairKernels kernels = pressure == 0 ? PairKernels(scene.support_ratio * scene.spacing) : fluid::pair_kernels(scene);
  const int viscosity = scene.mode_of(term::viscosity) == Mode::paper ? 1 : laplacian ? 3 : kernels.shear.even() ? 2 : 4;
  const int flow = pressure == 0 ? 0 : 4 * (pressure - 1) + viscosity, moments = heat == 2 ? 1 : 0;
  if (lanes == 0) lanes = density + flow + heat > 0 ? best_lanes() : 1;
  const PairPasses passes = pair_passes(lanes);
  const bool meets_all = heat + moments > 0 || summed || pressure == 0;
  impl_ = std::make_unique<Impl>(Impl{lanes, passes.density({density, moments}), passes.rates({flow, heat}),
                                      passes.rates({0, heat}), kernels, sums_all || meets_all, density == 2,
                                      sums_all ? std::nullopt : tripoint::sleeps_beyond(scene, effects, meets_all)});
}
Passes::~Passes() = default;
Passes::Passes(Passes&&) noexcept = default;
Passes& Passes::operator=(Passes&&) noexcept = default;

int Passes::lanes() const { return impl_->lanes; }

bool Passes::needed() const { return impl_->density.run != nullptr || impl_->rates.run != nullptr; }

std::optional<double> Passes::sleeps_beyond() const { return impl_->sleeps_beyond; }

void Passes::forget_clusters() { impl_->busy.forget(); }

void Passes::run_fixed(PassName name, World& world) const {
  if (name == PassName::density)
    impl_->busy.sum_fixed_density(impl_->density, world, impl_->kernels);
  else
    impl_->busy.sum_fixed_rates(impl_->rates, world, impl_->kernels);
}

void Passes::run(PassName name, World& world) const {
  if (!needed()) return;
  Impl& i = *impl_;
  const PassFunction& pass = name == PassName::density ? i.density : name == PassName::rates ? i.rates : i.heat;
  if (!i.meets_all && name == PassName::density)
    i.busy.sum_density(pass, world, i.kernels, i.leaves_own);
  else if (!i.meets_all && name == PassName::rates)
    i.busy.sum_rates(pass, world, i.kernels);
  else
    run_pass(pass, world.particles, *world.neighbours, i.kernels, world.threads);
  if (pass.run) world.refresh(pass.adds());
}

}  // namespace tripoint
