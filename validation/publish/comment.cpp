// SPDX-License-Identifier: BSD-3-Clause
#include "validation/publish/comment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>

#include "tables/text_table.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/judge/physics.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t named = 20;        // rows of a list below the table; the rest is counted
constexpr std::size_t longest = 60'000;  // a comment holds 65536 characters

struct Count {
  int green = 0, all = 0;
};

Count gates_of(const Results& r) {
  Count n;
  for (const auto& c : r.cases)
    for (const auto& e : c.engines)
      for (const auto& g : e.gates) {
        ++n.all;
        n.green += g.verdict == Verdict::pass;
      }
  return n;
}

/// The path of a file as its repository knows it: relative to the working folder; empty where it lies
/// elsewhere.
std::string path_in_repository(const std::string& file) {
  std::error_code none;
  auto path = fs::path(file).lexically_normal();
  if (path.is_absolute()) path = path.lexically_relative(fs::current_path(none));
  const auto text = path.generic_string();
  return text.empty() || text.starts_with("..") ? std::string() : text;
}

std::string linked(const std::string& text, const SourcePlace& place, const std::string& links) {
  const auto path = path_in_repository(place.file);
  if (links.empty() || path.empty()) return markdown(text);
  return fmt::format("[{}]({}/{}{})", markdown(text), links, url_path(path),
                     place.line > 1 ? fmt::format("#L{}", place.line) : "");
}

std::string limit_of(const MetricChange& c) {
  const std::string& base = c.base ? c.base->allows : c.head->allows;
  const std::string& head = c.head ? c.head->allows : c.base->allows;
  const std::string first = base.empty() ? "no limit" : base, second = head.empty() ? "no limit" : head;
  return first == second ? first : first + " -> " + second;
}

/// "0.4 -> 0.5 of limit 0.01"
std::string used_of_limit(const MetricChange& c) {
  return fmt::format("{} of {}", used_text(c), markdown(limit_of(c)));
}

TextTable::Cells row_of(const MetricChange& c, const CommentOptions& o) {
  return {c.trend == Trend::same ? "same" : fmt::format("**{}**", word_of(c.trend)),
          change_text(c),
          linked(c.case_id, c.place, o.links),
          markdown(name_of(c)),
          markdown(values_text(c)),
          used_of_limit(c),
          markdown(noise_text(c))};
}

std::string table_of(const Comparison& all, const CommentOptions& o) {
  TextTable table(
      {{""}, {"change", 0, true}, {"case"}, {"metric"}, {"base -> head"}, {"of the limit"}, {"noise"}});
  std::size_t count = 0;
  for (const auto& c : all.changes) {
    const bool moved = c.trend == Trend::better || c.trend == Trend::worse ||
                       (c.trend == Trend::same && std::abs(c.change) >= least_change);
    if (moved && count < o.most) {
      ++count;
      table.add(row_of(c, o));
    }
  }
  if (table.empty()) return "No metric of the base has changed by a thousandth of its limit or more.\n";
  return table.markdown() +
         "\nChanges and noise are in units of the limit; above 0 is worse, 1 is all that the limit allows. A "
         "change counts when "
         "it is larger than its noise.\n";
}

/// New and lost values, by name.
std::string arrivals(const Comparison& all, Trend trend, const CommentOptions& o) {
  std::string text;
  std::size_t count = 0;
  for (const auto& c : all.changes) {
    if (c.trend != trend || ++count > named) continue;
    text += fmt::format("- {}: {} {}: {}, {}\n", word_of(trend), linked(c.case_id, c.place, o.links),
                        markdown(name_of(c)), markdown(values_text(c)), used_of_limit(c));
  }
  return count > named ? text + fmt::format("- and {} more\n", count - named) : text;
}

