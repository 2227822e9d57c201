// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

namespace tripoint::bench {

/// A standard piece of work: a shipped case at a size, and how much of it to time.
struct Work {
  std::string_view name, case_id;
  Mode mode = Mode::corrected;
  std::vector<std::string> set;  ///< as of --set
  int copies = 1;                ///< of every body along each axis
  double pitch = 0.0;            ///< between copies [m]
  double closing = 0.0;          ///< rate at which copies fly towards the middle of all [1/s]
  long warm = 20, steps = 120;   ///< steps before and within the timed part
  bool has_limit = false;        ///< whether the hand-written loops do the same work
};

/// 40k and 200k particles of liquid with heat, elastic solid, figures 9 and 12, 1,000 rigid bodies.
[[nodiscard]] const std::vector<Work>& standard_work();
/// Liquid with heat at this many particles across: the ladder of `--growth`.
[[nodiscard]] Work liquid_heat(int across, Mode mode);

struct Start {
  Scene scene;
  InitialState particles;
};
/// @throws InputError when the case is not found or wrong
[[nodiscard]] Start prepare(const Work&);

}  // namespace tripoint::bench
