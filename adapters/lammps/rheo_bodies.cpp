// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/rheo_bodies.hpp"
#include "core/not_a_number.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace tripoint::lammps {

RheoBodies::RheoBodies(const Job& job, const InitialState& state) : row_(state.body) {
  for (const JobBody& b : job.bodies)
    if (b.index >= 0) held_.push_back(b.motion != Motion::free);
}

void RheoBodies::follow(const std::vector<int>& piece) {
  std::map<int, std::map<int, int>> shares;  // piece -> row -> particles
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (piece[i] < 0) continue;
    auto& share = shares[piece[i]];
    if (row_[i] >= 0) ++share[row_[i]];
  }
  std::vector<std::tuple<bool, int, int, int>> claims;  // held, particles, -row, piece: the strongest last
  for (const auto& [label, share] : shares)
    for (const auto& [row, count] : share)
      claims.emplace_back(held_[static_cast<std::size_t>(row)], count, -row, label);
  std::sort(claims.begin(), claims.end());
  std::map<int, int> row_of_piece;
  std::vector<bool> taken(held_.size(), false);
  for (auto claim = claims.rbegin(); claim != claims.rend(); ++claim) {
    const int row = -std::get<2>(*claim), label = std::get<3>(*claim);
    if (taken[static_cast<std::size_t>(row)] || row_of_piece.count(label)) continue;
    taken[static_cast<std::size_t>(row)] = true;
    row_of_piece[label] = row;
  }
  for (const auto& [label, share] : shares)
    if (!row_of_piece.count(label)) {
      row_of_piece[label] = static_cast<int>(held_.size());
      held_.push_back(false);
    }
  for (std::size_t i = 0; i < piece.size(); ++i) row_[i] = piece[i] < 0 ? -1 : row_of_piece.at(piece[i]);
}

std::vector<BodyState> RheoBodies::states(const Snapshot& s) const {
  const Vec3 nowhere{not_a_number, not_a_number, not_a_number};
  std::vector<BodyState> bodies(held_.size());
  for (std::size_t i = 0; i < row_.size(); ++i) {
    if (row_[i] < 0) continue;
    BodyState& b = bodies[static_cast<std::size_t>(row_[i])];
    b.mass += s.mass[i];
    b.position += s.mass[i] * s.position[i];
    b.velocity += s.mass[i] * s.velocity[i];
  }
  for (BodyState& b : bodies) {
    const bool lives = b.mass > 0.0;
    b.position = lives ? b.position / b.mass : nowhere;
    b.velocity = lives ? b.velocity / b.mass : nowhere;
    b.angular_velocity = nowhere;
    b.orientation = {not_a_number, not_a_number, not_a_number, not_a_number};
    if (!lives) b.mass = not_a_number;
  }
  return bodies;
}

}  // namespace tripoint::lammps
