// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "particles/neighbours.hpp"
#include "particles/particles.hpp"
#include "sph/kernels.hpp"

/// The fused pair pass. A pair term says which fields it reads of i and j, which it adds to i, and the formula; a Pass fuses
/// the terms of its slots at compile time, and a scene picks one of the combinations at run time.
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
  V r;           ///< |r_j - r_i| [m]
  V gradient;    ///< W'(r)/r of the Wendland kernel [1/m5]
  V apart;       ///< 0 for an own pair, two members of one deformable body that meet through their bonds alone; else 1
  const PairKernels& kernels;
};

/// A slot has a paper form and a corrected form of one term; None where one of them does not exist.
struct None {};
template <class Paper, class Corrected>
struct Slot {
  using paper = Paper;
  using corrected = Corrected;
};
enum class Form { off, paper, corrected };

namespace detail {

/// Registers of one term while i is worked on: its own fields, its own sums, and the columns of j.
template <class V, class Term>
struct Local {
  static constexpr std::size_t reads = Term::reads::size, adds = Term::adds::size;
  std::array<V, reads> i{};
  std::array<V, adds> sum{};
  std::array<const double*, reads> column{};
  std::array<double*, adds> target{};

  explicit Local(Particles& particles) {
    for (std::size_t k = 0; k < reads; ++k) column[k] = particles[*Term::reads::list[k]].data();
    for (std::size_t k = 0; k < adds; ++k) target[k] = particles[*Term::adds::list[k]].data();
  }
  void start(std::size_t row) {
    for (std::size_t k = 0; k < reads; ++k) i[k] = column[k][row];
    sum.fill(V{});
  }
  void add(const PairGeometry<V>& g, std::size_t row_j) {
    std::array<double, reads> j;
    for (std::size_t k = 0; k < reads; ++k) j[k] = column[k][row_j];
    Term::template pair<V>(g, std::span<const V, reads>(i), std::span<const double, reads>(j), std::span<V, adds>(sum));
  }
  void finish(std::size_t row) {
    for (std::size_t k = 0; k < adds; ++k) target[k][row] += sum[k];
  }
};

/// One combination of terms. Every i sums over all its j in list order; nothing is written to j.
/// Each term sums into registers of its own, so that its bits are the same alone and beside others.
template <class... Terms>
void fused(Particles& particles, const Neighbours& neighbours, const PairKernels& kernels, int threads, const std::vector<std::uint32_t>* rows) {
  if constexpr (sizeof...(Terms) > 0) {
    const auto x = positions(std::as_const(particles));
    const double support2 = neighbours.support() * neighbours.support();
    const std::size_t count = rows ? rows->size() : particles.size();
    const std::tuple<Local<double, Terms>...> prepared{Local<double, Terms>(particles)...};
#pragma omp parallel num_threads(threads)
    {
      auto locals = prepared;
#pragma omp for schedule(static)
      for (std::size_t n = 0; n < count; ++n) {
        const std::size_t i = rows ? (*rows)[n] : n;
        std::apply([&](auto&... l) { (l.start(i), ...); }, locals);
        for (const Entry e : neighbours.of(i)) {
          const std::size_t j = e.row();
          const Vec3& s = neighbours.shift(e.image());
          const double dx = (x.x[j] - x.x[i]) + s.x, dy = (x.y[j] - x.y[i]) + s.y, dz = (x.z[j] - x.z[i]) + s.z;
          const double r2 = dx * dx + dy * dy + dz * dz;
          if (r2 >= support2) continue;
          const double r = std::sqrt(r2);
          const PairGeometry<double> g{dx, dy, dz, r, kernels.wendland.derivative_over_r(r), e.own() ? 0.0 : 1.0, kernels};
          std::apply([&](auto&... l) { (l.add(g, j), ...); }, locals);
        }
        std::apply([&](auto&... l) { (l.finish(i), ...); }, locals);
      }
    }
  }
}

using Function = void (*)(Particles&, const Neighbours&, const PairKernels&, int, const std::vector<std::uint32_t>*);

/// From the forms chosen at run time to the combination made at compile time.
template <class Chosen, class... Slots>
struct Pick;
template <class... Terms>
struct Pick<std::tuple<Terms...>> {
  static Function get(const Form*) { return &fused<Terms...>; }
};
template <class... Terms, class S, class... Slots>
struct Pick<std::tuple<Terms...>, S, Slots...> {
  static Function get(const Form* form) {
    using paper = typename S::paper;
    using corrected = typename S::corrected;
    if constexpr (!std::is_same_v<paper, None>) {
      if (*form == Form::paper) return Pick<std::tuple<Terms..., paper>, Slots...>::get(form + 1);
    }
    if constexpr (!std::is_same_v<corrected, None>) {
      if (*form == Form::corrected) return Pick<std::tuple<Terms..., corrected>, Slots...>::get(form + 1);
    }
    return Pick<std::tuple<Terms...>, Slots...>::get(form + 1);
  }
};

}  // namespace detail

template <class... Slots>
class Pass {
 public:
  static constexpr std::size_t slots = sizeof...(Slots);
  static_assert(slots <= 4, "each combination is compiled: 3^4 is the most that the build bears");
  using Forms = std::array<Form, slots>;

  explicit Pass(const Forms& forms) : forms_(forms), run_(detail::Pick<std::tuple<>, Slots...>::get(forms_.data())) {}
  /// Adds each term's sum to its columns; what they hold before is the caller's.
  void operator()(Particles& particles, const Neighbours& neighbours, const PairKernels& kernels, int threads) const {
    run_(particles, neighbours, kernels, threads, nullptr);
  }
  /// For these rows only. @param rows each at most once
  void operator()(Particles& particles, const Neighbours& neighbours, const PairKernels& kernels, int threads, const std::vector<std::uint32_t>& rows) const {
    run_(particles, neighbours, kernels, threads, &rows);
  }
  [[nodiscard]] bool idle() const noexcept {
    for (const Form f : forms_) {
      if (f != Form::off) return false;
    }
    return true;
  }

 private:
  Forms forms_;
  detail::Function run_;
};

}  // namespace tripoint
