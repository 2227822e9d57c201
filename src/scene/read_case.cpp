// SPDX-License-Identifier: BSD-3-Clause
#include "scene/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scene/case_document.hpp"
#include "scene/effect_keys.hpp"
#include "scene/geometry.hpp"
#include "scene/nearest.hpp"
#include "scene/readers.hpp"

namespace tripoint {
namespace {

const TomlNode empty_table;

/// "subject/name" of ".../subject/name.toml".
std::string id_from(const std::string& file) {
  std::error_code error;
  const auto path = std::filesystem::absolute(file, error);
  return path.parent_path().filename().string() + "/" + path.stem().string();
}

void read_head(const TomlNode& node, Case& c, Reading& reading) {
  TableReader in(node, "case", "case", reading.decisions);
  if (const auto id = in.maybe_text("id"))
    c.id = *id;
  else
    in.ruled("id", "\"" + (c.id = id_from(c.file)) + "\"", "folder and name of the file");
  const bool plain = !c.id.empty() && c.id.size() <= 128 && c.id.front() != '/' && c.id.find("..") == std::string::npos &&
                     c.id.find_first_of("\\\"\n\r\t:*?<>|") == std::string::npos;
  if (!plain)
    in.refuse("id", "an id is a path like subject/case without .. or any of \\ \" : * ? < > |: it names folders of the report");
  if (const auto title = in.maybe_text("title"))
    c.title = *title;
  else
    in.ruled("title", "\"" + (c.title = c.id) + "\"", "the id");
  c.requirement = in.text("requirement"), c.claims = in.text("claims"), c.kind = in.text("kind");
  c.profiles = in.texts("profiles"), c.tags = in.texts("tags"), c.expect = in.text("expect");
  if (in.has("modes")) {
    c.modes.clear();
    for (const auto& word : in.texts("modes")) c.modes.push_back(mode_from(word));
    if (c.modes.empty()) in.refuse("modes", "name at least one of corrected, paper");
  }
}

void read_modes(TableReader& in, Scene& s) {
  const auto* modes = in.composite("modes");
  if (!modes) return;
  if (modes->kind != TomlNode::Kind::table)
    in.refuse("modes", fmt::format("write modes.TERM = \"paper\" or \"corrected\", not {}", kind_name(modes->kind)));
  for (const auto& [term, word] : modes->members) {
    try {
      if (word.kind != TomlNode::Kind::text)
        throw InputError(fmt::format("must be \"corrected\" or \"paper\", not {}", kind_name(word.kind)));
      s.modes_given[static_cast<std::size_t>(term_from(term))] = mode_from(word.text);
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
  std::optional<Mode>& given = s.modes_given[static_cast<std::size_t>(Term::clamp)];
  if (given) in.refuse("clamp", "scene.modes.clamp says the same: remove one of them");
  given = *clamp ? Mode::corrected : Mode::paper;
}

void read_domain(TableReader& in, Scene& s) {
  s.min = in.maybe_vector("min"), s.max = in.maybe_vector("max");
  if (s.min.has_value() != s.max.has_value())
    in.refuse(s.min ? "min" : "max", fmt::format("a domain has two corners: give scene.{} too", s.min ? "max" : "min"));
  for (const auto& word : in.texts("periodic")) s.periodic[static_cast<std::size_t>(word[0] - 'x')] = true;
  for (std::size_t a = 0; a < 3; ++a) {
    if (s.periodic[a] && !(s.min && s.max))
      in.refuse("periodic", fmt::format("direction {} repeats over the domain: give scene.min and scene.max", "xyz"[a]));
    if (s.min && s.max && !((*s.max)[a] > (*s.min)[a]))
      in.refuse("max", fmt::format("the domain has no extent along {}: max must be greater than min", "xyz"[a]));
  }
}

/// [scene], but for spacing, which its bodies decide where it is not given.
void read_scene(TableReader& in, Scene& s) {
  s.end_time = in.number("end_time");
  s.gravity = in.vector("gravity");
  s.mode = mode_from(in.text("mode"));
  read_modes(in, s);
  read_clamp(in, s);
  s.time_step = in.maybe_number("time_step");
  if (s.time_step && *s.time_step > s.end_time)
    in.refuse("time_step", fmt::format("{} s is longer than end_time = {} s: shorten it", *s.time_step, s.end_time));
  if (s.time_step && s.end_time > most_steps * *s.time_step)
    in.refuse("time_step", fmt::format("{} s would need {:.3g} steps to end_time = {} s: at most {:.0e} can be made; lengthen it",
                                       *s.time_step, s.end_time / *s.time_step, s.end_time, most_steps));
  s.seed = static_cast<std::uint64_t>(in.integer("seed"));
  s.jitter = in.number("jitter");
  read_domain(in, s);
  if (const auto interval = in.maybe_number("output_interval"))
    s.output_interval = *interval;
  else
    in.ruled("output_interval", show(s.output_interval = s.end_time / 20.0), "a twentieth of end_time");
  if (s.output_interval > s.end_time)
    in.refuse("output_interval", fmt::format("{} s is longer than end_time = {} s: shorten it", s.output_interval, s.end_time));
  if (s.end_time / s.output_interval > 1e6)
    in.refuse("output_interval",
              fmt::format("{:.3g} frames would be written; at most 1e6: lengthen it", s.end_time / s.output_interval));
  read_effect_keys(in, "scene", s);
  s.settle = in.flag("settle");
  s.contact = in.text("contact") == "auto";
  s.recovers = in.text("on_failure") == "recover", s.unguarded = in.texts("unguarded");
}

void resolve_modes(TableReader& in, Scene& s) {
  for (std::size_t t = 0; t < term_count; ++t) {
    s.modes[t] = s.modes_given[t].value_or(s.mode);
    if (!s.modes_given[t])
      in.ruled(fmt::format("modes.{}", to_string(static_cast<Term>(t))), fmt::format("\"{}\"", to_string(s.mode)),
               "as scene.mode");
  }
  if (!in.has("clamp")) in.ruled("clamp", s.clamps() ? "true" : "false", "as modes.clamp");
  const bool paper = s.all_printed();
  if (const auto ratio = in.maybe_number("support_ratio")) {
    s.support_ratio = *ratio, s.support_ratio_given = true;
    if (s.support_ratio > 10.0)
      in.refuse("support_ratio", fmt::format("{} spacings reach some {:.0f} neighbours: at most 10", s.support_ratio,
                                             4.19 * std::pow(s.support_ratio, 3)));
  } else {
    s.support_ratio = paper ? 2.12 : 2.6;
    in.ruled("support_ratio", show(s.support_ratio),
             paper ? "every term is paper: about 40 neighbours by volume, as the paper has"
                   : "some term is corrected: 2.6 for its Wendland kernel");
  }
  if (const auto distance = in.maybe_number("merge_distance")) {
    s.merge_distance = *distance, s.merge_distance_given = true;
  } else {
    s.merge_distance = default_merge_distance(s);
    in.ruled("merge_distance", show(s.merge_distance),
             s.mode_of(Term::phase) == Mode::paper ? "phase is paper: whatever is within reach of its bonds"
                                                   : "nearest and diagonal neighbours of the lattice");
  }
}

void resolve_spacing(TableReader& in, Scene& s) {
  if (const auto spacing = in.maybe_number("spacing")) {
    s.spacing = *spacing;
    return;
  }
  double least = INFINITY;
  std::string which;
  for (const auto& b : s.bodies) {
    const Vec3 e = bounds(b.shape).extent();
    for (std::size_t a = 0; a < 3; ++a)
      if (e[a] < least) least = e[a], which = b.name;
  }
  if (!std::isfinite(least) || !(least > 0.0))
    in.refuse("spacing", "no body has a finite extent to take a tenth of: give scene.spacing");
  s.spacing = least / 10.0;
  in.ruled("spacing", show(s.spacing), fmt::format("a tenth of the smallest extent, {} m of body {}", least, which));
}

/// Materials of [[material]], then those of the library that a body or inflow names.
void read_materials(TableReader& top, Scene& s, Reading& reading) {
  for (const auto* node : top.tables("material")) s.materials.push_back(read_material(*node, reading));
  for (const char* list : {"body", "inflow"}) {
    if (!top.has(list)) continue;
    for (const auto* node : top.tables(list)) {
      const auto* name = node->find("material");
      if (!name || name->kind != TomlNode::Kind::text || library_file(name->text).empty()) continue;
      if (std::any_of(s.materials.begin(), s.materials.end(), [&](const Material& m) { return m.name == name->text; })) continue;
      TomlNode entry;
      entry.place = name->place;
      entry.members.emplace_back("name", *name);
      s.materials.push_back(read_material(entry, reading));
    }
  }
}

void read_judgement(TableReader& top, Case& c, Reading& reading) {
  if (const auto* engines = top.composite("engines")) {
    if (engines->kind != TomlNode::Kind::table) top.refuse("engines", "write one table an engine: [engines.NAME]");
    for (const auto& [name, node] : engines->members) c.engines.push_back(read_engine(node, name, reading));
  }
  if (const auto* reference = top.composite("reference")) {
    c.reference = read_reference(*reference, "reference", reading);
  } else {
    c.reference.kind = "invariant";
    top.ruled("reference.kind", "\"invariant\"", "no [reference]: only what every run must keep is known");
  }
  for (const auto* node : top.tables("metric")) c.metrics.push_back(read_metric(*node, reading));
  std::size_t n = 0;
  for (const auto* node : top.tables("study")) c.studies.push_back(read_study(*node, ++n, c.scene.end_time, reading));
  n = 0;
  for (const auto* node : top.tables("gate")) c.gates.push_back(read_gate(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("input")) c.inputs.push_back(read_input(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("defect")) c.defects.push_back(read_defect(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("harmless"))
    c.harmless.push_back(TableReader(*node, "harmless", fmt::format("harmless.{}", ++n), reading.decisions).text("name"));
}

/// In the order of the reference page, whatever order the rules asked for.
void sort_by_table(std::vector<Decision>& decisions) {
  const auto tables = key_names("");
  const auto rank = [&](const Decision& d) {
    return std::find(tables.begin(), tables.end(), d.key.substr(0, d.key.find('.'))) - tables.begin();
  };
  std::stable_sort(decisions.begin(), decisions.end(), [&](const Decision& a, const Decision& b) { return rank(a) < rank(b); });
}

/// The case as one document, with the replacements of --set.
TomlNode whole_document(const std::string& path, const std::vector<std::string>& set) {
  TomlNode document = read_case_document(path);
  for (const auto& s : set) apply_override(document, s);
  if (!set.empty()) check_written_out(document);
  return document;
}

}  // namespace

std::string resolved_case(const CaseReading& reading, const std::vector<std::string>& set) {
  TomlNode document = whole_document(reading.value.file, set), head, id;
  if (auto* given = document.find("case")) head = std::move(*given);
  std::erase_if(document.members, [](const auto& m) { return m.first == "case"; });
  std::erase_if(head.members, [](const auto& m) { return m.first == "id"; });
  id.kind = TomlNode::Kind::text, id.text = reading.value.id;
  head.members.insert(head.members.begin(), {"id", std::move(id)});
  document.members.insert(document.members.begin(), {"case", std::move(head)});
  return document_text(document);
}

CaseReading read_case(const std::string& path, const std::vector<std::string>& set) {
  Reading reading;
  std::error_code error;
  reading.folder = std::filesystem::absolute(path, error).parent_path().string();
  const TomlNode document = whole_document(path, set);

  CaseReading out;
  Case& c = out.value;
  c.file = path;
  TableReader top(document, "", "", reading.decisions);
  if (const long format = top.integer("format"); format != 1)
    top.refuse("format", fmt::format("format {} is not known: write 1", format));
  const auto* head = top.composite("case");
  read_head(head ? *head : empty_table, c, reading);
  // Materials come first: their faults are theirs, whatever else is missing.
  read_materials(top, c.scene, reading);
  const auto* scene = top.composite("scene");
  TableReader in(*scene, "scene", "scene", reading.decisions);
  read_scene(in, c.scene);
  for (const auto* node : top.tables("body")) c.scene.bodies.push_back(read_body(*node, c.scene.materials, reading));
  if (c.scene.bodies.empty()) top.refuse("body", "the scene has no body: add a [[body]]");
  resolve_spacing(in, c.scene);
  resolve_modes(in, c.scene);
  if (!(head && head->find("modes"))) {
    c.modes = {c.scene.mode};
    reading.decisions.push_back({"case.modes", fmt::format("[\"{}\"]", to_string(c.scene.mode)), "the scene's mode", false, {}});
  }
  std::size_t n = 0;
  for (const auto* node : top.tables("event")) c.scene.events.push_back(read_event(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("inflow")) c.scene.inflows.push_back(read_inflow(*node, ++n, c.scene.end_time, reading));
  const bool flows = !c.scene.inflows.empty() || std::any_of(c.scene.bodies.begin(), c.scene.bodies.end(),
                                                             [](const Body& b) { return b.phase == Phase::liquid; });
  if (!c.scene.contact && flows)
    in.refuse("contact", "a liquid meets every solid by the same forces as solids meet each other: remove it");
  if (const auto stiffness = default_stiffness(c.scene))
    reading.decisions.push_back({"material.stiffness", show(stiffness->value), stiffness->rule, false, {}});
  read_judgement(top, c, reading);
  check_references(c, reading);
  out.decisions = std::move(reading.decisions);
  sort_by_table(out.decisions);
  return out;
}

}  // namespace tripoint
