// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <vector>

#include "files/job.hpp"
#include "files/trajectory.hpp"

namespace tripoint::lammps {

/// Rows of the solid bodies while bonds come and go. A piece (connected by bonds) keeps the row that most of
/// its particles had at the time before, held bodies first. A piece without such a row is born. A row that no
/// piece takes is dead for good.
class RheoBodies {
 public:
  RheoBodies(const Job&, const InitialState&);
  /// Rows of the particles at the next time. @param piece label of each particle's piece, -1 for a liquid one
  void follow(const std::vector<int>& piece);
  [[nodiscard]] const std::vector<int>& rows() const { return row_; }  ///< -1 for a liquid particle
  /// Every row that ever existed: mass, centre and velocity of its particles. Bodies that change have no
  /// orientation here.
  [[nodiscard]] std::vector<BodyState> states(const Snapshot&) const;

 private:
  std::vector<int> row_;
  std::vector<bool> held_;  ///< of the rows
};

}  // namespace tripoint::lammps
