// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// Lists of partners by particle id, each a stretch of one pool, in order of insertion. The cost of a change
/// depends on its size alone. Neither threads nor the order of rows affect the order of a list. Changes are
/// counted, so that data made from the lists can follow.
template <class Pair>
class PairLists {
 public:
  [[nodiscard]] std::size_t particles() const noexcept { return lists_.size(); }
  /// Directed pairs of all lists.
  [[nodiscard]] std::size_t pairs() const noexcept { return pairs_; }
  [[nodiscard]] bool empty() const noexcept { return pairs_ == 0; }
  /// Lists for ids 0..particles-1; the new ones are empty.
  void grow(std::size_t particles) { lists_.resize(std::max(particles, lists_.size())); }

  [[nodiscard]] std::span<const Pair> of(std::size_t id) const {
    if (id >= lists_.size()) return {};
    return {pool_.data() + lists_[id].start, lists_[id].count};
  }
  /// The same to write to: the list counts as changed.
  [[nodiscard]] std::span<Pair> edit(std::size_t id) {
    if (id >= lists_.size()) return {};
    lists_[id].changed = ++changes_;
    return {pool_.data() + lists_[id].start, lists_[id].count};
  }
  /// Changes of all lists until now; that of them which was the last of this list.
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_; }
  [[nodiscard]] std::uint64_t changed(std::size_t id) const noexcept { return lists_[id].changed; }
  /// Where a list begins in the pool, and places that the pool has.
  [[nodiscard]] std::size_t start(std::size_t id) const noexcept { return lists_[id].start; }
  [[nodiscard]] std::size_t places() const noexcept { return pool_.size(); }
  /// The list becomes `pairs`; spans taken before are no longer valid. @param pairs none of this object's own
  void replace(std::size_t id, std::span<const Pair> pairs) {
    grow(id + 1);
    List& list = lists_[id];
    list.changed = ++changes_;
    pairs_ += pairs.size();
    pairs_ -= list.count;
    if (pairs.size() > list.room) {
      wasted_ += list.room;
      list.start = pool_.size();
      list.room = pairs.size() + pairs.size() / 4;
      pool_.resize(pool_.size() + list.room);
    }
    std::ranges::copy(pairs, pool_.begin() + static_cast<std::ptrdiff_t>(list.start));
    list.count = pairs.size();
    if (wasted_ > pool_.size() / 2) compact();
  }
  /// The same of a list that is empty, without room to grow: lists that are laid in order of id are compact.
  void lay(std::size_t id, std::span<const Pair> pairs) {
    assert(of(id).empty());
    grow(id + 1);
    lists_[id] = {pool_.size(), pairs.size(), pairs.size(), ++changes_};
    pool_.insert(pool_.end(), pairs.begin(), pairs.end());
    pairs_ += pairs.size();
  }
  void add(std::size_t id, const Pair& pair) {
    grow(id + 1);
    if (lists_[id].count < lists_[id].room) {
      pool_[lists_[id].start + lists_[id].count++] = pair;
      lists_[id].changed = ++changes_;
      ++pairs_;
      return;
    }
    std::vector<Pair> list(of(id).begin(), of(id).end());
    list.push_back(pair);
    replace(id, list);
  }

  /// Puts the lists in order of id, without room to grow, so that they stream by.
  void compact() {
    std::vector<Pair> packed;
    packed.reserve(pairs_);
    ++changes_;
    for (List& list : lists_) {
      const std::size_t start = packed.size();
      packed.insert(packed.end(), pool_.begin() + static_cast<std::ptrdiff_t>(list.start),
                    pool_.begin() + static_cast<std::ptrdiff_t>(list.start + list.count));
      list = {start, list.count, list.count, changes_};
    }
    pool_.swap(packed);
    wasted_ = 0;
  }

 private:
  struct List {
    std::size_t start = 0, count = 0, room = 0;
    std::uint64_t changed = 0;
  };
  std::vector<List> lists_;
  std::vector<Pair> pool_;
  std::size_t pairs_ = 0, wasted_ = 0;
  std::uint64_t changes_ = 0;
};

/// A body neighbour j of i: one line of the cache, so that reference data stream by.
struct Bond {
  std::uint32_t other = 0;  ///< id of j
  std::uint32_t twin = 0;   ///< place of i in the list of j
  Vec3 x;                   ///< reference vector x_ij = r_i - r_j, in the reference frame of i [m]
  /// Grad W(x_ij) of the kernel (17) with respect to i, or what stands for it at a surface (model 8.7) [1/m4]
  Vec3 gradient;
  double weight = 0.0;  ///< W(x_ij) of the kernel (17) [1/m3]
};
static_assert(sizeof(Bond) == 64);
using Bonds = PairLists<Bond>;

/// Two members of one body, which exert no pressure and no viscous force on each other (model 8.2). Lists are
/// in order of id.
struct ExcludedPair {
  std::uint32_t other = 0;
  /// W(x_ij) of the density kernel where the pair began, a constant part of both number densities [1/m3]
  double weight = 0.0;
};
using ExcludedPairs = PairLists<ExcludedPair>;

/// Adds the bond of i and j to both lists. @param of_i,of_j x, gradient and weight of each; other and twin
/// are set here
inline void connect(Bonds& bonds, std::uint32_t i, std::uint32_t j, Bond of_i, Bond of_j) {
  of_i.other = j;
  of_j.other = i;
  of_i.twin = static_cast<std::uint32_t>(bonds.of(j).size());
  of_j.twin = static_cast<std::uint32_t>(bonds.of(i).size());
  bonds.add(i, of_i);
  bonds.add(j, of_j);
}

/// Ends the bonds of i that `ends` picks, in both lists; the others keep their order.
/// @param ends called as ends(const Bond&)  @return ids of the partners that were lost, in the order of the
/// list
template <class Ends>
std::vector<std::uint32_t> disconnect(Bonds& bonds, std::uint32_t i, Ends ends) {
  std::vector<std::uint32_t> lost;
  const auto drop = [&](std::uint32_t id, auto gone) {
    std::vector<Bond> kept;
    for (const Bond& b : bonds.of(id))
      if (!gone(b)) kept.push_back(b);
    bonds.replace(id, kept);
    const auto list = bonds.of(id);
    for (std::size_t n = 0; n < list.size(); ++n)
      bonds.edit(list[n].other)[list[n].twin].twin = static_cast<std::uint32_t>(n);
  };
  for (const Bond& b : bonds.of(i))
    if (ends(b)) lost.push_back(b.other);
  if (lost.empty()) return lost;
  for (const std::uint32_t j : lost) drop(j, [&](const Bond& b) { return b.other == i; });
  drop(i, [&](const Bond& b) { return std::ranges::find(lost, b.other) != lost.end(); });
  return lost;
}

/// Makes i and j an excluded pair; nothing where they are one already.
void make_own(ExcludedPairs&, std::uint32_t i, std::uint32_t j, double weight);
/// Ends an excluded pair. @return its weight, 0 where they were none
double end_own(ExcludedPairs&, std::uint32_t i, std::uint32_t j);
[[nodiscard]] bool are_own(const ExcludedPairs&, std::uint32_t i, std::uint32_t j);

}  // namespace tripoint
