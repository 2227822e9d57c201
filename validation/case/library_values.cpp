// SPDX-License-Identifier: BSD-3-Clause
#include "tables/library.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {

std::vector<Finding> library_values(const CaseReading& reading) {
  std::vector<Finding> found;
  for (const Material& m : reading.value.scene.materials) {
    if (library_file(m.name).empty()) continue;
    const std::string table = "material." + m.name + ".", from = "library, ";
    std::string taken;
    bool is_table = false;  // not the bare name in a body
    SourcePlace place;
    for (const Decision& d : reading.decisions) {
      if (d.key.rfind(table, 0) != 0) continue;
      const std::string key = d.key.substr(table.size());
      if (d.given && key == "name") place = d.place;
      is_table = is_table || (d.given && key != "name");
      if (!d.given && d.reason.rfind(from, 0) == 0 && key != "source")
        taken += (taken.empty() ? "" : ", ") + key + " = " + d.value;
    }
    if (is_table && !taken.empty())
      found.push_back({false,
                       "material \"" + m.name +
                           "\" takes what it does not give from the library's material of that name: " +
                           taken + "; name it otherwise to have none of these",
                       place});
  }
  return found;
}

}  // namespace tripoint
