// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pressure/phase_jump.hpp"

#include <algorithm>
#include <vector>

#include "effects/pressure/pressure_terms.hpp"
#include "liquids/carried_density.hpp"
#include "liquids/fields.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::pressure {
namespace {

void sort_once(std::vector<std::uint32_t>& ids) {
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Rows of all that changed, in order of id; where solids alone sum densities, with their neighbours, which
/// see them come and go.
std::vector<std::size_t> changed_rows(const State& state, bool of_solids) {
  std::vector<std::uint32_t> ids = state.change.regrouped;
  ids.insert(ids.end(), state.change.relisted.begin(), state.change.relisted.end());
  sort_once(ids);
  if (of_solids) {
    const auto id = state.particles[field::id];
    for (const std::uint32_t one : std::vector(ids))
      for (const Entry e : state.neighbours->of(state.particles.row(one)))
        ids.push_back(static_cast<std::uint32_t>(id[e.row()]));
    sort_once(ids);
  }
  std::vector<std::size_t> rows;
  for (const std::uint32_t id : ids) rows.push_back(state.particles.row(id));
  return rows;
}

/// Energy of compression before a change and after it, at the same places.
class Jump {
 public:
  Jump(const State& state, const liquid::SceneNumbers& n, const PairKernels& kernels,
       const std::function<double(std::size_t)>& group_now, double back)
      : state_(state),
        n_(n),
        kernels_(kernels),
        group_now_(group_now),
        back_(back),
        core_(state.scene.mode_of(term::pressure) == Mode::corrected),
        sums_density_(state.scene.mode_of(term::density) == Mode::corrected),
        clamps_(liquid::clamps(state.scene)),
        sums_(state.scene),
        rows_(changed_rows(state, sums_.of_solids())),
        changed_(state.particles.size(), 0),
        group_(state.particles[field::group]),
        id_(state.particles[field::id]) {
    for (const std::size_t i : rows_) changed_[i] = 1;
  }
  /// After less before [J].
  double operator()() {
    for (const std::size_t i : rows_) add(i);
    return jump_;
  }

 private:
  [[nodiscard]] Vec3 place(std::size_t row) const {
    return state_.particles.position(row) - back_ * state_.particles.velocity(row);
  }
  [[nodiscard]] std::uint32_t id(std::size_t row) const { return static_cast<std::uint32_t>(id_[row]); }
  /// What a particle adds to its own number density, and its excluded pairs [1/m3].
  void start(std::size_t i) {
    before_ = after_ = kernels_.wendland.value(0.0);
    const Particles& p = state_.particles;
    if (sums_density_ && p.has(field::own_density)) before_ += p[field::own_density][i];
    for (const ExcludedPair& pair : state_.own.of(id(i))) after_ += pair.weight;
  }
  void add_pair(std::size_t i, const Entry& e) {
    const std::size_t j = e.row();
    const double r = norm((place(j) - place(i)) + state_.neighbours->shift(e.image()));
    const double W = kernels_.wendland.value(r);
    const bool own_now = are_own(state_.own, id(i), id(j));
    const bool met = !e.own() && sums_(group_[i]) && sums_(group_[j]),
               meet = !own_now && sums_(group_now_(i)) && sums_(group_now_(j));
    if (met) before_ += W;
    if (meet) after_ += W;
    if (!core_) return;
    const double acted = met ? acts(group_[i], group_[j]) : 0.0,
                 acts_now = meet ? acts(group_now_(i), group_now_(j)) : 0.0;
    jump_ += (changed_[j] ? 0.5 : 1.0) * (acts_now - acted) * kernels_.core.energy(r);
  }
  void add(std::size_t i) {
    start(i);
    for (const Entry e : state_.neighbours->of(i)) add_pair(i, e);
    if (!sums_density_) return;
    const bool counted = sums_(group_[i]), counts = sums_(group_now_(i));
    if (before_ != after_ || counted != counts)
      jump_ += (counts ? energy(i, after_) : 0.0) - (counted ? energy(i, before_) : 0.0);
  }
  [[nodiscard]] double energy(std::size_t i, double delta) const {
    const Particles& p = state_.particles;
    const double m = p[field::mass][i];
    const EquationOfState equation = liquid::state_of(n_, group_[i], p[field::rest_density][i], clamps_);
    return compression_energy(equation, m, m * delta / n_.lattice_density);
  }

  const State& state_;
  const liquid::SceneNumbers& n_;
  const PairKernels& kernels_;
  const std::function<double(std::size_t)>& group_now_;
  double back_;
  bool core_, sums_density_, clamps_;
  liquid::SumsDensity sums_;
  std::vector<std::size_t> rows_;
  std::vector<char> changed_;  ///< by row
  std::span<const double> group_;
  std::span<const int> id_;
  double before_ = 0.0, after_ = 0.0;  ///< number density of the present particle [1/m3]
  double jump_ = 0.0;
};

}  // namespace

double compression_jump(const State& state, const liquid::SceneNumbers& n, const PairKernels& kernels,
                        const std::function<double(std::size_t)>& group_now, double back) {
  const bool stores = state.scene.mode_of(term::pressure) == Mode::corrected ||
                      state.scene.mode_of(term::density) == Mode::corrected;
  if (!state.neighbours || state.neighbours->rebuilds() == 0 || !stores) return 0.0;
  return Jump(state, n, kernels, group_now, back)();
}

}  // namespace tripoint::pressure
