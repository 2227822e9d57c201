// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "files/reference_choice.hpp"
#include "tables/settings.hpp"
#include "validation/case/case_words.hpp"
#include "validation/case/study_axes.hpp"

/// What a case file says beside its scene: engines, metrics, studies, gates, inputs and defects. SI, with
/// every default filled in.
namespace tripoint {

struct EngineChoice {
  std::string name;
  bool required = false;
  /// `gate adopt` wrote it: no validation may leave the engine out by --engines
  bool adopted = false;
  std::vector<std::string> presets;  ///< one row of the results each; empty = "default"
  Settings settings;
};

struct MetricChoice {
  std::string name, quantity, body, at = "end";
  Norm norm = Norm::max;
  std::array<double, 2> window{0.0, 0.0};    ///< [s]; {0, 0} = all
  double average = 0.0;                      ///< around each output time [s]; 0 = none
  double scale = 1.0;                        ///< error is divided by it
  std::string unit;                          ///< of the scaled value, for people
  std::optional<ReferenceChoice> reference;  ///< overrides the case's
  SourcePlace place;
};

struct Study {
  StudyAxes axes;
  std::vector<double> levels;  ///< coarse to fine
  /// Refined together with the levels, one for each; empty = the case's own
  std::vector<double> support_ratios, time_steps;
  double jitter = 0.0;
  int seeds = 1;
  std::string engine;  ///< empty = all
  JudgedMode mode = JudgedMode::none;
  std::optional<FitClass> expect;  ///< empty = not judged
  std::optional<double> order;     ///< formal
  std::string metric;              ///< empty = every metric
  SourcePlace place;
};

struct Gate {
  std::string metric;          ///< a metric's name, or a part of it: gated_metric.hpp
  std::string engine, preset;  ///< empty = all
  JudgedMode mode = JudgedMode::none;
  std::optional<double> limit, at_least;
  std::optional<std::array<double, 2>> band;
  std::optional<double> level;  ///< of the study's axis; empty = every run
  /// Share by which the value may move from its baseline before that turns red; empty = a tenth, and it warns
  std::optional<double> drift;
  /// Class of convergence that an order must have; empty = any that falls to the truth
  std::optional<FitClass> expect;
  std::string reason, by, date;
  SourcePlace place;
};

/// A number that the scene takes from a measurement, at one standard uncertainty below and above the case's
/// value.
struct UncertainInput {
  std::string key;        ///< as of --set: material.water.viscosity
  std::string low, high;  ///< TOML values, or numbers with a unit
  SourcePlace place;
};

struct Defect {
  std::string name;
  double size = 0.0;
  std::optional<double> smallest;  ///< least size that its gates were seen to catch; empty = not sought
  std::vector<std::string> killed_by;
  SourcePlace place;
};

}  // namespace tripoint
