// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "sph/pass.hpp"

namespace tripoint {

/// Transport velocity [Adami, Hu, Adams 2013, J. Comput. Phys. 241, 292, (8), (13), (15)], d = r_j - r_i, w = transport
/// velocity less velocity:
/// background force per background pressure [m2]: sum (V_i^2 + V_j^2) (W'/r) d, which evens out the particles;
/// stress force [N]: sum (V_i^2 + V_j^2) 1/2 (A_i + A_j).grad_i W, A = rho v w^T, the momentum that the difference carries.
struct TransportForces {
  using reads = Keys<field::volume, field::density, field::viscous_velocity_x, field::viscous_velocity_y,
                     field::viscous_velocity_z, field::shift_x, field::shift_y, field::shift_z>;
  using adds = Keys<field::background_x, field::background_y, field::background_z, field::transport_force_x,
                    field::transport_force_y, field::transport_force_z>;
  template <class V>
  static void pair(const PairGeometry<V>& g, std::span<const V, 8> i, std::span<const V, 8> j, std::span<V, 6> sum) {
    const V b = (i[0] * i[0] + j[0] * j[0]) * g.gradient;
    sum[0] += b * g.dx;
    sum[1] += b * g.dy;
    sum[2] += b * g.dz;
    const V out_i = -0.5 * b * i[1] * (i[5] * g.dx + i[6] * g.dy + i[7] * g.dz);
    const V out_j = -0.5 * b * j[1] * (j[5] * g.dx + j[6] * g.dy + j[7] * g.dz);
    sum[3] += out_i * i[2] + out_j * j[2];
    sum[4] += out_i * i[3] + out_j * j[3];
    sum[5] += out_i * i[4] + out_j * j[4];
  }
};

}  // namespace tripoint
