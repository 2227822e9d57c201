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

}  // namespace

double compression_jump(const State& state, const liquid::SceneNumbers& n, const PairKernels& kernels,
                        const std::function<double(std::size_t)>& group_now, double back) {
  const bool core = state.scene.mode_of(term::pressure) == Mode::corrected,
             numbers = state.scene.mode_of(term::density) == Mode::corrected,
             clamps = liquid::clamps(state.scene);
  if (!state.neighbours || state.neighbours->rebuilds() == 0 || !(core || numbers)) return 0.0;
  const Particles& p = state.particles;
  const liquid::SumsDensity sums(state.scene);
  const std::vector<std::size_t> rows = changed_rows(state, sums.of_solids());
  std::vector<char> changed(p.size(), 0);
  for (const std::size_t i : rows) changed[i] = 1;
  const auto x = positions(p), v = velocities(p);
  const auto place = [&](std::size_t row) { return x.at(row) - back * v.at(row); };
  const auto group = p[field::group], m = p[field::mass], rest = p[field::rest_density];
  const auto id = p[field::id];
  const auto own_before =
      numbers && p.has(field::own_density.name) ? p[field::own_density] : std::span<const double>{};
  double jump = 0.0;
  for (const std::size_t i : rows) {
    double before = kernels.wendland.value(0.0), after = before;
    if (!own_before.empty()) before += own_before[i];
    for (const OwnPair& pair : state.own.of(static_cast<std::size_t>(id[i]))) after += pair.weight;
    for (const Entry e : state.neighbours->of(i)) {
      const std::size_t j = e.row();
      const double r = norm((place(j) - place(i)) + state.neighbours->shift(e.image()));
      const bool own_now =
          are_own(state.own, static_cast<std::uint32_t>(id[i]), static_cast<std::uint32_t>(id[j]));
      const double W = kernels.wendland.value(r);
      const bool both = sums(group[i]) && sums(group[j]), both_now = sums(group_now(i)) && sums(group_now(j));
      if (!e.own() && both) before += W;
      if (!own_now && both_now) after += W;
      if (!core) continue;
      const double acted = e.own() || !both ? 0.0 : acts(group[i], group[j]),
                   acts_now = own_now || !both_now ? 0.0 : acts(group_now(i), group_now(j));
      jump += (changed[j] ? 0.5 : 1.0) * (acts_now - acted) * kernels.core.energy(r);
    }
    const bool counts = sums(group[i]), counts_now = sums(group_now(i));
    if (!numbers || (before == after && counts == counts_now)) continue;
    const EquationOfState equation = liquid::state_of(n, group[i], rest[i], clamps);
    const auto energy = [&](double delta) {
      return compression_energy(equation, m[i], m[i] * delta / n.lattice_density);
    };
    jump += (counts_now ? energy(after) : 0.0) - (counts ? energy(before) : 0.0);
  }
  return jump;
}

}  // namespace tripoint::pressure
