// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "scene/model.hpp"
#include "scene/scene_keys.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {

std::vector<Finding> old_keys(const CaseReading& reading) {
  std::vector<Finding> found;
  for (const ModelTerm& t : model_terms()) {
    const ModelForm* form = form_in(reading.value.scene, t);
    for (const Decision& d : reading.decisions) {
      const auto sets = [&](const auto& one) {
        return d.given && d.key == fmt::format("scene.{}", one.first) &&
               key_row("scene", one.first).type == ValueType::number;
      };
      if (form && std::ranges::any_of(form->values, sets))
        found.push_back({false,
                         fmt::format("{} = {} is read for one more version: write model.{} = \"{}\"", d.key,
                                     d.value, t.name, form->word),
                         d.place});
    }
  }
  return found;
}

}  // namespace tripoint
