// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace tripoint::predict {

/// Speeds of a machine between ranks: from the probe of the engine tripoint-mpi, or from a file.
struct Machine {
  std::string name = "this machine";
  int cores_a_node = 1;
  double latency = 0.0;     ///< of one message between two ranks [s]
  double bandwidth = 0.0;   ///< of one rank to another, while it takes as much [bytes/s]
  double allreduce = 0.0;   ///< of one number, for each doubling of the ranks [s]
  double pack_rate = 0.0;   ///< at which scattered numbers are put together [bytes/s]
  double core_speed = 1.0;  ///< of its cores over those here
  /// Of a core where all have work, over one alone; none: as measured here
  std::optional<double> speed_at_once;
  /// Of a step's work that ranks wait for the slowest, beyond the prediction of the shares
  double waiting = 0.05;
  std::string source;  ///< "probe of MPICH 5.0.2 between two ranks", or the file
};

/// A TOML file: name, cores_a_node, latency (s), bandwidth (bytes/s), and, where they are not as here said:
/// allreduce (= latency), pack_rate (4e9), core_speed (1), speed_at_once (as measured here), waiting (0.05).
/// @throws InputError with place, also for a key that is not known
[[nodiscard]] Machine read_machine(const std::string& file);

/// Reads the output of `engine-tripoint-mpi --probe`. @throws EngineError where it is no such answer
[[nodiscard]] Machine machine_of_probe(const std::string& json, int cores);

}  // namespace tripoint::predict
