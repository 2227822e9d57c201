// SPDX-License-Identifier: BSD-3-Clause
#include "effects/arithmetic/form.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::arithmetic {
namespace {

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && s.takes_form(term::viscosity, word) ? "model.viscosity asks for it" : "";
}

std::string left_out(const Scene&) { return "the viscosity has another form"; }

}  // namespace

EffectRule rule() {
  return {
      .name = "arithmetic",
      .called_for = called_for,
      .left_out = left_out,
      .forms = {{term::viscosity,
                 {word, "along the difference of velocities, by the arithmetic mean of two viscosities"}}}};
}

}  // namespace tripoint::arithmetic
