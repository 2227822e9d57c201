// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint::lammps {

/// One LAMMPS instance behind plain data. A build with exceptions throws EngineError in LAMMPS's own words.
/// One without (Debian's) writes them to the log and ends the process, which supervise() turns into a result.
class Library {
 public:
  /// @param log file for LAMMPS's log, "none" for no log
  explicit Library(const std::string& log = "none");
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  /// One command or several lines. @throws EngineError
  void run(const std::string& commands);
  /// Atoms with ids 1..n. @param velocity may be empty
  void create_atoms(const std::vector<int>& type, const std::vector<Vec3>& position,
                    const std::vector<Vec3>& velocity);
  /// A vector column (x, v, f), row = id - 1.
  [[nodiscard]] std::vector<Vec3> vectors(const char* name) const;
  /// A scalar column (esph), row = id - 1.
  [[nodiscard]] std::vector<double> scalars(const char* name) const;
  /// A column of whole numbers (rheo_status), row = id - 1.
  [[nodiscard]] std::vector<int> integers(const char* name) const;
  /// A compute of one number a particle at the present step, row = id - 1.
  [[nodiscard]] std::vector<double> compute(const char* id) const;
  /// One number of a fix's global vector.
  [[nodiscard]] double fix_value(const std::string& id, int index) const;
  void set_scalars(const char* name, const std::vector<double>& by_id);
  /// Positions in LAMMPS's own order, without a copy by id: for walkers, which are only counted.
  [[nodiscard]] std::vector<Vec3> unordered_positions() const;
  [[nodiscard]] std::vector<int> unordered_types() const;  ///< in the same order
  /// One number of a compute's global vector, brought up to date now.
  [[nodiscard]] double compute_value(const std::string& id, int index) const;

  [[nodiscard]] bool has_style(const char* category, const char* name) const;
  [[nodiscard]] std::string version() const;  ///< yyyymmdd
  [[nodiscard]] double mass_of_type(int type) const;
  [[nodiscard]] double time_step() const;
  [[nodiscard]] static std::string path();  ///< of the library that is loaded

 private:
  [[nodiscard]] int local_count() const;
  [[nodiscard]] const int* ids() const;
  void check() const;
  template <class T>
  [[nodiscard]] std::vector<T> by_id(const void* column, const char* name) const;
  void* handle_ = nullptr;
};

/// Ends MPI, once; instances that are still open are then left as they are.
void finish();

}  // namespace tripoint::lammps
