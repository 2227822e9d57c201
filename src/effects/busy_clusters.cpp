// SPDX-License-Identifier: BSD-3-Clause
#include "effects/busy_clusters.hpp"

#include <algorithm>

#include "effects/body_table.hpp"
#include "effects/run_pass.hpp"

namespace tripoint {
namespace {

enum Work : std::uint8_t { none = 0, density = 1, rates = 2, density_is_still = 4 };

/// Of each row whether it never moves: a member of a fixed rigid body.
std::vector<char> fixed_rows(const World& world) {
  std::vector<char> of_body;
  for (std::size_t b = 0; b < world.bodies.size(); ++b)
    of_body.push_back(is_rigid(world, b) && world.bodies[field::body_motion][b] == static_cast<int>(Motion::fixed));
  const auto body = world.particles[field::body];
  std::vector<char> fixed(body.size());
  for (std::size_t i = 0; i < body.size(); ++i) fixed[i] = body[i] >= 0 ? of_body[static_cast<std::size_t>(body[i])] : char{0};
  return fixed;
}

/// What is to be done for a cluster. Two act on each other unless they are an own pair, or members of one group of 0 and above.
/// @param acting of each entry of the cluster a bit, set where it acts on a member; zero until now
Work work_of(const Clusters& c, std::size_t cluster, std::span<const double> group, const std::vector<char>& fixed, bool leaves_own, std::uint64_t* acting) {
  const std::uint32_t first = c.first[cluster], past = c.first[cluster + 1];
  const std::size_t start = c.start[cluster], end = c.start[cluster + 1];
  const bool all_liquid = std::all_of(group.begin() + first, group.begin() + past, [](double g) { return g < 0.0; });
  if (all_liquid && c.own.empty()) {  // everything acts on them
    std::fill(acting, acting + (end - start + within_bits - 1) / within_bits, ~std::uint64_t{0});
    return static_cast<Work>(density | rates);
  }
  bool any_acts = false, any_apart = false, any_moves = false;
  const unsigned all = ~0u;
  double asked = group[first];
  unsigned of_another = 0;  // bits of the members whose group is not the one that was asked for
  const auto look = [&](double g) {
    asked = g, of_another = 0;
    for (std::uint32_t i = first; i < past; ++i) of_another |= static_cast<unsigned>(group[i] != g) << (i - first);
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
    const bool acts = (apart & (group[j] < 0.0 ? all : others(group[j]))) != 0;
    any_apart = any_apart || apart != 0;
    any_acts = any_acts || acts;
    acting[(e - start) / within_bits] |= std::uint64_t{acts} << ((e - start) % within_bits);
  }
  const Work in_density = !any_moves ? density_is_still : any_acts || any_apart || !leaves_own ? density : none;
  return static_cast<Work>(in_density | (any_acts ? rates : none));
}

}  // namespace

void BusyClusters::find(World& world, bool leaves_own) {
  Clusters& c = world.neighbours->clusters();
  const auto group = world.particles[field::group];
  const std::vector<char> fixed = fixed_rows(world);
  std::vector<Work> work(c.size());
  c.acting.assign(c.size() > 0 ? within_start(c.start.back(), c.size()) : 0, 0);
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t k = 0; k < c.size(); ++k) work[k] = work_of(c, k, group, fixed, leaves_own, c.acting.data() + within_start(c.start[k], k));
  in_density_ = {}, in_rates_ = {};
  still_.clear();
  for (std::uint32_t k = 0; k < c.size(); ++k) {
    if ((work[k] & density) != 0) in_density_.clusters.push_back(k);
    if ((work[k] & rates) != 0) in_rates_.clusters.push_back(k);
    if ((work[k] & density_is_still) == 0) continue;
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i) still_.push_back(i);
  }
  fixed_.clear();
  for (std::uint32_t i = 0; i < group.size(); ++i)
    if (fixed[i] != 0) fixed_.push_back(i);
  known_ = true;
}

void BusyClusters::keep(const PassFunction& pass, const Particles& p) {
  density_.clear(), place_.clear();
  const auto x = positions(p);
  for (const std::uint32_t i : fixed_) place_.push_back(x.at(i));
  for (const Field<double>* f : pass.adds()) {
    const auto column = p[*f];
    for (const std::uint32_t i : still_) density_.push_back(column[i]);
  }
}

void BusyClusters::put_back(const PassFunction& pass, Particles& p) const {
  auto kept = density_.begin();
  for (const Field<double>* f : pass.adds()) {
    const auto column = p[*f];
    for (const std::uint32_t i : still_) column[i] = *kept++;
  }
}

/// What is fixed is put to its place by its body's pose, so that its first step can move it by a rounding error.
bool BusyClusters::stays(const Particles& p) const {
  const auto x = positions(p);
  for (std::size_t n = 0; n < fixed_.size(); ++n)
    if (x.at(fixed_[n]) != place_[n]) return false;
  return true;
}

/// The first over new lists sums all, also because the passes that follow ask which pairs are within the support.
void BusyClusters::sum_density(const PassFunction& pass, World& world, const PairKernels& kernels, bool leaves_own) {
  Particles& p = world.particles;
  if (known_ && stays(p)) {
    put_back(pass, p);
    run_pass_over(pass, p, *world.neighbours, kernels, world.threads, in_density_);
    return;
  }
  run_pass(pass, p, *world.neighbours, kernels, world.threads);
  if (!known_) find(world, leaves_own);
  keep(pass, p);
}

void BusyClusters::sum_rates(const PassFunction& pass, World& world, const PairKernels& kernels) const {
  if (known_) run_pass_over(pass, world.particles, *world.neighbours, kernels, world.threads, in_rates_);
  else run_pass(pass, world.particles, *world.neighbours, kernels, world.threads);
}

}  // namespace tripoint
