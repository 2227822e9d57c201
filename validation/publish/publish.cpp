// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/judge/apply_gate.hpp"
#include "validation/publish/comment.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

/// For programs that put a name into a page or a table as it is: no markup is left in it.
std::string harmless(const std::string& text) {
  auto out = one_line(text);
  std::replace_if(
      out.begin(), out.end(),
      [](char c) { return c == '<' || c == '>' || c == '|' || c == '`' || c == '&' || c == '@'; }, '?');
  return out;
}

struct Badge {
  std::string message, colour;
};

Badge badge_of(const Results& results, const GateVerdict& verdict) {
  int all = 0, green = 0;
  for (const auto& c : results.cases)
    for (const auto& e : c.engines)
      for (const auto& g : e.gates) {
        ++all;
        green += g.verdict == Verdict::pass;
      }
  const std::string count = fmt::format("{}/{} gates", green, all);
  if (verdict.code == exit_pass) return {count, "#2e7d32"};
  const bool open =
      verdict.code == exit_inconclusive || verdict.code == exit_cost || verdict.code == exit_interrupted;
  return {fmt::format("{}, {}", verdict.word, count), open ? "#b26a00" : "#c62828"};
}

/// Width of a text in Verdana 11, near enough for a box around it [px].
int width_of(const std::string& text) {
  return static_cast<int>(6.8 * static_cast<double>(text.size())) + 12;
}

std::string svg_of(const std::string& label, const Badge& badge) {
  const int left = width_of(label), right = width_of(badge.message);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="20" role="img" aria-label="{3}: {4}"><title>{3}: {4}</title>
<rect width="{1}" height="20" fill="#444"/><rect x="{1}" width="{2}" height="20" fill="{5}"/>
<g fill="#fff" text-anchor="middle" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11"><text x="{6}" y="14">{3}</text><text x="{7}" y="14">{4}</text></g></svg>
)",
      left + right, left, right, xml(label), xml(badge.message), badge.colour, left / 2, left + right / 2);
}

}  // namespace

std::string badge_text(const Results& results, const GateVerdict& verdict, bool json) {
  const auto badge = badge_of(results, verdict);
  if (!json) return svg_of("accuracy", badge);
  Json answer;
  answer["schemaVersion"] = 1;
  answer["label"] = "accuracy";
  answer["message"] = badge.message;
  answer["color"] = badge.colour;
  return json_text(answer);
}

std::string dashboard_json(const Results& results, bool in_limits) {
  Json list = Json::array();
  for (const auto& c : compare_results(results, results, {}).changes) {
    const auto& s = *c.head;
    // a class, a metric without a gate, no value
    if (!std::isfinite(s.used) || !std::isfinite(s.value)) continue;
    // Of one result, not of a difference of two
    const double range = in_limits ? c.noise / std::sqrt(2.0) : 2.0 * s.noise;
    Json entry;
    entry["name"] = harmless(fmt::format("{} {}", c.case_id, name_of(c)));
    entry["unit"] = in_limits        ? std::string("of the limit")
                    : c.unit.empty() ? std::string("1")
                                     : harmless(c.unit);
    entry["value"] = in_limits ? s.used : s.value;
    entry["range"] = fmt::format("\u00b1 {:.3g}", range);
    entry["extra"] =
        harmless(fmt::format("{}: {} {}, {}", s.verdict, fmt::format("{:.6g}", s.value), c.unit, s.allows));
    list.push_back(entry);
  }
  return json_text(list);
}

std::string sarif_text(const GateVerdict& verdict) {
  Json results = Json::array();
  for (const auto& r : verdict.remarks) {
    Json result;
    result["ruleId"] = !r.word.empty() ? r.word : r.error ? verdict_word(r.code) : std::string("WARNING");
    result["level"] = r.error ? "error" : "warning";
    result["message"]["text"] = one_line(r.title + ": " + r.text);
    if (!r.place.file.empty()) {
      Json location;
      location["physicalLocation"]["artifactLocation"]["uri"] = url_path(r.place.file);
      location["physicalLocation"]["region"]["startLine"] = std::max(r.place.line, 1);
      result["locations"].push_back(location);
    }
    results.push_back(result);
  }
  Json run;
  run["tool"]["driver"]["name"] = "tripoint";
  run["tool"]["driver"]["version"] = this_tool().version;
  run["results"] = results;
  Json document;
  document["version"] = "2.1.0";
  document["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  document["runs"].push_back(run);
  return json_text(document);
}

}  // namespace tripoint
