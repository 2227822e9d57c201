// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "state/state.hpp"

/// Liquid that flows in: layers of one spacing, which travel through the inflow's shape at its speed and are
/// free beyond it. So entering particles never overlap.
namespace tripoint::prescribed {

/// One [[inflow]] on the lattice.
class Entrance {
 public:
  /// @throws InputError where its velocity is not along an axis, or its shape holds no particle
  Entrance(const Scene&, std::size_t inflow);

  /// Layers that have begun to enter until then.
  [[nodiscard]] long layers_until(double time) const;
  /// When a layer was at its first place [s].
  [[nodiscard]] double begin_of(long layer) const {
    return start_ + static_cast<double>(layer) * spacing_ / speed_;
  }
  /// Whether a particle of a layer is still on its way through the shape.
  [[nodiscard]] bool inside(long layer, double time) const {
    return (time - begin_of(layer)) * speed_ < depth_;
  }
  /// The same of a place [m], of whatever layer; false also where rounding could tell otherwise.
  [[nodiscard]] bool surely_inside(const Vec3& place) const {
    return dot(place - section_.front(), velocity_) < (depth_ - 1e-6 * spacing_) * norm(velocity_);
  }
  /// First places of a layer's particles [m]
  [[nodiscard]] const std::vector<Vec3>& section() const { return section_; }
  [[nodiscard]] const Vec3& velocity() const { return velocity_; }

 private:
  std::vector<Vec3> section_;
  Vec3 velocity_;
  double start_, stop_, spacing_, speed_ = 0.0, depth_ = 0.0;
};

/// Particles of every inflow that entered until now, appended in order of inflow, layer and place: they
/// become the next ids. State::change.born lists them; the energy that they bring is accumulated as inflow.
void let_in(State&, const std::vector<Entrance>&);
/// Row in Scene::inflows of a particle that flowed in; -1 for one that was there from the start.
[[nodiscard]] int inflow_of(const State&, std::size_t row);

}  // namespace tripoint::prescribed
