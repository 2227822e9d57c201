// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene/scene.hpp"

namespace tripoint::fluid {

/// Why liquids of the scene can have no numerical bulk viscosity, whatever scene.bulk_viscosity says; "" where they can:
/// something is liquid and never freezes, which changes densities at once; density, pressure and state are corrected; and the
/// scene clamps, so that a free surface or a contact can be.
[[nodiscard]] std::string no_bulk_viscosity(const Scene&);

/// Gravity without its parts along periodic directions, which drive a flow there and press on nothing [m/s2].
[[nodiscard]] Vec3 pressing_gravity(const Scene&);
/// Why the topmost layer of a liquid can bear no part of its own weight, whatever scene.surface_weight says; "" where it can: as
/// for the numerical bulk viscosity, there is a weight, and no free body, which at a surface weighs what it likes.
[[nodiscard]] std::string no_surface_weight(const Scene&);

/// Why scene.contact_stiffness changes nothing; "" where it does: the state is corrected, nothing freezes, which would change the
/// stiffness of a particle at once, and a solid is free.
[[nodiscard]] std::string no_contact_stiffness(const Scene&);

/// Why scene.face_pressure changes nothing; "" where it does: density, pressure, state and elasticity are corrected, something
/// elastic moves, and no list of bonds changes.
[[nodiscard]] std::string no_face_pressure(const Scene&);

/// Why scene.interface_weight changes nothing; "" where it does: as for the numerical bulk viscosity, and liquids of two
/// densities have a weight.
[[nodiscard]] std::string no_interface_weight(const Scene&);

/// Why scene.core_reach changes nothing; "" where it does: the pressure is corrected.
[[nodiscard]] std::string no_core(const Scene&);

/// Why scene.mean_pressure and scene.sound_damping change nothing; "" where they do: density, pressure and state are corrected,
/// and particles move by the transport velocity.
[[nodiscard]] std::string no_transport(const Scene&);

/// Why scene.isotropic_shear changes nothing; "" where it does: something is viscous, and the viscosity is corrected and
/// `central`.
[[nodiscard]] std::string no_isotropic_shear(const Scene&);

}  // namespace tripoint::fluid
