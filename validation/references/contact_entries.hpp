// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/references/functions.hpp"

/// Reference functions of bodies that have Coulomb's law and Newton's law of impact.
namespace tripoint {

[[nodiscard]] ReferenceEntry sliding_entry();
[[nodiscard]] ReferenceEntry rolling_entry();
[[nodiscard]] ReferenceEntry landing_entry();
[[nodiscard]] ReferenceEntry ball_hits_entry();

}  // namespace tripoint
