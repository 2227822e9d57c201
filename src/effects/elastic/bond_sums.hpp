// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstring>

#include "core/lanes.hpp"
#include "core/matrix3.hpp"
#include "effects/elastic/bond_lists.hpp"

/// The loops over the bonds of one particle: three components side by side in a vector of four lanes. The
/// fourth lane reads what lies behind the components in memory, and its result is not used. The loops are
/// compiled for each vector unit; the bits are the same.
namespace tripoint::elastic {

#ifdef __AVX2__
typedef double Quad __attribute__((vector_size(32)));
#else
/// The same in two halves, as any machine has them.
struct Quad {
  typedef double Half __attribute__((vector_size(16)));
  Half low, high;
  friend Quad operator+(const Quad& a, const Quad& b) noexcept { return {a.low + b.low, a.high + b.high}; }
  friend Quad operator-(const Quad& a, const Quad& b) noexcept { return {a.low - b.low, a.high - b.high}; }
  friend Quad operator*(double s, const Quad& a) noexcept { return {s * a.low, s * a.high}; }
  Quad& operator+=(const Quad& b) noexcept { return *this = *this + b; }
  Quad& operator-=(const Quad& b) noexcept { return *this = *this - b; }
};
#endif

/// A column of a matrix, as wide as a vector of four. It has no value of its own: the sums below are written
/// as a whole.
struct alignas(sizeof(Quad)) Column {
  double x, y, z, unused;
  operator Vec3() const noexcept { return {x, y, z}; }
};
[[nodiscard]] inline Matrix3 by_columns(const Vec3& x, const Vec3& y, const Vec3& z) noexcept {
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}
/// A matrix by columns.
struct Columned {
  Column x, y, z;
  operator Matrix3() const noexcept { return by_columns(x, y, z); }
};

/// Where a particle is [m], and its v_i [m3].
struct alignas(sizeof(Quad)) Place {
  Vec3 r;
  double volume = 0.0;
};

/// What the partners of a particle see of it, in three lines of the cache: two matrices by columns, each
/// column at the start of a vector of four, and the moduli of its hourglass energy in the places between.
struct alignas(vector_bytes) Deformed {
  /// Columns of what the hourglass energy measures bonds by: F - I of a solid, the strain of a sheet or
  /// chain.
  Vec3 measure_x;
  double hourglass_energy = 0.0;  ///< v_i a E/2 where the hourglass energy is that of a solid, else 0 [J]
  Column measure_y, measure_z;
  /// Columns of T = (v F S + H) A: the force of i on j is -v_j T gradW(x_ij), and that of the residual [N m].
  Vec3 T_x;
  double solid_hourglass = 0.0;  ///< a E/2 where the hourglass energy is that of a solid, else 0 [Pa]
  Vec3 T_y;
  double flat_hourglass = 0.0;  ///< a E/2 where it is that of a sheet or chain, else 0 [Pa]
  Column T_z;

