// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/accuracy_cost.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "scene/scene.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

/// Replicas of one level as one point: mean value with its uncertainty, mean seconds.
std::optional<LadderPoint> point_of(const std::vector<const RunRow*>& runs, Axis axis, double level,
                                    const std::string& metric) {
  std::vector<MetricValue> values;
  LadderPoint point;
  for (const auto* run : runs) {
    const auto value = measured(*run, metric);
    if (run->status != Status::ok || !value || !std::isfinite(value->value)) return {};
    values.push_back(*value);
    point.cpu_s += run->cost.cpu_s / static_cast<double>(runs.size());
    point.pairs += run->cost.pairs / static_cast<double>(runs.size());
  }
  const auto pool = pooled(values);
  point.level = level;
  point.step = step_of(axis, level);
  point.error = std::abs(pool.value) + 2.0 * pool.uncertainty.combined();
  if (!(point.error > 0.0) || !std::isfinite(point.error) || !(point.cpu_s > 0.0)) return {};
  return point;
}

/// Runs that differ from the finest of an axis in nothing else: a level of another axis is not of this
/// ladder.
bool only_along(const RunRow& run, const StudyAxes& axes, const EngineRow& engine) {
  if (run.levels.size() == 1) return true;
  return run.base || std::all_of(run.levels.begin(), run.levels.end(), [&](const auto& l) {
           return l.first == axes ||
                  std::any_of(engine.runs.begin(), engine.runs.end(), [&](const RunRow& b) {
                    const auto at = b.levels.find(l.first);
                    return b.base && at != b.levels.end() && same_level(at->second, l.second);
                  });
         });
}

struct Line {
  double slope = 0.0, change = 0.0;  ///< of the line itself, and between it and its neighbour
  const LadderPoint* a = nullptr;
};

Line line_at(const Ladder& ladder, double step, const std::function<double(const LadderPoint&)>& y) {
  const auto& p = ladder.points;
  const auto slope = [&](std::size_t i) {
    return std::log(y(p[i]) / y(p[i + 1])) / std::log(p[i].step / p[i + 1].step);
  };
  std::size_t i = 0;
  while (i + 2 < p.size() && step < p[i + 1].step) ++i;
  double change = 0.0;
  if (i > 0) change = std::max(change, std::abs(slope(i) - slope(i - 1)));
  if (i + 2 < p.size()) change = std::max(change, std::abs(slope(i + 1) - slope(i)));
  if (p.size() == 2) change = 0.5;  // nothing says how straight the line is
  const bool nearer_second = std::abs(std::log(step / p[i + 1].step)) < std::abs(std::log(step / p[i].step));
  return {slope(i), change, &p[i + (nearer_second ? 1 : 0)]};
}

Prediction predict(const Ladder& ladder, double step, const std::function<double(const LadderPoint&)>& y) {
  const auto line = line_at(ladder, step, y);
  const double away = std::abs(std::log(step / line.a->step));
  return {y(*line.a) * std::pow(step / line.a->step, line.slope),
          std::max(1.1, std::exp(line.change * away))};
}

/// Lengths that every level must divide: edges of boxes, of the domain, of cylinders along their axis.
void lengths_of(const Shape& s, std::vector<double>& lengths) {
  if (s.kind == Shape::Kind::box)
    for (const double l : {s.max.x - s.min.x, s.max.y - s.min.y, s.max.z - s.min.z}) lengths.push_back(l);
  for (const auto& part : s.of) lengths_of(part, lengths);
}

bool divides(double level, double length) {
  const double n = length / level;
  return std::abs(n - std::round(n)) <= 1e-6 * std::max(n, 1.0);
}

}  // namespace

std::vector<Ladder> ladders_of(const CaseResult& result, const std::string& metric) {
  std::vector<Ladder> ladders;
  for (const auto& engine : result.engines) {
    if (is_exact(engine.name)) continue;
    std::map<std::pair<JudgedMode, StudyAxes>, std::map<double, std::vector<const RunRow*>>>
        groups;  // (mode, axis) -> step -> runs
    for (const auto& run : engine.runs)
      for (const auto& [axes, level] : run.levels)
        if (run.input.empty() && axes.alone() && only_along(run, axes, engine))
          groups[{run.knobs.mode, axes}][-step_of(axes.axis, level)].push_back(&run);
    for (const auto& [key, levels] : groups) {
      Ladder ladder{engine.name, engine.preset, key.first, key.second.axis, {}};
      for (const auto& [negative, runs] : levels)
        if (const auto point = point_of(runs, ladder.axis, runs.front()->levels.at(key.second), metric))
          ladder.points.push_back(*point);
      if (ladder.points.size() >= 2) ladders.push_back(std::move(ladder));
    }
  }
  return ladders;
}

