// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/fields.hpp"
#include "pairs/pass.hpp"

/// Pair terms of the liquid that carries its density. G = grad_i W = (-W'/r) d, d = r_j - r_i.
namespace tripoint::carried_liquid {

/// Forms of the pair of pressures: F_i = -sum V_i V_j (p_i X + p_j Y). In each but `reverse_plain` the rate
/// of density is -rho_i sum V_j (v_j - v_i).X, the adjoint of the force. Of a solid B is the identity.
enum class Pair : int {
  own,            ///< X = B_i G, Y = B_j G: exact for linear velocities [Bonet & Lok 1999]
  mean,           ///< X = Y = (B_i + B_j)/2 G
  reverse,        ///< X = B_j G, Y = B_i G
  reverse_plain,  ///< the same force, and the rate without B [Zhang et al. 2024]
};
/// What takes noise out of velocities: what linear reconstruction leaves of a pair, the same where it
/// approaches and limited, or the whole approach, limited [Zhang, Hu, Adams 2017].
enum class Damping : int { residue, limited_residue, limited };
inline constexpr std::array<std::string_view, 4> pair_words{"own", "mean", "reverse", "reverse plain"};
inline constexpr std::array<std::string_view, 3> damping_words{" residue", " limited residue", " limited"};

/// X and Y of a pair over -W'/r.
template <Pair form, class V>
[[gnu::always_inline]] inline std::pair<VectorOf<V>, VectorOf<V>> sides(const VectorOf<V>& of_i,
                                                                        const VectorOf<V>& of_j, V z_i,
                                                                        V z_j) {
  if constexpr (form == Pair::own) return {of_i, of_j};
  const V one = every_lane<V>(1.0), none{};
  const MaskOf<V> wall_j = z_j == 0.0, wall_i = z_i == 0.0;
  const V own = form == Pair::mean ? every_lane<V>(0.5) : none, other = 1.0 - own;
  const V a = wall_j ? one : own, b = wall_j ? none : other;
  const V c = wall_i ? one : own, d = wall_i ? none : other;
  return {a * of_i + b * of_j, c * of_j + d * of_i};
}

/// -W'/r, 0 between solids and beyond the support.
template <class V>
[[gnu::always_inline]] inline V slope_of(const PairGeometry<V>& g, V z_i, V z_j) {
  return where<V>(g.within & ((z_i != 0.0) | (z_j != 0.0)), -g.gradient);
}

/// A pair in the middle of the drift. What the rate does there is the mean of what the forces of its two ends
/// do, to second order.
template <class V>
struct Halfway {
  VectorOf<V> d;
  V r;
  /// @param v velocity along the drift of j less that of i
  [[gnu::always_inline]] Halfway(const PairGeometry<V>& g, const VectorOf<V>& v)
      : d(g.d() - every_lane<V>(g.kernels.half_step) * v), r(root(dot(d, d))) {}
  /// -W'/r, as slope_of
  [[nodiscard, gnu::always_inline]] V slope(const PairGeometry<V>& g, V z_i, V z_j) const {
    const MaskOf<V> wet = g.within & ((z_i != 0.0) | (z_j != 0.0));
    return where<V>(wet, -g.kernels.wendland.derivative_over_r(r));
  }
};

/// Share of the neighbourhood of i that j fills where it is solid.
template <class V>
[[gnu::always_inline]] inline V solid_share(const PairGeometry<V>& g, V z_j, V V_j) {
  const MaskOf<V> wall = g.within & (z_j == 0.0);
  return any(wall) ? where<V>(wall, V_j * g.kernels.wendland.value_inside(g.r)) : V{};
}

/// Value times W(r) where i is solid and j liquid.
template <class V>
[[gnu::always_inline]] inline V liquid_share(const PairGeometry<V>& g, V r, V z_i, V z_j, V value) {
  const MaskOf<V> touch = g.within & (z_i == 0.0) & (z_j != 0.0);
  return any(touch) ? where<V>(touch, value * g.kernels.wendland.value(r)) : V{};
}

/// What solids fill around a liquid, and liquids around a solid, there now and amid the drift.
template <class V>
[[gnu::always_inline]] inline void add_shares(const PairGeometry<V>& g, const Halfway<V>& middle, V z_i,
                                              V z_j, V V_j, auto& sum) {
  sum(field::wall_share) += solid_share<V>(g, z_j, V_j);
  sum(field::touching) += liquid_share<V>(g, g.r, z_i, z_j, V_j);
  sum(field::touching_halfway) += liquid_share<V>(g, middle.r, z_i, z_j, V_j);
}

/// Pressure with which solids push out a liquid, of a pair of the two.
template <class V>
[[gnu::always_inline]] inline V push_out(const auto& i, const auto& j, V z_i, V z_j) {
  return where<V>(z_j == 0.0, i(field::wall_pressure)) + where<V>(z_i == 0.0, j(field::wall_pressure));
}

/// Viscosity of a pair. A solid is seen with its velocity mirrored; two solids have none.
template <class V>
[[gnu::always_inline]] inline V viscosity_between(const auto& i, const auto& j) {
  const MaskOf<V> wall_i = i(field::impedance) == 0.0, wall_j = j(field::impedance) == 0.0;
  const V mu_i = i(field::liquid_viscosity), mu_j = j(field::liquid_viscosity),
          liquids = harmonic_mean<V>(mu_i, mu_j);
  if (!any(wall_i | wall_j)) return liquids;
  const V stick = where<V>(wall_i, 2.0 * (1.0 - i(field::slips))) * mu_j +
                  where<V>(wall_j, 2.0 * (1.0 - j(field::slips))) * mu_i;
  return wall_i | wall_j ? stick : liquids;
}
/// Viscous force along the line of centres. @param k f V V mu @param v velocity of j less that of i
template <class V>
[[gnu::always_inline]] inline VectorOf<V> shear(const PairGeometry<V>& g, V k, const VectorOf<V>& v) {
  const V along = dot(v, g.d()) * g.per_r2;
  const V size =
      g.kernels.shear.weighted((g.kernels.central * g.kernels.per_gradient_moment) * k * along, g.r * g.r);
  return size * g.d();
}

/// Coefficient of the viscosity of the residue along d, of which that of `residue` lacks the factor beta h.
/// @param ff f V V @param pressed whether one of them has a pressure: what parts freely is not held back
/// @param v velocity of j less that of i
template <Damping damping, class V>
[[gnu::always_inline]] inline V damped(const PairGeometry<V>& g, V ff, MaskOf<V> pressed, const auto& i,
                                       const auto& j, const VectorOf<V>& v) {
  const V z_i = i(field::impedance), z_j = j(field::impedance);
  const V rest_i = i(field::liquid_rest_density), rest_j = j(field::liquid_rest_density);
  const VectorOf<V> d = g.d();
  const V parting = dot(v, d) * g.per_r2;  // [1/s], below 0 where the pair approaches
  V left = parting;
  if constexpr (damping != Damping::limited)
    left -= (0.5 * g.per_r2) * dot((i(field::strain_rate) + j(field::strain_rate)) * d, d);
  const MaskOf<V> liquids = !((z_i == 0.0) | (z_j == 0.0));
  const V z = where<V>(liquids, 2.0 * z_i * z_j / (z_i + z_j + 1e-300));
  if constexpr (damping == Damping::residue)
    return where<V>(pressed & (rest_i == rest_j), ff * z * left);  // unlike liquids slip along each other
  const V u = g.r * (parting > left ? -parting : -left),
          mach = 3.0 * u * (rest_i + rest_j) / (z_i + z_j + 1e-300);
  return where<V>(u > 0.0, -(ff * z) * u * (mach < 1.0 ? mach : every_lane<V>(1.0)));
}

/// Moments sum V d (x) G of all neighbours.
struct Moments {
  static constexpr std::string_view name = "CarriedMoments";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance>;
  using adds = Keys<field::moment>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance);
    sum(field::moment) += (slope_of<V>(g, z_i, z_j) * j(field::carried_volume)) * square(g.d());
  }
};

