// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/busy_clusters.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <iterator>
#include <numeric>

#include "pairs/run_pass.hpp"
#include "particles/rank_grid.hpp"
#include "state/body_table.hpp"

namespace tripoint {
namespace {

enum Work : std::uint8_t { none = 0, density = 1, rates = 2, density_is_still = 4 };

Work work_of_pairs(bool any_moves, bool any_acts, bool any_counts) {
  if (!any_moves) return static_cast<Work>(density_is_still | (any_acts ? rates : none));
  if (any_acts) return static_cast<Work>(density | rates);
  return any_counts ? density : none;
}

/// The work of a cluster of fixed walls, which are all of one group. @param acting as for work_of()
Work work_of_fixed(const Clusters& c, std::size_t cluster, std::span<const double> group,
                   const std::vector<char>& fixed, std::uint64_t* acting) {
  const std::size_t start = c.start[cluster], end = c.start[cluster + 1];
  bool any_moves = false;
  for (std::size_t e = start; e < end; ++e) {
    const std::size_t j = Entry{c.entries[e]}.row();
    any_moves = any_moves || fixed[j] == 0;
    acting[(e - start) / within_bits] |= std::uint64_t{group[j] != group[c.first[cluster]]}
                                         << ((e - start) % within_bits);
  }
  return any_moves ? density : density_is_still;
}

/// The work that a cluster needs. Two act on each other unless they are an excluded pair, or members of one
/// group of 0 and above.
/// @param moving number of rows that may move @param acting of each entry of the cluster a bit, set where it
/// acts on a member; zero until now
Work work_of(const Clusters& c, std::size_t cluster, std::span<const double> group,
             const std::vector<char>& fixed, std::size_t moving, bool leaves_own, std::uint64_t* acting) {
  const std::uint32_t first = c.first[cluster], past = c.first[cluster + 1];
  const std::size_t start = c.start[cluster], end = c.start[cluster + 1];
  if (first >= moving) return work_of_fixed(c, cluster, group, fixed, acting);
  const bool all_liquid = std::all_of(group.begin() + first, group.begin() + past, acts_on_all);
  if (all_liquid && c.own.empty()) {  // everything acts on them
    std::fill(acting, acting + (end - start + within_bits - 1) / within_bits, ~std::uint64_t{0});
    return static_cast<Work>(density | rates);
  }
  bool any_acts = false, any_apart = false, any_moves = false;
  const unsigned all = ~0u;
  double asked = group[first];
  unsigned of_another = 0;  // bits of the members whose group is not the one that was asked for
  const auto look = [&](double g) {
    asked = g;
    of_another = 0;
    for (std::uint32_t i = first; i < past; ++i)
      of_another |= static_cast<unsigned>(group[i] != g) << (i - first);
  };
  look(asked);
  const auto others = [&](double g) {
    if (g != asked) look(g);
    return of_another;
  };
  for (std::uint32_t i = first; i < past; ++i) any_moves = any_moves || fixed[i] == 0;
  for (std::size_t e = start; e < end; ++e) {
    const std::size_t j = Entry{c.entries[e]}.row();
    any_moves = any_moves || fixed[j] == 0;
    const unsigned apart = c.near[e] & (c.own.empty() ? ~0u : ~static_cast<unsigned>(c.own[e]));
    const bool acts = (apart & (acts_on_all(group[j]) ? all : others(group[j]))) != 0;
    any_apart = any_apart || apart != 0;
    any_acts = any_acts || acts;
    acting[(e - start) / within_bits] |= std::uint64_t{acts} << ((e - start) % within_bits);
  }
  return work_of_pairs(any_moves, any_acts, any_apart || !leaves_own);
}

bool owns_any(const State& state, std::uint32_t first, std::uint32_t past) {
  for (std::uint32_t i = first; i < past; ++i)
    if (state.owns(i)) return true;
  return false;
}

}  // namespace

std::vector<char> fixed_rows(const State& state, std::size_t rows) {
  std::vector<char> of_body;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    of_body.push_back(is_rigid(state, b) &&
                      state.bodies[field::body_motion][b] == static_cast<int>(Motion::fixed));
  const auto body = state.particles[field::body];
  std::vector<char> fixed(rows, 1);
  for (std::size_t i = 0; i < state.particles.moving(); ++i)
    fixed[i] = body[i] >= 0 ? of_body[static_cast<std::size_t>(body[i])] : char{0};
  return fixed;
}

void BusyClusters::find_own(const State& state) {
  own_is_known_ = true;
  own_.reset();
  if (state.ghosts.empty()) return;
  own_.emplace();
  const Clusters& c = state.neighbours->clusters();
  c.each([&](std::uint32_t k) {
    if (owns_any(state, c.first[k], c.first[k + 1])) own_->clusters.push_back(k);
  });
}

void BusyClusters::sum_own(const PassFunction& pass, State& state, const PairKernels& kernels) {
  if (!own_is_known_) find_own(state);
  run_pass_in(pass, state.particles, *state.neighbours, kernels, state.threads, own_);
}

void BusyClusters::find(State& state, bool leaves_own) {
  Clusters& c = state.neighbours->clusters();
  const auto group = state.particles[field::group];
  const std::vector<char> fixed = fixed_rows(state, state.neighbours->rows());
  std::vector<Work> work(c.size());
  c.acting.assign(c.size() > 0 ? within_start(c.start.back(), c.size()) : 0, 0);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!owns_any(state, c.first[k], c.first[k + 1])) continue;
    work[k] = work_of(c, k, group, fixed, state.particles.moving(), leaves_own,
                      c.acting.data() + within_start(c.start[k], k));
  }
  in_density_ = {};
  in_rates_ = {};
  still_.clear();
  c.each([&](std::uint32_t k) {
    if (c.first[k] >= state.particles.awake()) return;
    if ((work[k] & density) != 0) in_density_.clusters.push_back(k);
    if ((work[k] & rates) != 0 && c.first[k] < state.particles.moving()) in_rates_.clusters.push_back(k);
    if ((work[k] & density_is_still) == 0) return;
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i) still_.push_back(i);
  });
  known_ = true;
}

