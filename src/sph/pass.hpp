// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <tuple>
#include <utility>

#include "core/field.hpp"
#include "core/lanes.hpp"
#include "core/vec3.hpp"
#include "particles/catalogue.hpp"
#include "particles/entry.hpp"
#include "sph/kernels.hpp"

/// The fused pair pass. A pair term says which fields it reads of i and j, which it adds to i, and the formula; a pass fuses the terms
/// of its slots at compile time, for whole vectors of particles i against one neighbour j at a time, and a scene picks one of the
/// combinations at run time (effects/run_pass.hpp).
namespace tripoint {

template <const auto&... fields>
struct Keys {
  static constexpr std::size_t size = sizeof...(fields);
  static constexpr std::array<const Field<double>*, size> list{&fields...};
};

/// What every term is told of a pair.
template <class V>
struct PairGeometry {
  V dx, dy, dz;  ///< r_j - r_i [m]
  V r2, r;       ///< its square [m2], |r_j - r_i| [m]; what no term asks for is not formed
  V per_r2;      ///< 1/r^2; where r is 0, a number that keeps products with dx, dy, dz and r at 0 [1/m2]
  V gradient;    ///< W'(r)/r of the Wendland kernel [1/m5]
  V apart;       ///< 0 for an own pair, two members of one deformable body that meet through their bonds alone; else 1
  const PairKernels& kernels;
};

/// Clusters of particles and what they are to be summed over, as plain memory: what is compiled for one vector unit shares no code
/// with the rest.
struct PassTask {
  const double *x, *y, *z;       ///< [m]
  double* const* columns;        ///< those that the terms read and add to, in the order of PassFunction::fields
  const std::uint32_t* first;    ///< first row of each cluster, and one past the last row
  const std::size_t* start;      ///< first entry of each cluster's list, and one past the last
  const std::uint32_t* entries;  ///< row and image of j, as in Entry
  const std::uint8_t* near;      ///< of each entry, bit l where it is near to member l
  const std::uint8_t* own;       ///< of each entry, bit l where it is an own pair of member l; null where there is none
  const Vec3* shift;             ///< of each image [m]
  const std::uint32_t* chosen;   ///< clusters to work on; null for all
  const std::uint8_t* members;   ///< of each chosen one, bit l where member l is to be summed; null for all
  std::size_t count;             ///< clusters to work on
  double support2;               ///< square of the support radius [m2]
  const PairKernels* kernels;
  int threads;
};

/// One combination of terms. Adds each term's sum to its columns.
struct PassFunction {
  void (*run)(const PassTask&) = nullptr;            ///< null where all slots are off
  std::span<const Field<double>* const> fields{};  ///< whose columns it wants
};

namespace detail {

/// The fields of terms, one term after the other: those it reads, then those it adds to.
template <class... Terms>
struct FieldsOf {
  static constexpr std::size_t size = (0 + ... + (Terms::reads::size + Terms::adds::size));
  static constexpr std::array<const Field<double>*, size> list = [] {
    std::array<const Field<double>*, size> all{};
    std::size_t n = 0;
    const auto take = [&](const auto& some) {
      for (const Field<double>* f : some) all[n++] = f;
    };
    ((take(Terms::reads::list), take(Terms::adds::list)), ...);
    return all;
  }();
};

/// Registers of one term while a cluster is worked on: its members' fields and their sums, and the columns of j.
template <int L, class Term>
struct Local {
  using V = typename Lanes<L>::Real;
  static constexpr std::size_t reads = Term::reads::size, adds = Term::adds::size;
  std::array<V, reads> i;
  std::array<V, adds> sum;
  std::array<const double*, reads> column;
  double* const* target;