/// What the rates of the solids around a liquid add to its own: the adjoint of the pressure of a solid.
struct WallRate {
  static constexpr std::string_view name = "CarriedWallRate";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::impedance, field::displaced, field::predicted>;
  using adds = Keys<field::wall_rate>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const Halfway<V> middle(g, j(field::predicted) - i(field::predicted));
    sum(field::wall_rate) +=
        liquid_share<V>(g, middle.r, j(field::impedance), i(field::impedance), j(field::displaced));
  }
};

/// Pressure that liquids have at a solid, over their share.
struct WallPressure {
  static constexpr std::string_view name = "CarriedWallPressure";
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::carried_volume, field::impedance, field::density, field::carried_pressure, field::pull>;
  using adds = Keys<field::pressed, field::weighed>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V share =
        liquid_share<V>(g, g.r, i(field::impedance), j(field::impedance), j(field::carried_volume));
    sum(field::pressed) += share * j(field::carried_pressure);
    sum(field::weighed) -= share * j(field::density) * dot(i(field::pull), g.d());
  }
};

/// First derivatives: raw ones of velocity and pressure in the same liquid, the unevenness sum V_j (X + Y),
/// the greatest velocity difference; the share of liquids at a solid; the kernel sum of the number density
/// without the own kernel, and its slope.
template <Pair form>
struct Gradients {
  static constexpr std::string_view first = "CarriedGradients ",
                                    second = pair_words[static_cast<std::size_t>(form)];
  static constexpr std::string_view name = JoinedName<first, second>::value;
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::carried_volume, field::impedance, field::liquid_rest_density, field::carried_pressure,
           field::predicted, field::correction, field::correction_halfway, field::exposed>;
  using adds = Keys<field::own_moment, field::touching, field::touching_halfway, field::velocity_gradient,
                    field::pressure_gradient, field::unevenness, field::exposed_near, field::nearby_speed2,
                    field::divergence, field::wall_share, field::summed_density, field::summed_slope>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance);
    const V f = slope_of<V>(g, z_i, z_j) * j(field::carried_volume);
    const VectorOf<V> d = g.d(), v = j(field::predicted) - i(field::predicted);
    const V same =
        where<V>((i(field::liquid_rest_density) == j(field::liquid_rest_density)) & (z_j != 0.0), f);
    const V jump = j(field::carried_pressure) - i(field::carried_pressure);
    sum(field::summed_density) += where<V>(g.within, g.kernels.wendland.value_inside(g.r));
    sum(field::summed_slope) += where<V>(g.within, -g.gradient) * d;
    sum(field::own_moment) += same * square(d);
    sum(field::velocity_gradient) += outer<V>(v, same * d);
    sum(field::pressure_gradient) += jump * (same * d);
    const auto [X, Y] = sides<form, V>(i(field::correction) * d, j(field::correction) * d, z_i, z_j);
    sum(field::unevenness) += f * (X + Y);
    const V close = where<V>(g.within, j(field::exposed)),
            speed2 = where<V>(g.within & (z_j != 0.0), dot(v, v));
    V &near = sum(field::exposed_near), &greatest = sum(field::nearby_speed2);
    near = close > near ? close : near;
    greatest = speed2 > greatest ? speed2 : greatest;
    const Halfway<V> middle(g, v);
    const V F = middle.slope(g, z_i, z_j) * j(field::carried_volume);
    if constexpr (form == Pair::reverse_plain)
      sum(field::divergence) += F * dot(v, middle.d);
    else
      sum(field::divergence) += F * dot(v, sides<form, V>(i(field::correction_halfway) * middle.d,
                                                          j(field::correction_halfway) * middle.d, z_i, z_j)
                                               .first);
    add_shares<V>(g, middle, z_i, z_j, j(field::carried_volume), sum);
  }
};

