// SPDX-License-Identifier: BSD-3-Clause
#include "program/predict/part_times.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>

#include "core/errors.hpp"

namespace tripoint::predict {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The less of each pair of entries. @param kept empty before the first
void keep_least(std::vector<double>& kept, const std::vector<double>& other) {
  if (kept.empty()) kept = other;
  if (kept.size() != other.size())
    throw EngineError("two runs of the same job made different numbers of steps or calls");
  for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = std::min(kept[k], other[k]);
}

std::vector<double> sums(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> both(a.size());
  std::transform(a.begin(), a.end(), b.begin(), both.begin(), std::plus<>());
  return both;
}

}  // namespace

double PartTimes::wall_a_step() const { return (sum(work) + sum(call)) / static_cast<double>(steps); }
double PartTimes::cpu_a_step() const { return sum(cpu) / static_cast<double>(steps); }

PartTimes read_part_times(const std::string& path) {
  PartTimes times;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line); ++times.steps) {
    std::istringstream parts(line);
    for (double work = 0.0, call = 0.0, cpu = 0.0; parts >> work >> call >> cpu;) {
      times.work.push_back(work);
      times.call.push_back(call);
      times.cpu.push_back(cpu);
    }
    if (!parts.eof()) throw EngineError(path + ": is not made of three times for each part of a step");
  }
  if (times.work.empty()) throw EngineError(path + ": the engine has left no times of steps");
  return times;
}

void BestTimes::add(const std::vector<PartTimes>& ranks) {
  keep(ranks, sums(ranks.front().work, ranks.front().call));
}

void BestTimes::add_apart(const std::vector<PartTimes>& runs) {
  std::vector<double> slowest(runs.front().work.size(), 0.0);
  for (const PartTimes& run : runs) {
    const std::vector<double> wall = sums(run.work, run.call);
    for (std::size_t k = 0; k < std::min(slowest.size(), wall.size()); ++k)
      slowest[k] = std::max(slowest[k], wall[k]);
  }
  keep(runs, slowest);
}

void BestTimes::keep(const std::vector<PartTimes>& ranks, const std::vector<double>& wall) {
  steps_ = ranks.front().steps;
  keep_least(wall_, wall);
  keep_least(cpu_, ranks.front().cpu);
  work_.resize(ranks.size());
  for (std::size_t n = 0; n < ranks.size(); ++n) {
    keep_least(work_[n], ranks[n].work);
    keep_least(call_, ranks[n].call);
  }
}

double BestTimes::wall() const { return sum(wall_) / static_cast<double>(steps_); }
double BestTimes::cpu() const { return sum(cpu_) / static_cast<double>(steps_); }

double BestTimes::undisturbed() const {
  double all = sum(call_);
  for (std::size_t k = 0; k < call_.size(); ++k) {
    double slowest = 0.0;
    for (const auto& work : work_) slowest = std::max(slowest, work[k]);
    all += slowest;
  }
  return all / static_cast<double>(steps_);
}

bool Settling::add(std::vector<double> best) {
  bool lowered = best.size() != best_.size();
  for (std::size_t k = 0; !lowered && k < best.size(); ++k) lowered = best[k] < (1.0 - falls) * best_[k];
  even_ = lowered ? 0 : even_ + 1;
  best_ = std::move(best);
  return settled();
}

}  // namespace tripoint::predict
