// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/fields.hpp"
#include "pairs/pass.hpp"

/// Pair terms of the liquid that carries its density. G = grad_i W = (-W'/r) d, d = r_j - r_i.
namespace tripoint::carried_liquid {

/// Forms of the pair of pressures: F_i = -sum V_i V_j (p_i X + p_j Y). In each but `reverse_plain` the rate of density is
/// -rho_i sum V_j (v_j - v_i).X, the adjoint of the force. At a solid all have 2 p_i B_i G.
enum class Pair : int {
  own,            ///< X = B_i G, Y = B_j G: exact for linear velocities [Bonet & Lok 1999]
  mean,           ///< X = Y = (B_i + B_j)/2 G
  reverse,        ///< X = B_j G, Y = B_i G
  reverse_plain,  ///< the same force, and the rate without B [Zhang et al. 2024]
};
/// What takes noise out of velocities: what linear reconstruction leaves of a pair, the same where it approaches and limited, or
/// the whole approach, limited [Zhang, Hu, Adams 2017].
enum class Damping : int { residue, limited_residue, limited };
inline constexpr std::array<std::string_view, 4> pair_words{"own", "mean", "reverse", "reverse plain"};
inline constexpr std::array<std::string_view, 3> damping_words{" residue", " limited residue", " limited"};

template <class V>
struct Way {
  V x, y, z;
};
template <class V>
[[gnu::always_inline]] inline Way<V> mixed(V a, const Way<V>& u, V b, const Way<V>& v) {
  return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}
/// B d, of the components xx, yy, zz, yz, xz, xy.
template <class V, std::size_t n>
[[gnu::always_inline]] inline Way<V> corrected(std::span<const V, n> b, std::size_t at, const PairGeometry<V>& g) {
  return {b[at] * g.dx + b[at + 5] * g.dy + b[at + 4] * g.dz, b[at + 5] * g.dx + b[at + 1] * g.dy + b[at + 3] * g.dz,
          b[at + 4] * g.dx + b[at + 3] * g.dy + b[at + 2] * g.dz};
}

/// Weight of the own pressure of i in a pair: 2 Z_j/(Z_i + Z_j) between liquids, 2 at a solid, which has no pressure of its own.
template <class V>
[[gnu::always_inline]] inline V weight(V z_i, V z_j) noexcept {
  const MaskOf<V> differ = z_i != z_j;
  const V one = every_lane<V>(1.0);
  if (!any(differ)) return one;
  const V liquids = differ ? 2.0 * z_j / (z_i + z_j) : one;
  return z_j == 0.0 ? every_lane<V>(2.0) : liquids;
}

/// X and Y of a pair over -W'/r, with the weights of the impedances.
template <Pair form, class V>
[[gnu::always_inline]] inline std::pair<Way<V>, Way<V>> sides(const Way<V>& of_i, const Way<V>& of_j, V z_i, V z_j) {
  const V w_i = weight<V>(z_i, z_j), w_j = weight<V>(z_j, z_i), none{};
  if constexpr (form == Pair::own) return {mixed<V>(w_i, of_i, none, of_i), mixed<V>(w_j, of_j, none, of_j)};
  const MaskOf<V> wall_j = z_j == 0.0, wall_i = z_i == 0.0;
  const V own = form == Pair::mean ? every_lane<V>(0.5) : none, other = 1.0 - own;
  const V a = wall_j ? w_i : w_i * own, b = wall_j ? none : w_i * other;
  const V c = wall_i ? w_j : w_j * own, d = wall_i ? none : w_j * other;
  return {mixed<V>(a, of_i, b, of_j), mixed<V>(c, of_j, d, of_i)};
}

/// Half of the head between a liquid and a solid; where that would pull, no more than the pressure.
template <class V>
[[gnu::always_inline]] inline V head(V pressure, V difference) noexcept {
  const V pressed = where<V>(pressure > 0.0, pressure), half = 0.5 * difference;
  return half > -pressed ? half : -pressed;
}

/// Viscosity of a pair. A solid is seen with its velocity mirrored; two solids have none.
template <class V>
[[gnu::always_inline]] inline V pair_viscosity(V z_i, V z_j, V mu_i, V mu_j, V slips_i, V slips_j) {
  const MaskOf<V> wall_i = z_i == 0.0, wall_j = z_j == 0.0;
  const V liquids = harmonic_mean<V>(mu_i, mu_j);
  if (!any(wall_i | wall_j)) return liquids;
  const V stick = where<V>(wall_i, 2.0 * (1.0 - slips_i)) * mu_j + where<V>(wall_j, 2.0 * (1.0 - slips_j)) * mu_i;
  return wall_i | wall_j ? stick : liquids;
}
/// Viscous force along the line of centres. @param k f V V mu @param v velocity of j less that of i
template <class V>
[[gnu::always_inline]] inline void add_shear(const PairGeometry<V>& g, V k, const Way<V>& v, std::span<V, 3> sum) {
  const V along = (v.x * g.dx + v.y * g.dy + v.z * g.dz) * g.per_r2;
  const V size = (10.0 * g.kernels.per_gradient_moment) * k * along;
  sum[0] += size * g.dx;
  sum[1] += size * g.dy;
  sum[2] += size * g.dz;
}

/// Kernel sum of the number density.
struct SummedDensity {
  static constexpr std::string_view name = "SummedDensity";
  static constexpr bool zero_beyond = true;
  using reads = Keys<>;
  using adds = Keys<field::summed_density>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 0>, std::span<const V, 0>, std::span<V, 1> sum) {
    sum[0] += where(g.within, g.kernels.wendland.value_inside(g.r));
  }
};

