// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "files/job.hpp"
#include "files/result.hpp"
#include "files/trajectory.hpp"
#include "sampling/shape_overlap.hpp"
#include "validation/metrics/frames.hpp"
#include "validation/metrics/near_pairs.hpp"

/// The checks of an audit, one a file. Each returns an empty text where the run is sound, else what is wrong,
/// where and when.
namespace tripoint {

/// Box that holds all places of a body; empty where it has none.
struct Box {
  Vec3 low, high;
  bool empty = true;
};

/// All that a check may look at.
struct Audited {
  const Job& job;
  const InitialState& initial;
  const Readback& held;
  const Trajectory& trajectory;
  const Frames& frames;  ///< of the trajectory, at the job's times

  /// Of each body in each frame, made when first asked for
  mutable std::vector<std::vector<Box>> boxes = {};
  /// Space that shapes share at the start, found when first asked for
  mutable std::optional<std::vector<SharedSpace>> overlaps = {};

  [[nodiscard]] bool is_single() const { return held.precision == "single"; }
  /// Time step of the engine, at most the interval: the larger of the job's and of what it read back [s].
  [[nodiscard]] double step(double interval) const;
};

/// Values outside their set: not finite, no unit quaternion, a mass or density that is not positive, a code
/// out of range.
[[nodiscard]] std::string values_outside_their_set(const Audited&, const Snapshot&);
/// Particles that are lost or have changed their mass.
[[nodiscard]] std::string lost_matter(const Audited&, const Snapshot&);
/// The first frame must be the job's start.
[[nodiscard]] std::string another_start(const Audited&);
/// A run that stands still though the scene moves, or does not warm though heat must flow.
[[nodiscard]] std::string frozen(const Audited&);
/// A body's row must be where its particles are, move as they do and turn as they do.
[[nodiscard]] std::string apart_from_its_particles(const Audited&, const Snapshot&);
/// A fixed body that does not stay, or one that is led by the job and is elsewhere.
[[nodiscard]] std::string moves_otherwise_than_given(const Audited&);
/// Places that change by another way than the velocities say.
[[nodiscard]] std::string moves_against_its_velocity(const Audited&);
/// Orientations that change by another turn than the angular velocities say.
[[nodiscard]] std::string turns_against_its_spin(const Audited&);
/// Places or turns that all frames show late, or all rates too large.
[[nodiscard]] std::string lags_behind_its_rate(const Audited&);
/// A body in contact that states a rate in all frames and does not move by it.
[[nodiscard]] std::string rests_at_a_rate(const Audited&);
/// Velocities and angular velocities of a free body that leave those of the frames before and after for one
/// frame.
[[nodiscard]] std::string leaves_for_one_frame(const Audited&);
/// A gauge that says something else than the particles of the same run.
[[nodiscard]] std::string gauges_against_particles(const Audited&);
/// Sums that the engine states (mass, momentum, angular momentum, kinetic energy) and the same of its
/// particles.
[[nodiscard]] std::string sums_against_particles(const Audited&);

/// A number for a message, to six digits.
template <class T>
[[nodiscard]] std::string figure(const T& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}
[[nodiscard]] inline std::string at_time(const Snapshot& s) {
  return " at t = " + std::to_string(s.time) + " s";
}
[[nodiscard]] inline std::string between(const Snapshot& a, const Snapshot& b) {
  return " from t = " + std::to_string(a.time) + " to " + std::to_string(b.time) + " s";
}
[[nodiscard]] inline bool dead(const Snapshot& s, std::size_t i) { return i < s.id.size() && s.id[i] == -1; }
[[nodiscard]] inline bool is_there(const BodyState& b) { return finite(b.position); }
/// Row in Job::bodies that a particle was sampled for, or nullptr.
[[nodiscard]] const JobBody* body_of(const Audited&, std::size_t particle);
/// Name of a row of /particles/bodies, for messages.
[[nodiscard]] std::string row_name(const Audited&, std::size_t row);

/// Whether each particle belongs to the body of the start in every frame: nothing unites, parts, melts or
/// freezes.
[[nodiscard]] bool keeps_bodies(const Job&);

}  // namespace tripoint
