// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"
#include "scene/initial_state.hpp"

/// Trajectories as H5MD 1.1 (contracts: layout, units, checksums). The only room that knows HDF5.
namespace tripoint {

/// One solid body at one time; a dead or unborn body is all NaN.
struct BodyState {
  Vec3 position, velocity, angular_velocity;  ///< [m], [m/s], [rad/s] world frame
  /// Unit quaternion [1], from the pose at the start, or at birth, to now
  Quaternion orientation;
  double mass = 0.0;   ///< [kg]
  Vec3 force, torque;  ///< from all others [N], [N m]
};

/// Values that an engine shows at one time: SI, world frame. Each column of particles has one value a
/// particle, row = particle id, or is empty where the engine has no such values.
struct Snapshot {
  double time = 0.0;                           ///< [s]
  long step = 0;                               ///< steps that the engine has taken
  std::vector<Vec3> position, velocity;        ///< [m], [m/s]
  std::vector<double> temperature;             ///< [K]
  std::vector<double> temperature_error;       ///< one standard error of it, of random walkers [K]
  std::vector<double> density;                 ///< [kg/m3]
  std::vector<double> pressure;                ///< [Pa]
  std::vector<double> liquid_fraction;         ///< [1], 0 solid to 1 liquid
  std::vector<int> id, phase, body, material;  ///< id -1 = not alive (and NaN values)
  std::vector<double> mass;                    ///< [kg]
  std::vector<BodyState> bodies;               ///< one row for each solid body that ever existed so far
  double total_mass = 0.0;                     ///< [kg]
  Vec3 momentum, angular_momentum;             ///< [kg m/s]; [kg m2/s], about the origin
  std::map<std::string, double> energy;        ///< TERM of the ledger -> [J]
  std::map<std::string, double> counts;        ///< [1]: recoveries so far; objects that bonds hold together
  /// Name of a body -> heat given to it so far by what holds its temperature [J]
  std::map<std::string, double> heat_given;
  /// Name of a gauge of the job -> value that the engine itself reads there [SI]
  std::map<std::string, double> gauges;
  /// Whether the engine shows no particles at all: a solver of fields that answers by its gauges.
  [[nodiscard]] bool gauges_only() const {
    return position.empty() && temperature.empty() && !gauges.empty();
  }
};

/// The scene's domain, as far as it has one; a bound that is not finite is none.
struct Domain {
  Vec3 min{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};  ///< [m]
  Vec3 max{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};  ///< [m]
  std::array<bool, 3> periodic{};
  [[nodiscard]] bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
};

/// A whole trajectory in memory: frames in order of time. Frames may have unequal row counts only by inflow
/// (later ones longer).
struct Trajectory {
  std::vector<Snapshot> frames;
};

/// Appends frames to trajectory.h5; every frame is flushed before append() returns, and then announced as
/// written by `frames()`.
class TrajectoryWriter {
 public:
  /// @param domain what /particles/all/box says: its boundary, and its edges where a direction is periodic
  explicit TrajectoryWriter(const std::string& path, const Domain& domain = {});
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;
  /// @throws EngineError when the disk is full or the file cannot be written
  void append(const Snapshot&);
  [[nodiscard]] long frames() const;
  /// @throws EngineError when the library's remaining data cannot be written
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

/// Reads trajectory.h5. @throws InputError naming the file and the part that is missing, torn or of the wrong
/// shape, and where it has more than most_frames frames. Sizes are bounded before reading.
[[nodiscard]] Trajectory read_trajectory(const std::string& path, std::size_t most_frames = any_number);
/// Reads a small engine's trajectory.csv (contracts): rows of particles or, with the column `body`, of
/// bodies. Masses, phases and materials come from `initial`. @throws InputError with the line, and where it
/// has more than most_frames times
[[nodiscard]] Trajectory read_trajectory_csv(const std::string& path, const InitialState& initial,
                                             std::size_t bodies, std::size_t most_frames = any_number);
/// Reads gauges.csv (rows of time, number of the gauge, value) into the frames of their times, and makes
/// these where there are none.
/// @param names of the job's gauges, in their order
/// @throws InputError with the line, and where there would be more than most_frames frames
void read_gauges_csv(const std::string& path, const std::vector<std::string>& names, Trajectory&,
                     std::size_t most_frames = any_number);

/// The same bytes for the same trajectory, within one build of the program: one process reads in place of
/// another.
[[nodiscard]] std::string packed(const Trajectory&);
/// @throws InputError where the bytes are no whole trajectory: none of its sizes is taken on trust
[[nodiscard]] Trajectory unpacked(const std::string& bytes, std::size_t most_frames = any_number);

/// particles.h5: one frame, time 0, of the particles that the harness sampled.
void write_particles(const std::string& path, const InitialState&);
[[nodiscard]] InitialState read_particles(const std::string& path);

/// trajectory.xdmf beside trajectory.h5, for ParaView.
/// @param times of the frames [s]   @param last the last frame: its columns and row count are those of the
/// file
void write_xdmf(const std::string& folder, const std::vector<double>& times, const Snapshot& last);

/// FNV-1a over the bits of positions, velocities, temperatures and bodies, as 16 hex digits.
[[nodiscard]] std::string state_hash(const Snapshot&);
/// FNV-1a over the bits of all that was sampled.
[[nodiscard]] std::string state_hash(const InitialState&);
/// FNV-1a over the bits of all that these frames show, one after the other. Rows that do not exist count for
/// nothing, so frames read back have the hash that they had when written.
class FramesHash {
 public:
  void add(const Snapshot&);
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t hash_ = 1469598103934665603ULL;
};

}  // namespace tripoint