/// Moments sum V d (x) G: of all neighbours, where a solid counts once, and of those of the same liquid.
struct Moments {
  static constexpr std::string_view name = "CarriedMoments";
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::liquid_rest_density>;
  using adds = Keys<field::moment_xx, field::moment_yy, field::moment_zz, field::moment_yz, field::moment_xz, field::moment_xy,
                    field::own_moment_xx, field::own_moment_yy, field::own_moment_zz, field::own_moment_yz, field::own_moment_xz,
                    field::own_moment_xy, field::wall_share>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 3> i, std::span<const V, 3> j, std::span<V, 13> sum) {
    const V z_i = i[1], z_j = j[1], rest_i = i[2], rest_j = j[2];
    const V w = z_j == 0.0 ? every_lane<V>(1.0) : weight<V>(z_i, z_j);
    const V f = where<V>(g.within, -g.gradient * j[0]);
    add_outer<V>(w * f, g, sum.template first<6>());
    add_outer<V>(where<V>((rest_i == rest_j) & (z_j != 0.0), f), g, sum.template subspan<6, 6>());
    sum[12] += where<V>(g.within & (z_j == 0.0), j[0] * g.kernels.wendland.value_inside(g.r));
  }
};

/// First derivatives: raw ones of velocity and density in the same liquid, the divergence by the form's pair, the unevenness
/// sum V_j (X + Y), and the greatest velocity difference.
template <Pair form>
struct Gradients {
  static constexpr std::string_view first = "CarriedGradients ", second = pair_words[static_cast<std::size_t>(form)];
  static constexpr std::string_view name = JoinedName<first, second>::value;
  static constexpr bool zero_beyond = true;
  using reads = Keys<field::carried_volume, field::impedance, field::liquid_rest_density, field::density, field::velocity_x,
                     field::velocity_y, field::velocity_z, field::correction_xx, field::correction_yy, field::correction_zz,
                     field::correction_yz, field::correction_xz, field::correction_xy, field::exposed>;
  using adds = Keys<field::velocity_gradient_xx, field::velocity_gradient_xy, field::velocity_gradient_xz,
                    field::velocity_gradient_yx, field::velocity_gradient_yy, field::velocity_gradient_yz,
                    field::velocity_gradient_zx, field::velocity_gradient_zy, field::velocity_gradient_zz,
                    field::density_gradient_x, field::density_gradient_y, field::density_gradient_z, field::unevenness_x,
                    field::unevenness_y, field::unevenness_z, field::exposed_near, field::nearby_speed2, field::divergence>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 14> i, std::span<const V, 14> j, std::span<V, 18> sum) {
    const V z_i = i[1], z_j = j[1], rest_i = i[2], rest_j = j[2], rho_i = i[3], rho_j = j[3];
    const V f = where<V>(g.within, -g.gradient * j[0]);
    const V vx = j[4] - i[4], vy = j[5] - i[5], vz = j[6] - i[6];
    const V same = where<V>((rest_i == rest_j) & (z_j != 0.0), f);
    const V gx = same * g.dx, gy = same * g.dy, gz = same * g.dz, jump = rho_j - rho_i;
    sum[0] += vx * gx;
    sum[1] += vx * gy;
    sum[2] += vx * gz;
    sum[3] += vy * gx;
    sum[4] += vy * gy;
    sum[5] += vy * gz;
    sum[6] += vz * gx;
    sum[7] += vz * gy;
    sum[8] += vz * gz;
    sum[9] += jump * gx;
    sum[10] += jump * gy;
    sum[11] += jump * gz;
    const auto [X, Y] = sides<form, V>(corrected<V>(i, 7, g), corrected<V>(j, 7, g), z_i, z_j);
    sum[12] += f * (X.x + Y.x);
    sum[13] += f * (X.y + Y.y);
    sum[14] += f * (X.z + Y.z);
    const V close = where<V>(g.within, j[13]), speed2 = where<V>(g.within & (z_j != 0.0), vx * vx + vy * vy + vz * vz);
    sum[15] = close > sum[15] ? close : sum[15];
    sum[16] = speed2 > sum[16] ? speed2 : sum[16];
    if constexpr (form == Pair::reverse_plain)
      sum[17] += (weight<V>(z_i, z_j) * f) * (vx * g.dx + vy * g.dy + vz * g.dz);
    else
      sum[17] += f * (vx * X.x + vy * X.y + vz * X.z);
  }
};

