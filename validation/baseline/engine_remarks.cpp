// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>

#include "validation/baseline/baseline_rows.hpp"
#include "validation/campaign/case_run.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/finished_run.hpp"

/// The engines that made the results, beside those that are here now and those that were accepted.
namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// "1.10.2" as numbers; none where it is no row of numbers: a date or a word cannot be compared.
std::optional<std::vector<long>> numbers_of(const std::string& version) {
  std::vector<long> numbers;
  std::istringstream in(version.starts_with("v") ? version.substr(1) : version);
  for (std::string part; std::getline(in, part, '.');) {
    if (part.empty() || part.size() > 9 || part.find_first_not_of("0123456789") != std::string::npos)
      return {};
    numbers.push_back(std::stol(part));
  }
  if (numbers.empty()) return {};
  while (numbers.size() > 1 && numbers.back() == 0) numbers.pop_back();  // 2.0 is 2
  return numbers;
}

bool is_lower(const std::string& now, const std::string& then) {
  const auto a = numbers_of(now), b = numbers_of(then);
  return a && b && *a < *b;
}

Remark warning(const CaseResult& c, const std::string& engine, const std::string& text) {
  return {false, 0, {c.file, 1, 0}, c.id + " " + engine, text, 1.0, {}};
}

/// A report that is older than the engine says nothing of the engine as it is.
void compare_programs(const Results& results, std::vector<Remark>& list) {
  std::set<std::string> named;
  std::error_code none;
  for (const auto& c : results.cases)
    for (const auto& e : c.engines) {
      if (e.executable.empty() || !fs::is_regular_file(e.executable, none) ||
          !named.insert(e.executable).second)
        continue;
      if (program_hash(e.executable) == e.executable_hash) continue;
      list.push_back(
          {true,
           exit_missing,
           {},
           e.name,
           fmt::format(
               "the results are not of this engine: {} has changed since they were made; validate again",
               one_line(e.executable)),
           infinity,
           "CHANGED"});
    }
}

/// An adopted engine's run is repeated; what differs is the reason of a run that is ok.
void name_untrue_flags(const Results& results, std::vector<Remark>& list) {
  for (const auto& c : results.cases)
    for (const auto& e : c.engines)
      for (const auto& run : e.runs)
        if (run.status == Status::ok && run.reason.starts_with(untrue_flag))
          list.push_back(warning(c, e.name, one_line(run.reason)));
}

const AcceptedEngine* accepted(const Baseline& b, const std::string& name) {
  const auto at =
      std::find_if(b.engines.begin(), b.engines.end(), [&](const auto& e) { return e.name == name; });
  return at == b.engines.end() ? nullptr : &*at;
}

/// A value that differs from the accepted one, where program, seed and scene are the same.
std::string belied(const CaseResult& c, const EngineRow& e, const Baseline& b) {
  const auto now = gates_of(c, {});
  for (std::size_t k = 0; k < now.size(); ++k) {
    const auto* old = now[k].engine == e.name && now[k].preset == preset_unless_default(e.preset)
                          ? counterpart(now, k, b.gates)
                          : nullptr;
    if (old && old->value != now[k].value)
      return fmt::format("{} was {:.9g} and is {:.9g}", now[k].metric, old->value, now[k].value);
  }
  return {};
}

void compare_engine(const Results& results, const CaseResult& c, const EngineRow& e, const Baseline& b,
                    std::vector<Remark>& list) {
  const auto* old = accepted(b, e.name);
  if (!old) return;
  if (is_lower(e.version, old->version))
    list.push_back(warning(c, e.name,
                           fmt::format("its version has fallen from {}, which was accepted, to {}",
                                       one_line(old->version), one_line(e.version))));
  const auto hashes = case_hashes(c.file);
  if (!e.deterministic || old->executable.empty() || old->executable != e.executable_hash ||
      results.seed != b.seed || !hashes || hashes->scene != b.scene)
    return;
  if (const auto how = belied(c, e, b); !how.empty())
    list.push_back(warning(
        c, e.name,
        "says that it is deterministic, and the same program gave another value than was accepted: " + how));
}

}  // namespace

std::vector<Remark> engine_remarks(const Results& results, const std::string& root) {
  std::vector<Remark> list;
  compare_programs(results, list);
  name_untrue_flags(results, list);
  for (const auto& c : results.cases) {
    const auto file = baseline_file(c.file, root);
    if (!fs::exists(file)) continue;
    const auto b = read_baseline(file);
    for (const auto& e : c.engines) compare_engine(results, c, e, b, list);
  }
  return list;
}

}  // namespace tripoint