/// Errors, and warnings of a comparison; other warnings are counted, since the log holds them.
std::string not_green(const GateVerdict& verdict, const CommentOptions& o) {
  std::string text;
  std::size_t errors = 0, warnings = 0;
  for (const auto& r : verdict.remarks) {
    if (!r.error)
      ++warnings;
    else if (++errors <= named)
      text += fmt::format("- {}: {}\n",
                          r.place.file.empty() ? markdown(r.title) : linked(r.title, r.place, o.links),
                          markdown(r.text));
  }
  if (errors > named) text += fmt::format("- and {} more\n", errors - named);
  if (!text.empty()) text = "\n### Not green\n\n" + text;
  return warnings > 0 ? text + fmt::format("\n{} warning{} in the log of the gate.\n", warnings,
                                           warnings == 1 ? "" : "s")
                      : text;
}

/// Judged metrics, those that use most of their limits first, for results without a base.
std::string most_used(const Results& results, const CommentOptions& o) {
  auto all = compare_results(results, results, {});
  std::erase_if(all.changes, [](const auto& c) { return !std::isfinite(c.head->used); });
  std::ranges::stable_sort(all.changes, std::greater{},
                           [](const auto& c) { return c.head ? c.head->used : 0.0; });
  if (all.changes.empty()) return "";
  TextTable table({{"case"}, {"metric"}, {"value"}, {"of the limit"}});
  for (std::size_t k = 0; k < std::min(o.most, all.changes.size()); ++k) {
    auto c = all.changes[k];
    c.base.reset();
    table.add({linked(c.case_id, c.place, o.links), markdown(name_of(c)), markdown(values_text(c)),
               used_of_limit(c)});
  }
  return table.markdown();
}

std::string names_of(const CommentOptions& o) {
  std::string text;
  if (!o.head.empty()) text += "; head " + o.head;
  if (!o.base.empty()) text += "; base " + o.base;
  return text;
}

std::string engines_of(const Results& results) {
  std::map<std::string, std::string> versions;
  for (const auto& c : results.cases)
    for (const auto& e : c.engines)
      if (!is_exact(e.name) && e.status == Status::ok) versions[e.name] = e.version;
  std::string text;
  for (const auto& [name, version] : versions)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, version);
  return text;
}

std::string verdict_text(const GateVerdict& verdict, const CommentOptions& o) {
  return o.informational && verdict.code != exit_pass
             ? fmt::format("{} (informational: nothing is blocked)", verdict.word)
             : verdict.word;
}

}  // namespace

std::string comment_markdown(const Results& results, const GateVerdict& verdict, const Comparison* against,
                             const CommentOptions& o) {
  const auto gates = gates_of(results);
  std::string text =
      fmt::format("{}\n## Accuracy: {}\n\n{} of {} gates pass in {} case{}; {}; {}{}.\n", comment_mark,
                  verdict_text(verdict, o), gates.green, gates.all, results.cases.size(),
                  results.cases.size() == 1 ? "" : "s", physics_counts(results),
                  markdown(engines_of(results)), markdown(names_of(o)));
  if (!o.note.empty()) text += "\n" + markdown(o.note) + "\n";
  if (against) {
    text += fmt::format("\n**{}**\n\n", counts_text(*against)) + table_of(*against, o);
    for (const auto& remark : against->remarks) text += fmt::format("\nNote: {}.\n", markdown(remark));
    const auto listed = arrivals(*against, Trend::appeared, o) + arrivals(*against, Trend::gone, o);
    if (!listed.empty()) text += "\n### New and gone\n\n" + listed;
  } else {
    text += "\n" + most_used(results, o);
  }
  text += not_green(verdict, o);
  if (text.size() > longest)
    text = text.substr(0, text.rfind('\n', longest)) + "\n\n(cut; the rest is in the report)\n";
  return text;
}

std::string comment_text(const Results& results, const GateVerdict& verdict, const Comparison* against,
                         const CommentOptions& o) {
  const auto gates = gates_of(results);
  std::string text =
      one_line(fmt::format("accuracy {}: {} of {} gates pass in {} cases; {}; {}{}", verdict_text(verdict, o),
                           gates.green, gates.all, results.cases.size(), physics_counts(results),
                           engines_of(results), names_of(o))) +
      "\n";
  if (!o.note.empty()) text += one_line(o.note) + "\n";
  if (against) text += changes_table(*against);
  return text + remarks_text(verdict.remarks);
}

}  // namespace tripoint