/// Forces of pressure, of viscosity and of the damping, and the diffusion of density. A solid feels the opposite of what it does.
template <Pair form, Damping damping>
struct Forces {
  static constexpr std::string_view first = "CarriedForces ", second = pair_words[static_cast<std::size_t>(form)],
                                    third = damping_words[static_cast<std::size_t>(damping)];
  static constexpr std::string_view name = JoinedName<first, second, third>::value;
  static constexpr bool zero_beyond = true;
  using reads =
      Keys<field::carried_volume, field::impedance, field::liquid_rest_density, field::density, field::pressure,
           field::liquid_viscosity, field::slips, field::correction_xx, field::correction_yy, field::correction_zz,
           field::correction_yz, field::correction_xz, field::correction_xy, field::velocity_x, field::velocity_y,
           field::velocity_z, field::velocity_gradient_xx, field::velocity_gradient_xy, field::velocity_gradient_xz,
           field::velocity_gradient_yx, field::velocity_gradient_yy, field::velocity_gradient_yz, field::velocity_gradient_zx,
           field::velocity_gradient_zy, field::velocity_gradient_zz, field::density_gradient_x, field::density_gradient_y,
           field::density_gradient_z, field::pull_x, field::pull_y, field::pull_z, field::predicted_x, field::predicted_y,
           field::predicted_z, field::wall_pressure>;
  using adds =
      Keys<field::force_x, field::force_y, field::force_z, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z,
           field::residue_force_x, field::residue_force_y, field::residue_force_z, field::diffused>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 35> i, std::span<const V, 35> j, std::span<V, 10> sum) {
    const V z_i = i[1], z_j = j[1];
    const MaskOf<V> wall_i = z_i == 0.0, wall_j = z_j == 0.0, liquids = !(wall_i | wall_j);
    const V f = where<V>(g.within, -g.gradient), ff = f * (i[0] * j[0]);
    // pressure; at a solid that of the liquid and of the head between the two
    const V towards = wall_i ? every_lane<V>(-1.0) : every_lane<V>(1.0);
    const V lean = towards * ((i[28] + j[28]) * g.dx + (i[29] + j[29]) * g.dy + (i[30] + j[30]) * g.dz);
    const V p_i = i[4] + where<V>(wall_j, head<V>(i[4], i[3] * lean)), p_j = j[4] + where<V>(wall_i, head<V>(j[4], j[3] * lean));
    const auto [X, Y] = sides<form, V>(corrected<V>(i, 7, g), corrected<V>(j, 7, g), z_i, z_j);
    const V out = where<V>(wall_j, i[34]) + where<V>(wall_i, j[34]);
    sum[0] -= ff * (p_i * X.x + p_j * Y.x + out * g.dx);
    sum[1] -= ff * (p_i * X.y + p_j * Y.y + out * g.dy);
    sum[2] -= ff * (p_i * X.z + p_j * Y.z + out * g.dz);
    const V mu = pair_viscosity<V>(z_i, z_j, i[5], j[5], i[6], j[6]);
    add_shear<V>(g, ff * mu, {j[31] - i[31], j[32] - i[32], j[33] - i[33]}, sum.template subspan<3, 3>());
    // damping
    const V vx = j[13] - i[13], vy = j[14] - i[14], vz = j[15] - i[15];
    const V parting = (vx * g.dx + vy * g.dy + vz * g.dz) * g.per_r2;  // [1/s], below 0 where the pair approaches
    V left = parting;
    if constexpr (damping != Damping::limited) {
      const V lx = (i[16] + j[16]) * g.dx + (i[17] + j[17]) * g.dy + (i[18] + j[18]) * g.dz;
      const V ly = (i[19] + j[19]) * g.dx + (i[20] + j[20]) * g.dy + (i[21] + j[21]) * g.dz;
      const V lz = (i[22] + j[22]) * g.dx + (i[23] + j[23]) * g.dy + (i[24] + j[24]) * g.dz;
      left -= (0.5 * g.per_r2) * (lx * g.dx + ly * g.dy + lz * g.dz);
    }
    const V z = where<V>(liquids, 2.0 * z_i * z_j / (z_i + z_j + 1e-300));
    V k;
    if constexpr (damping == Damping::residue) {
      k = where<V>(i[2] == j[2], ff * z * left);  // times beta h; unlike liquids slip along each other
    } else {
      const V u = g.r * (parting > left ? -parting : -left), mach = 3.0 * u * (i[2] + j[2]) / (z_i + z_j + 1e-300);
      k = where<V>(u > 0.0, -(ff * z) * u * (mach < 1.0 ? mach : every_lane<V>(1.0)));
    }
    sum[6] += k * g.dx;
    sum[7] += k * g.dy;
    sum[8] += k * g.dz;
    // diffusion of density
    if constexpr (damping == Damping::limited) {
      sum[9] += where<V>(liquids, (2.0 * j[0]) * i[3] * (j[4] - i[4]) * f * g.r / (z_i + z_j + 1e-300));
    } else {
      const V linear = 0.5 * ((i[25] + j[25]) * g.dx + (i[26] + j[26]) * g.dy + (i[27] + j[27]) * g.dz);
      sum[9] += where<V>(liquids & (i[2] == j[2]), f * j[0] * (j[3] - i[3] - linear));
    }
  }
};

}  // namespace tripoint::carried_liquid
