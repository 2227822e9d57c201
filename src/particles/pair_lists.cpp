// SPDX-License-Identifier: BSD-3-Clause
#include "particles/pair_lists.hpp"

namespace tripoint {
namespace {

auto place_of(std::span<const ExcludedPair> list, std::uint32_t other) {
  return std::ranges::lower_bound(list, other, {}, &ExcludedPair::other);
}

void insert(ExcludedPairs& own, std::uint32_t i, const ExcludedPair& pair) {
  std::vector<ExcludedPair> list(own.of(i).begin(), own.of(i).end());
  list.insert(std::ranges::lower_bound(list, pair.other, {}, &ExcludedPair::other), pair);
  own.replace(i, list);
}

void erase(ExcludedPairs& own, std::uint32_t i, std::uint32_t other) {
  std::vector<ExcludedPair> list(own.of(i).begin(), own.of(i).end());
  std::erase_if(list, [&](const ExcludedPair& p) { return p.other == other; });
  own.replace(i, list);
}

}  // namespace

bool are_own(const ExcludedPairs& own, std::uint32_t i, std::uint32_t j) {
  const auto list = own.of(i);
  const auto at = place_of(list, j);
  return at != list.end() && at->other == j;
}

void make_own(ExcludedPairs& own, std::uint32_t i, std::uint32_t j, double weight) {
  own.grow(std::max(i, j) + std::size_t{1});
  if (are_own(own, i, j)) return;
  insert(own, i, {j, weight});
  insert(own, j, {i, weight});
}

double end_own(ExcludedPairs& own, std::uint32_t i, std::uint32_t j) {
  const auto list = std::as_const(own).of(i);
  const auto at = place_of(list, j);
  if (at == list.end() || at->other != j) return 0.0;
  const double weight = at->weight;
  erase(own, i, j);
  erase(own, j, i);
  return weight;
}

}  // namespace tripoint
