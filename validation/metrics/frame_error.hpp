// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/not_a_number.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "validation/case/choices.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {

/// Input of a metric.
struct MetricInput {
  const MetricChoice& choice;
  const Job& job;
  const InitialState& initial;
  const Reference& reference;
};

/// One moment of a run beside its truth. For the norm `drift` the truth is the run's own first frame.
struct FramePair {
  const MetricInput& in;
  const Snapshot& now;
  const Snapshot& truth;
  const Snapshot& first;  ///< the run's frame at the first time of the job
};

/// Differences of one frame, sample by sample, with their weights; `problem` says why there are none.
struct FrameError {
  std::vector<double> error;   ///< SI; signed for a single number, a length for vectors
  std::vector<double> weight;  ///< volume m/rho0 for particles, 1 for bodies and single numbers
  std::vector<double> sigma;   ///< standard error of each sample; empty = none
  std::vector<long> row;       ///< particle id or body row, -1 for a single number
  std::string problem;
  void add(double e, double w, long r) {
    error.push_back(e);
    weight.push_back(w);
    row.push_back(r);
  }
};

[[nodiscard]] inline FrameError problem(const std::string& why) {
  FrameError e;
  e.problem = why;
  return e;
}
[[nodiscard]] inline FrameError single(double error) {
  FrameError e;
  e.add(error, 1.0, -1);
  return e;
}

/// No value of a metric, and why.
[[nodiscard]] inline MetricValue unformed(const std::string& why) {
  MetricValue v;
  v.value = not_a_number;
  v.note = why;
  return v;
}

/// A quantity that can be compared frame by frame.
struct Quantity {
  MetricWord word;
  std::function<FrameError(const FramePair&)> error;
};
[[nodiscard]] const std::vector<Quantity>& particle_quantities();
[[nodiscard]] const std::vector<Quantity>& body_quantities();
[[nodiscard]] const std::vector<Quantity>& conserved_quantities();
[[nodiscard]] const std::vector<Quantity>& profile_quantities();
[[nodiscard]] const std::vector<Quantity>& liquid_quantities();
[[nodiscard]] const std::vector<Quantity>& solid_quantities();
[[nodiscard]] const std::vector<Quantity>& contact_quantities();
[[nodiscard]] const std::vector<Quantity>& joint_quantities();
[[nodiscard]] const std::vector<Quantity>& phase_quantities();
[[nodiscard]] const std::vector<Quantity>& probe_quantities();

/// A quantity that needs the whole run: decay_rate, event_time, event_count. The value is signed, run minus
/// truth, in SI.
struct RunQuantity {
  MetricWord word;
  std::function<MetricValue(const MetricInput&, const std::vector<const Snapshot*>& frames)> value;
};
[[nodiscard]] const std::vector<RunQuantity>& run_quantities();
[[nodiscard]] const std::vector<RunQuantity>& motion_quantities();
[[nodiscard]] const std::vector<RunQuantity>& front_quantities();
[[nodiscard]] const std::vector<RunQuantity>& solid_run_quantities();
[[nodiscard]] const std::vector<RunQuantity>& phase_run_quantities();
[[nodiscard]] const std::vector<RunQuantity>& heat_run_quantities();

/// r - r0 by the nearest image in periodic directions [m].
[[nodiscard]] Vec3 displacement(const Scene&, const Vec3& r, const Vec3& r0);
/// Whether an image of a place in periodic directions lies in the box, its faces included.
[[nodiscard]] bool in_box(const Scene&, const Vec3& r, const Vec3& low, const Vec3& high);
/// Rest volume m/rho0 of a particle [m3]; its mass where the scene has no materials.
[[nodiscard]] double rest_volume(const MetricInput&, std::size_t particle);
/// Whether the metric takes a particle: all, or those of its body as sampled.
[[nodiscard]] bool takes(const MetricInput&, std::size_t particle);
/// Row of the metric's body in /particles/bodies, or -1 when it names none. @throws InputError for a name
/// that the job does not have
[[nodiscard]] long body_row(const MetricInput&);

}  // namespace tripoint
