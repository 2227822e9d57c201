// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::faces {
namespace {

constexpr const char* centres = "pressure acts at the middles of outer particles";

std::string no_face_pressure(const Scene& s) {
  const std::string printed = printed_among(s, {term::density, term::pressure, term::state, term::elastic});
  if (!printed.empty()) return printed;
  if (!calls_for(s, "elastic")) return "nothing elastic moves";
  if (calls_for(s, "phase")) return "where matter melts or freezes, its shape of reference changes at once";
  return calls_for(s, "fracture") ? "where bonds break, the shape of reference changes at once" : "";
}

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && acting_number(s, "face_pressure") > 0.0
             ? "pressure acts at the faces of elastic solids"
             : "";
}

std::string left_out(const Scene& s) {
  if (!calls_for(s, "pressure")) return liquid::why_none_summed(s);
  const std::string why = no_face_pressure(s);
  return why.empty() ? centres : why;
}

std::vector<EffectKey> keys() {
  return {
      {old_key("face_pressure", Range::fraction, "0",
               "fraction of the pressure on an elastic solid that acts at its face (model 8.3)"),
       {},
       no_face_pressure},
  };
}

}  // namespace

EffectRule rule() {
  return {
      .name = "faces",
      .called_for = called_for,
      .left_out = left_out,
      .choices = {{"contact_face",
                   {{"face", "pressure acts at the faces of elastic solids (8.3)", {{"face_pressure", 1.0}}},
                    {"centres", "at the middles of their outer particles", {{"face_pressure", 0.0}}}},
                   "bodies of many particles hardly need it"}},
      .keys = keys(),
      .over_processes = true};
}

}  // namespace tripoint::faces
