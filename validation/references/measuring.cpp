// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/measuring.hpp"

#include "files/job.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

MeasuredPhase phase_of(const std::string& word, const std::string& function) {
  if (const auto phase = find_word<MeasuredPhase>(word)) return *phase;
  throw InputError("argument `phase` of reference function " + function +
                   " must be \"liquid\", \"elastic\", \"rigid\" or \"solid\"");
}

std::size_t body_named(const Job& job, const std::string& name, const std::string& function) {
  std::vector<std::string> known;
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    if (job.bodies[b].name == name) return b;
    known.push_back(job.bodies[b].name);
  }
  throw InputError("argument `other` of reference function " + function + " names body `" + printable(name) +
                   "`" + suggestion(name, known));
}

/// Both corners, or neither.
std::optional<MeasuredBox> stated_box(const ReferenceInput& in, const std::string& function) {
  const auto low = in.args.vector("min"), high = in.args.vector("max");
  if (low.has_value() != high.has_value())
    throw InputError("reference function " + function + " needs both `min` and `max` for a box, or neither");
  if (!low) return {};
  for (std::size_t k = 0; k < 3; ++k)
    if (!((*high)[k] > (*low)[k]))
      throw InputError("reference function " + function + ": `max` must lie above `min` in " +
                       std::string(1, static_cast<char>('x' + k)));
  return MeasuredBox{*low, *high};
}

}  // namespace

std::vector<ReferenceArgument> measuring_arguments() {
  return {{"phase", "", "liquid, elastic, rigid or solid (either of the two); default all particles",
           ArgumentType::word, true},
          {"axis", "", "x, y or z", ArgumentType::axis, true},
          {"other", "", "name of the second body of a pair", ArgumentType::word},
          {"gauge", "", "middle fraction of the body's length over which a stretch is measured; default 1"},
          {"min", "m", "low corner of a box", ArgumentType::vector, true},
          {"max", "m", "high corner of a box", ArgumentType::vector, true},
          {"outside", "", "true: what is not in the box; default false", ArgumentType::flag, true},
          {"follows", "",
           "true: the box moves and turns with the metric's body, from where that body began; default false",
           ArgumentType::flag},
          {"point", "m", "place of a probe; for a displacement the place at the start", ArgumentType::vector,
           true},
          {"frequency", "Hz", "true frequency, for the norm frequency"},
          {"amplitude", "", "true amplitude, for the norm swing"},
          {"diffusivity", "m2/s", "true diffusivity, for the quantity of that name"}};
}

Measuring stated_measuring(const ReferenceInput& in, const std::string& function) {
  Measuring m;
  m.outside = in.args.flag("outside").value_or(false);
  m.follows = in.args.flag("follows").value_or(false);
  if (const auto word = in.args.word("phase")) m.phase = phase_of(*word, function);
  m.axis = in.args.axis("axis");
  if (const auto word = in.args.word("other")) m.other = body_named(in.job, *word, function);
  m.box = stated_box(in, function);
  m.point = in.args.vector("point");
  return m;
}

Numbers stated_numbers(const ReferenceInput& in, const std::string& function) {
  Numbers n;
  if (const auto value = in.args.number("gauge")) n["gauge"] = *value;
  if (const auto value = in.args.number("frequency")) {
    if (!(*value > 0.0))
      throw InputError("argument `frequency` of reference function " + function + " must be greater than 0");
    n["stated_frequency"] = *value;
  }
  if (const auto value = in.args.number("amplitude")) n["stated_amplitude"] = *value;
  if (const auto value = in.args.number("diffusivity")) n["diffusivity"] = *value;
  return n;
}

}  // namespace tripoint
