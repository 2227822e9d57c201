// SPDX-License-Identifier: BSD-3-Clause
#include "scene/name_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tables/nearest.hpp"

namespace tripoint {

bool holds(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

SourcePlace NameChecks::place(const std::string& key, const SourcePlace& table) const {
  for (const auto& d : reading_.decisions)
    if (d.key == key && d.given) return d.place;
  return table.line > 0 || !table.file.empty() ? table : SourcePlace{reading_.file, 0, 0};
}

SourcePlace NameChecks::last_place(const std::string& key) const {
  SourcePlace p{reading_.file, 0, 0};
  for (const auto& d : reading_.decisions)
    if (d.key == key && d.given) p = d.place;
  return p;
}

void NameChecks::unique_names(const std::vector<std::string>& names, const char* table) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (names[i] == names[j])
        throw InputError(
            last_place(fmt::format("{}.{}.name", table, names[i])),
            fmt::format("two tables [[{}]] are named \"{}\": rename one", table, printable(names[i])));
}

void NameChecks::known_body(const Scene& scene, const std::string& name, const std::string& key,
                            const SourcePlace& table, const std::vector<std::string>& also) const {
  auto known = names_of(scene.bodies);
  known.insert(known.end(), also.begin(), also.end());
  if (!holds(known, name))
    throw InputError(place(key, table), fmt::format("`{}`: no body is named \"{}\"{}", key, printable(name),
                                                    suggestion(name, known)));
}

}  // namespace tripoint
