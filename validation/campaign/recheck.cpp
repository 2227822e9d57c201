// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/recheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "validation/campaign/suite.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/read_case.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/experiment.hpp"
#include "validation/results/case_hash.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

// Of a value against the norm of its series: both were written with all their digits
constexpr double rounding = 1e-9;

class Recheck {
 public:
  Recheck(const Results& results, const CaseResult& stored, const Case& file, std::vector<Remark>& list)
      : results_(results), stored_(stored), file_(file), list_(list) {}

  void all() {
    if (stored_.id != file_.id)
      return say({}, fmt::format("its file {} is that of {}", stored_.file, file_.id));
    if (stored_.expect != file_.expect)
      say({}, fmt::format("expects \"{}\", and the file says \"{}\"", stored_.expect, file_.expect));
    question();
    reference();
    metrics();
    gates();
    studies();
    engines();
    values();
  }

 private:
  void say(const SourcePlace& place, const std::string& what) {
    list_.push_back({true, exit_missing, place.file.empty() ? SourcePlace{stored_.file, 1, 0} : place,
                     stored_.id, "the results are not of this case: " + what, infinity, "CHANGED"});
  }

  /// Compares the hashes of the run with those of now: an easier scene then, or other data, is seen also
  /// where limits and metrics stay.
  void question() {
    const auto now = case_hashes(stored_.file);
    if (!stored_.hashes || !now) return;
    if (stored_.hashes->scene != now->scene) say({}, "the scene was another when it was run");
    if (stored_.hashes->reference != now->reference)
      say({}, "the reference, or its data, were others when it was run");
    for (const auto& m : file_.metrics) {
      const auto then = stored_.hashes->metrics.find(m.name), today = now->metrics.find(m.name);
      if (then != stored_.hashes->metrics.end() && today != now->metrics.end() &&
          then->second != today->second)
        say(m.place, fmt::format("the metric {} was another when it was run", m.name));
    }
  }

  void reference() {
    const auto& a = stored_.reference;
    const auto b = with_source_of_file(file_.reference);
    if (a.kind != b.kind || a.function != b.function ||
        fs::path(a.file).filename() != fs::path(b.file).filename() || a.args != b.args ||
        a.uncertainty != b.uncertainty)
      say({}, "the reference is another");
  }

  void metrics() {
    for (const auto& m : file_.metrics) {
      const auto at = std::find_if(stored_.metrics.begin(), stored_.metrics.end(),
                                   [&](const auto& s) { return s.name == m.name; });
      if (at == stored_.metrics.end())
        say(m.place, "the metric " + m.name + " is not in them");
      else if (at->quantity != m.quantity || at->norm != m.norm || at->body != m.body || at->at != m.at ||
               at->scale != m.scale || at->unit != m.unit || at->window != m.window)
        say(m.place,
            fmt::format("the metric {} has another quantity, norm, body, place, window, scale or unit",
                        m.name));
    }
  }

  static bool same(const Gate& a, const Gate& b) {
    return a.metric == b.metric && a.engine == b.engine && a.mode == b.mode && a.preset == b.preset &&
           a.limit == b.limit && a.at_least == b.at_least && a.expect == b.expect && a.band == b.band &&
           a.level == b.level && a.drift == b.drift && a.date == b.date;
  }

  /// Each gate of the file must be in the results, once for each time that it is in the file.
  void gates() {
    auto left = stored_.gates;
    for (const auto& g : file_.gates) {
      const auto at = std::find_if(left.begin(), left.end(), [&](const auto& s) { return same(s, g); });
      if (at == left.end())
        say(g.place, fmt::format("the gate on {}, {}, is not in them", g.metric, describe(g)));
      else
        left.erase(at);
    }
    for (const auto& g : left)
      say({}, fmt::format("they hold a gate on {}, {}, that the file does not", g.metric, describe(g)));
  }

  void studies() {
    const auto same_study = [](const Study& a, const Study& b) {
      return a.axes == b.axes && a.levels == b.levels && a.jitter == b.jitter && a.seeds == b.seeds &&
             a.engine == b.engine && a.mode == b.mode && a.expect == b.expect && a.order == b.order &&
             a.metric == b.metric;
    };
    for (const auto& s : file_.studies)
      if (std::none_of(stored_.studies.begin(), stored_.studies.end(),
                       [&](const auto& t) { return same_study(t, s); }))
        say(s.place, fmt::format("the study over {} is not in them", to_string(s.axes.axis)));
  }

