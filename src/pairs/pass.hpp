// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

#include "core/field.hpp"
#include "core/lanes.hpp"
#include "core/pair_term.hpp"
#include "core/vec3.hpp"
#include "pairs/term_values.hpp"
#include "particles/catalogue.hpp"
#include "particles/entry.hpp"
#include "sph/kernels.hpp"

/// The fused pair pass. A pair term names the fields that it reads of i and j, those that it adds to i, and
/// the formula. A function sums one combination of terms, for whole vectors of particles i against one
/// neighbour j at a time. A scene takes its combination from a table (pairs/pair_passes.hpp).
namespace tripoint {

/// Geometry of a pair that every term gets.
template <class V>
struct PairGeometry {
  V dx, dy, dz;      ///< r_j - r_i [m]
  V r2, r;           ///< its square [m2], |r_j - r_i| [m]; values that no term asks for are not formed
  V per_r2;          ///< 1/r^2; where r is 0, a number that keeps products with dx, dy, dz and r at 0 [1/m2]
  V gradient;        ///< W'(r)/r of the Wendland kernel [1/m5]
  MaskOf<V> within;  ///< within the support
  /// Within, and not an excluded pair, two members of one deformable body that meet through their bonds alone
  MaskOf<V> apart;
  const PairKernels& kernels;
  [[nodiscard, gnu::always_inline]] VectorOf<V> d() const { return {dx, dy, dz}; }
};

/// A term that says that it adds 0 beyond the support by itself: each of its parts has a factor that is
/// `where` g.within or g.apart. The pass then masks none of its sums, which saves up to a sixth of its time.
template <class Term>
concept ZeroBeyond = requires {
  requires Term::zero_beyond;
};

/// Clusters of particles and their neighbours to sum over, as plain memory. Code compiled for one vector unit
/// shares nothing with the rest.
struct PassTask {
  const double *x = nullptr, *y = nullptr, *z = nullptr;  ///< [m]
  /// Those that the terms read and add to, in the order of PassFunction::fields
  double* const* columns = nullptr;
  const std::uint32_t* first = nullptr;    ///< first row of each cluster, and one past the last row
  const std::size_t* start = nullptr;      ///< first entry of each cluster's list, and one past the last
  const std::uint32_t* entries = nullptr;  ///< row and image of j, as in Entry
  const std::uint8_t* near = nullptr;      ///< of each entry, bit l where it is near to member l
  /// Of each entry, bit l where it is an excluded pair of member l; null where there is none
  const std::uint8_t* own = nullptr;
  std::uint64_t* within = nullptr;  ///< as Clusters::within; null: all entries are looked at
  /// Of each entry a bit, as in Clusters::within: whether it is looked at; null: all are
  const std::uint64_t* only = nullptr;
  const Vec3* shift = nullptr;            ///< of each image [m]
  const std::uint32_t* chosen = nullptr;  ///< clusters to work on; null for all
  /// Of each chosen one, bit l where member l is to be summed; null for all
  const std::uint8_t* members = nullptr;
  std::size_t count = 0;  ///< clusters to work on
  double support2 = 0.0;  ///< square of the support radius [m2]
  const PairKernels* kernels = nullptr;
  int threads = 1;
};

/// One combination of terms. Adds each term's sum to its columns.
struct PassFunction {
  void (*run)(const PassTask&) = nullptr;          ///< null for no term
  std::span<const Field<double>* const> fields{};  ///< whose columns it wants
  bool finds = false;                              ///< whether it writes PassTask::within; else it reads it
  std::size_t reads = 0;                           ///< fields that are read; it adds to those after them
  std::span<const PairTerm> terms{};               ///< that it sums
  [[nodiscard]] std::span<const Field<double>* const> adds() const { return fields.subspan(reads); }
};

namespace detail {

/// The fields of terms: those that they read, each once, then those that each adds to, one term after the
/// other.
template <class... Terms>
struct FieldsOf {
  static constexpr std::size_t adds = (0 + ... + Terms::adds::size);
  static constexpr std::size_t mentions = (0 + ... + Terms::reads::size);
  struct Reads {
    std::array<const Field<double>*, mentions> list{};
    /// Of each mention, one term after the other: its place in the list
    std::array<std::size_t, mentions> where{};
    std::size_t size = 0;
  };
  static constexpr Reads unique = [] {
    Reads r;
    std::size_t mention = 0;
    const auto take = [&](const auto& some) {
      for (const Field<double>* f : some) {
        std::size_t k = 0;
        while (k < r.size && r.list[k] != f) ++k;
        if (k == r.size) r.list[r.size++] = f;
        r.where[mention++] = k;
      }
    };
    (take(Terms::reads::list), ...);
    return r;
  }();
  static constexpr std::size_t reads = unique.size;
  static constexpr std::array<const Field<double>*, reads + adds> list = [] {
    std::array<const Field<double>*, reads + adds> all{};
    std::size_t n = 0;
    while (n < reads) {
      all[n] = unique.list[n];
      ++n;
    }
    const auto take = [&](const auto& some) {
      for (const Field<double>* f : some) all[n++] = f;
    };
    (take(Terms::adds::list), ...);
    return all;
  }();
};

/// {make(0), ..., make(n - 1)}, with numbers known at compile time. A loop of more than 16 rounds is not
/// unrolled, and an array with an index that is not constant cannot lie in registers.
template <std::size_t n, class Make>
[[gnu::always_inline]] inline auto array_of(Make make) {
  return [&]<std::size_t... k>(std::index_sequence<k...>) {
    return std::array<decltype(make(std::integral_constant<std::size_t, 0>{})), n>{
        make(std::integral_constant<std::size_t, k>{})...};
  }
  (std::make_index_sequence<n>{});
}

/// Adds a term's part of a pair to its sums, for the members within whose support j is. The sums of the
/// others keep their bits.
/// @tparam mention first of the term's fields among those of all terms @param i, j fields that all terms
/// read, each once @param sum the term's first
template <class Fields, class Term, std::size_t mention, class V>
void add_term(const PairGeometry<V>& g, const std::array<V, Fields::reads>& i,
              const std::array<V, Fields::reads>& j, V* sum) {
  constexpr std::size_t reads = Term::reads::size, adds = Term::adds::size;
  using Values = ValuesOf<V, typename Term::reads>;
  const Values of_i{array_of<reads>([&](auto k) { return i[Fields::unique.where[mention + k]]; })};
  const Values of_j{array_of<reads>([&](auto k) { return j[Fields::unique.where[mention + k]]; })};
  SumsOf<V, typename Term::adds> next{array_of<adds>([&](auto k) { return sum[k]; })};
  Term::template pair<V>(g, of_i, of_j, next);
  for (std::size_t k = 0; k < adds; ++k) {
    if constexpr (ZeroBeyond<Term>)
      sum[k] = next.values[k];
    else
      sum[k] = g.within ? next.values[k] : sum[k];
  }
}

template <class Fields, class V, std::size_t mention, std::size_t sums>
void add_terms(const PairGeometry<V>&, const std::array<V, Fields::reads>&,
               const std::array<V, Fields::reads>&, V*) {}
template <class Fields, class V, std::size_t mention, std::size_t sums, class Term, class... More>
void add_terms(const PairGeometry<V>& g, const std::array<V, Fields::reads>& i,
               const std::array<V, Fields::reads>& j, V* sum) {
  add_term<Fields, Term, mention>(g, i, j, sum + sums);
  add_terms<Fields, V, mention + Term::reads::size, sums + Term::adds::size, More...>(g, i, j, sum);
}

/// Adds the sums of a cluster to a column. A part of a vector is added lane by lane: the rows beyond are
/// another cluster's.
template <int L>
void add_to(double* target, typename Lanes<L>::Real sum, unsigned members) {
  if (members == (1u << L) - 1u) {
    const typename Lanes<L>::Real total = load_lanes<L>(target) + sum;
    std::memcpy(target, &total, sizeof total);
    return;
  }
  double lane[L];
  std::memcpy(lane, &sum, sizeof lane);
  for (unsigned l = 0; l < L; ++l)
    if (members >> l & 1u) target[l] += lane[l];
}

inline constexpr double nowhere = 1e200;  ///< its square is more than any [m]

/// Looks at the entries of a cluster that a pass has to look at, in list order.
/// @param meet called as meet(e); not 0 where entry e is within the support of a member. @tparam finds
/// whether that is kept
template <bool finds, class Meet>
void for_entries(const PassTask& t, std::size_t cluster, Meet meet) {
  const std::size_t start = t.start[cluster], end = t.start[cluster + 1];
  std::uint64_t* within = t.within ? t.within + within_start(start, cluster) : nullptr;
  const std::uint64_t* only = t.only ? t.only + within_start(start, cluster) : nullptr;
  for (std::size_t from = start; from < end; from += within_bits) {
    const std::size_t count = std::min(end - from, within_bits);
    std::uint64_t left = ~std::uint64_t{0} >> (within_bits - count), found = 0;
    if (!finds && within) left = *within++;
    if (only) left &= *only++;
    if (finds && !only) {  // all of them: a count costs less than a search for bits
      alignas(64) std::uint8_t bits[within_bits];
      for (std::size_t n = 0; n < count; ++n) bits[n] = static_cast<std::uint8_t>(meet(from + n));
      found = bits_of_bytes(bits) & left;
    } else {
      for (; left != 0; left &= left - 1) {
        const auto n = static_cast<std::size_t>(std::countr_zero(left));
        found |= std::uint64_t{meet(from + n) != 0} << n;
      }
    }
    if (finds && within) *within++ = found;
  }
}

/// Every member sums over all its j in list order; nothing is written to j. Each term sums into registers of
/// its own, so that its bits are the same alone and beside others, and in vectors of any width.
/// @tparam finds which entries are within the support of a member, for the passes that follow: a root for one
/// that is not is lost
template <int L, class ForUnit, bool finds, class... Terms>
[[gnu::flatten]] void sum_cluster(const PassTask& t, std::size_t cluster, unsigned members) {
  using V = typename Lanes<L>::Real;
  using Mask = typename Lanes<L>::Mask;
  using Fields = FieldsOf<Terms...>;
  const std::size_t row = t.first[cluster];
  V xi = load_lanes<L>(t.x + row);
  const V yi = load_lanes<L>(t.y + row), zi = load_lanes<L>(t.z + row);
  // Lanes without a member are near to nothing
  if constexpr (L > 1) xi = mask_of<L>((1u << (t.first[cluster + 1] - row)) - 1u) ? xi : V{} + nowhere;
  const auto column = array_of<Fields::reads>([&](auto k) -> const double* { return t.columns[k]; });
  const auto i = array_of<Fields::reads>([&](auto k) { return load_lanes<L>(column[k] + row); });
  std::array<V, Fields::adds> sum{};
  const PairKernels& kernels = *t.kernels;
  const bool any_own = t.own != nullptr;
  const std::uint32_t members_bits = Entry::of(static_cast<std::uint32_t>(row), Entry::box_itself).bits;
  // Adds the pairs with entry e to the sums. @return bit l where it is within the support of member l: no
  // branch, which would often be guessed wrong; a member itself does no harm
  const auto meet = [&](std::size_t e) -> unsigned {
    const Entry entry{t.entries[e]};
    const std::size_t row_j = entry.row();
    V dx = t.x[row_j] - xi, dy = t.y[row_j] - yi, dz = t.z[row_j] - zi;
    if (entry.image() != Entry::box_itself) [[unlikely]] {
      const Vec3& s = t.shift[entry.image()];
      dx += s.x;
      dy += s.y;
      dz += s.z;
    }
    const V r2 = dx * dx + dy * dy + dz * dz;
    // Particles within the support are near, because nothing has moved by more than half the skin. A member
    // is the exception: it is not near to itself.
    Mask within_support = r2 < t.support2;
    if (entry.bits - members_bits < static_cast<std::uint32_t>(L)) [[unlikely]]
      within_support &= mask_of<L>(t.near[e]);
    Mask apart = within_support;
    if (any_own) apart &= mask_of<L>(~t.own[e]);
    const V r = root(r2);
    const auto j = array_of<Fields::reads>([&](auto k) { return every_lane<V>(column[k][row_j]); });
    const PairGeometry<V> g{dx,
                            dy,
                            dz,
                            r2,
                            r,
                            1.0 / (r2 + 1e-300),
                            kernels.wendland.derivative_over_r_inside(r),
                            within_support,
                            apart,
                            kernels};
    add_terms<Fields, V, 0, 0, Terms...>(g, i, j, sum.data());
    return finds ? bits_below(r2, t.support2) : 0;
  };
  for_entries<finds>(t, cluster, meet);
  for (std::size_t k = 0; k < Fields::adds; ++k)
    add_to<L>(t.columns[Fields::reads + k] + row, sum[k], members);
}

template <int L, class ForUnit, bool finds, class... Terms>
void fused(const PassTask& t) {
#pragma omp parallel for schedule(static) num_threads(t.threads)
  for (std::size_t n = 0; n < t.count; ++n) {
    const std::size_t cluster = t.chosen ? t.chosen[n] : n;
    const unsigned all = (1u << (t.first[cluster + 1] - t.first[cluster])) - 1u;
    sum_cluster<L, ForUnit, finds, Terms...>(t, cluster, t.members ? t.members[n] : all);
  }
}

}  // namespace detail

/// Terms that one function sums, each into columns of its own.
template <class... T>
struct Terms {
  static constexpr std::array<PairTerm, sizeof...(T)> list{pair_term<T>...};
};

/// The function that sums these terms. @tparam L particles of a cluster @tparam ForUnit the vector unit that
/// this file is compiled for @tparam finds whether it is the first over new places, which finds the entries
/// within the support
template <int L, class ForUnit, bool finds, class... T>
[[nodiscard]] consteval PassFunction pass_of(Terms<T...> terms) {
  if constexpr (sizeof...(T) == 0)
    return {};
  else
    return {&detail::fused<L, ForUnit, finds, T...>, detail::FieldsOf<T...>::list, finds,
            detail::FieldsOf<T...>::reads, terms.list};
}

}  // namespace tripoint
