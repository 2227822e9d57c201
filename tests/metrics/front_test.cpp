// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "metrics/fakes.hpp"
#include "references/liquids.hpp"
#include "references/measured.hpp"

namespace tripoint {
namespace {

using test::DataFile;
using test::metric;

constexpr double dx = 0.1;

/// A block of liquid, 0.4 m long, whose far end runs along x as the experiment of its name does, plus a lead.
struct Dam {
  test::Prepared s;
  DataFile file{
      test::sealed("# source: none\n# unit time: 0.1 s\n# unit front: 0.4 m\n# uncertainty front: 5 "
                   "%\ntime,front\n1,1.1\n4,1.4\n8,2\n")};
  std::shared_ptr<const Reference> truth;
  Trajectory run;

  Dam() {
    s.job.scene.spacing = dx;
    test::add_matter(s, "water", Phase::liquid, {{4, 4, 4}, dx, {}, 1.0}, {}, 1000.0);
    test::set_times(s, 1.0, 10);
    truth = make_reference(test::experiment(file), s.job, s.initial);
  }
  /// The front stands at `place(t)`; the body is drawn out without tearing.
  template <class Place>
  void move(Place place) {
    run.frames.clear();
    for (const double t : s.job.times) {
      Snapshot frame;
      frame.time = t;
      frame.position = s.initial.position;
      frame.velocity = s.initial.velocity;
      frame.mass = s.initial.mass;
      for (auto& r : frame.position) r.x += (place(t) - 0.4) * (r.x > 0.3 ? 1.0 : 0.0);
      run.frames.push_back(frame);
    }
  }
  [[nodiscard]] MetricValue value(const std::string& quantity, double scale = 1.0) const {
    auto choice = metric(quantity, "final", "water");
    choice.scale = scale;
    return evaluate(choice, s.job, s.initial, run, *truth);
  }
};

/// The measured curve, straight from row to row.
double measured(double t) { return t < 0.4 ? 0.44 + (t - 0.1) * 0.4 : 0.56 + (t - 0.4) * 0.6; }

TEST(Front, OfTheMeasuredMotionHasNoLeadAndItsSpeed) {
  Dam dam;
  dam.move(measured);
  EXPECT_NEAR(dam.value("front_lead").value, 0.0, 1e-12);
  EXPECT_NEAR(dam.value("front_speed").value, 0.0, 1e-12);
}

TEST(Front, LeadKeepsItsSignAndCarriesTheUncertaintyOfItsRow) {
  Dam dam;
  dam.move([](double t) { return measured(t) - (t > 0.35 && t < 0.45 ? 0.08 : 0.02); });
  const auto lead = dam.value("front_lead", 0.4);
  EXPECT_NEAR(lead.value, -0.2, 1e-12);  // of 0.4 m
  EXPECT_NEAR(lead.uncertainty.data, 0.05 * 1.4, 1e-12);
  EXPECT_EQ(lead.series.size(), 3u);
  EXPECT_NEAR(lead.series[2], -0.05, 1e-12);
}

/// A block of 0.5 m that stands still: what was measured is a quarter of a metre behind it, and then as far
/// ahead.
TEST(Front, OfTwoLeadsOfOneSizeTheFirstIsTold) {
  test::Prepared s;
  s.job.scene.spacing = 0.125;
  test::add_matter(s, "water", Phase::liquid, {{4, 4, 4}, 0.125, {}, 1.0}, {}, 1000.0);
  test::set_times(s, 1.0, 4);
  const DataFile file(
      test::sealed("# source: none\n# unit time: 1 s\n# unit front: 1 m\n# uncertainty front: 10 "
                   "%\ntime,front\n0.25,0.25\n0.75,0.75\n"));
  Trajectory run;
  for (const double t : s.job.times) {
    Snapshot frame;
    frame.time = t;
    frame.position = s.initial.position;
    frame.velocity = s.initial.velocity;
    frame.mass = s.initial.mass;
    run.frames.push_back(frame);
  }
  const auto lead = evaluate(metric("front_lead", "final", "water"), s.job, s.initial, run,
                             *make_reference(test::experiment(file), s.job, s.initial));
  EXPECT_EQ(lead.value, 0.25);
  EXPECT_NEAR(lead.uncertainty.data, 0.025, 1e-15);
  EXPECT_EQ(lead.note, "at t = 0.250000 s");
}

TEST(Front, SpeedIsThatBetweenTheFirstAndTheLastMeasuredPlace) {
  Dam dam;
  dam.move([](double t) { return 0.44 + 1.5 * (measured(t) - 0.44); });
  const auto speed = dam.value("front_speed");
  EXPECT_NEAR(speed.value, 0.5, 1e-12);
  // Both ends, over the way of 0.9
  EXPECT_NEAR(speed.uncertainty.data, 1.5 * std::hypot(0.05 * 1.1, 0.05 * 2.0) / 0.9, 1e-12);
}

TEST(Front, OfSeveralLiquidsIsThatOfANamedOne) {
  Dam dam;
  dam.move(measured);
  const auto of_all = [&] {
    return evaluate(metric("front_lead", "final"), dam.s.job, dam.s.initial, dam.run, *dam.truth);
  };
  EXPECT_NEAR(of_all().value, 0.0, 1e-12);
  dam.s.job.bodies.push_back(dam.s.job.bodies.front());
  dam.s.job.bodies.back().name = "bed";
  EXPECT_TRUE(std::isnan(of_all().value));
  EXPECT_EQ(of_all().note, "the scene has several liquids: name the body whose front it is");
  EXPECT_NEAR(dam.value("front_lead").value, 0.0, 1e-12);
}

TEST(Front, IsNotADropThatFliesAlone) {
  Dam dam;
  dam.move(measured);
  for (auto& frame : dam.run.frames) frame.position[0].x = 5.0;
  EXPECT_NEAR(dam.value("front_lead").value, 0.0, 1e-12);
}

TEST(Front, IsReadBetweenOutputTimesButNeverBeyondThem) {
  Dam dam;
  test::set_times(dam.s, 1.0, 4);  // rows lie at 0.4 and 1.6 intervals
  dam.move([](double t) { return 0.4 + 0.4 * t; });
  EXPECT_NEAR(dam.value("front_lead").value, 0.4 + 0.4 * 0.8 - 0.8, 1e-12);
  test::set_times(dam.s, 0.7, 7);  // ends before the last row
  dam.move(measured);
  const auto lead = dam.value("front_lead");
  EXPECT_TRUE(std::isnan(lead.value));
  EXPECT_NE(lead.note.find("do not enclose"), std::string::npos);
}

TEST(Front, NeedsAnExperimentThatSawOne) {
  Dam dam;
  dam.move(measured);
  dam.truth = make_reference(test::function("invariant"), dam.s.job, dam.s.initial);
  EXPECT_TRUE(std::isnan(dam.value("front_lead").value));
  EXPECT_TRUE(std::isnan(dam.value("front_speed").value));
}

}  // namespace
}  // namespace tripoint
