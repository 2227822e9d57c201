// SPDX-License-Identifier: BSD-3-Clause
#include "passes/pair_passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/machine.hpp"
#include "passes/run_pass.hpp"

namespace tripoint {
namespace {

std::vector<int> widths_of_this_machine() {
  std::vector<int> lanes{1};
  if (machine_has_avx2()) lanes.push_back(4);
  if (machine_has_avx512()) lanes.push_back(8);
  return lanes;
}

/// Every pass at every choice of forms, by name.
std::vector<std::pair<std::string, PassFunction>> all_passes(int lanes) {
  const PairPasses p = pair_passes(lanes);
  std::vector<std::pair<std::string, PassFunction>> list{{"transport", p.transport}};
  for (int a = 1; a <= 2; ++a) list.emplace_back("wall_extrapolation " + std::to_string(a), p.wall_extrapolation({a}));
  for (int a = 0; a <= 2; ++a)
    for (int b = 0; b <= 1; ++b) list.emplace_back("density " + std::to_string(a) + std::to_string(b), p.density({a, b}));
  for (int a = 1; a <= 4; ++a) list.emplace_back("spread " + std::to_string(a), p.spread({a}));
  for (int a = 0; a <= 8; ++a)
    for (int b = 0; b <= 2; ++b) list.emplace_back("rates " + std::to_string(a) + std::to_string(b), p.rates({a, b}));
  return list;
}

/// A periodic cloud of liquid, walls, bodies and deformable solids with every column that a pass names, at random.
Particles mixture(const std::set<std::string_view>& names, const std::vector<FieldInfo>& fields) {
  Particles p(500, fields);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t i = 0; i < p.size(); ++i) positions(p).set(i, {0.6 * uniform(random), 0.5 * uniform(random), uniform(random)});
  p.for_each([&](const FieldInfo& info, auto values) {
    if constexpr (std::is_same_v<typename decltype(values)::value_type, double>) {
      if (!names.count(info.name)) return;
      for (double& v : values) {
        v = info.name == field::group.name                                     ? std::floor(5.0 * uniform(random)) - 2.0
            : info.name == field::solid.name || info.name == field::stick.name ? std::floor(2.0 * uniform(random))
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
  OwnPairs own;
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
      if (names.insert(f->name).second && std::ranges::find(fields, FieldInfo(*f)) == fields.end()) fields.emplace_back(*f);
  const Particles p = mixture(names, fields);
  const auto oracles = all_passes(1);
  for (const int lanes : widths) {
    const auto passes = all_passes(lanes);
    for (std::size_t k = 0; k < passes.size(); ++k) {
      ASSERT_EQ(passes[k].second.run == nullptr, oracles[k].second.run == nullptr);
      if (!passes[k].second.run) continue;
      const Sums oracle = run(oracles[k].second, p, 1);
      EXPECT_TRUE(std::ranges::any_of(oracle.values, [](double v) { return v != 0.0; }));
      EXPECT_TRUE(run(passes[k].second, p, lanes) == oracle) << passes[k].first << " at " << lanes << " lanes";
    }
  }
}

}  // namespace
}  // namespace tripoint
