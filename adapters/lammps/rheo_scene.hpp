// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include "adapters/lammps/particle_model.hpp"
#include "files/job.hpp"

/// A scene's matter in RHEO's terms.
namespace tripoint::lammps {

[[nodiscard]] bool anything_free(const Job&);

/// Spacing, mass of a free particle, and the time of sound over a spacing (of the bonds, where nothing
/// flows).
[[nodiscard]] Units rheo_units(const Job&);

/// Matter of one body in RHEO's units; energy is temperature.
struct RheoMatter {
  double viscosity = 0.0, conductivity = 0.0;
  bool melts = false;
  double melting = 0.0, latent = 0.0;  ///< [K]; latent heat over heat capacity
};
/// A body that is held beside free ones is given no melting point: RHEO would shift it. refuse_molten_walls()
/// watches over that.
[[nodiscard]] RheoMatter rheo_matter(const Job&, std::size_t body);
/// Young's modulus of the bonds, of the stiffest solid that is free, in RHEO's units.
[[nodiscard]] double bond_modulus(const Job&);
/// Energy of a particle of a body at a temperature, liquid above its melting point [K].
[[nodiscard]] double rheo_energy(const RheoMatter&, double temperature);
/// Whether an event takes a particle of a body of the case that is at a place.
[[nodiscard]] bool takes(const Event&, const std::string& body, const Vec3& place);

}  // namespace tripoint::lammps
