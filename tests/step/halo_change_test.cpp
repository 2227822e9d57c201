// SPDX-License-Identifier: BSD-3-Clause
// What is decided of a whole scene, while it is shared out: what breaks, melts, freezes, flows in or is made
// to happen.
#include <gtest/gtest.h>

#include "adapters/changing_scenes.hpp"
#include "step/slab_halo.hpp"

namespace tripoint {
namespace {

using lab::expect_same, lab::far, lab::Seen, lab::seen_shared, lab::seen_whole;
using test::brittle_bar, test::eventful, test::merging_and_splitting;

/// Over one slab, two and four. @return of two
Seen expect_same_shared(const test::Prepared& p, const Seen& whole, double border) {
  Seen two;
  for (const std::vector<double>& planes : {std::vector<double>{-far, far},
                                            {-far, border, far},
                                            {-far, border - 0.021, border - 0.004, border + 0.02, far}}) {
    SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs");
    Seen shared = seen_shared(p, planes);
    expect_same(whole, shared);
    EXPECT_GT(shared.gatherings, 1) << "beside that of the checkpoint";
    if (planes.size() == 3) two = std::move(shared);
  }
  return two;
}

TEST(Halo, ABarThatIsSharedTearsAsTheWholeDoes) {
  for (const bool flows : {false, true}) {
    SCOPED_TRACE(flows ? "ductile" : "brittle");
    const test::Prepared p = brittle_bar(flows, Mode::corrected);
    const Seen whole = seen_whole(p);
    EXPECT_GE(whole.objects, 2u);
    EXPECT_GT(whole.ledger.energy.at("fracture"), 1e-4);
    expect_same_shared(p, whole, 0.012);
  }
}

TEST(Halo, ABarThatIsSharedTearsAsPrinted) {
  const test::Prepared p = brittle_bar(false, Mode::paper);
  const Seen whole = seen_whole(p);
  EXPECT_GT(whole.ledger.energy.at("fracture"), 1e-4);
  expect_same_shared(p, whole, 0.012);
}

TEST(Halo, WhatMeltsAndFreezesMakesTheSameBodiesWhereItIsShared) {
  for (const SolidKind solid : {SolidKind::rigid, SolidKind::elastic}) {
    SCOPED_TRACE(to_string(solid));
    const test::Prepared p = merging_and_splitting(solid);
    const Seen whole = seen_whole(p);
    EXPECT_EQ(std::ranges::count(whole.alive, 1), 3) << "two became one, and one two";
    expect_same_shared(p, whole, 0.0036);
  }
}

TEST(Halo, WhatSoftensIsAsSoftWhereItIsShared) {
  const test::Prepared p = test::warm_rubber();
  const Seen whole = seen_whole(p);
  const Seen two = seen_shared(p, {-far, 0.062, far});
  expect_same(whole, two);
  EXPECT_EQ(two.gatherings, 1) << "that of the checkpoint: nothing changes its body";
}

TEST(Halo, EventsAndInflowDoTheSameWhereTheSceneIsShared) {
  const test::Prepared p = eventful();
  const Seen whole = seen_whole(p);
  EXPECT_GT(whole.position.size(), p.initial.size() + 50);
  EXPECT_EQ(std::ranges::count(whole.alive, 1), 2);
  for (const double border : {0.025, 0.22, 0.3}) {
    SCOPED_TRACE("border at " + std::to_string(border));
    expect_same(whole, seen_shared(p, {-far, border, far}));
  }
}

/// A run that is cut over two slabs goes on in one process, over two slabs and over four.
TEST(Halo, ACheckpointOfASharedSceneIsOneOfTheWhole) {
  for (const test::Prepared& p :
       {brittle_bar(true, Mode::corrected), merging_and_splitting(SolidKind::elastic), eventful()}) {
    const Seen whole = seen_whole(p);
    const double border = p.job.scene.inflows.empty() ? 0.0036 : 0.22;
    const Seen cut = seen_shared(p, {-far, border, far});
    ASSERT_FALSE(cut.kept.real.empty());
    for (const auto& [name, values] : whole.kept.real)
      EXPECT_EQ(cut.kept.real.at(name).size(), values.size()) << name;
    expect_same(whole, seen_whole(p, &cut.kept));
    expect_same(whole, seen_shared(p, {-far, border, far}, "", &cut.kept));
    expect_same(whole, seen_shared(p, {-far, border - 0.003, border, border + 0.004, far}, "", &cut.kept));
    expect_same(whole, seen_shared(p, {-far, border, far}, "", &whole.kept));
  }
}

}  // namespace
}  // namespace tripoint
