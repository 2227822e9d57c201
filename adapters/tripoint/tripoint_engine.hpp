// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "adapters/engine/engine.hpp"
#include "files/point_cloud.hpp"
#include "step/simulation.hpp"

namespace tripoint {

/// The unified particle solver as an engine.
class TripointEngine : public Engine, public Restartable {
 public:
  [[nodiscard]] EngineInfo info() const override;
  [[nodiscard]] std::string refusal(const Job&) const override;
  [[nodiscard]] std::string trial(const Job&) const override;
  void load(const Job&, const InitialState&) override;
  void advance_to(double time) override;
  [[nodiscard]] Snapshot observe() const override;
  [[nodiscard]] Readback readback() const override;
  [[nodiscard]] std::string show_failure(const Diverged&, const std::string& folder) const override;
  void account(Result&) const override;
  void resume(const Job&, const InitialState&, const Checkpoint&) override;
  bool advance_to(double time, const std::function<bool(double, long)>& go_on) override;
  void save(Checkpoint&) const override;

 private:
  /// Not const where the engine is: observe() and save() ask it, and asking computes
  std::unique_ptr<Simulation> simulation_;
};

/// The culprit of a failure with all particles within two support radii of it (of no single particle:
/// everything). Every column of the solver is an array. A particle whose place is not finite has the place
/// where it was listed last.
[[nodiscard]] PointCloud culprits_of(const State&, const Diverged&);

/// Snapshot of the state: rows by id, places not put back into a periodic box.
[[nodiscard]] Snapshot snapshot_of(Simulation&);

}  // namespace tripoint
