// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tables/key_table.hpp"

/// The one list of the keys of a scene.
namespace tripoint {

/// Every key of a scene, those of effects too. How a scene is judged has keys of its own
/// (validation/case/case_keys.hpp).
[[nodiscard]] const KeyTable& scene_keys();
/// Row of scene_keys(). @pre the key exists
[[nodiscard]] const Key& key_row(std::string_view table, std::string_view name);

}  // namespace tripoint
