// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "effects/world.hpp"

namespace tripoint {

/// The columns of one force on every particle [N], and where the work that it does is booked [J].
struct ForceColumns {
  Triple<const double> force;
  double Booked::*work;            ///< on what moves by forces
  double Booked::*work_on_driven;  ///< on what the scene moves
};

/// A force that an effect can make: its fields, and where its work is booked.
struct ForceFields {
  Field<double> x, y, z;
  double Booked::*work;
  double Booked::*work_on_driven;
};

/// Every force that there is, each once, in the order in which forces are summed.
inline constexpr auto force_fields = std::to_array<ForceFields>({
    {field::force_x, field::force_y, field::force_z, &Booked::pressure_work, &Booked::wall_pressure_work},
    {field::viscous_force_x, field::viscous_force_y, field::viscous_force_z, &Booked::viscous_work, &Booked::wall_viscous_work},
    {field::transport_force_x, field::transport_force_y, field::transport_force_z, &Booked::transport_work, &Booked::transport_work},
    {field::elastic_force_x, field::elastic_force_y, field::elastic_force_z, &Booked::elastic_work, &Booked::wall_elastic_work},
});

/// Those of them that the effects of this scene make. Valid until particles are sorted anew.
[[nodiscard]] inline std::vector<ForceColumns> force_columns(const World& world) {
  const Particles& p = world.particles;
  std::vector<ForceColumns> list;
  for (const ForceFields& f : force_fields)
    if (p.has(f.x.name)) list.push_back({triple(p, f.x, f.y, f.z), f.work, f.work_on_driven});
  return list;
}

/// Sum of the forces on one particle [N].
[[nodiscard]] inline Vec3 total_force(const std::vector<ForceColumns>& forces, std::size_t row) {
  Vec3 sum;
  for (const ForceColumns& f : forces) sum += f.force.at(row);
  return sum;
}

}  // namespace tripoint