  /// @param columns of all terms that are still to be served; moves past those of this one
  Local(double* const*& columns, std::size_t row) {
    for (std::size_t k = 0; k < reads; ++k) column[k] = columns[k], i[k] = load_lanes<L>(columns[k] + row);
    target = columns + reads;
    sum.fill(V{});
    columns += reads + adds;
  }
  /// Adds the pair's part to the members whose lane is in `acting`; the sums of the others keep their bits.
  void add(const PairGeometry<V>& g, typename Lanes<L>::Mask acting, std::size_t row_j) {
    std::array<double, reads> j;
    for (std::size_t k = 0; k < reads; ++k) j[k] = column[k][row_j];
    std::array<V, adds> next = sum;
    Term::template pair<V>(g, std::span<const V, reads>(i), std::span<const double, reads>(j), std::span<V, adds>(next));
    for (std::size_t k = 0; k < adds; ++k) sum[k] = acting ? next[k] : sum[k];
  }
  void finish(std::size_t row, unsigned members) const {
    for (std::size_t k = 0; k < adds; ++k) {
      double lane[L];
      std::memcpy(lane, &sum[k], sizeof lane);
      for (unsigned l = 0; l < L; ++l)
        if (members >> l & 1u) target[k][row + l] += lane[l];
    }
  }
};

/// Every member sums over all its j in list order; nothing is written to j. Each term sums into registers of its own, so that its
/// bits are the same alone and beside others, and in vectors of any width.
template <int L, class ForUnit, class... Terms>
[[gnu::flatten]] void sum_cluster(const PassTask& t, std::size_t cluster, unsigned members) {
  using V = typename Lanes<L>::Real;
  const std::size_t row = t.first[cluster];
  const V xi = load_lanes<L>(t.x + row), yi = load_lanes<L>(t.y + row), zi = load_lanes<L>(t.z + row);
  double* const* columns = t.columns;
  std::tuple<Local<L, Terms>...> locals{Local<L, Terms>(columns, row)...};
  const PairKernels& kernels = *t.kernels;
  for (std::size_t e = t.start[cluster]; e < t.start[cluster + 1]; ++e) {
    const Entry entry{t.entries[e]};
    const std::size_t j = entry.row();
    const Vec3& s = t.shift[entry.image()];
    const V dx = (t.x[j] - xi) + s.x, dy = (t.y[j] - yi) + s.y, dz = (t.z[j] - zi) + s.z;
    const V r2 = dx * dx + dy * dy + dz * dz;
    const typename Lanes<L>::Mask within = r2 < t.support2, acting = within & mask_of<L>(t.near[e]);
    const V r = root(r2);
    V apart = r2 - r2 + 1.0;
    if (t.own) apart = mask_of<L>(t.own[e]) ? V{} : apart;
    const PairGeometry<V> g{dx, dy, dz, r2, r, 1.0 / (r2 + 1e-300), kernels.wendland.derivative_over_r(r), apart, kernels};
    std::apply([&](auto&... l) { (l.add(g, acting, j), ...); }, locals);
  }
  std::apply([&](const auto&... l) { (l.finish(row, members), ...); }, locals);
}

template <int L, class ForUnit, class... Terms>
void fused(const PassTask& t) {
#pragma omp parallel for schedule(static) num_threads(t.threads)
  for (std::size_t n = 0; n < t.count; ++n) {
    const std::size_t cluster = t.chosen ? t.chosen[n] : n;
    const unsigned all = (1u << (t.first[cluster + 1] - t.first[cluster])) - 1u;
    sum_cluster<L, ForUnit, Terms...>(t, cluster, t.members ? t.members[n] : all);
  }
}

}  // namespace detail

/// Terms that are summed together: one of the forms of a slot.
template <class... Terms>
struct Together {};

/// The forms that a slot has; 0 is none of them, n the n-th.
template <class... Forms>
struct Slot {
  static constexpr std::size_t forms = sizeof...(Forms);
};

namespace detail {

template <class>
struct IsTogether : std::false_type {};
template <class... Terms>
struct IsTogether<Together<Terms...>> : std::true_type {};

/// From the forms chosen at run time to the combination made at compile time.
template <int L, class ForUnit, class Chosen, class... Slots>
struct Pick;
template <int L, class ForUnit, class... Terms>
struct Pick<L, ForUnit, Together<Terms...>> {
  static PassFunction get(const int*) {
    if constexpr (sizeof...(Terms) == 0) return {};
    else return {&fused<L, ForUnit, Terms...>, FieldsOf<Terms...>::list};
  }
};
template <int L, class ForUnit, class... Terms, class... Forms, class... Slots>
struct Pick<L, ForUnit, Together<Terms...>, Slot<Forms...>, Slots...> {
  template <class... More>
  static PassFunction with(Together<More...>, const int* form) { return Pick<L, ForUnit, Together<Terms..., More...>, Slots...>::get(form + 1); }
  template <class Form>
  static PassFunction take(const int* form) {
    if constexpr (IsTogether<Form>::value) return with(Form{}, form);
    else return with(Together<Form>{}, form);
  }
  static PassFunction get(const int* form) {
    PassFunction f = {};
    int n = 0;
    const bool found = ((++n == *form && (f = take<Forms>(form), true)) || ...);
    return found ? f : with(Together<>{}, form);
  }
};

}  // namespace detail

/// The slots of a pass. Each combination of forms is compiled for each width: 3^4 is the most that the build bears.
template <class... Slots>
struct Pass {
  static constexpr std::size_t slots = sizeof...(Slots);
  static_assert((1 * ... * (Slots::forms + 1)) <= 81);
  /// @param forms of each slot, in order: 0 for off   @tparam ForUnit the vector unit that this file is compiled for
  template <int L, class ForUnit>
  [[nodiscard]] static PassFunction choose(const std::array<int, slots>& forms) {
    return detail::Pick<L, ForUnit, Together<>, Slots...>::get(forms.data());
  }
};

}  // namespace tripoint
