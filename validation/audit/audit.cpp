// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "validation/audit/audit.hpp"
#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

std::string unsound_frames(const Audited& run) {
  for (const auto* s : run.frames) {
    if (auto why = values_outside_their_set(run, *s); !why.empty()) return why;
    if (auto why = lost_matter(run, *s); !why.empty()) return why;
  }
  return {};
}

std::string apart(const Audited& run) {
  for (const auto* s : run.frames)
    if (auto why = apart_from_its_particles(run, *s); !why.empty()) return why;
  return {};
}

}  // namespace

double Audited::step(double interval) const {
  const double given = std::max(job.resolution.time_step.value_or(0.0), held.time_step);
  return given > 0.0 ? std::min(given, interval) : 0.0;
}

const JobBody* body_of(const Audited& run, std::size_t particle) {
  const auto& source = run.initial.source;
  const auto row =
      particle < source.size() ? static_cast<std::size_t>(source[particle]) : run.job.bodies.size();
  return row < run.job.bodies.size() ? &run.job.bodies[row] : nullptr;
}

std::string row_name(const Audited& run, std::size_t row) {
  for (const auto& b : run.job.bodies)
    if (b.index == static_cast<int>(row)) return "`" + b.name + "`";
  return "body row " + std::to_string(row);
}

bool keeps_bodies(const Job& job) {
  return job.scene.events.empty() && std::none_of(job.scene.materials.begin(), job.scene.materials.end(),
                                                  [](const Material& m) { return m.t_melt.has_value(); });
}

std::string audit(const Job& job, const InitialState& initial, const Trajectory& trajectory,
                  const Readback& held) {
  const auto frames = frames_of_job(job, initial, trajectory);
  if (!frames.problem.empty()) return frames.problem;
  const Audited run{job, initial, held, trajectory, frames.list};
  if (auto why = unsound_frames(run); !why.empty()) return why;
  for (const auto& check :
       {another_start, frozen, apart, moves_otherwise_than_given, moves_against_its_velocity,
        turns_against_its_spin, rests_at_a_rate, leaves_for_one_frame, lags_behind_its_rate,
        gauges_against_particles, sums_against_particles})
    if (auto why = check(run); !why.empty()) return why;
  return {};
}

}  // namespace tripoint
