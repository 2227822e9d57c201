// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "tables/library.hpp"
#include "tables/text_table.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/publish/scorecard.hpp"
#include "validation/results/json_text.hpp"
#include "validation/run/process.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr double page_limit = 120.0;     // [s]
constexpr std::size_t most_in_full = 4;  // engines whose rows the terminal shows; of more it shows the totals

bool ran(const ScoreRow& r) { return r.verdict != Score::refused && r.verdict != Score::missing; }

std::string figure(double value, const char* form = "{:.3g}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(form), value) : "-";
}

std::string error_cell(const ScoreRow& r) {
  return std::isfinite(r.error) ? fmt::format("{:.3g} ({})", r.error, r.allowed) : "-";
}

std::string order_cell(const ScoreRow& r) {
  if (!r.order_class) return "-";
  return std::isfinite(r.order) ? fmt::format("{:.1f} {}", r.order, *r.order_class)
                                : std::string(to_string(*r.order_class));
}

std::string drift_cell(const ScoreRow& r) {
  return std::isfinite(r.drift) ? fmt::format("{} {:.2g}", r.drift_metric, r.drift) : "-";
}

std::string rank_cell(const ScoreRow& r) { return r.rank > 0 ? fmt::format("{} of {}", r.rank, r.of) : "-"; }

std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// "12 pass, 1 fail, 14 refused": counts of 0 are left out, except pass and fail.
std::string tally(const EngineScore& s) {
  std::string text;
  for (const auto v : all_of<Score>())
    if (const int n = s.count(v); n > 0 || v == Score::pass || v == Score::fail)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, v);
  return text;
}

double cpu_of(const EngineScore& s) {
  double sum = 0.0;
  for (const auto& r : s.rows)
    if (std::isfinite(r.cpu_s)) sum += r.cpu_s;
  return sum;
}

int firsts(const EngineScore& s) {
  return static_cast<int>(
      std::count_if(s.rows.begin(), s.rows.end(), [](const auto& r) { return r.rank == 1 && r.of > 1; }));
}

/// Refusals with one reason stand together.
std::vector<std::pair<std::string, std::vector<std::string>>> refusals(const EngineScore& s) {
  std::vector<std::pair<std::string, std::vector<std::string>>> list;
  for (const auto& r : s.rows) {
    if (ran(r)) continue;
    const auto words =
        fmt::format("{}{}{}", r.verdict, r.reason.starts_with("as expected: ") ? ", " : ": ", r.reason);
    const auto at = std::find_if(list.begin(), list.end(), [&](const auto& l) { return l.first == words; });
    if (at == list.end())
      list.push_back({words, {r.case_id}});
    else
      at->second.push_back(r.case_id);
  }
  return list;
}

/// ": reason. cause", as far as there are any.
std::string because(const ScoreRow& r) {
  return (r.reason.empty() ? "" : ": " + r.reason) +
         (r.cause.empty() ? "" : (r.reason.empty() ? ": " : ". ") + r.cause);
}

TextTable::Cells row_of(const ScoreRow& r) {
  return {std::string(to_string(r.verdict)),
          r.case_id,
          error_cell(r),
          order_cell(r),
          drift_cell(r),
          figure(r.cpu_s, "{:.2f}"),
          figure(r.cost, "{:.2g}"),
          rank_cell(r)};
}

std::string rows_text(const EngineScore& s) {
  TextTable table({{"verdict", 13},
                   {"case", 26},
                   {"error (limit)", -28},
                   {"order", -10},
                   {"drift", -18},
                   {"CPU s", -8},
                   {"x ours", -7},
                   {"rank", -8}});
  for (const auto& r : s.rows) {
    if (!ran(r)) continue;
    table.add(row_of(r));
    for (const auto& line : {r.reason, r.cause})
      if (!line.empty()) table.note("                " + line);
  }
  std::string text =
      fmt::format("\nscorecard of {} {}: {}\n", s.label(), s.version, tally(s)) + table.text("  ");
  for (const auto& [reason, ids] : refusals(s))
    text += fmt::format("  {} ({} case{})\n", reason, ids.size(), ids.size() == 1 ? "" : "s");
  return text;
}

