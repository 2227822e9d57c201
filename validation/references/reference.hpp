// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/trajectory.hpp"
#include "job/job.hpp"

namespace tripoint {

/// What an experiment saw of a quantity, in SI.
struct MeasuredCurve {
  std::vector<double> time, value, uncertainty;  ///< times rise; standard uncertainty of each value
};

/// Truth, as far as it is known: what an exact (or exactly discrete) solution says of this job's particles and bodies.
class Reference {
 public:
  virtual ~Reference() = default;
  /// The solution at a time: positions and velocities of particles and bodies, temperatures; columns that it does not know are
  /// empty.
  [[nodiscard]] virtual Snapshot at(double time) const = 0;
  /// The truth that this frame is compared with. A solution that is a field of place (a liquid's) takes the frame's own places,
  /// so that a particle is judged where it is; others know each particle's place, and this is at(now.time).
  [[nodiscard]] virtual Snapshot beside(const Snapshot& now) const { return at(now.time); }
  /// A number it knows by name: decay_rate [1/s], event_time [s], energy_ratio ...; empty when it does not.
  [[nodiscard]] virtual std::optional<double> number(std::string_view quantity) const {
    (void)quantity;
    return {};
  }
  /// Measured values by the name of their column; nullptr when it has none.
  [[nodiscard]] virtual const MeasuredCurve* measured(std::string_view column) const {
    (void)column;
    return nullptr;
  }
  /// Standard uncertainty of what it says of a quantity at a time, in SI; empty where its data state none.
  [[nodiscard]] virtual std::optional<double> uncertainty(std::string_view quantity, double time) const {
    (void)quantity, (void)time;
    return {};
  }
  /// A number that changes in time: stretch, front_position ...; one that does not is the same at all times.
  [[nodiscard]] virtual std::optional<double> number_at(std::string_view quantity, double time) const {
    (void)time;
    return number(quantity);
  }
};

/// One argument of a reference function, for the schema and the reference page.
struct ReferenceArgument {
  std::string name, unit, meaning;  ///< the meaning says the default taken from the scene
};
struct ReferenceFunction {
  std::string name, kind, source, meaning;
  std::vector<ReferenceArgument> args;
};
[[nodiscard]] const std::vector<ReferenceFunction>& reference_functions();

/// @throws InputError for an unknown function (with the nearest known one) or a scene that it does not fit
[[nodiscard]] std::unique_ptr<Reference> make_reference(const ReferenceChoice&, const Job&, const InitialState&);

}  // namespace tripoint
