// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/defaults.hpp"
#include "scene/effect_keys.hpp"
#include "scene/geometry.hpp"
#include "scene/model.hpp"
#include "scene/scene_keys.hpp"
#include "scene/scene_records.hpp"
#include "scene/shared_terms.hpp"
#include "scene/value_reader.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"

/// [scene], and everything else that is simulated.
namespace tripoint {
namespace {

void read_modes(TableReader& in, Scene& s) {
  const auto* modes = in.composite("modes");
  if (!modes) return;
  if (modes->kind != TomlNode::Kind::table)
    in.refuse("modes",
              fmt::format("write modes.TERM = \"paper\" or \"corrected\", not {}", kind_name(modes->kind)));
  for (const auto& [term, word] : modes->members) {
    try {
      if (word.kind != TomlNode::Kind::text)
        throw InputError(fmt::format("must be \"corrected\" or \"paper\", not {}", kind_name(word.kind)));
      s.modes_given[term_from(term)] = mode_from(word.text);
    } catch (const InputError& e) {
      throw InputError(word.key_place, fmt::format("`scene.modes.{}`: {}", printable(term), e.what()));
    }
    in.decisions().push_back({"scene.modes." + term, "\"" + word.text + "\"", "given", true, word.place});
  }
}

/// `clamp = true` is modes.clamp = "corrected", whatever the mode.
void read_clamp(TableReader& in, Scene& s) {
  const auto clamp = in.maybe_flag("clamp");
  if (!clamp) return;
  if (!s.modes_given.try_emplace(term::clamp, *clamp ? Mode::corrected : Mode::paper).second)
    in.refuse("clamp", "scene.modes.clamp says the same: remove one of them");
}

/// The old key of [scene] that gives the form of a term; empty where none does.
std::string given_old_key(const TableReader& in, const Scene& s, const ModelTerm& t) {
  const auto keys = old_keys_of(t);
  const auto given = std::ranges::find_if(keys, [&](const std::string& key) {
    return in.has(key) || (key.starts_with("modes.") && s.modes_given.contains(*t.term) &&
                           !(t.term == term::clamp && in.has("clamp")));
  });
  return given == keys.end() ? "" : *given;
}

/// [model]. @pre the keys of [scene] are read
void read_model(TableReader& top, const TableReader& in, Scene& s, Reading& reading) {
  const auto* node = top.composite("model");
  if (!node) return;
  TableReader model(*node, "model", "model", reading.decisions, scene_keys());
  for (const ModelTerm& t : model_terms()) {
    const auto word = model.maybe_text(t.name);
    if (!word) continue;
    const ModelForm& form = *form_of_word(t, *word);
    const std::string key = given_old_key(in, s, t);
    const auto is_number = [&](const auto& one) { return one.first == key; };
    if ((t.term && s.modes_given.contains(*t.term)) || std::ranges::any_of(form.values, is_number))
      model.refuse(t.name, fmt::format("scene.{} gives the form too: remove one of them", key));
    choose(s, t, form);
    // A run in another mode than the file's has every term of the paper in that one
    if (t.term && t.has_equation && s.modes_given[*t.term] == s.mode) s.modes_given.erase(*t.term);
  }
}

void check_domain(const TableReader& in, const Scene& s) {
  if (s.removes_escaped && !(s.min && s.max))
    in.refuse("on_escape", "what leaves is known where there is a domain: give scene.min and scene.max");
  if (s.min.has_value() != s.max.has_value())
    in.refuse(s.min ? "min" : "max",
              fmt::format("a domain has two corners: give scene.{} too", s.min ? "max" : "min"));
  for (std::size_t a = 0; a < 3; ++a) {
    if (a == 1 && s.is_planar()) continue;
    if (s.periodic[a] && !(s.min && s.max))
      in.refuse("periodic",
                fmt::format("direction {} repeats over the domain: give scene.min and scene.max", "xyz"[a]));
    if (s.min && s.max && !((*s.max)[a] > (*s.min)[a]))
      in.refuse("max",
                fmt::format("the domain has no extent along {}: max must be greater than min", "xyz"[a]));
  }
}

/// [scene], but for spacing, which its bodies decide where it is not given.
void read_scene_table(TableReader& in, Scene& s, RecordReader<Scene>& read, Reading& reading) {
  read("end_time");
  read("dimensions");
  if (s.dimensions != 2 && s.dimensions != 3)
    in.refuse("dimensions", "write 2 for one layer in the plane of x and z, or 3");
  read("plane");
  if (s.plane_stress && !s.is_planar())
    in.refuse("plane", "it says how a layer strains: write dimensions = 2 too, or remove it");
  read("gravity");
  if (s.is_planar() && s.gravity.y != 0.0)
    in.refuse("gravity", "scene.dimensions = 2 has x and z alone: leave its y 0");
  read("mode");
  read_modes(in, s);
  read_clamp(in, s);
  read("time_step");
  if (s.time_step && *s.time_step > s.end_time)
    in.refuse("time_step",
              fmt::format("{} s is longer than end_time = {} s: shorten it", *s.time_step, s.end_time));
  if (s.time_step && s.end_time > most_steps * *s.time_step)
    in.refuse("time_step",
              fmt::format(
                  "{} s would need {:.3g} steps to end_time = {} s: at most {:.0e} can be made; lengthen it",
                  *s.time_step, s.end_time / *s.time_step, s.end_time, most_steps));
  read("seed");
  read("jitter");
  read("min");
  read("max");
  read("periodic");
  read("on_escape");
  if (s.is_planar() && s.periodic[1])
    in.refuse("periodic", "scene.dimensions = 2 has x and z alone: leave y out");
  check_domain(in, s);
  if (read("output_interval"))
    in.ruled("output_interval", show(s.output_interval = s.end_time / 20.0), "a twentieth of end_time");
  if (s.output_interval > s.end_time)
    in.refuse("output_interval",
              fmt::format("{} s is longer than end_time = {} s: shorten it", s.output_interval, s.end_time));
  if (s.end_time / s.output_interval > 1e6)
    in.refuse("output_interval", fmt::format("{:.3g} frames would be written; at most 1e6: lengthen it",
                                             s.end_time / s.output_interval));
  read_effect_keys(in, "scene", s, reading);
  read.rest();
}

/// The form of each term that [model] does not name, with its reason.
void decide_forms(TableReader& top, TableReader& in, Scene& s) {
  const auto reasons = take_leading_forms(top, in, s);
  const TomlNode* model = top.composite("model");
  for (const ModelTerm& t : model_terms()) {
    if (model && model->find(t.name)) continue;
    const ModelForm* form = form_in(s, t);
    const auto reason = reasons.find(t.name);
    const std::string key = given_old_key(in, s, t);
    in.decisions().push_back({fmt::format("model.{}", t.name),
                              form ? fmt::format("\"{}\"", form->word) : "between its words",
                              !key.empty()              ? fmt::format("as scene.{} says", key)
                              : reason != reasons.end() ? reason->second
                              : t.term                  ? "as scene.mode"
                                                        : std::string(t.why),
                              false,
                              {}});
  }
}

void resolve_modes(TableReader& top, TableReader& in, Scene& s, RecordReader<Scene>& read) {
  s.resolve_modes();
  decide_forms(top, in, s);
  const bool paper = s.all_printed();
  if (!read("support_ratio")) {
    s.support_ratio_given = true;
    if (s.support_ratio > 10.0)
      in.refuse("support_ratio",
                fmt::format("{} spacings reach some {:.0f} neighbours: at most 10", s.support_ratio,
                            s.is_planar() ? 3.14 * std::pow(s.support_ratio, 2)
                                          : 4.19 * std::pow(s.support_ratio, 3)));
  } else {
    s.support_ratio = s.default_support_ratio();
    in.ruled("support_ratio", show(s.support_ratio),
             paper ? std::string("every term is paper: about 40 neighbours by volume, as the paper has")
             : s.has_brought_form(term::pressure)
                 ? fmt::format("liquid flows: at {} no lattice of it resists shear", flowing_support)
                 : fmt::format("some term is corrected: {} for its Wendland kernel", corrected_support));
  }
  if (!read("merge_distance")) {
    s.merge_distance_given = true;
  } else {
    s.merge_distance = default_merge_distance(s);
    in.ruled("merge_distance", show(s.merge_distance),
             s.mode_of(term::phase) == Mode::paper ? "phase is paper: whatever is within reach of its bonds"
                                                   : "nearest and diagonal neighbours of the lattice");
  }
}

void resolve_spacing(TableReader& in, Scene& s, RecordReader<Scene>& read) {
  if (!read("spacing")) return;
  double least = INFINITY;
  std::string which;
  for (const auto& b : s.bodies) {
    const Vec3 e = bounds(b.shape).extent();
    for (std::size_t a = 0; a < 3; ++a)
      if (e[a] < least && !(a == 1 && s.is_planar())) {
        least = e[a];
        which = b.name;
      }
  }
  if (!std::isfinite(least) || !(least > 0.0))
    in.refuse("spacing", "no body has a finite extent to take a tenth of: give scene.spacing");
  s.spacing = least / 10.0;
  in.ruled("spacing", show(s.spacing),
           fmt::format("a tenth of the smallest extent, {} m of body {}", least, which));
}

/// Materials of [[material]], then those of the library that a body or inflow names.
void read_materials(TableReader& top, Scene& s, Reading& reading) {
  for (const auto* node : top.tables("material")) s.materials.push_back(read_material(*node, reading));
  for (const char* list : {"body", "inflow"}) {
    if (!top.has(list)) continue;
    for (const auto* node : top.tables(list)) {
      const auto* name = node->find("material");
      if (!name || name->kind != TomlNode::Kind::text || library_file(name->text).empty()) continue;
      if (std::any_of(s.materials.begin(), s.materials.end(),
                      [&](const Material& m) { return m.name == name->text; }))
        continue;
      TomlNode entry;
      entry.place = name->place;
      entry.members.emplace_back("name", *name);
      s.materials.push_back(read_material(entry, reading));
    }
  }
}

}  // namespace

Scene read_scene(TableReader& top, Reading& reading) {
  Scene s;
  // Materials come first: their faults are theirs, whatever else is missing.
  read_materials(top, s, reading);
  const auto* scene = top.composite("scene");
  TableReader in(*scene, "scene", "scene", reading.decisions, scene_keys());
  RecordReader read(in, s, reading);
  read_scene_table(in, s, read, reading);
  read_model(top, in, s, reading);
  for (const auto* node : top.tables("body")) s.bodies.push_back(read_body(*node, s.materials, reading));
  if (s.bodies.empty()) top.refuse("body", "the scene has no body: add a [[body]]");
  std::size_t n = 0;
  for (const auto* node : top.tables("event")) s.events.push_back(read_event(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("inflow"))
    s.inflows.push_back(read_inflow(*node, ++n, s.end_time, reading));
  n = 0;
  for (const auto* node : top.tables("outflow")) s.outflows.push_back(read_outflow(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("contact"))
    s.contact_laws.push_back(read_contact_law(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("force")) s.forces.push_back(read_force(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("spring")) s.springs.push_back(read_spring(*node, ++n, reading));
  for (const auto* node : top.tables("joint")) s.joints.push_back(read_joint(*node, reading));
  n = 0;
  for (const auto* node : top.tables("source"))
    s.sources.push_back(read_source(*node, ++n, s.end_time, reading));
  if (s.is_planar()) {
    make_planar(s);
    reading.decisions.push_back({"scene.depth",
                                 fmt::format("{}", layer_depth),
                                 "m along y, however deep shapes are drawn",
                                 false,
                                 {}});
  }
  resolve_spacing(in, s, read);
  resolve_modes(top, in, s, read);
  if (!s.contact && s.has_liquid())
    in.refuse("contact",
              "a liquid meets every solid by the same forces as solids meet each other: remove it");
  if (const auto stiffness = default_stiffness(s))
    reading.decisions.push_back({"material.stiffness", show(stiffness->value), stiffness->rule, false, {}});
  return s;
}

}  // namespace tripoint