/// A row an engine. Markdown has room for its version.
TextTable totals(const Scorecard& card, bool is_markdown) {
  TextTable table({{"engine", 34},
                   {"pass", -5},
                   {"fail", -5},
                   {is_markdown ? "known defect" : "known", -6},
                   {"refused", -8},
                   {"missing", -8},
                   {"crashed", -8},
                   {"first", -6},
                   {"CPU s", -9}});
  for (const auto& s : card.engines) {
    const int fails = s.count(Score::fail) + s.count(Score::inconclusive) + s.count(Score::not_judged);
    TextTable::Cells cells{is_markdown ? s.label() + " " + s.version : s.label()};
    for (const int n :
         {s.count(Score::pass), fails, s.count(Score::known_defect), s.count(Score::refused),
          s.count(Score::missing), s.count(Score::crashed) + s.count(Score::diverged), firsts(s)})
      cells.push_back(std::to_string(n));
    cells.push_back(is_markdown ? fmt::format("{:.1f}", cpu_of(s)) : fmt::format("{:.2f}", cpu_of(s)));
    table.add(cells);
  }
  return table;
}

std::string rows_markdown(const EngineScore& s) {
  TextTable table(
      {{"case"}, {"verdict"}, {"error"}, {"order"}, {"drift"}, {"CPU s"}, {"times ours"}, {"rank"}});
  for (const auto& r : s.rows) {
    if (!ran(r)) continue;
    auto cells = row_of(r);
    std::swap(cells[0], cells[1]);
    cells[1] += cell(because(r));
    if (std::isfinite(r.error) && !r.unit.empty()) cells[2] += " " + cell(r.unit);
    cells[4] = cell(cells[4]);
    table.add(cells);
  }
  std::string text = fmt::format("\n## {} {}\n\n{}.\n", s.label(), s.version, tally(s));
  if (!table.empty()) text += "\n" + table.markdown();
  const auto list = refusals(s);
  if (!list.empty()) text += "\n";
  for (const auto& [reason, ids] : list)
    text += fmt::format("- {}: {}\n", cell(reason), fmt::join(ids, ", "));
  return text;
}

std::string disagreement_markdown(const Disagreement& d) {
  std::string text = fmt::format("\n### {}\n\n{} and {} are {:.3g} {} apart in `{}` ({}).\n\n", d.case_id,
                                 d.a, d.b, d.difference, cell(d.unit), d.metric, d.allowed);
  TextTable table({{"engine"}, {"off the truth"}, {"verdict"}, {"the setting, in the vendor's words"}});
  for (const auto& w : d.witnesses)
    table.add({w.label, fmt::format("{:.3g}", w.error), std::string(to_string(w.verdict)), cell(w.words)});
  return text + table.markdown();
}

Json json(const WorstLimit& w) {
  return {{"metric", w.metric},
          {"unit", w.unit},
          {"allowed", w.allowed},
          {"value", json_number(w.value)},
          {"share", json_number(w.share)}};
}

Json json(const ScoreRow& r) {
  return {{"case", r.case_id},
          {"title", r.title},
          {"verdict", r.verdict},
          {"reason", r.reason},
          {"defect", r.defect},
          {"cause", r.cause},
          {"metric", r.metric},
          {"unit", r.unit},
          {"error", json_number(r.error)},
          {"allowed", r.allowed},
          {"share", json_number(r.share)},
          {"worst", json(r.worst)},
          {"order", json_number(r.order)},
          {"order_metric", r.order_metric},
          {"order_class", r.order_class ? to_string(*r.order_class) : ""},
          {"drift", json_number(r.drift)},
          {"drift_metric", r.drift_metric},
          {"cpu_s", json_number(r.cpu_s)},
          {"cost", json_number(r.cost)},
          {"rank", r.rank},
          {"of", r.of}};
}

