// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// The catalogue of fields that several rooms know: one line a field. One that an effect alone knows stands
/// in its folder, in fields.hpp. Vectors of particles are three columns, so that a pair pass loads lanes.
namespace tripoint::field {

// particles: every scene has these
inline constexpr Field<int> id{"id", "1"}, body{"body", "1"}, phase{"phase", "1"}, material{"material", "1"},
    source{"source", "1"};
inline constexpr Field<double> mass{"mass", "kg"};
inline constexpr VectorField<double> position{"position", "m"}, velocity{"velocity", "m/s"};
/// How many box widths a particle has been moved back by in a periodic direction.
inline constexpr VectorField<int> image{"image", "1"};

// density (4)
inline constexpr Field<double> density{"density", "kg/m3"};

// liquids and contact (4), (7)-(9)
inline constexpr Field<double> volume{"volume", "m3"}, pressure{"pressure", "Pa"};
/// Of pressure
inline constexpr VectorField<double> force{"force", "N"};
/// Group of the particle. Members of one group of 0 and above exert no force on each other. The values are
/// listed at the end of this file.
inline constexpr Field<double> group{"group", "1"};
/// Transport velocity less velocity.
inline constexpr VectorField<double> shift{"shift", "m/s"};

/// sum of W(x_ij) over excluded pairs of a member of a deformable body: constant part of its number density
/// (model 8.2)
inline constexpr Field<double> own_density{"own_density", "1/m3"};

/// Code of the agent that moves this particle in place of forces: 0 none, else one of the codes at the end of
/// this file.
inline constexpr Field<int> driven{"driven", "1"};
/// Row in the trajectory, where particles can leave: ids are of those that are there.
inline constexpr Field<int> number{"number", "1"};

// elastic solids (10)-(17)
/// A_i = pinv M_i of the reference list (model 8.7), symmetric, and its rank: 3 solid, 2 sheet, 1 chain, 0
/// without neighbours. Members of rigid bodies that own no strain energy have rank 3.
inline constexpr SymmetricField shape_inverse{"shape_inverse", "1"};
inline constexpr Field<int> shape_rank{"shape_rank", "1"};
inline constexpr Field<double> solid_volume{"solid_volume", "m3"};  ///< v_i: m/rho0, printed (11)
/// Material whose constants the strain energy of a particle has, and how many times: 0 where it owns none.
inline constexpr Field<int> solid_material{"solid_material", "1"};
inline constexpr Field<double> solid_stiffness{"solid_stiffness", "1"};
/// 1 where neither this particle nor any of its body neighbours is a sheet or a chain.
inline constexpr Field<int> regular_bonds{"regular_bonds", "1"};
/// Square of the frequency that the bonds give this particle while its neighbours stay [1/s2]; 0 while its
/// list is the first one.
inline constexpr Field<double> bond_frequency{"bond_frequency", "1/s2"};
/// Strain of the present time, total, within the range of M_i; and the part of it that has flowed
/// (model 8.7, 8.8).
inline constexpr SymmetricField strain{"strain", "1"};
inline constexpr SymmetricField plastic_strain{"plastic_strain", "1"};
/// 1 where the strain of now is beyond the bound of plastic flow, else 0
inline constexpr Field<int> may_flow{"may_flow", "1"};

// phase change, Fig. 5
inline constexpr Field<double> liquid_fraction{"liquid_fraction", "1"};
/// Remaining share of E and mu of a solid that softens.
inline constexpr Field<double> stiffness_share{"stiffness_share", "1"};

// heat (21)
inline constexpr Field<double> temperature{"temperature", "K"};
inline constexpr Field<double> enthalpy{"enthalpy", "J"};
/// Of the solid where something melts
inline constexpr Field<double> heat_capacity{"heat_capacity", "J/kg/K"};
inline constexpr Field<int> held{"temperature.held", "1"};

// solid bodies: one row for each that ever existed, [[body]] order, then births
inline constexpr Field<double> body_mass{"body.mass", "kg", Per::body};
inline constexpr Field<Vec3> body_centre{"body.centre", "m", Per::body},
    body_velocity{"body.velocity", "m/s", Per::body};
/// Velocity change of the last kick, divided by the kick's length.
inline constexpr Field<Vec3> body_acceleration{"body.acceleration", "m/s2", Per::body},
    body_angular_acceleration{"body.angular_acceleration", "rad/s2", Per::body};
inline constexpr Field<Vec3> body_angular_momentum{"body.angular_momentum", "kg m2/s", Per::body};
inline constexpr Field<Vec3> body_angular_velocity{"body.angular_velocity", "rad/s", Per::body};
/// Principal, ascending; 0 where truncated
inline constexpr Field<Vec3> body_inertia{"body.inertia", "kg m2", Per::body};
inline constexpr Field<Quaternion> body_orientation{"body.orientation", "1", Per::body};
inline constexpr Field<Quaternion> body_axes{"body.axes", "1", Per::body};  ///< principal frame to body frame
/// 1 about the world axes it may turn about
inline constexpr Field<Vec3> body_turns{"body.turns", "1", Per::body};
inline constexpr Field<Vec3> body_start_centre{"body.start_centre", "m", Per::body};
/// From the point that keyframes move to the centre of mass, in the body frame: not 0 after others have
/// joined.
inline constexpr Field<Vec3> body_offset{"body.offset", "m", Per::body};
inline constexpr Field<Vec3> body_start_velocity{"body.start_velocity", "m/s", Per::body},
    body_start_spin{"body.start_spin", "rad/s", Per::body};
/// Rigid where the particles move as one, else elastic
inline constexpr Field<int> body_phase{"body.phase", "1", Per::body};
/// Number of the event that grips it + 1, 0 for none; its centre and orientation as it was gripped.
inline constexpr Field<int> body_grip{"body.grip", "1", Per::body};
inline constexpr Field<Vec3> body_grip_centre{"body.grip_centre", "m", Per::body};
inline constexpr Field<Quaternion> body_grip_orientation{"body.grip_orientation", "1", Per::body};
/// Given to it so far by what holds the temperature of its particles
inline constexpr Field<double> body_heat{"body.heat", "J", Per::body};
inline constexpr Field<int> body_motion{"body.motion", "1", Per::body},
    body_alive{"body.alive", "1", Per::body}, body_source{"body.source", "1", Per::body};

}  // namespace tripoint::field

namespace tripoint {

/// Values of field::group; members of a free rigid body have 1 + its row. Members of one group of 0 and above
/// exert no force on each other.
inline constexpr double deformable_group = -2.0, liquid_group = -1.0, wall_group = 0.0;
/// Whether a particle of this group exerts a force on every other particle, also of its own group.
[[nodiscard]] constexpr bool acts_on_all(double group) noexcept { return group < wall_group; }

/// Values of field::driven: flowing in, held in place, and from there on the number of the event that grips.
inline constexpr int driven_in = -1, driven_still = 1, driven_grip = 2;

}  // namespace tripoint
