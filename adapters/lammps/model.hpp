// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine/engine.hpp"
#include "adapters/lammps/library.hpp"

namespace tripoint::lammps {

/// One way to put a scene into LAMMPS. The engine picks it by the scene and the settings.
class Model {
 public:
  virtual ~Model() = default;
  virtual void advance_to(double time) = 0;  ///< [s]
  [[nodiscard]] virtual Snapshot observe() const = 0;
  [[nodiscard]] virtual Readback readback() const = 0;
  virtual void account(Result&) const = 0;
};

/// Settings of a case for LAMMPS, checked.
struct Choice {
  std::string conduction;  ///< brownian | langevin | sph | rheo; empty = the library's default
  double walkers = 1e5;
  std::optional<double> cutoff;         ///< support radius of pair styles [spacings]; empty = the model's own
  bool pool = true;                     ///< walkers of a field of one coordinate are counted in layers
  std::optional<double> rigid_modulus;  ///< of the bonds that stand in for rigid matter that melts [Pa]
  std::optional<double> sound_speed;    ///< of RHEO's liquid [m/s]
  /// t_melt | t_solid: which of them RHEO takes for both; empty = it takes none that differ
  std::string freezing;
  std::string commands;  ///< LAMMPS commands after the set-up
};
[[nodiscard]] std::vector<std::string> preset_names();
[[nodiscard]] std::map<std::string, std::string> setting_help();
/// @throws InputError naming an unknown preset, key or word
[[nodiscard]] Choice choice_for(const Job&);

/// The step of the engine's settings, else the job's, if any. [s]
[[nodiscard]] std::optional<double> wanted_time_step(const Job&);

/// Equal steps, none above `limit`, over an interval. [s]
struct Steps {
  long count = 1;
  double size = 0.0;
};
[[nodiscard]] inline Steps steps_in(double interval, double limit) {
  const long n = std::max(1L, static_cast<long>(std::ceil(interval / limit * (1.0 - 1e-9))));
  return {n, interval / static_cast<double>(n)};
}

/// Runs LAMMPS over an interval; set-up is repeated only where the step changes by more than round-off.
class Clock {
 public:
  void run(Library&, const Steps&);
  /// The scene has changed: the next run begins with its set-up.
  void set_up_again() { size_ = 0.0; }
  [[nodiscard]] long total() const { return total_; }

 private:
  double size_ = 0.0;
  long total_ = 0;
};

}  // namespace tripoint::lammps
