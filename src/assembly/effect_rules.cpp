// SPDX-License-Identifier: BSD-3-Clause
// The rules of all effects, as scene/effect_rule.hpp asks for them. A test may have a list of its own.
#include "scene/effect_rule.hpp"

#ifndef TRIPOINT_EFFECT_LIST
#define TRIPOINT_EFFECT_LIST "effects/effect_list.inc"
#endif

namespace tripoint {

#define TRIPOINT_EFFECT(name) \
  namespace name {            \
  EffectRule rule();          \
  }
#include TRIPOINT_EFFECT_LIST
#undef TRIPOINT_EFFECT

std::span<const EffectRule> effect_rules() {
  static const std::vector<EffectRule> rules{
#define TRIPOINT_EFFECT(name) name::rule(),
#include TRIPOINT_EFFECT_LIST
#undef TRIPOINT_EFFECT
  };
  return rules;
}

}  // namespace tripoint
