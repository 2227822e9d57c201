// SPDX-License-Identifier: BSD-3-Clause
#include "particles/moving_lists.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "core/errors.hpp"

namespace tripoint {
namespace {

constexpr std::size_t of_counts = 2, of_bond = 8, of_own = 2;  ///< numbers

/// The ids here of a particle, by its number: an own particle before its ghosts. There is one ghost for each
/// image that is near.
class Ids {
  using Pair = std::pair<int, std::uint32_t>;

 public:
  explicit Ids(const std::vector<int>& number)
      : first_(std::bit_ceil(2 * number.size() + 1), {none_here, none}) {
    for (std::uint32_t id = 0; id < number.size(); ++id) {
      Pair& place = first_[place_of(number[id])];
      if (place.first == none_here) place = {number[id], id};
      ids_.emplace_back(number[id], id);
    }
    std::ranges::sort(ids_);
  }
  [[nodiscard]] std::span<const Pair> of(int number) const {
    const auto from = std::ranges::lower_bound(ids_, number, {}, &Pair::first);
    return {from, std::ranges::upper_bound(from, ids_.end(), number, {}, &Pair::first)};
  }
  /// The one that has the bonds: places are told apart by the nearest image, so that any image will do. none
  /// where it is not here
  [[nodiscard]] std::uint32_t first(int number) const { return first_[place_of(number)].second; }
  static constexpr std::uint32_t none = ~std::uint32_t{0};

 private:
  static constexpr int none_here = -1;
  /// Where a number stands in the table, or would: the first such place or free one from a place that its
  /// bits choose.
  [[nodiscard]] std::size_t place_of(int number) const {
    const std::size_t last = first_.size() - 1;
    std::size_t at = (static_cast<std::uint32_t>(number) * std::size_t{2654435761U} >> 7) & last;
    while (first_[at].first != number && first_[at].first != none_here) at = (at + 1) & last;
    return at;
  }
  std::vector<Pair> first_;  ///< a table of twice as many places, by number
  std::vector<Pair> ids_;
};

constexpr double of_twin = 2147483648.0;  ///< 2^31: a partner and the place in its list are one number

Bond bond_from(const double* n, std::uint32_t other) {
  Bond b;
  b.other = other;
  b.twin = static_cast<std::uint32_t>(n[0] / of_twin);
  b.x = {n[1], n[2], n[3]};
  b.gradient = {n[4], n[5], n[6]};
  b.weight = n[7];
  return b;
}

int partner_in(const double* n) { return static_cast<int>(n[0] - of_twin * std::floor(n[0] / of_twin)); }

[[noreturn]] void refuse_lost(int number, int partner) {
  throw InputError("particle " + std::to_string(number) + " of the scene has a bond with particle " +
                   std::to_string(partner) +
                   ", which is not among the ghosts of its process: their bond is longer than ghosts reach");
}

/// @param bonds becomes the list of that id. Twins are those of whole lists, which particles of its own have
void take_bonds(const Share& share, const Ids& ids, std::size_t id, std::vector<Bond>& bonds) {
  const std::span<const double> numbers = share.lists(id);
  bonds.clear();
  if (numbers.empty()) return;
  const auto count = static_cast<std::size_t>(numbers[0]);
  for (std::size_t k = 0; k < count; ++k) {
    const double* const one = numbers.data() + of_counts + k * of_bond;
    const std::uint32_t other = ids.first(partner_in(one));
    if (id >= share.owned && other >= share.owned) continue;
    if (other == Ids::none) refuse_lost(share.number[id], partner_in(one));
    bonds.push_back(bond_from(one, other));
  }
}

std::vector<ExcludedPair> own_of(const Share& share, const Ids& ids, std::size_t id) {
  const std::span<const double> numbers = share.lists(id);
  std::vector<ExcludedPair> own;
  if (numbers.empty()) return own;
  const auto before = static_cast<std::size_t>(numbers[0]), count = static_cast<std::size_t>(numbers[1]);
  for (std::size_t k = 0; k < count; ++k) {
    const double* const one = numbers.data() + of_counts + before * of_bond + k * of_own;
    for (const auto& [number, other] : ids.of(static_cast<int>(one[0]))) own.push_back({other, one[1]});
  }
  std::ranges::sort(own, {}, &ExcludedPair::other);
  return own;
}

/// The list of a copy is cut short, and has other places.
void set_twins_of_copies(Bonds& bonds, std::size_t owned) {
  for (std::size_t id = 0; id < owned; ++id) {
    const auto list = std::as_const(bonds).of(id);
    if (std::ranges::none_of(list, [&](const Bond& b) { return b.other >= owned; })) continue;
    for (Bond& b : bonds.edit(id)) {
      if (b.other < owned) continue;
      const auto of_copy = std::as_const(bonds).of(b.other);
      b.twin = static_cast<std::uint32_t>(std::ranges::find(of_copy, id, &Bond::other) - of_copy.begin());
      if (b.twin == of_copy.size())
        throw InputError("a bond that went to another process is in the list of one of its particles alone");
    }
  }
}

}  // namespace

std::vector<double> lists_as_numbers(const Bonds& bonds, const ExcludedPairs& own, std::size_t id) {
  const auto b = bonds.of(id);
  const auto o = own.of(id);
  std::vector<double> numbers{static_cast<double>(b.size()), static_cast<double>(o.size())};
  numbers.reserve(of_counts + b.size() * of_bond + o.size() * of_own);
  for (const Bond& one : b)
    numbers.insert(numbers.end(), {one.other + of_twin * one.twin, one.x.x, one.x.y, one.x.z, one.gradient.x,
                                   one.gradient.y, one.gradient.z, one.weight});
  for (const ExcludedPair& one : o)
    numbers.insert(numbers.end(), {static_cast<double>(one.other), one.weight});
  return numbers;
}

std::size_t most_list_numbers(const Bonds& bonds, const ExcludedPairs& own) {
  if (bonds.empty() && own.empty()) return 0;
  std::size_t most = 0;
  for (std::size_t id = 0; id < std::max(bonds.particles(), own.particles()); ++id)
    most = std::max(most, bonds.of(id).size() * of_bond + own.of(id).size() * of_own);
  return of_counts + most;
}

void take_lists(const Share& share, Bonds& bonds, ExcludedPairs& own) {
  const Ids ids(share.number);
  const std::size_t count = share.number.size();
  bonds = {};
  own = {};
  bonds.grow(count);
  own.grow(count);
  std::vector<Bond> list;
  for (std::size_t id = 0; id < count; ++id) {
    if (ids.first(share.number[id]) != id) continue;  // another image has its lists
    take_bonds(share, ids, id, list);
    if (!list.empty()) bonds.lay(id, list);
    if (id >= share.owned) continue;
    if (const std::vector<ExcludedPair> pairs = own_of(share, ids, id); !pairs.empty()) own.lay(id, pairs);
  }
  set_twins_of_copies(bonds, share.owned);
}

double longest_bond(const Particles& particles, const Bonds& bonds, std::size_t owned,
                    const PeriodicBox& box) {
  double most = 0.0;
  for (std::size_t id = 0; id < owned; ++id) {
    const auto list = bonds.of(id);
    if (list.empty()) continue;
    const Vec3 at = particles.position(particles.row(id));
    for (const Bond& b : list) {
      Vec3 d = particles.position(particles.row(b.other)) - at;
      for (std::size_t a = 0; a < 3; ++a)
        if (box.periodic[a]) d[a] -= box.width[a] * std::round(d[a] / box.width[a]);
      most = std::max(most, dot(d, d));
    }
  }
  return std::sqrt(most);
}

}  // namespace tripoint
