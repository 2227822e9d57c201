// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "program/cli/predict_turns.hpp"

namespace tripoint {

/// One line: a prediction, and its measurement.
struct PredictedLine {
  predict::Prediction prediction;
  std::array<int, 3> grid{1, 1, 1};
  bool weak = false;     ///< as many particles a rank as the case has on one
  predict::Share first;  ///< of rank 0
  std::optional<Timed> measured;
  double measured_efficiency = 0.0;     ///< from the measured time on one rank
  double measured_at_once = 1.0;        ///< speed of a core where all have work, from such times
  double undisturbed_efficiency = 0.0;  ///< from such times where no core is ever slow
};

/// All that the command says.
struct PredictionReport {
  std::string case_id, version;
  std::vector<std::string> set;
  predict::Machine machine;
  std::string cpu;  ///< of the machine that the runs were made on
  int cores = 1;
  predict::WorkCost cost;
  predict::Memory memory;
  predict::Traffic traffic;
  /// By how many runs on one rank went at once, apart from each other: the speed of each, over that of one
  /// alone, where no core is ever slow for another reason.
  std::map<int, double> speed_at_once;
  std::vector<predict::OneRank> runs;
  std::vector<std::string> labels;  ///< of the runs
  std::vector<PredictedLine> lines;
  HowRunsWent went;
  std::vector<std::string> notes;  ///< warnings: runs that failed, a slow probe
};

[[nodiscard]] nlohmann::ordered_json prediction_json(const PredictionReport&);
/// The tables of a document of prediction_json(): of these runs, or read from a file. @throws InputError
/// where it is no such document
[[nodiscard]] std::string prediction_text(const nlohmann::ordered_json&);

}  // namespace tripoint