  [[nodiscard]] Matrix3 measure() const noexcept { return by_columns(measure_x, measure_y, measure_z); }
  [[nodiscard]] Matrix3 T() const noexcept { return by_columns(T_x, T_y, T_z); }
  void set_measure(const Matrix3& a) noexcept {
    measure_x = {a.xx, a.yx, a.zx};
    measure_y = {a.xy, a.yy, a.zy, 0.0};
    measure_z = {a.xz, a.yz, a.zz, 0.0};
  }
  void set_T(const Matrix3& a) noexcept {
    T_x = {a.xx, a.yx, a.zx};
    T_y = {a.xy, a.yy, a.zy};
    T_z = {a.xz, a.yz, a.zz, 0.0};
  }
  /// @param solid,flat a E/2 of the hourglass energy of a solid, and of a sheet or chain [Pa]   @param volume
  /// v_i [m3]
  void set_moduli(double solid, double flat, double volume) noexcept {
    solid_hourglass = solid;
    flat_hourglass = flat;
    hourglass_energy = volume * solid;
  }
};
static_assert(sizeof(Deformed) == 3 * vector_bytes);

/// Half of the box and the box where a direction is periodic, infinity and 0 where it is not [m].
struct PeriodicWidths {
  Column half, width;
};

/// What a list tells of the reference shape, with x = x_ij, w = v_j W(x)/|x|^2: the same until bonds or
/// volumes change.
struct ReferenceSums {
  Matrix3 moment;  ///< sum w x x^T
  Vec3 gradient;   ///< sum v_j gradW
  Vec3 hourglass;  ///< sum w x
};

/// What it tells of the deformed one, with u = u_ji.
struct ListSums {
  Columned displacement;  ///< sum v_j u gradW^T
  Columned swept;         ///< sum w u x^T
  Column residual;        ///< sum w u
};

/// What the energies of the partners of a particle do to it, for a volume of 1: force [N/m3].
struct PartnerForces {
  Column stress, hourglass;
};

/// The loops of one scene.
struct BondSums {
  void (*reference)(const BondLists::List&, const BondShape*, const Place*, ReferenceSums&);
  void (*list)(const BondLists::List&, const BondShape*, const Place*, const Place&, const PeriodicWidths&,
               ListSums&);
  void (*partners)(const BondLists::List&, const BondShape*, const Place*, const Deformed*, const Place&,
                   const PeriodicWidths&, PartnerForces&);
};
/// What differs between scenes.
struct BondForms {
  bool periodic = false, hourglass = false;
  /// Bonds have gradients of their own: gradW below is that of the bond, which need not lie along x
  bool bends = false;
};
/// Those that this machine runs fastest.
[[nodiscard]] BondSums bond_sums(const BondForms&);
/// Those that are compiled for a vector unit.
template <class ForUnit>
[[nodiscard]] BondSums bond_sums_for(const BondForms&);
template <>
BondSums bond_sums_for<Any>(const BondForms&);
template <>
BondSums bond_sums_for<Avx2>(const BondForms&);

namespace detail {

[[gnu::always_inline]] inline void load(Quad& to, const void* from) noexcept {
  std::memcpy(&to, from, sizeof to);
}
[[gnu::always_inline]] inline void store(void* to, const Quad& from) noexcept {
  std::memcpy(to, &from, sizeof from);
}

struct Quads {
  Quad x{}, y{}, z{};
};
[[gnu::always_inline]] inline void store(Columned& to, const Quads& from) noexcept {
  store(&to.x, from.x);
  store(&to.y, from.y);
  store(&to.z, from.z);
}

/// A difference of places as the nearest images have it: both lie in the box, or apart by less than a bond.
template <bool periodic>
[[gnu::always_inline]] inline void nearest(Quad& d, const PeriodicWidths& box) noexcept {
  if constexpr (periodic) {
    Column c;
    store(&c, d);
    const auto shift = [](double along, double half, double width) {
      return along > half ? width : along < -half ? -width : 0.0;
    };
    Quad by;
    const Column widths{shift(c.x, box.half.x, box.width.x), shift(c.y, box.half.y, box.width.y),
                        shift(c.z, box.half.z, box.width.z), 0.0};
    load(by, &widths);
    d -= by;
  }
}

}  // namespace detail

/// @param places by id: their volumes are read
template <bool hourglass, bool bends, class ForUnit>
void sum_reference(const BondLists::List& list, const BondShape* shapes, const Place* places,
                   ReferenceSums& out) {
  using namespace detail;
  Quads moment;
  Quad gradient{}, weighted{};
  for (std::size_t n = 0; n < list.count; ++n) {
    const BondShape& bond = shapes[list.shape[n]];
    const double volume = places[list.other[n]].volume;
    Quad x;
    load(x, &bond);
    if constexpr (bends) {
      Quad g;
      load(g, &bond.gradient);
      gradient += volume * g;
    } else {
      gradient += (volume * bond.slope) * x;
    }
    if constexpr (hourglass) {
      const Quad wx = (volume * bond.hourglass) * x;
      moment.x += bond.x.x * wx;
      moment.y += bond.x.y * wx;
      moment.z += bond.x.z * wx;
      weighted += wx;
    }
  }
  Columned columns;
  store(columns, moment);
  Column c, w;
  store(&c, gradient);
  store(&w, weighted);
  out = {columns, c, w};
}

/// @param at place of i   @param places by id
template <bool periodic, bool hourglass, bool bends, class ForUnit>
void sum_list(const BondLists::List& list, const BondShape* shapes, const Place* places, const Place& at,
              const PeriodicWidths& box, ListSums& out) {
  using namespace detail;
  Quads displacement, swept;
  Quad i, residual{};
  load(i, &at);
  for (std::size_t n = 0; n < list.count; ++n) {
    const BondShape& bond = shapes[list.shape[n]];
    const Place& j = places[list.other[n]];
    Quad x, u;
    load(x, &bond);
    load(u, &j);
    u -= i;
    nearest<periodic>(u, box);
    u += x;
    const Quad ux = bond.x.x * u, uy = bond.x.y * u, uz = bond.x.z * u;
    if constexpr (bends) {
      const Vec3 g = j.volume * bond.gradient;
      displacement.x += g.x * u;
      displacement.y += g.y * u;
      displacement.z += g.z * u;
    } else {
      const double slope = j.volume * bond.slope;
      displacement.x += slope * ux;
      displacement.y += slope * uy;
      displacement.z += slope * uz;
    }
    if constexpr (hourglass) {
      const double w = j.volume * bond.hourglass;
      swept.x += w * ux;
      swept.y += w * uy;
      swept.z += w * uz;
      residual += w * u;
    }
  }
  store(out.displacement, displacement);
  store(out.swept, swept);
  store(&out.residual, residual);
}

/// sum_j -T_j gradW(x_ji), and sum_j -k_j v_j W(x_ji)/|x_ji|^2 ((F_j - I) x_ji + u_ij), k = a E/2: x_ji as j
/// has it in its list.
/// @param at place of i   @param places,deformed by id
template <bool periodic, bool hourglass, bool bends, class ForUnit>
void sum_partners(const BondLists::List& list, const BondShape* shapes, const Place* places,
                  const Deformed* deformed, const Place& at, const PeriodicWidths& box, PartnerForces& out) {
  using namespace detail;
  Quad i, stress{}, of_hourglass{};
  load(i, &at);
  for (std::size_t n = 0; n < list.count; ++n) {
    const BondShape& bond = shapes[list.seen[n]];
    const Deformed& j = deformed[list.other[n]];
    const Vec3& x = bond.x;
    Quads T;
    load(T.x, &j.T_x);
    load(T.y, &j.T_y);
    load(T.z, &j.T_z);
    if constexpr (bends)
      stress -= bond.gradient.x * T.x + bond.gradient.y * T.y + bond.gradient.z * T.z;
    else
      stress -= bond.slope * (x.x * T.x + x.y * T.y + x.z * T.z);
    if constexpr (hourglass) {
      Quads G;
      Quad u, r;
      load(G.x, &j.measure_x);
      load(G.y, &j.measure_y);
      load(G.z, &j.measure_z);
      load(u, &bond);
      load(r, &places[list.other[n]]);
      r = i - r;
      nearest<periodic>(r, box);
      u += r;
      of_hourglass -= (j.hourglass_energy * bond.hourglass) * (x.x * G.x + x.y * G.y + x.z * G.z + u);
    }
  }
  store(&out.stress, stress);
  store(&out.hourglass, of_hourglass);
}

template <bool periodic, bool hourglass, bool bends, class ForUnit>
[[nodiscard]] BondSums sums_of() {
  return {&sum_reference<hourglass, bends, ForUnit>, &sum_list<periodic, hourglass, bends, ForUnit>,
          &sum_partners<periodic, hourglass, bends, ForUnit>};
}
template <bool bends, class ForUnit>
[[nodiscard]] BondSums pick_of(const BondForms& forms) {
  if (forms.periodic)
    return forms.hourglass ? sums_of<true, true, bends, ForUnit>() : sums_of<true, false, bends, ForUnit>();
  return forms.hourglass ? sums_of<false, true, bends, ForUnit>() : sums_of<false, false, bends, ForUnit>();
}
template <class ForUnit>
[[nodiscard]] BondSums pick_bond_sums(const BondForms& forms) {
  return forms.bends ? pick_of<true, ForUnit>(forms) : pick_of<false, ForUnit>(forms);
}

}  // namespace tripoint::elastic
