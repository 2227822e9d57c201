// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "validation/metrics/frame_error.hpp"
#include "validation/metrics/norms.hpp"
#include "validation/references/rigid_body.hpp"

/// Common parts of the quantities of solids and phases: whose particles they take, and their references.
namespace tripoint {

/// The reference's number of this name at this time, else the `value` that the case states.
[[nodiscard]] std::optional<double> truth_of(const MetricInput&, const char* quantity, double time);

/// The same where it does not change in time.
[[nodiscard]] std::optional<double> number_or_value(const MetricInput&, const char* quantity);

/// measured - truth, or why there is no truth.
[[nodiscard]] FrameError against_truth(const FramePair&, const char* quantity, double measured);

[[nodiscard]] bool is_alive(const Snapshot&, std::size_t particle);
/// Whether a particle was sampled for a body that is fixed or driven: a wall, a tank, a plate.
[[nodiscard]] bool is_driven(const MetricInput&, std::size_t particle);
/// Whether a quantity of motion takes a particle: of the metric's body, or of no wall where it names none.
[[nodiscard]] bool takes_free(const MetricInput&, std::size_t particle);
/// Whether a quantity of a liquid takes a particle: liquid in this frame, and of the metric's body; of no
/// wall where it names none.
[[nodiscard]] bool takes_liquid(const MetricInput&, const Snapshot&, std::size_t particle);
/// Whether a particle is of the phase that the reference names (3 = any solid); all are where it names none.
[[nodiscard]] bool of_stated_phase(const MetricInput&, const Snapshot&, std::size_t particle);
/// Mass of a particle [kg]: of the frame, else as sampled.
[[nodiscard]] double particle_mass(const MetricInput&, const Snapshot&, std::size_t particle);

/// c_p T + L f, above 0 K [J/kg]. Where the solid has its own heat capacity: (1 - f) c_s T + f (c_s t_melt +
/// L + c_l (T - t_melt)).
[[nodiscard]] long double heat_per_mass(const Material&, const Snapshot&, std::size_t particle);

/// Particles sampled for a body of the job (row in Job::bodies), in the order of their ids.
[[nodiscard]] std::vector<std::size_t> sampled(const MetricInput&, std::size_t body);
/// Row in Job::bodies of the metric's body. @throws InputError when the metric names none
[[nodiscard]] std::size_t job_body(const MetricInput&);
/// Row in Job::bodies of the reference's `other` body. @throws InputError when it names none
[[nodiscard]] std::size_t other_body(const MetricInput&);

/// Centre, momentum and spin of the given particles that are alive, places unwrapped by the nearest image
/// from the first of them.
[[nodiscard]] RigidBody motion_of(const MetricInput&, const Snapshot&,
                                  const std::vector<std::size_t>& members);

[[nodiscard]] inline MetricValue not_formed(const std::string& why) {
  MetricValue v;
  v.value = not_a_number;
  v.note = why;
  return v;
}

}  // namespace tripoint