  /// Every engine of the case has its row, and every run that is planned for it.
  void engines() {
    for (const auto& e : file_.engines)
      if (e.adopted &&
          std::find(stored_.adopted.begin(), stored_.adopted.end(), e.name) == stored_.adopted.end())
        say({}, fmt::format("{} was adopted by the case, and they do not know it", e.name));
    Selection selection;
    selection.engines = results_.only_engines;
    if (results_.seed_given) selection.seed = results_.seed;
    for (const auto& plan : plan_runs(file_, {}, selection)) {
      const bool named = !file_.engines.empty() &&
                         std::any_of(file_.engines.begin(), file_.engines.end(), [&](const auto& e) {
                           return e.name == plan.name && !e.presets.empty();
                         });
      const auto at = std::find_if(stored_.engines.begin(), stored_.engines.end(), [&](const auto& e) {
        return e.name == plan.name && (!named || e.preset == plan.preset);
      });
      if (at == stored_.engines.end()) {
        say({}, fmt::format("{} has no row in them", label_of(plan.name, plan.preset)));
        continue;
      }
      if (plan.required && !at->required)
        say({}, fmt::format("{} is required, and they say that it is not", plan.name));
      if (at->status != Status::missing) runs(plan, *at);
    }
  }

  void runs(const EnginePlan& plan, const EngineRow& row) {
    for (const auto& run : plan.runs) {
      const auto folder = run_folder_name(row.preset, run.label);
      if (std::none_of(row.runs.begin(), row.runs.end(),
                       [&](const auto& r) { return fs::path(r.folder).filename() == folder; }))
        say({}, fmt::format("the run {} of {} is not in them", run.label, label_of(row.name, row.preset)));
    }
  }

  void values() {
    for (const auto& e : stored_.engines)
      for (const auto& run : e.runs)
        for (const auto& m : file_.metrics) {
          if (run.status != Status::ok) continue;
          const auto at = run.metrics.find(m.name);
          if (at == run.metrics.end()) {
            say(m.place, fmt::format("{} has no value of {} in its run {}", label_of(e.name, e.preset),
                                     m.name, run.group));
            continue;
          }
          const auto norm = value_of_series(m, at->second);
          const double value = at->second.value;
          if (norm && std::isfinite(value) &&
              !(std::abs(*norm - value) <= rounding * std::max(std::abs(*norm), std::abs(value))))
            say(m.place, fmt::format("{:.6g} of {} in {} {} is not the {} of its series, {:.6g}", value,
                                     m.name, label_of(e.name, e.preset), run.group, m.norm, *norm));
        }
  }

  const Results& results_;
  const CaseResult& stored_;
  const Case& file_;
  std::vector<Remark>& list_;
};

/// Cases that the same question would run now, and that the results do not hold.
void recheck_selection(const Results& results, std::vector<Remark>& list) {
  if (!results.filter_known || !results.shard.empty()) return;
  CaseFilter filter;
  filter.what = results.what;
  filter.profile = results.profile;
  filter.tag = results.tag;
  const auto say = [&](const std::string& id, const std::string& what) {
    list.push_back({true, exit_missing, {}, id, what, infinity, "CHANGED"});
  };
  try {
    for (const auto& c : select_cases(filter))
      if (std::none_of(results.cases.begin(), results.cases.end(),
                       [&](const auto& r) { return r.id == c.id; }))
        say(c.id, "belongs to these results and is not in them: validate again");
  } catch (const std::exception& e) {
    say("the results", std::string("the cases that they are of cannot be listed again: ") + e.what());
  }
}

}  // namespace

std::vector<Remark> recheck_remarks(const Results& results) {
  std::vector<Remark> list;
  for (const auto& c : results.cases) {
    try {
      const auto file = read_case(c.file).value;
      Recheck(results, c, file, list).all();
    } catch (const std::exception& e) {
      list.push_back({true,
                      exit_missing,
                      {c.file, 1, 0},
                      c.id,
                      std::string("the case cannot be read again: ") + e.what(),
                      infinity,
                      "CHANGED"});
    }
  }
  recheck_selection(results, list);
  return list;
}

}  // namespace tripoint
