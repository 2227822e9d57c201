// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/measuring.hpp"

#include "scene/nearest.hpp"

namespace tripoint {
namespace {

double phase_number(const std::string& word, const std::string& function) {
  if (word == "solid") return 3.0;
  try {
    return static_cast<double>(phase_from(word));
  } catch (const InputError&) {
    throw InputError("argument `phase` of reference function " + function +
                     " must be \"liquid\", \"elastic\", \"rigid\" or \"solid\"");
  }
}

double axis_number(const std::string& word, const std::string& function) {
  if (word == "x" || word == "y" || word == "z") return word[0] - 'x';
  throw InputError("argument `axis` of reference function " + function + " must be \"x\", \"y\" or \"z\"");
}

double body_number(const Job& job, const std::string& name, const std::string& function) {
  std::vector<std::string> known;
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    if (job.bodies[b].name == name) return static_cast<double>(b);
    known.push_back(job.bodies[b].name);
  }
  throw InputError("argument `other` of reference function " + function + " names body `" + printable(name) + "`" +
                   suggestion(name, known));
}

void add_vector(Numbers& n, const std::string& name, const Vec3& v) {
  n[name + ".x"] = v.x, n[name + ".y"] = v.y, n[name + ".z"] = v.z;
}

}  // namespace

std::vector<ReferenceArgument> measuring_arguments() {
  return {{"phase", "", "liquid, elastic, rigid or solid (either of the two); default all particles"},
          {"axis", "", "x, y or z"},
          {"other", "", "name of the second body of a pair"},
          {"gauge", "", "middle share of the body's length over which a stretch is measured; default 1"},
          {"min", "m", "low corner of a box"},
          {"max", "m", "high corner of a box"},
          {"outside", "", "true: what is not in the box; default false"},
          {"follows", "", "true: the box moves and turns with the metric's body, from where that body began; default false"},
          {"point", "m", "place of a probe; for a displacement the place at the start"},
          {"frequency", "Hz", "true frequency, for the norm frequency"},
          {"diffusivity", "m2/s", "true diffusivity, for the quantity of that name"}};
}

Numbers measuring_numbers(const ReferenceInput& in, const std::string& function) {
  Numbers n;
  if (const auto value = in.args.number("gauge")) n["gauge"] = *value;
  for (const char* name : {"outside", "follows"}) n[name] = in.args.flag(name).value_or(false) ? 1.0 : 0.0;
  if (const auto word = in.args.word("phase")) n["phase"] = phase_number(*word, function);
  if (const auto word = in.args.word("axis")) n["axis"] = axis_number(*word, function);
  if (const auto word = in.args.word("other")) n["other"] = body_number(in.job, *word, function);
  if (const auto value = in.args.number("frequency")) {
    if (!(*value > 0.0)) throw InputError("argument `frequency` of reference function " + function + " must be greater than 0");
    n["stated_frequency"] = *value;
  }
  if (const auto value = in.args.number("diffusivity")) n["diffusivity"] = *value;
  const auto low = in.args.vector("min"), high = in.args.vector("max");
  if (low.has_value() != high.has_value())
    throw InputError("reference function " + function + " needs both `min` and `max` for a box, or neither");
  for (std::size_t k = 0; low && k < 3; ++k)
    if (!((*high)[k] > (*low)[k]))
      throw InputError("reference function " + function + ": `max` must lie above `min` in " +
                       std::string(1, static_cast<char>('x' + k)));
  if (low) add_vector(n, "low", *low), add_vector(n, "high", *high);
  if (const auto point = in.args.vector("point")) add_vector(n, "point", *point);
  return n;
}

std::optional<Vec3> stated_point(const Reference& reference) {
  const auto x = reference.number("point.x"), y = reference.number("point.y"), z = reference.number("point.z");
  return x && y && z ? std::optional(Vec3{*x, *y, *z}) : std::nullopt;
}

}  // namespace tripoint
