// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/pair_passes.hpp"
#include "effects/heat/fields.hpp"
#include "liquids/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/machine.hpp"
#include "effects/density/pair_slots.hpp"
#include "effects/heat/pair_slots.hpp"
#include "effects/no_slip/pair_slots.hpp"
#include "effects/pressure/pair_slots.hpp"
#include "effects/transport/pair_slots.hpp"
#include "effects/viscosity/pair_slots.hpp"
#include "pairs/run_pass.hpp"

namespace tripoint {
namespace {

std::vector<int> widths_of_this_machine() {
  std::vector<int> lanes{1};
  if (machine_has_avx2()) lanes.push_back(4);
  if (machine_has_avx512()) lanes.push_back(8);
  return lanes;
}

using Wanted = std::vector<PairTerm>;

/// Each of these with each of those.
std::vector<Wanted> each_with_each(const std::vector<Wanted>& these, const std::vector<Wanted>& those) {
  std::vector<Wanted> all;
  for (const Wanted& a : these)
    for (const Wanted& b : those) {
      all.push_back(a);
      all.back().insert(all.back().end(), b.begin(), b.end());
    }
  return all;
}

std::string names_of(const Wanted& terms) {
  std::string names;
  for (const PairTerm& t : terms) (names += ' ') += t.name;
  return names;
}

constexpr PairTerm viscosities[] = {pair_term<ViscosityPaper>, pair_term<ViscosityCentral>,
                                    pair_term<ViscosityLaplacian>, pair_term<ViscosityCentralWeighted>};

const std::vector<Wanted> densities = each_with_each(
    {{}, {pair_term<DensityPaper>}, {pair_term<NumberDensity>}}, {{}, {pair_term<HeatMoment>}});

std::vector<Wanted> rates() {
  std::vector<Wanted> flows{{}};
  for (const PairTerm& pressure : {pair_term<PressurePaper>, pair_term<PressureCorrected>})
    for (const PairTerm& viscosity : viscosities) flows.push_back({pressure, viscosity});
  return each_with_each(flows, {{}, {pair_term<HeatFlowPaper>}, {pair_term<HeatFlowCorrected>}});
}

const Wanted alone{pair_term<TransportForces>,
                   pair_term<WallExtrapolation>,
                   pair_term<WallExtrapolationWeighted>,
                   pair_term<ViscousSpread<ViscosityPaper>>,
                   pair_term<ViscousSpread<ViscosityCentral>>,
                   pair_term<ViscousSpread<ViscosityLaplacian>>,
                   pair_term<ViscousSpread<ViscosityCentralWeighted>>};

/// Every pass at every choice of forms, by name.
std::vector<std::pair<std::string, PassFunction>> all_passes(int lanes) {
  const PairPasses p = pair_passes(lanes);
  std::vector<std::pair<std::string, PassFunction>> list;
  for (const PairTerm& one : alone) list.emplace_back(one.name, p.alone(one));
  for (const Wanted& some : densities) list.emplace_back("density" + names_of(some), p.density(some));
  for (const Wanted& some : rates()) list.emplace_back("rates" + names_of(some), p.rates(some));
  return list;
}

TEST(PairPasses, SumTheTermsThatAreWantedAndNoOthers) {
  const PairPasses p = pair_passes(1);
  for (const PairTerm& one : alone) EXPECT_EQ(p.alone(one).terms.size(), 1U) << one.name;
  EXPECT_EQ(p.alone(pair_term<HeatMoment>).run, nullptr) << "which is fused with others";
  for (const Wanted& some : densities) EXPECT_EQ(p.density(some).terms.size(), some.size()) << names_of(some);
  for (const Wanted& some : rates()) {
    EXPECT_EQ(p.rates(some).terms.size(), some.size()) << names_of(some);
    EXPECT_EQ(p.density(some).run, nullptr) << names_of(some);
  }
  EXPECT_EQ(p.rates(Wanted{pair_term<PressurePaper>}).terms.size(), 1U)
      << "where another effect brings the viscosity";
  EXPECT_EQ(p.rates(Wanted{pair_term<ViscosityPaper>}).terms.size(), 1U) << "which is an effect of its own";
  EXPECT_EQ(p.rates(Wanted{pair_term<HeatMoment>}).terms.size(), 0U) << "which is a sum of the other pass";
  const auto names_term = [](const Field<double>* f) { return f->name == field::number_density.name; };
  EXPECT_TRUE(std::ranges::any_of(p.density(Wanted{pair_term<NumberDensity>}).adds(), names_term));
}

/// Names of the terms of each function.
std::vector<std::string> names_in(std::span<const PassFunction> table) {
  std::vector<std::string> names;
  for (const PassFunction& f : table) names.push_back(names_of({f.terms.begin(), f.terms.end()}));
  return names;
}

TEST(PairPasses, AreATableOfEachFormOfEachEffectWithThoseOfTheOthers) {
  struct Mine;
  struct FirstEffect : NoPairTerms {
    using density = OneTermOf<DensityPaper, NumberDensity>;
    using alone = OneTermOf<TransportForces>;
  };
  struct Nothing;
  struct SecondEffect : NoPairTerms {
    using density = OneTermOf<HeatMoment>;
    using rates = OneTermOf<HeatFlowPaper>;
  };
  using All = PassesOf<1, Mine, FirstEffect, Nothing, SecondEffect, void>;
  using Names = std::vector<std::string>;
  EXPECT_EQ(names_in(All::density), (Names{"", " HeatMoment", " DensityPaper", " DensityPaper HeatMoment",
                                           " NumberDensity", " NumberDensity HeatMoment"}));
  EXPECT_EQ(names_in(All::rates), (Names{"", " HeatFlowPaper"}));
  EXPECT_EQ(names_in(All::alone), (Names{" TransportForces"}));
  EXPECT_EQ(All::timed.run, nullptr);
  EXPECT_EQ(pair_term<ViscousSpread<ViscosityCentral>>.name, "ViscousSpread of ViscosityCentral");
}

struct Namesake {
  static constexpr std::string_view name = HeatMoment::name;
};
static_assert(detail::names_differ(Terms<HeatMoment, DensityPaper, HeatMoment>{}));
static_assert(!detail::names_differ(Terms<HeatMoment, Namesake>{}));
static_assert(!detail::each_once(Terms<HeatMoment, DensityPaper, HeatMoment>{}));

/// A term that the program does not have: sum_j m_j r_ij.
struct Far {
  static constexpr std::string_view name = "Far";
  using reads = Keys<field::mass>;
  using adds = Keys<field::conductance>;
  template <class V>
  static void pair(const PairGeometry<V>& g, const auto&, const auto& j, auto& sum) {
    sum(field::conductance) += j(field::mass) * g.r;
  }
};
struct FarSlots : NoPairTerms {
  using density = OneTermOf<Far>;
};

TEST(PairPasses, FuseTheTermOfOneMoreEffectWithThoseOfTheOthers) {
  struct Mine;  // a vector unit of the test's own: one particle at a time
  using All = PassesOf<1, Mine, density::PairSlots, pressure::PairSlots, viscosity::PairSlots,
                       heat::PairSlots, FarSlots>;
  const PairPasses passes{All::density, All::rates, All::alone, All::timed};
  const PassFunction pass = passes.density(Wanted{pair_term<Far>, pair_term<NumberDensity>});
  ASSERT_EQ(pass.terms.size(), 2U);
  std::vector<FieldInfo> fields = common_fields(false);
  fields.insert(fields.end(), {field::conductance, field::number_density});
  Particles p(100, fields);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    positions(p).set(i, {uniform(random), uniform(random), uniform(random)});
  for (double& m : p[field::mass]) m = 1.0 + uniform(random);
  constexpr double support = 0.4;
  Neighbours neighbours(support, 0.05, {}, 1, 1);
  neighbours.update(p, 0.0);
  run_pass(pass, p, neighbours, PairKernels(support), 1);
  const auto x = positions(std::as_const(p));
  for (std::size_t i = 0; i < p.size(); ++i) {
    double far = 0.0, crowd = 0.0;
    for (std::size_t j = 0; j < p.size(); ++j) {
      const double r = norm(x.at(j) - x.at(i));
      if (j == i || r >= support) continue;
      far += p[field::mass][j] * r;
      crowd += PairKernels(support).wendland.value(r);
    }
    EXPECT_NEAR(p[field::conductance][i], far, 1e-13 * far);  // round-off of some 30 neighbours
    EXPECT_NEAR(p[field::number_density][i], crowd, 1e-13 * crowd);
  }
}

/// A periodic cloud of liquid, walls, bodies and deformable solids with every column that a pass names, at
/// random.
Particles mixture(const std::set<std::string_view>& names, const std::vector<FieldInfo>& fields) {
  Particles p(500, fields);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    positions(p).set(i, {0.6 * uniform(random), 0.5 * uniform(random), uniform(random)});
  p.for_each([&](const FieldInfo& info, auto values) {
    if constexpr (std::is_same_v<typename decltype(values)::value_type, double>) {
      if (!names.count(info.name)) return;
      for (double& v : values) {
        v = info.name == field::group.name ? std::floor(5.0 * uniform(random)) - 2.0
            : info.name == field::solid.name || info.name == field::stick.name
                ? std::floor(2.0 * uniform(random))
                : 0.5 + uniform(random);
      }
    }
  });
  return p;
}

struct Sums {
  std::vector<double> values;
  bool operator==(const Sums&) const = default;
};

Sums run(const PassFunction& pass, Particles p, int lanes) {
  const PeriodicBox box{{true, false, true}, {}, {0.6, 0.0, 1.0}};
  Neighbours n(0.2, 0.02, box, 2, lanes);
  n.update(p, 0.0);
  ExcludedPairs own;
  for (std::uint32_t i = 0; i < 100; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if ((i + j) % 3 == 0) make_own(own, i, j, 0.5);
  n.mark_own(p, own);
  PairKernels kernels(0.2);
  kernels.core = {3.0, 0.05};
  kernels.per_gradient_moment = 0.9;
  kernels.shear = {0.1, 3.0};
  run_pass(pass, p, n, kernels, 2);
  Sums sums;
  for (const Field<double>* f : pass.fields)
    for (std::size_t id = 0; id < p.size(); ++id) sums.values.push_back(p[*f][p.row(id)]);
  return sums;
}

TEST(PairPasses, OfEveryCombinationHaveTheBitsOfTheScalarOracleAtEveryWidth) {
  const std::vector<int> widths = widths_of_this_machine();
  if (widths.size() == 1) GTEST_SKIP() << "this machine has neither AVX2 nor AVX-512";
  std::set<std::string_view> names;
  std::vector<FieldInfo> fields = common_fields(true);
  for (const auto& [name, pass] : all_passes(1))
    for (const Field<double>* f : pass.fields)
      if (names.insert(f->name).second && std::ranges::find(fields, FieldInfo(*f)) == fields.end())
        fields.emplace_back(*f);
  const Particles p = mixture(names, fields);
  const auto oracles = all_passes(1);
  for (const int lanes : widths) {
    const auto passes = all_passes(lanes);
    for (std::size_t k = 0; k < passes.size(); ++k) {
      ASSERT_EQ(passes[k].second.run == nullptr, oracles[k].second.run == nullptr);
      if (!passes[k].second.run) continue;
      const Sums oracle = run(oracles[k].second, p, 1);
      EXPECT_TRUE(std::ranges::any_of(oracle.values, [](double v) { return v != 0.0; }));
      EXPECT_TRUE(run(passes[k].second, p, lanes) == oracle)
          << passes[k].first << " at " << lanes << " lanes";
    }
  }
}

}  // namespace
}  // namespace tripoint
