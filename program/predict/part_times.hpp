// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint::predict {

/// Seconds of all parts of all steps of one rank in one run. A part is work, and then a call of all ranks,
/// which lasts as long as another rank still works. No rank is ahead of another where a part ends.
struct PartTimes {
  std::vector<double> work, call, cpu;  ///< wall, wall, processor [s]
  long steps = 0;
  [[nodiscard]] double wall_a_step() const;
  [[nodiscard]] double cpu_a_step() const;
};

/// step-times-N.txt, as the engine has left it in the folder of a run. @throws EngineError where it is not
/// there, or is no such file
[[nodiscard]] PartTimes read_part_times(const std::string& path);

/// The best of each part over several runs of the same job, which make the same steps.
class BestTimes {
 public:
  /// One run, with all its ranks. @throws EngineError where it made other steps or calls than the one before
  void add(const std::vector<PartTimes>& ranks);
  /// One turn of runs that went at once, apart from each other. @throws EngineError as add()
  void add_apart(const std::vector<PartTimes>& runs);
  /// [s] a step of the first rank, waiting included, or of the slowest of runs apart: of each part the
  /// shortest of all repeats.
  [[nodiscard]] double wall() const;
  [[nodiscard]] double cpu() const;
  /// [s] a step where no core is ever slow: of each part the work of the slowest rank, each at its best, and
  /// the call at the shortest that any rank has had. The last rank to come to a call waits for nobody.
  [[nodiscard]] double undisturbed() const;

 private:
  void keep(const std::vector<PartTimes>& ranks, const std::vector<double>& wall);

  long steps_ = 0;
  std::vector<double> wall_, cpu_;         ///< of the first rank; wall of the slowest run, of runs apart
  std::vector<std::vector<double>> work_;  ///< of each rank
  std::vector<double> call_;
};

/// Tells when repeats are enough: when three in a row have lowered no best time by half a per cent.
class Settling {
 public:
  static constexpr double falls = 0.005;  ///< share of a time
  static constexpr int even_repeats = 3;
  /// @param best all best times after one more repeat, in the same order each time   @return whether they
  /// have settled
  bool add(std::vector<double> best);
  [[nodiscard]] bool settled() const { return even_ >= even_repeats; }

 private:
  std::vector<double> best_;
  int even_ = 0;
};

}  // namespace tripoint::predict
