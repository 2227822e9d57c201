// SPDX-License-Identifier: BSD-3-Clause
// Gates that adopting an engine writes, from values made by hand.
#include "validation/harness/adopt.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "validation/harness/apply_gate.hpp"

namespace tripoint {
namespace {

constexpr double round_off = 1e-11;

TEST(Adopt, AnErrorGetsRoomToBothSides) {
  const auto g = adopted_gate("angle", {0.04, 0.04}, 0.0, 1.5, round_off);
  ASSERT_TRUE(g.band);
  EXPECT_NEAR((*g.band)[0], 0.04 / 1.5, 1e-12);
  EXPECT_NEAR((*g.band)[1], 0.06, 1e-12);
  EXPECT_EQ(verdict_of(g, 0.04, 0.0), Verdict::pass);
  EXPECT_EQ(verdict_of(g, 0.061, 0.0), Verdict::fail);
  EXPECT_EQ(verdict_of(g, 0.02, 0.0), Verdict::fail);
}

TEST(Adopt, ANegativeValueKeepsItsSign) {
  const auto g = adopted_gate("energy", {-0.06, -0.06}, 0.0, 2.0, round_off);
  EXPECT_NEAR((*g.band)[0], -0.12, 1e-12);
  EXPECT_NEAR((*g.band)[1], -0.03, 1e-12);
}

TEST(Adopt, NoiseAndStatedUncertaintyWidenTheBand) {
  const auto quiet = adopted_gate("angle", {0.04, 0.04, 0.04}, 0.0, 1.5, round_off);
  const auto noisy = adopted_gate("angle", {0.04, 0.041, 0.039}, 0.0, 1.5, round_off);
  const auto stated = adopted_gate("angle", {0.04, 0.04, 0.04}, 0.001, 1.5, round_off);
  EXPECT_NEAR((*noisy.band)[1] - (*quiet.band)[1], 4.0 * 0.001, 1e-9);
  EXPECT_NEAR((*stated.band)[1] - (*quiet.band)[1], 2.0 * 0.001, 1e-12);
}

TEST(Adopt, RoundOffMayBecomeSmaller) {
  const auto g = adopted_gate("position", {3e-15, 3e-15}, 0.0, 1.5, round_off);
  EXPECT_FALSE(g.band);
  EXPECT_EQ(g.limit, 1e-10);
  EXPECT_EQ(adopted_gate("position", {2e-6, 2e-6}, 0.0, 1.5, 1e-5).limit, 6e-6);  // single precision
}

const char* const source = R"(# A throw.
format = 1

[case]
title = "A throw"
requirement = "R"
claims = "ours is exact"
profiles = ["commit", "acceptance"]
modes = ["corrected", "paper"]

[scene]
end_time = 1.0

# Of ours.
[engines.tripoint]
required = true

[[metric]]
name = "position"
quantity = "position"

[[metric]]
name = "heat"
quantity = "temperature"

[[study]]
axis = "time_step"
levels = [0.02, 0.01]
engine = "bullet"

# Of all.
[[study]]
axis = "time_step"
levels = [0.02, 0.01]
mode = "not paper"

[[gate]]
metric = "position"
limit = 0.05
reason = "of any"

[[defect]]
name = "rigid.gravity"
size = 0.01
)";

AdoptedCase adopted() {
  AdoptedCase c{"rigid/throw", "throw.toml", {AdoptedRow{"default", Status::ok, "", {}, {"heat"}, {}}}};
  auto g = adopted_gate("position", {0.04, 0.04}, 0.0, 1.5, round_off);
  g.engine = "stone";
  g.level = 0.01;
  g.date = "2026-11-22";
  c.rows[0].gates = {g};
  return c;
}

EngineEntry stone() {
  EngineEntry e;
  e.name = "stone";
  e.version = "2";
  return e;
}

TEST(Adopt, TheWrittenCaseIsTheSourceWithoutOtherEngines) {
  const auto text = adopted_text(source, adopted(), stone());
  for (const char* kept : {"# A throw.", "id = \"rigid/throw\"", "[scene]", "end_time = 1.0", "name = \"position\"", "# Of all.",
                           "[engines.\"stone\"]", "required = true", "level = 0.01", "band = [0.0266667, 0.06]"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << "\n" << text;
  for (const char* gone : {"bullet", "modes", "ours is exact", "rigid.gravity", "of any", "# Of ours.", "name = \"heat\"",
                           "not paper", "acceptance"})
    EXPECT_EQ(text.find(gone), std::string::npos) << gone << "\n" << text;
}

TEST(Adopt, ACaseThatLeansOnAFileBesideItIsRefused) {
  auto text = std::string(source) + "\n[reference]\nkind = \"experiment\"\nfile = \"throw.ref.csv\"\n";
  EXPECT_THROW(static_cast<void>(adopted_text(text, adopted(), stone())), InputError);
}

}  // namespace
}  // namespace tripoint
