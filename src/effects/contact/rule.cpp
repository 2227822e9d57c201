// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::contact {
namespace {

bool is_free_solid(const Scene&, const Body& b, const Material&) {
  return b.phase != Phase::liquid && b.motion == Motion::free;
}

std::string no_contact_stiffness(const Scene& s) {
  if (s.mode_of(term::state) == Mode::paper) return "the equation of state is as printed";
  if (calls_for(s, "phase")) return "where matter melts or freezes, its stiffness would change at once";
  return any_body(s, is_free_solid) ? "" : "no solid is free to touch another";
}

std::string no_contact_step(const Scene& s) {
  if (s.time_step) return "the scene gives its time_step";
  if (!s.clamps()) return "the scene does not clamp: solids pull at each other before they touch";
  const std::string printed = printed_among(s, {term::density, term::pressure, term::state});
  if (!printed.empty()) return printed;
  if (calls_for(s, "phase")) return "where matter melts or freezes, densities change at once";
  return any_body(s, is_free_solid) ? "" : "no solid is free to touch another";
}

bool asks(const Scene& s) {
  return acting_number(s, "contact_stiffness") > 0.0 || acting_number(s, "contact_step") > 0.0;
}

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && asks(s) ? "solids that touch are stiffer, or shorten the step" : "";
}

std::string left_out(const Scene& s) {
  if (!calls_for(s, "pressure")) return liquid::why_none_summed(s);
  const std::string why = no_contact_stiffness(s);
  return why.empty() ? "contacts are as stiff as liquids, and their bound of the step always holds" : why;
}

std::vector<EffectKey> keys() {
  using enum Range;
  return {
      {old_key("contact_stiffness", not_negative, "0",
               "extra stiffness of solid contact: contacts use (1 + contact_stiffness) k (model 8.3)"),
       {},
       no_contact_stiffness},
      {old_key("contact_step", fraction, "0",
               "fraction of the contact bound of the step while a free solid is pressed or about to be "
               "(model 8.10); 0: the bound always holds"),
       {},
       no_contact_step},
  };
}

std::vector<ModelChoice> choices() {
  return {{"contact",
           {{"stiff", "solids are 25 times as stiff where they touch (8.3)", {{"contact_stiffness", 24.0}}},
            {"common", "as stiff as the scene's liquids", {{"contact_stiffness", 0.0}}}},
           "a stiffer contact needs shorter steps"},
          {"contact_step",
           {{"at-touch", "the bound of contact holds near a touch alone (8.10)", {{"contact_step", 1.0}}},
            {"short-at-touch", "0.3 of that bound", {{"contact_step", 0.3}}},
            {"always", "it holds in every step", {{"contact_step", 0.0}}}},
           "steps are those of the contact"}};
}

}  // namespace

EffectRule rule() {
  return {.name = "contact",
          .called_for = called_for,
          .left_out = left_out,
          .choices = choices(),
          .keys = keys(),
          .over_processes = true};
}

}  // namespace tripoint::contact
