// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "scene/scene.hpp"

/// What a scene has where its file says nothing, or a run wants otherwise.

namespace tripoint {

/// What one run changes of its scene.
struct RunChoice {
  std::optional<Mode> mode;
  std::optional<double> spacing, time_step, support_ratio, jitter;
  std::optional<std::uint64_t> seed;
};

/// The scene of one run: modes resolved for every term, support ratio by its default rule where the file gives none.
[[nodiscard]] Scene scene_for(Scene, const RunChoice&);

/// Stiffness k [m2/s2] of a scene whose materials give none, and its rule in words.
struct DefaultStiffness {
  double value = 0.0;
  std::string rule;
};
/// What flows takes k = (10 v)^2: v the greatest of initial and prescribed speeds and sqrt(2 |g| depth of the liquids), so that
/// the speed of sound is ten times what is to be expected. Solids of which two can meet (meeting.hpp) take it from their speed of
/// approach and the height of the scene, and from the moduli of elastic bodies. Empty where a material gives one, nothing flows
/// or can meet, or no speed is known.
[[nodiscard]] std::optional<DefaultStiffness> default_stiffness(const Scene&);

/// How near a freezing particle joins where the scene does not say [spacings]: as the paper has it, whatever its bonds reach
/// (h = 2.12 dx); corrected, nearest and diagonal neighbours of the lattice, so that no bond bridges a molten layer.
[[nodiscard]] double default_merge_distance(const Scene&);

}  // namespace tripoint