Json json(const EngineScore& s) {
  Json rows = Json::array(), totals = Json::object();
  for (const auto& r : s.rows) rows.push_back(json(r));
  for (const auto v : all_of<Score>()) totals[std::string(to_string(v))] = s.count(v);
  return {{"engine", s.engine}, {"preset", s.preset}, {"label", s.label()}, {"version", s.version},
          {"totals", totals},   {"first", firsts(s)}, {"cpu_s", cpu_of(s)}, {"rows", rows}};
}

Json json(const Disagreement& d) {
  Json witnesses = Json::array();
  for (const auto& w : d.witnesses)
    witnesses.push_back(
        {{"engine", w.label}, {"verdict", w.verdict}, {"error", json_number(w.error)}, {"words", w.words}});
  return {{"case", d.case_id},
          {"metric", d.metric},
          {"unit", d.unit},
          {"allowed", d.allowed},
          {"a", d.a},
          {"b", d.b},
          {"difference", json_number(d.difference)},
          {"engines", witnesses}};
}

}  // namespace

std::string scorecard_text(const Scorecard& card, const std::vector<std::string>& asked) {
  std::vector<const EngineScore*> shown;
  for (const auto& s : card.engines)
    if (std::find(asked.begin(), asked.end(), s.engine) != asked.end()) shown.push_back(&s);
  std::string text;
  if (shown.size() <= most_in_full)
    for (const auto* s : shown) text += rows_text(*s);
  return text + "\n" + totals(card, false).text() +
         (card.disagreements.empty() ? ""
                                     : fmt::format("in {} cases two engines differ by more than half of the "
                                                   "limit: the page says which is how far off\n",
                                                   card.disagreements.size()));
}

std::string scorecard_markdown(const Scorecard& card) {
  std::string text = fmt::format(
      "# Acceptance: engines by the limits that any engine must hold\n\nWritten by `{}`: {}, exit {}.\n\n",
      card.command, card.verdict, card.exit_code);
  text +=
      "`first` counts the cases in which an engine has the smallest error of several. An engine that fails a "
      "case, or holds it "
      "by "
      "a known defect, has no rank there. `CPU s` is the sum over its own runs of "
      "the cases, studies left out.\n\n" +
      totals(card, true).markdown();
  for (const auto& s : card.engines) text += rows_markdown(s);
  if (!card.disagreements.empty())
    text +=
        "\n## Where engines disagree\n\nTwo engines differ by more than half of the limit. The error of each "
        "is against the "
        "exact solution.\n";
  for (const auto& d : card.disagreements) text += disagreement_markdown(d);
  return text;
}

std::string scorecard_json(const Scorecard& card) {
  Json engines = Json::array(), disagreements = Json::array();
  for (const auto& s : card.engines) engines.push_back(json(s));
  for (const auto& d : card.disagreements) disagreements.push_back(json(d));
  return json_text(Json{{"format", 1},
                        {"command", card.command},
                        {"verdict", card.verdict},
                        {"exit_code", card.exit_code},
                        {"date", card.date},
                        {"commit", card.commit},
                        {"engines", engines},
                        {"disagreements", disagreements}});
}

std::string write_scorecard(const Scorecard& card, const std::string& folder) {
  const fs::path out = fs::absolute(folder);
  fs::create_directories(out);
  fs::remove(out / "scorecard.html");  // an old page must not stand for new results
  write_durably((out / "scorecard.json").string(), scorecard_json(card));
  write_durably((out / "scorecard.md").string(), scorecard_markdown(card));
  ProcessSpec spec;
  spec.argv = {python_program(), (fs::path(share_folder()) / "reports" / "scorecard.py").string(),
               (out / "scorecard.json").string()};
  spec.wall_limit = page_limit;
  spec.outlives_interrupt = true;
  spec.log = (out / "scorecard.log").string();
  const auto end = run_process(spec);
  if (end.how == ProcessEnd::How::exited && end.code == 0 && fs::exists(out / "scorecard.html")) return {};
  return fmt::format("the page of the scorecard {}: {}", describe(end), end.log_tail);
}

}  // namespace tripoint
