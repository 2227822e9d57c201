// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

namespace tripoint::fracture {
namespace {

bool has_limit(const Material& m) { return m.fracture_stretch || m.fracture_distance; }

std::string called_for(const Scene& s) { return limit_called_for(s, has_limit, "a fracture limit", "break"); }

std::string left_out(const Scene& s) { return limit_left_out(s, has_limit, "a fracture limit"); }

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {{"material", "fracture_stretch", number, "", above_one, "", "never breaks", "",
        "corrected: stretch |r|/|x| that breaks a bond"},
       &Material::fracture_stretch},
      {{"material", "fracture_distance", number, "", positive, "", "never breaks", "",
        "paper: distance that breaks a bond, in spacings"},
       &Material::fracture_distance},
  };
}

}  // namespace

EffectRule rule() { return {"fracture", called_for, left_out, nullptr, {}, {}, keys()}; }

}  // namespace tripoint::fracture
