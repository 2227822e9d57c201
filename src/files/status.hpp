// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tables/words.hpp"

namespace tripoint {

/// How a run ended. An engine says ok, refused, diverged or error of itself. The harness sees that an engine
/// is missing, was killed or ran out of time.
enum class Status { ok, refused, missing, diverged, killed, timeout, error };

constexpr WordTable<7> word_table(Status) {
  return {"status of a run", {"ok", "refused", "missing", "diverged", "killed", "timeout", "error"}};
}

}  // namespace tripoint
