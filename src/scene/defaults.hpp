// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "scene/term.hpp"

/// Values that a scene has where its file says nothing, or a run wants otherwise.

namespace tripoint {

struct Scene;

/// Changes of one run to its scene.
struct RunChoice {
  std::optional<Mode> mode;
  std::optional<double> spacing, time_step, support_ratio, jitter;
  std::optional<std::uint64_t> seed;
};

/// The scene of one run: modes resolved for every term, support ratio by its default rule where the file
/// gives none.
[[nodiscard]] Scene scene_for(Scene, const RunChoice&);

/// Stiffness k [m2/s2] of a scene whose materials give none, and its rule in words.
struct DefaultStiffness {
  double value = 0.0;
  std::string rule;
};
/// Liquids take k = (10 v)^2, v the greatest of initial and prescribed speeds and sqrt(2 |g| depth of the
/// liquids); at rest, a spacing in the time of the run. Solids of which two can meet (meeting.hpp) take it
/// from their speed of approach, the height that they can fall, and the moduli of elastic bodies. Only bodies
/// that meet, are joined or can be splashed count together; the hardest such neighbourhood decides. Empty
/// where a material gives one, or nothing flows or can meet.
[[nodiscard]] std::optional<DefaultStiffness> default_stiffness(const Scene&);

/// Distance within which a freezing particle joins where the scene does not say [spacings]. As in the paper:
/// all that its bonds reach (h = 2.12 dx). Corrected: nearest and diagonal neighbours of the lattice, so that
/// no bond bridges a molten layer.
[[nodiscard]] double default_merge_distance(const Scene&);

}  // namespace tripoint
