// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/scene_passes.hpp"

#include <algorithm>

#include "pairs/busy_clusters.hpp"
#include "pairs/pair_passes.hpp"
#include "pairs/run_pass.hpp"
#include "particles/rank_grid.hpp"
#include "state/fill.hpp"

namespace tripoint {
namespace {

/// Work that all effects of a scene ask of the passes.
struct AllWork {
  std::vector<PairTerm> terms, again, held;
  bool any_acts = false;   ///< an effect's terms add something where pairs act on each other alone
  bool meets_all = false;  ///< a term works on every pair, whatever meets there
  bool leaves_excluded_pairs = false;
  const PairKernels* kernels = nullptr;
  double awake_around = 0.0;  ///< [m]

  void add(const PairWork& w) {
    terms.insert(terms.end(), w.terms.begin(), w.terms.end());
    held.insert(held.end(), w.held.begin(), w.held.end());
    if (w.again) again.insert(again.end(), w.terms.begin(), w.terms.end());
    any_acts = any_acts || w.where_it_acts;
    meets_all = meets_all || (!w.terms.empty() && !w.where_it_acts);
    leaves_excluded_pairs = leaves_excluded_pairs || w.leaves_excluded_pairs;
    if (w.kernels) kernels = w.kernels;
    awake_around = std::max(awake_around, w.awake_around);
  }
  [[nodiscard]] std::vector<PairTerm> without_held() const {
    std::vector<PairTerm> rest = terms;
    std::erase_if(rest, [&](const PairTerm& term) { return std::ranges::find(held, term) != held.end(); });
    return rest;
  }
};

/// @throws InputError where a pair term of an effect reads or adds to a field that the effect has not
/// declared
void refuse_undeclared(const DeclaredFields& declared, const PassFunction& pass) {
  for (const Field<double>* f : pass.fields) {
    if (!std::ranges::binary_search(declared.keys, f->key))
      throw InputError("a pair term of the effect " + std::string(declared.who) +
                       " reads or adds to the field " + std::string(f->name) +
                       ", which the effect does not declare");
  }
}

/// @throws InputError where an effect asks for a term that no pass has, or for one that uses a field without
/// declaring it
AllWork work_of(const std::vector<EffectPairWork>& effects) {
  const PairPasses passes = pair_passes(1);
  AllWork all;
  for (const auto& [work, declared, skips] : effects) {
    const PassFunction density = passes.density(work.terms), rates = passes.rates(work.terms);
    if (density.terms.size() + rates.terms.size() != work.terms.size())
      throw InputError("the effect " + std::string(declared.who) +
                       " asks for pair terms that its pair_slots.hpp does not bring");
    refuse_undeclared(declared, density);
    refuse_undeclared(declared, rates);
    all.add(work);
  }
  all.meets_all = all.meets_all || !all.any_acts;
  return all;
}

/// Fixed particles may sleep where every effect of the scene skips those that do, and no term works on every
/// pair.
std::optional<double> sleeps_beyond(const AllWork& work, const std::vector<EffectPairWork>& effects) {
  const bool all_skip = std::ranges::all_of(effects, &EffectPairWork::skips_sleeping);
  return work.meets_all || !all_skip ? std::nullopt : std::optional(work.awake_around);
}

}  // namespace

struct Passes::Impl {
  int lanes;
  PassFunction density, without_held, rates, again;
  PairKernels plain;           ///< where no effect has its own
  const PairKernels* kernels;  ///< of the effect that sets them, or the plain ones
  bool meets_all;              ///< a term works on every pair, whatever meets there
  bool leaves_own;             ///< the density leaves excluded pairs out
  std::optional<double> sleeps_beyond;
  BusyClusters busy{};

  [[nodiscard]] const PassFunction& pass(PassName name, const State& state) const {
    if (name == PassName::density) return state.holds_sums ? without_held : density;
    return name == PassName::rates ? rates : again;
  }
};

Passes::Passes(const Scene& scene, const std::vector<EffectPairWork>& effects, int lanes, bool sums_all) {
  const AllWork work = work_of(effects);
  const PairKernels plain(scene.support_ratio * scene.spacing, scene.space());
  if (lanes == 0) lanes = work.terms.empty() ? 1 : best_lanes();
  const PairPasses passes = pair_passes(lanes);
  impl_ = std::make_unique<Impl>(Impl{lanes, passes.density(work.terms), passes.density(work.without_held()),
                                      passes.rates(work.terms), passes.rates(work.again), plain, work.kernels,
                                      sums_all || work.meets_all, work.leaves_excluded_pairs,
                                      sums_all ? std::nullopt : tripoint::sleeps_beyond(work, effects)});
  if (!impl_->kernels) impl_->kernels = &impl_->plain;
}
Passes::~Passes() = default;
Passes::Passes(Passes&&) noexcept = default;
Passes& Passes::operator=(Passes&&) noexcept = default;

int Passes::lanes() const { return impl_->lanes; }

bool Passes::needed() const { return impl_->density.run != nullptr || impl_->rates.run != nullptr; }

bool Passes::can_hold() const { return impl_->without_held.run != nullptr; }

std::optional<double> Passes::sleeps_beyond() const { return impl_->sleeps_beyond; }

void Passes::drop_clusters() { impl_->busy.drop_clusters(); }

bool Passes::works_on_all() const { return impl_->meets_all; }

std::vector<double> Passes::cost_at_start(const State& state) const {
  const std::vector<char> fixed = fixed_rows(state, state.particles.size());
  std::vector<double> cost;
  for (const char one : fixed) cost.push_back(ParticleCost::at_start(one != 0 && !impl_->meets_all));
  return cost;
}

std::vector<double> Passes::cost(const State& state, double steps) const {
  if (state.neighbours && !impl_->busy.has_entries(state, impl_->meets_all)) return cost_at_start(state);
  const Particles& p = state.particles;
  std::vector<double> cost(p.size(), 0.0);
  if (state.neighbours) cost = impl_->busy.cost_by_row(state, steps, impl_->meets_all);
  for (std::size_t i = 0; i < p.size(); ++i)
    cost[i] += ParticleCost::of_row(steps) +
               ParticleCost::of_bond *
                   static_cast<double>(state.bonds.of(static_cast<std::size_t>(p[field::id][i])).size());
  return cost;
}

void Passes::run_fixed(PassName name, State& state) const {
  if (name == PassName::density)
    impl_->busy.sum_fixed_density(impl_->density, state, *impl_->kernels);
  else
    impl_->busy.sum_fixed_rates(impl_->rates, state, *impl_->kernels);
}

void Passes::start_sums(PassName name, State& state, const Rows& rows) const {
  for (const Field<double>* f : impl_->pass(name, state).adds())
    fill(part(state.particles[*f], rows), 0.0, state.threads);
}

void Passes::run(PassName name, State& state) const {
  if (!needed()) return;
  Impl& i = *impl_;
  const PassFunction& pass = i.pass(name, state);
  if (!i.meets_all && name == PassName::density)
    i.busy.sum_density(pass, state, *i.kernels, i.leaves_own);
  else if (!i.meets_all && name == PassName::rates)
    i.busy.sum_rates(pass, state, *i.kernels);
  else
    i.busy.sum_own(pass, state, *i.kernels);
  if (pass.run) state.refresh(pass.adds());
}

}  // namespace tripoint
