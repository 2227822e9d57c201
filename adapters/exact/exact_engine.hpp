// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "adapters/engine/engine.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {

/// The exact solution of the job's reference, served by the same protocol as every engine. Its row in a
/// report shows the error of the comparison itself (reading, interpolating, rounding). It also gives pictures
/// and curves of the truth.
class ExactEngine : public Engine {
 public:
  [[nodiscard]] EngineInfo info() const override;
  /// The reference's own words when it does not fit the scene, or when it knows no states (an invariant).
  [[nodiscard]] std::string refusal(const Job&) const override;
  void load(const Job&, const InitialState&) override;
  void advance_to(double time) override { time_ = time; }
  [[nodiscard]] Snapshot observe() const override;
  [[nodiscard]] Readback readback() const override;

 private:
  void fill_observables(Snapshot&) const;
  Job job_;
  InitialState initial_;
  std::unique_ptr<Reference> reference_;
  double time_ = 0.0;
};

}  // namespace tripoint