Prediction predicted_error(const Ladder& ladder, double step) {
  return predict(ladder, step, [](const LadderPoint& p) { return p.error; });
}
Prediction predicted_cpu(const Ladder& ladder, double step) {
  return predict(ladder, step, [](const LadderPoint& p) { return p.cpu_s; });
}

std::vector<double> possible_levels(const Scene& scene, const Ladder& ladder) {
  const double coarsest = ladder.points.front().step, finest = 0.5 * ladder.points.back().step;
  std::vector<double> levels;
  for (const auto& p : ladder.points) levels.push_back(p.level);
  if (ladder.axis == Axis::spacing || ladder.axis == Axis::time_step) {
    std::vector<double> lengths;
    if (ladder.axis == Axis::time_step)
      lengths = {scene.output_interval};
    else {
      for (const auto& b : scene.bodies) lengths_of(b.shape, lengths);
      if (scene.min && scene.max)
        for (const double l :
             {scene.max->x - scene.min->x, scene.max->y - scene.min->y, scene.max->z - scene.min->z})
          lengths.push_back(l);
    }
    std::erase_if(lengths, [&](double l) {
      return !std::isfinite(l) || !divides(ladder.points.back().level, l);
    });  // lengths that the measured ones do not divide are no demand
    const double whole =
        lengths.empty() ? coarsest * 60.0 : *std::max_element(lengths.begin(), lengths.end());
    for (double n = std::max(1.0, std::ceil(whole / coarsest - 1e-9)); whole / n >= finest && n < 1e7;
         n += 1.0)
      if (std::all_of(lengths.begin(), lengths.end(), [&](double l) { return divides(whole / n, l); }))
        levels.push_back(whole / n);
  } else {
    for (double step = coarsest; step >= finest; step /= std::pow(2.0, 0.125))
      levels.push_back(ladder.axis == Axis::support_ratio ? 1.0 / step : std::ceil(1.0 / step));
  }
  std::erase_if(levels, [&](double l) { return step_of(ladder.axis, l) > coarsest * (1.0 + 1e-9); });
  return levels;
}

namespace {

/// The setting that is possible, good enough and least by `measure`; none = there is none.
template <class Enough, class Measure>
std::optional<Recommendation> least(const Scene& scene, const std::vector<Ladder>& ladders, Enough enough,
                                    Measure measure) {
  std::optional<Recommendation> best;
  for (const auto& ladder : ladders)
    for (const double level : possible_levels(scene, ladder)) {
      const double step = step_of(ladder.axis, level);
      const Recommendation r{&ladder, level, predicted_error(ladder, step), predicted_cpu(ladder, step)};
      if (enough(r) && (!best || measure(r) < measure(*best))) best = r;
    }
  return best;
}

}  // namespace

std::optional<Recommendation> cheapest_for_error(const Scene& scene, const std::vector<Ladder>& ladders,
                                                 double error) {
  const auto enough = [&](const Recommendation& r) {
    const bool is_measured = std::any_of(r.ladder->points.begin(), r.ladder->points.end(),
                                         [&](const auto& p) { return same_level(p.level, r.level); });
    // Between levels the line is known to some per cent
    return r.error.value * (is_measured ? 1.0 : 1.05) <= error;
  };
  return least(scene, ladders, enough, [](const Recommendation& r) { return r.cpu_s.value; });
}

std::optional<Recommendation> best_within(const Scene& scene, const std::vector<Ladder>& ladders,
                                          double cpu_s) {
  return least(
      scene, ladders, [&](const Recommendation& r) { return r.cpu_s.value <= cpu_s; },
      [](const Recommendation& r) { return r.error.value; });
}

}  // namespace tripoint
