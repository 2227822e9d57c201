// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <chrono>
#include <optional>
#include <string>

/// Progress lines of `tripoint run`: time, step, the bound of the step, the ledger, and the time that is
/// left.
namespace tripoint {

/// One line `status {...}` of an engine, as far as the engine says it.
struct RunStatus {
  double time = 0.0, end = 0.0;  ///< [s]
  long step = 0;
  std::optional<double> time_step;         ///< [s]
  std::string bound;                       ///< the effect whose bound sets the step
  std::optional<double> ledger_residual;   ///< change of the sum of the ledger, at the last frame [J]
  std::optional<double> ledger_exchanged;  ///< energy that its terms have exchanged so far [J]
};

/// @return nothing where the text is no such object
[[nodiscard]] std::optional<RunStatus> status_from(const std::string& text);

/// " 42 %  t = 0.42 s  step 1200  dt = 1e-4 s (sound)  energy +2e-07 of what was exchanged  12 s left"
/// @param seconds_left of wall time; none while it is not known
[[nodiscard]] std::string status_line(const RunStatus&, double done, std::optional<double> seconds_left);

/// Where and how progress is shown, on stderr.
enum class ProgressForm { none, terminal, lines, json };

/// "auto" is a terminal's line that is written over, and nothing where stderr is none. @throws InputError for
/// another word
[[nodiscard]] ProgressForm progress_form(const std::string& word, bool quiet, bool is_terminal);

class RunProgress {
 public:
  explicit RunProgress(ProgressForm form) : form_(form) {}
  void at(double done);
  void at(const std::string& status);
  void end();  ///< clears the terminal's line
  /// [s] of wall time between status lines that the engine is asked for; empty = none
  [[nodiscard]] std::string interval() const;

 private:
  void show(double done);
  [[nodiscard]] std::optional<double> seconds_left(double done);
  using Clock = std::chrono::steady_clock;
  ProgressForm form_;
  std::optional<RunStatus> last_;
  /// Fraction and time at the first sign of life
  std::optional<std::pair<double, Clock::time_point>> begun_;
};

}  // namespace tripoint
