// SPDX-License-Identifier: BSD-3-Clause
#include "scene/contact_law.hpp"

#include <algorithm>

namespace tripoint {
namespace {

bool can_meet(const Body& a, const Body& b) {
  return a.phase != Phase::liquid && b.phase != Phase::liquid &&
         (a.motion == Motion::free || b.motion == Motion::free);
}

}  // namespace

const ContactLaw* contact_law_of(const Scene& scene, std::string_view material, std::string_view other) {
  const auto at = std::ranges::find_if(scene.contact_laws, [&](const ContactLaw& law) {
    const auto &a = law.materials.at(0), &b = law.materials.at(1);
    return (a == material && b == other) || (a == other && b == material);
  });
  return at == scene.contact_laws.end() ? nullptr : &*at;
}

CommonContact common_contact(const Scene& scene) {
  CommonContact common;
  if (scene.contact_laws.empty()) return common;
  bool first = true;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      if (!can_meet(scene.bodies[i], scene.bodies[j])) continue;
      const ContactLaw* law = contact_law_of(scene, scene.bodies[i].material, scene.bodies[j].material);
      const CommonContact own{law ? law->friction : std::nullopt, law ? law->restitution : std::nullopt};
      common.differs = common.differs ||
                       (!first && (own.friction != common.friction || own.restitution != common.restitution));
      if (first) common = own;
      first = false;
    }
  return common;
}

}  // namespace tripoint
