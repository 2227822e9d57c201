// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/matrix3.hpp"
#include "state/state.hpp"

namespace tripoint::carried_liquid {

/// Liquid meets an elastic solid at its face, not at the middles of its outer particles (model 8.12). In the
/// rate of density a solid particle s has the velocity v_s + e_s d/2 halfway to a liquid, with e_s its own
/// rate of strain and d the way to the liquid. The adjoint of e_s is a stress on the bonds of s. Only
/// particles that are bonded in all directions have one.
class ElasticFaces {
 public:
  /// Of each row, above 0 where it is liquid that a solid touches, or a solid that liquid touches.
  [[nodiscard]] static std::vector<double> where_they_meet(const State&);
  /// Rates of strain of the elastic particles amid the drift. @param half_step half of the drift [s]
  void set_rates(State&, double half_step) const;
  /// Loads of the pressure on bonds, by the sums of FaceLoad.
  void set_loads(State&);
  /// Adds what the loads do to the forces of these rows.
  void add_forces(State&, const Rows&) const;

 private:
  std::vector<std::uint32_t> bonded_;  ///< rows that have a load, or a bond to one that has
  std::vector<Matrix3> load_;          ///< by id, dU/dF A [J]
};

}  // namespace tripoint::carried_liquid
