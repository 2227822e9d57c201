// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "state/state.hpp"

/// Liquid that flows in: columns of particles one spacing apart, which travel through the inflow's shape at
/// its velocity and are free beyond it. So entering particles never overlap.
namespace tripoint::prescribed {

/// One [[inflow]] on the lattice.
class Entrance {
 public:
  /// @throws InputError where its velocity is not along an axis, or its shape holds no particle
  Entrance(const Scene&, std::size_t inflow);

  /// Particles of a column that have begun to enter until then.
  [[nodiscard]] long layers_until(double time, std::size_t column) const;
  /// The same of all columns.
  [[nodiscard]] long particles_until(double time) const;
  /// When a particle of a column would be at its first place at full velocity from the start on [s].
  [[nodiscard]] double begin_of(long layer, std::size_t column) const {
    return start_ + static_cast<double>(layer) * spacing_ / speed_[column];
  }
  /// Time that has passed at full velocity [s].
  [[nodiscard]] double clock(double time) const;
  /// The same from a time to the next, dt later [s].
  [[nodiscard]] double way(double time, double next, double dt) const {
    return ramp_ == 0.0 ? dt : clock(next) - clock(time);
  }
  /// Velocity then, over the full one [1].
  [[nodiscard]] double opening(double time) const;
  /// Whether a particle of a column is still on its way through the shape.
  [[nodiscard]] bool inside(long layer, std::size_t column, double time) const {
    return (clock(time) - begin_of(layer, column)) * speed_[column] < depth_;
  }
  /// The same of a place [m], of whatever layer; false also where rounding could tell otherwise.
  [[nodiscard]] bool surely_inside(const Vec3& place) const {
    return dot(place - section_.front(), velocity_.front()) <
           (depth_ - 1e-6 * spacing_) * norm(velocity_.front());
  }
  /// First places of the columns [m]
  [[nodiscard]] const std::vector<Vec3>& section() const { return section_; }
  /// Full velocity of a column [m/s]
  [[nodiscard]] const Vec3& velocity(std::size_t column) const { return velocity_[column]; }
  /// The column of a place on its way.
  [[nodiscard]] std::size_t column_of(const Vec3& place) const;

 private:
  void set_speeds(const Inflow&, double depth);
  void index_columns();
  std::vector<Vec3> section_, velocity_;
  std::vector<double> speed_;
  double start_, stop_, ramp_, spacing_, depth_ = 0.0;
  std::array<std::size_t, 2> across_{};    ///< directions
  std::array<long, 2> first_{}, count_{};  ///< of the table of columns
  std::vector<std::size_t> column_;        ///< by place across
};

/// Time until which layers were let in [s]; none were, where it is below 0.
inline constexpr StepNumber let_in_until{"let_in_until", -1.0};

/// Particles of every inflow that entered until now, appended in order of inflow, layer and place: they
/// become the next ids. State::change.born lists them; the energy that they bring is accumulated as inflow.
void let_in(State&, const std::vector<Entrance>&);
/// Row in Scene::inflows of a particle that flowed in; -1 for one that was there from the start.
[[nodiscard]] int inflow_of(const State&, std::size_t row);

}  // namespace tripoint::prescribed
