// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "validation/case/engine_names.hpp"
#include "validation/judge/judge.hpp"

namespace tripoint {
namespace {

/// Outcome of one engine over all cases.
struct Answer {
  int rows = 0, missing = 0, refused = 0, ran = 0, judged = 0;
  std::string why;      ///< of the first row that did not run
  std::string crashed;  ///< the first row that ended otherwise than it should
  std::string partly;   ///< the first case of which it ran some and refused the rest
};

Answer answer_of(const Results& results, const std::string& name) {
  Answer a;
  for (const auto& c : results.cases)
    for (const auto& e : c.engines) {
      if (e.name != name) continue;
      ++a.rows;
      a.missing += e.status == Status::missing;
      a.refused += e.status == Status::refused;
      a.ran += std::any_of(e.runs.begin(), e.runs.end(), [](const auto& r) {
        return r.status == Status::ok || r.status == Status::diverged;
      });
      a.judged += std::any_of(e.gates.begin(), e.gates.end(),
                              [](const auto& g) { return g.verdict != Verdict::missing; });
      if (e.status != Status::ok && a.why.empty())
        a.why = fmt::format("{} in {}: {}", e.status, c.id, e.reason);
      const auto refused = std::find_if(e.runs.begin(), e.runs.end(),
                                        [](const auto& r) { return r.status == Status::refused; });
      const bool some_ran =
          std::any_of(e.runs.begin(), e.runs.end(), [](const auto& r) { return r.status == Status::ok; });
      if (refused != e.runs.end() && some_ran && a.partly.empty())
        a.partly = fmt::format("{} ({})", c.id, refused->reason);
      if ((e.status == Status::killed || e.status == Status::timeout || e.status == Status::error) &&
          a.crashed.empty())
        a.crashed = fmt::format("{} in {}: {}", e.status, c.id, e.reason);
    }
  return a;
}

/// "2/4" is a part of a suite, and another part may judge the rest; "1/1" is the whole.
bool is_part(const std::string& shard) { return !shard.empty() && !shard.ends_with("/1"); }

}  // namespace

std::vector<std::string> unanswered(const Results& results) {
  std::vector<std::string> list;
  const bool part = is_part(results.shard);
  for (const auto& name : results.asked) {
    const auto a = answer_of(results, name);
    if (a.rows == a.missing && !(part && a.rows == 0))
      list.push_back(
          fmt::format("{} was asked for and is not there{}", name, a.why.empty() ? "" : "; " + a.why));
    else if (!a.crashed.empty())
      list.push_back(fmt::format("{} was asked for and is {}", name, a.crashed));
    else if (!a.partly.empty())
      list.push_back(
          fmt::format("{} was asked for, and ran a part of {} and refused the rest", name, a.partly));
    else if (part || is_exact(name))
      continue;
    else if (a.ran == 0 && a.refused == a.rows)
      list.push_back(
          fmt::format("{} was asked for and ran no case; it refuses {}, and nothing of it is judged: leave "
                      "it out, or ask for a "
                      "case that it takes; {}",
                      name, a.rows == 1 ? "the one case" : fmt::format("all {} cases", a.rows), a.why));
    else if (a.ran == 0)
      list.push_back(fmt::format("{} was asked for and ran no case; {}", name, a.why));
    else if (a.judged == 0)
      list.push_back(
          fmt::format("{} was asked for, ran {} case{}, and is not judged: no gate names it, and none is for "
                      "every engine "
                      "([[gate]] engine = \"{}\", or none)",
                      name, a.ran, a.ran == 1 ? "" : "s", name));
  }
  return list;
}

}  // namespace tripoint
