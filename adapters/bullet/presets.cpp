// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/presets.hpp"

#include <fmt/format.h>

#include <functional>

namespace tripoint::bullet {
namespace {

/// "impact": the position correction never enters the velocity and no contact acts before touch, so that a
/// central hit is exact at every step. Bullet's defaults err by O(1) in velocity at any step. "resting": more
/// iterations, defaults else.
const std::map<std::string, Preset>& presets() {
  static const std::map<std::string, Preset> table{{"default", {}},
                                                   {"impact",
                                                    {.erp2 = 0.0,
                                                     .split_threshold = 1e30,
                                                     .restitution_threshold = 1e-6,
                                                     .contact_threshold = 0.0,
                                                     .restitution = 1.0}},
                                                   {"resting", {.iterations = 200}}};
  return table;
}

const std::map<std::string, Gyro> gyro_words{{"implicit", Gyro::implicit_body},
                                             {"implicit_world", Gyro::implicit_world},
                                             {"explicit", Gyro::explicit_world},
                                             {"off", Gyro::off}};
const std::map<std::string, Collision> collision_words{{"solid", Collision::solid},
                                                       {"boxes", Collision::boxes},
                                                       {"spheres", Collision::spheres},
                                                       {"none", Collision::none}};

template <class Map>
std::string words(const Map& map) {
  std::string text;
  for (const auto& entry : map) text += (text.empty() ? "" : ", ") + entry.first;
  return text;
}

double number(const std::string& key, const Setting& value) {
  if (const auto* d = std::get_if<double>(&value)) return *d;
  throw InputError(fmt::format("bullet: the setting {} must be a number", key));
}

double not_negative(const std::string& key, const Setting& value) {
  const double d = number(key, value);
  if (!(d >= 0.0)) throw InputError(fmt::format("bullet: the setting {} is 0 or more", key));
  return d;
}

template <class T>
T word(const std::string& key, const Setting& value, const std::map<std::string, T>& allowed) {
  const auto* text = std::get_if<std::string>(&value);
  if (text && allowed.contains(*text)) return allowed.at(*text);
  throw InputError(fmt::format("bullet: the setting {} must be one of {}", key, words(allowed)));
}

using Apply = std::function<void(Preset&, const std::string&, const Setting&)>;
struct Entry {
  std::string help;
  Apply apply;
};

const std::map<std::string, Entry>& entries() {
  static const std::map<std::string, Entry> table{
      {"gyro",
       {"gyroscopic term: implicit (default, Bullet's own) | implicit_world | explicit | off",
        [](Preset& p, const std::string& k, const Setting& v) { p.gyro = word(k, v, gyro_words); }}},
      {"collision",
       {"geometry of contact: solid (default; a box or sphere as the case says, else boxes) | boxes | "
        "spheres, one a particle | "
        "none: free flight",
        [](Preset& p, const std::string& k, const Setting& v) {
          p.collision = word(k, v, collision_words);
        }}},
      {"iterations",
       {"solver iterations, default 10 (resting: 200); the job's resolution.iterations goes first",
        [](Preset& p, const std::string& k, const Setting& v) {
          p.iterations = static_cast<int>(number(k, v));
        }}},
      {"friction",
       {"Coulomb's coefficient of a pair of bodies, default 0",
        [](Preset& p, const std::string& k, const Setting& v) { p.friction = not_negative(k, v); }}},
      {"restitution",
       {"of a pair of bodies, default 0 (impact: 1)",
        [](Preset& p, const std::string& k, const Setting& v) { p.restitution = not_negative(k, v); }}}};
  return table;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const auto& [name, preset] : presets()) names.push_back(name);
  return names;
}

std::map<std::string, std::string> setting_help() {
  std::map<std::string, std::string> help;
  for (const auto& [key, entry] : entries()) help[key] = entry.help;
  help["time_step"] =
      "goes before the job's; default 1/240 s; shortened so that output times are hit exactly";
  return help;
}

Preset preset_for(const Job& job) {
  const auto found = presets().find(job.preset);
  if (found == presets().end())
    throw InputError(fmt::format("bullet: no preset '{}'; there are {}", job.preset, words(presets())));
  Preset preset = found->second;
  for (const auto& [key, value] : job.settings) {
    if (key == "time_step") continue;  // read where the step is chosen
    const auto entry = entries().find(key);
    if (entry == entries().end())
      throw InputError(
          fmt::format("bullet: no setting '{}'; there are {}, time_step", key, words(entries())));
    entry->second.apply(preset, key, value);
  }
  if (!job.scene.contact) preset.collision = Collision::none;
  if (job.resolution.iterations) preset.iterations = static_cast<int>(*job.resolution.iterations);
  return preset;
}

}  // namespace tripoint::bullet
