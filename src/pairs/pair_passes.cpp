// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/pair_passes.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/machine.hpp"
#include "pairs/run_pass.hpp"
#include "particles/catalogue.hpp"
#include "particles/neighbours.hpp"

namespace tripoint {

template <>
PairPasses pair_passes_for<Any>();
template <>
PairPasses pair_passes_for<Avx2>();
template <>
PairPasses pair_passes_for<Avx512>();

namespace {

PassFunction most_of(std::span<const PairTerm> wanted, std::span<const PassFunction> table) {
  const auto is_wanted = [&](const PairTerm& term) {
    return std::ranges::find(wanted, term) != wanted.end();
  };
  PassFunction most = {};
  for (const PassFunction& f : table)
    if (f.terms.size() > most.terms.size() && std::ranges::all_of(f.terms, is_wanted)) most = f;
  return most;
}

}  // namespace

PassFunction PairPasses::density(std::span<const PairTerm> wanted) const {
  return most_of(wanted, densities);
}
PassFunction PairPasses::rates(std::span<const PairTerm> wanted) const {
  return most_of(wanted, rates_of_scenes);
}
PassFunction PairPasses::alone(const PairTerm& term) const { return most_of({&term, 1}, single); }

PairPasses pair_passes(int lanes) {
  if (lanes == 1) return pair_passes_for<Any>();
  if (lanes == 4 && machine_has_avx2()) return pair_passes_for<Avx2>();
  if (lanes == 8 && machine_has_avx512()) return pair_passes_for<Avx512>();
  throw InputError(std::to_string(lanes) +
                   " lanes: there are 1, 4 (where the machine has AVX2) and 8 (AVX-512)");
}

namespace {

/// Seconds of the rates of a small block of liquid, the best of a few.
double seconds_of(int lanes) {
  const PassFunction rates = pair_passes(lanes).timed;
  std::vector<FieldInfo> fields = common_fields(false);
  for (const Field<double>* f : rates.fields)
    if (std::ranges::find(fields, FieldInfo(*f)) == fields.end()) fields.emplace_back(*f);
  constexpr std::size_t across = 8;
  Particles block(across * across * across, fields);
  for (const Field<double>* f : rates.fields) std::ranges::fill(block[*f], 1.0);
  std::ranges::fill(block[field::group], -1.0);
  for (std::size_t i = 0; i < block.size(); ++i)
    positions(block).set(i, {static_cast<double>(i % across), static_cast<double>(i / across % across),
                             static_cast<double>(i / across / across)});
  constexpr double support = 2.5;
  Neighbours neighbours(support, 0.0, {}, 1, lanes);
  neighbours.update(block, 0.0);
  const PairKernels kernels(support);
  double least = 1e300;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    run_pass(rates, block, neighbours, kernels, 1);
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

}  // namespace

int best_lanes() {
  static const int best = [] {
    if (!machine_has_avx2()) return 1;
    return machine_has_avx512() && seconds_of(8) < seconds_of(4) ? 8 : 4;
  }();
  return best;
}

}  // namespace tripoint
