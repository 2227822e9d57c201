// SPDX-License-Identifier: BSD-3-Clause
#include "scene/nearest.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/number_table.hpp"

namespace tripoint {
namespace {

/// What a case states itself: a claim, and what a quantity must know to be measured. It computes nothing, so that a metric says in the case
/// file what it is compared with. Numbers: value, axis, phase (3 = any solid), other (row in the job's bodies), gauge, outside, follows,
/// low.x ... high.z [m].
using Stated = NumberTable;

double phase_number(const std::string& word) {
  if (word == "solid") return 3.0;
  try {
    return static_cast<double>(phase_from(word));
  } catch (const InputError&) {
    throw InputError("argument `phase` of reference function stated must be \"liquid\", \"elastic\", \"rigid\" or \"solid\"");
  }
}

double axis_number(const std::string& word) {
  if (word == "x" || word == "y" || word == "z") return word[0] - 'x';
  throw InputError("argument `axis` of reference function stated must be \"x\", \"y\" or \"z\"");
}

double body_number(const Job& job, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    if (job.bodies[b].name == name) return static_cast<double>(b);
    known.push_back(job.bodies[b].name);
  }
  throw InputError("argument `other` of reference function stated names body `" + printable(name) + "`" + suggestion(name, known));
}

std::unique_ptr<Reference> make_stated(const ReferenceInput& in) {
  Numbers n;
  for (const char* name : {"value", "gauge"})
    if (const auto value = in.args.number(name)) n[name] = *value;
  for (const char* name : {"outside", "follows"}) n[name] = in.args.flag(name).value_or(false) ? 1.0 : 0.0;
  if (const auto word = in.args.word("phase")) n["phase"] = phase_number(*word);
  if (const auto word = in.args.word("axis")) n["axis"] = axis_number(*word);
  if (const auto word = in.args.word("other")) n["other"] = body_number(in.job, *word);
  const auto low = in.args.vector("min"), high = in.args.vector("max");
  if (low.has_value() != high.has_value()) throw InputError("reference function stated needs both `min` and `max` for a box, or neither");
  for (std::size_t k = 0; low && k < 3; ++k) {
    const std::string axis(1, static_cast<char>('x' + k));
    if (!((*high)[k] > (*low)[k])) throw InputError("reference function stated: `max` must lie above `min` in " + axis);
    n["low." + axis] = (*low)[k], n["high." + axis] = (*high)[k];
  }
  return std::make_unique<Stated>(std::move(n));
}

}  // namespace

ReferenceEntry stated_entry() {
  return {{"stated", "bound", "the case's own claim", "a number that the case states, and what a quantity is measured by: nothing is computed",
           {{"value", "", "what the quantity is compared with, in its unit"},
            {"phase", "", "liquid, elastic, rigid or solid (either of the two); default all particles"},
            {"axis", "", "x, y or z"},
            {"other", "", "name of the second body of a pair"},
            {"gauge", "", "middle share of the body's length over which a stretch is measured; default 1"},
            {"min", "m", "low corner of a box"},
            {"max", "m", "high corner of a box"},
            {"outside", "", "true: what is not in the box; default false"},
            {"follows", "", "true: the box moves and turns with the metric's body, from where that body began; default false"}}},
          make_stated};
}

}  // namespace tripoint