/// Finds the density of fixed particles that meet only fixed ones, for the time when their lists are no
/// longer made.
void BusyClusters::learn_still(const PassFunction& pass, State& state, const PairKernels& kernels) {
  Neighbours& n = *state.neighbours;
  Particles& p = state.particles;
  const Clusters& c = n.clusters();
  std::vector<char> is_still(p.size(), 0);
  for (const std::uint32_t one : n.still_ids()) is_still[p.row(one)] = 1;
  std::vector<std::uint64_t> among(within_start(c.start.back(), c.size()), 0);
  for (std::size_t k = 0; k < c.size(); ++k)
    for (std::size_t e = c.start[k], from = within_start(c.start[k], k) * within_bits; e < c.start[k + 1];
         ++e, ++from)
      among[from / within_bits] |= std::uint64_t{is_still[Entry{c.entries[e]}.row()] != 0}
                                   << from % within_bits;
  density_among_still_.clear();
  std::vector<std::vector<double>> before;
  for (const Field<double>* f : pass.adds()) before.emplace_back(p[*f].begin(), p[*f].end());
  run_pass_among(pass, p, n, kernels, state.threads, among);
  auto old = before.begin();
  for (const Field<double>* f : pass.adds()) {
    const auto column = p[*f];
    for (const std::uint32_t one : n.still_ids()) density_among_still_.push_back(column[p.row(one)]);
    std::ranges::copy(*old++, column.begin());
  }
  still_known_ = n.whole_lists();
}

/// Sums over all lists there are. A particle without a list gets its density among fixed particles.
void BusyClusters::sum_listed(const PassFunction& pass, State& state, const PairKernels& kernels) {
  Neighbours& n = *state.neighbours;
  Particles& p = state.particles;
  const Clusters& c = n.clusters();
  if (c.unlisted.empty() && c.on_demand.empty()) return sum_own(pass, state, kernels);
  assert(still_known_ == n.whole_lists());
  n.make_room_within();
  run_pass_over(pass, p, n, kernels, state.threads, {c.listed, {}});
  const auto id = p[field::id];
  std::size_t from = 0;
  for (const Field<double>* f : pass.adds()) {
    const auto column = p[*f];
    for (const std::uint32_t k : c.unlisted)
      for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
        column[i] = density_among_still_[from + n.still_place(static_cast<std::size_t>(id[i]))];
    from += n.still_ids().size();
  }
}

void BusyClusters::keep(const PassFunction& pass, const State& state) {
  density_.clear();
  for (const Field<double>* f : pass.adds()) {
    const auto column = state.particles[*f];
    for (const std::uint32_t i : still_) density_.push_back(column[i]);
  }
  placed_ = state.placed;
}

void BusyClusters::put_back(const PassFunction& pass, Particles& p) const {
  auto kept = density_.begin();
  for (const Field<double>* f : pass.adds()) {
    const auto column = p[*f];
    for (const std::uint32_t i : still_) column[i] = *kept++;
  }
}

