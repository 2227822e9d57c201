// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/library.hpp"

#include <lammps/library.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "adapters/engine/loaded_library.hpp"
#include "core/errors.hpp"

namespace tripoint::lammps {

namespace {
bool opened = false;
}

void finish() {
  if (opened) lammps_mpi_finalize();
  opened = false;
}

Library::Library(const std::string& log) {
  // Else OpenMPI starts a daemon, orted, that outlives the run
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  // LAMMPS then runs one thread; the OpenMP library has read the variable before
  ::unsetenv("OMP_NUM_THREADS");
  std::vector<std::string> words{"lammps", "-log", log, "-screen", "none", "-nocite"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  handle_ = lammps_open_no_mpi(static_cast<int>(arguments.size()), arguments.data(), nullptr);
  opened = true;
  if (!handle_) throw EngineError("LAMMPS could not be opened");
}

Library::~Library() {
  if (opened) lammps_close(handle_);
}

void Library::check() const {
  if (!lammps_config_has_exceptions() || !lammps_has_error(handle_)) return;
  std::array<char, 1024> text{};
  lammps_get_last_error_message(handle_, text.data(), static_cast<int>(text.size()));
  throw EngineError(text.data());
}

void Library::run(const std::string& commands) {
  for (std::size_t begin = 0; begin < commands.size();) {
    const std::size_t end = std::min(commands.find('\n', begin), commands.size());
    const std::string line = commands.substr(begin, end - begin);
    if (!line.empty()) lammps_command(handle_, line.c_str());
    check();
    begin = end + 1;
  }
}

void Library::create_atoms(const std::vector<int>& type, const std::vector<Vec3>& position,
                           const std::vector<Vec3>& velocity) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const int n = static_cast<int>(type.size());
  std::vector<int> id(type.size());
  for (int i = 0; i < n; ++i) id[static_cast<std::size_t>(i)] = i + 1;
  const int made = lammps_create_atoms(handle_, n, id.data(), type.data(), &position.front().x,
                                       velocity.empty() ? nullptr : &velocity.front().x, nullptr, 0);
  check();
  if (made != n)
    throw EngineError("LAMMPS took " + std::to_string(made) + " of " + std::to_string(n) +
                      " particles into its box");
}

int Library::local_count() const { return lammps_extract_setting(handle_, "nlocal"); }
const int* Library::ids() const { return static_cast<const int*>(lammps_extract_atom(handle_, "id")); }

std::vector<Vec3> Library::unordered_positions() const {
  const auto* const* x = static_cast<const double* const*>(lammps_extract_atom(handle_, "x"));
  std::vector<Vec3> all;
  all.reserve(static_cast<std::size_t>(local_count()));
  for (int i = 0; i < local_count(); ++i) all.push_back({x[i][0], x[i][1], x[i][2]});
  return all;
}

std::vector<int> Library::unordered_types() const {
  const auto* type = static_cast<const int*>(lammps_extract_atom(handle_, "type"));
  return {type, type + local_count()};
}

double Library::compute_value(const std::string& id, int index) const {
  const auto* value = static_cast<const double*>(
      lammps_extract_compute(handle_, id.c_str(), LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR));
  check();
  if (!value) throw EngineError("LAMMPS has no value of compute " + id);
  return value[index];
}

std::vector<Vec3> Library::vectors(const char* name) const {
  const auto* const* x = static_cast<const double* const*>(lammps_extract_atom(handle_, name));
  std::vector<Vec3> by_id(static_cast<std::size_t>(local_count()));
  for (int i = 0; i < local_count(); ++i)
    by_id.at(static_cast<std::size_t>(ids()[i] - 1)) = {x[i][0], x[i][1], x[i][2]};
  return by_id;
}

template <class T>
std::vector<T> Library::by_id(const void* column, const char* name) const {
  if (!column) throw EngineError(std::string("LAMMPS has no column ") + name);
  const auto* x = static_cast<const T*>(column);
  std::vector<T> rows(static_cast<std::size_t>(local_count()));
  for (int i = 0; i < local_count(); ++i) rows.at(static_cast<std::size_t>(ids()[i] - 1)) = x[i];
  return rows;
}

std::vector<double> Library::scalars(const char* name) const {
  return by_id<double>(lammps_extract_atom(handle_, name), name);
}
std::vector<int> Library::integers(const char* name) const {
  return by_id<int>(lammps_extract_atom(handle_, name), name);
}

std::vector<double> Library::compute(const char* id) const {
  const void* column = lammps_extract_compute(handle_, id, LMP_STYLE_ATOM, LMP_TYPE_VECTOR);
  check();
  return by_id<double>(column, id);
}

double Library::fix_value(const std::string& id, int index) const {
  auto* value = static_cast<double*>(
      lammps_extract_fix(handle_, id.c_str(), LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, index, 0));
  check();
  if (!value) throw EngineError("LAMMPS has no value of fix " + id);
  const double copy = *value;
  lammps_free(value);
  return copy;
}

void Library::set_scalars(const char* name, const std::vector<double>& by_id) {
  auto* x = static_cast<double*>(lammps_extract_atom(handle_, name));
  if (!x) throw EngineError(std::string("LAMMPS has no column ") + name);
  for (int i = 0; i < local_count(); ++i) x[i] = by_id.at(static_cast<std::size_t>(ids()[i] - 1));
}

bool Library::has_style(const char* category, const char* name) const {
  return lammps_has_style(handle_, category, name) != 0;
}
std::string Library::version() const { return std::to_string(lammps_version(handle_)); }
double Library::mass_of_type(int type) const {
  return static_cast<const double*>(lammps_extract_atom(handle_, "mass"))[type];
}
double Library::time_step() const {
  return *static_cast<const double*>(lammps_extract_global(handle_, "dt"));
}
std::string Library::path() { return loaded_library("liblammps"); }

}  // namespace tripoint::lammps
