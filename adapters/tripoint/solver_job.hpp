// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <variant>

#include "core/errors.hpp"
#include "files/job.hpp"
#include "files/result.hpp"
#include "step/simulation.hpp"

/// A job as the solver takes it, for every engine that is the solver.
namespace tripoint {

/// Begins the presets that turn bodies about one axis after the other; followed by the axes, outer to inner:
/// no_squish-012.
inline constexpr std::string_view no_squish = "no_squish-";

/// A setting of the job, or the other value where there is none. @throws InputError where it is of another
/// kind
template <class T>
T setting(const Job& job, const std::string& name, T otherwise) {
  const auto place = job.settings.find(name);
  if (place == job.settings.end()) return otherwise;
  const T* value = std::get_if<T>(&place->second);
  if (!value) throw InputError("the setting " + name + " of the engine tripoint has the wrong kind of value");
  return *value;
}

/// The scene with the time step of the job's resolution.
[[nodiscard]] Scene scene_of(const Job&);
/// Options from the job's settings and preset. @throws InputError for a setting of the wrong kind, and for a
/// preset that there is not
[[nodiscard]] SimulationOptions options_of(const Job&);
/// Values that the solver itself holds of the scene's bodies.
[[nodiscard]] Readback readback_of(const State&, const TimeStepBound&);
/// How often a guard sent the run back, and why the last time; nothing where none did.
void report_recoveries(const Recovery&, Result&);
/// How many particles have left, and what they took; nothing where none can.
void report_left(const State&, Result&);

}  // namespace tripoint
