// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/name_checks.hpp"
#include "tables/nearest.hpp"
#include "validation/case/case.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/case/judge_readers.hpp"
#include "validation/case/known_defect.hpp"

/// Rules between the tables that judge: names that refer to each other, and the effect of one key on another.
namespace tripoint {
namespace {

class JudgementChecker : NameChecks {
 public:
  JudgementChecker(const Case& c, const Reading& reading) : NameChecks(reading), case_(c), scene_(c.scene) {}

  void check() const {
    unique(case_.metrics, "metric");
    std::size_t n = 0;
    for (const auto& m : case_.metrics) {
      if (!m.body.empty()) {
        std::vector<std::string> born;
        for (const auto& e : scene_.events)
          if (!e.name.empty()) born.push_back(e.name);
        known_body(scene_, m.body, fmt::format("metric.{}.body", m.name), m.place, born);
      }
      if (m.window[0] > scene_.end_time)
        throw InputError(place(fmt::format("metric.{}.window", m.name), m.place),
                         fmt::format("the window begins after end_time = {} s", scene_.end_time));
    }
    for (const auto& s : case_.studies) {
      const auto path = fmt::format("study.{}", ++n);
      known_engine(s.engine, path + ".engine", s.place);
      if (!s.metric.empty()) known_metric(s.metric, path + ".metric", s.place);
      known_mode(s.mode, path + ".mode", s.place);
    }
    n = 0;
    for (const auto& g : case_.gates) gate(g, fmt::format("gate.{}", ++n));
    n = 0;
    for (const auto& d : case_.defects) {
      const auto path = fmt::format("defect.{}", ++n);
      for (const auto& metric : d.killed_by) known_metric(metric, path + ".killed_by", d.place);
    }
  }

 private:
  void known_engine(const std::string& name, const std::string& key, const SourcePlace& table) const {
    if (name.empty() || case_.engines.empty()) return;  // no [engines]: whatever engine is there runs
    const auto known = names_of(case_.engines);
    if (!holds(known, name))
      throw InputError(place(key, table),
                       fmt::format("`{}`: this case runs no engine \"{}\"{}; add [engines.{}]", key,
                                   printable(name), suggestion(name, known), printable(name)));
  }

  void known_metric(const std::string& name, const std::string& key, const SourcePlace& table) const {
    const auto known = names_of(case_.metrics);
    if (holds(known, name) || holds(known, metric_of_gate(fitted_metric(name)))) return;
    throw InputError(place(key, table), fmt::format("`{}`: no [[metric]] is named \"{}\"{}", key,
                                                    printable(name), suggestion(name, known)));
  }

  void known_mode(JudgedMode mode, const std::string& key, const SourcePlace& table) const {
    if (mode == JudgedMode::none || mode == JudgedMode::not_paper) return;
    if (std::find(case_.modes.begin(), case_.modes.end(), mode_from(to_string(mode))) == case_.modes.end())
      throw InputError(
          place(key, table),
          fmt::format("`{}`: this case does not run mode \"{}\": add it to case.modes", key, mode));
  }

  /// The case's own run stands in a study over one axis too, at the value that the scene has there.
  [[nodiscard]] bool is_own_level(const StudyAxes& axes, double level) const {
    const std::optional<double> own = !axes.alone()                      ? std::nullopt
                                      : axes.axis == Axis::spacing       ? std::optional(scene_.spacing)
                                      : axes.axis == Axis::support_ratio ? std::optional(scene_.support_ratio)
                                      : axes.axis == Axis::time_step     ? scene_.time_step
                                                                         : std::nullopt;
    return own && std::abs(*own - level) <= 1e-9 * level;
  }

  void gate(const Gate& g, const std::string& path) const {
    known_metric(g.metric, path + ".metric", g.place);
    known_engine(g.engine, path + ".engine", g.place);
    known_mode(g.mode, path + ".mode", g.place);
    known_defect(g, path);
    if (is_of_ladder(g.metric) && case_.studies.empty() && !holds(names_of(case_.metrics), g.metric))
      throw InputError(
          place(path + ".metric", g.place),
          fmt::format("`{}.metric`: \"{}\" needs a [[study]] to find it with", path, printable(g.metric)));
    if (!g.level) return;
    for (const auto& s : case_.studies)
      if (is_own_level(s.axes, *g.level) || std::any_of(s.levels.begin(), s.levels.end(), [&](double l) {
            return std::abs(l - *g.level) <= 1e-9 * l;
          }))
        return;
    throw InputError(
        place(path + ".level", g.place),
        fmt::format("`{}.level` = {}: no [[study]] has this level: write one of its levels, or remove it",
                    path, *g.level));
  }

  /// "known defect NAME: ..." declares a defect of the engine. It is that of a named engine, is measured from
  /// below too, and excuses from a limit that is there.
  void known_defect(const Gate& g, const std::string& path) const {
    if (tripoint::known_defect(g).empty()) return;
    const auto refuse = [&](const std::string& what) {
      throw InputError(place(path + ".reason", g.place), fmt::format("`{}.reason`: {}", path, what));
    };
    if (g.engine.empty() || !(g.band || g.at_least || g.expect))
      refuse(
          "a known defect is that of a named engine, and measured from below too: give engine, and band or "
          "at_least");
    if (std::none_of(case_.gates.begin(), case_.gates.end(),
                     [&](const Gate& a) { return a.engine.empty() && a.metric == g.metric; }))
      refuse(fmt::format("no gate without engine is on \"{}\": there is no limit to be excused from",
                         printable(g.metric)));
  }

  const Case& case_;
  const Scene& scene_;
};

}  // namespace

void check_judgement(const Case& c, const Reading& reading) { JudgementChecker(c, reading).check(); }

}  // namespace tripoint