/// The first over new lists sums all, also because the passes that follow ask which pairs are within the
/// support. So does the first one after fixed particles were placed by their body's pose, which can move them
/// by a rounding error.
void BusyClusters::sum_density(const PassFunction& pass, State& state, const PairKernels& kernels,
                               bool leaves_own) {
  Particles& p = state.particles;
  if (known_ && placed_ == state.placed) {
    put_back(pass, p);
    run_pass_over(pass, p, *state.neighbours, kernels, state.threads, in_density_);
    return;
  }
  if (state.neighbours->may_rest_next() && still_known_ != state.neighbours->whole_lists())
    learn_still(pass, state, kernels);
  sum_listed(pass, state, kernels);
  if (!known_) find(state, leaves_own);
  keep(pass, state);
}

/// Clusters without a list take the density that was stored for them among fixed particles alone.
void BusyClusters::sum_fixed_density(const PassFunction& pass, State& state,
                                     const PairKernels& kernels) const {
  Neighbours& n = *state.neighbours;
  Particles& p = state.particles;
  const Clusters& c = n.clusters();
  assert(still_known_ == n.whole_lists());
  std::vector<char> is_listed(n.rows(), 0);
  for (const std::uint32_t k : c.on_demand)
    std::fill(is_listed.begin() + c.first[k], is_listed.begin() + c.first[k + 1], char{1});
  std::size_t from = 0;
  for (const Field<double>* f : pass.adds()) {
    const auto column = p[*f];
    for (const std::uint32_t id : n.still_ids()) {
      const std::size_t row = p.row(id);
      const double among = density_among_still_[from++];
      if (row >= p.awake() && (row >= is_listed.size() || !is_listed[row])) column[row] = among;
    }
  }
  n.make_room_within();
  run_pass_over(pass, p, n, kernels, state.threads, {c.on_demand, {}});
}

void BusyClusters::sum_fixed_rates(const PassFunction& pass, State& state, const PairKernels& kernels) const {
  Clusters& c = state.neighbours->clusters();
  ChosenClusters fixed;
  for (const auto* some : {&c.listed, &c.on_demand})
    std::ranges::copy_if(*some, std::back_inserter(fixed.clusters),
                         [&](std::uint32_t k) { return c.first[k] >= state.particles.moving(); });
  c.acting.resize(within_start(c.start.back(), c.size()), 0);
  for (const std::uint32_t k : c.on_demand)  // their pairs with fixed particles add zeros
    std::fill(c.acting.begin() + static_cast<std::ptrdiff_t>(within_start(c.start[k], k)),
              c.acting.begin() + static_cast<std::ptrdiff_t>(within_start(c.start[k + 1], k + 1)),
              ~std::uint64_t{0});
  run_pass_over(pass, state.particles, *state.neighbours, kernels, state.threads, fixed);
}

bool BusyClusters::has_entries(const State& state, bool all) const {
  return state.neighbours->rows() == state.particles.size() && (all || known_);
}

std::vector<double> BusyClusters::cost_by_row(const State& state, double steps, bool all) const {
  const Clusters& c = state.neighbours->clusters();
  std::vector<double> cost(state.particles.size(), 0.0);
  const auto add = [&](std::uint32_t k, double of_cluster) {
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      cost[i] += of_cluster / (c.first[k + 1] - c.first[k]);
  };
  const auto entries_of = [&](std::uint32_t k) { return static_cast<double>(c.start[k + 1] - c.start[k]); };
  const auto acting_of = [&](std::uint32_t k) {
    const auto first = c.acting.begin() + static_cast<std::ptrdiff_t>(within_start(c.start[k], k)),
               past = c.acting.begin() + static_cast<std::ptrdiff_t>(within_start(c.start[k + 1], k + 1));
    const double bits = std::accumulate(
        first, past, 0.0, [](double sum, std::uint64_t word) { return sum + std::popcount(word); });
    return std::min(bits, entries_of(k));  // where all act, the bits past the last entry are set too
  };
  using Cost = ParticleCost;
  for (const std::uint32_t k : c.listed) {
    add(k, entries_of(k) * (Cost::of_listing / steps + Cost::of_density * (all ? 1.0 : 1.0 / steps)));
    if (all) add(k, entries_of(k) * Cost::of_rates);
  }
  if (all) return cost;
  for (const std::uint32_t k : in_density_.clusters)
    add(k, entries_of(k) * Cost::of_density * (1.0 - 1.0 / steps));
  for (const std::uint32_t k : in_rates_.clusters) add(k, acting_of(k) * Cost::of_rates);
  return cost;
}

void BusyClusters::sum_rates(const PassFunction& pass, State& state, const PairKernels& kernels) const {
  if (known_)
    run_pass_over(pass, state.particles, *state.neighbours, kernels, state.threads, in_rates_);
  else
    run_pass(pass, state.particles, *state.neighbours, kernels, state.threads);
}

}  // namespace tripoint