/// Forces of pressure, of viscosity and of the damping, and the diffusion of density. A solid feels the
/// opposite of what it does.
template <Pair form, Damping damping>
struct Forces {
  static constexpr std::string_view first = "CarriedForces ",
                                    second = pair_words[static_cast<std::size_t>(form)],
                                    third = damping_words[static_cast<std::size_t>(damping)];
  static constexpr std::string_view name = JoinedName<first, second, third>::value;
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::carried_volume, field::impedance, field::liquid_rest_density, field::liquid_viscosity,
           field::slips, field::correction, field::strain_rate, field::pressure_gradient, field::predicted,
           field::carried_pressure, field::wall_pressure>;
  using adds = Keys<field::force, field::viscous_force, field::residue_force, field::diffused>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto& i, const auto& j, auto& sum) {
    const V z_i = i(field::impedance), z_j = j(field::impedance), V_j = j(field::carried_volume);
    const V rest_i = i(field::liquid_rest_density), rest_j = j(field::liquid_rest_density);
    const MaskOf<V> wall_i = z_i == 0.0, wall_j = z_j == 0.0, liquids = !(wall_i | wall_j);
    const V f = slope_of<V>(g, z_i, z_j), ff = f * (i(field::carried_volume) * V_j);
    const VectorOf<V> d = g.d();
    const V p_i = i(field::carried_pressure), p_j = j(field::carried_pressure);
    const auto [X, Y] = sides<form, V>(i(field::correction) * d, j(field::correction) * d, z_i, z_j);
    sum(field::force) += -ff * (p_i * X + p_j * Y + push_out<V>(i, j, z_i, z_j) * d);
    const VectorOf<V> v = j(field::predicted) - i(field::predicted);
    sum(field::viscous_force) += shear<V>(g, ff * viscosity_between<V>(i, j), v);
    sum(field::residue_force) += damped<damping, V>(g, ff, (p_i != 0.0) | (p_j != 0.0), i, j, v) * d;
    // diffusion of density
    if constexpr (damping == Damping::limited) {
      const V jump = (2.0 * V_j) * (p_j - p_i) * f;
      sum(field::diffused) += where<V>(liquids, jump * g.r / (z_i + z_j + 1e-300));
    } else {
      const V linear = 0.5 * dot(i(field::pressure_gradient) + j(field::pressure_gradient), d);
      sum(field::diffused) += where<V>(liquids & (rest_i == rest_j), f * V_j * (p_j - p_i - linear));
    }
  }
};

}  // namespace tripoint::carried_liquid
