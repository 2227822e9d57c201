// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/effect.hpp"
#include "effects/lattice_walls/lattice_sums.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"

/// Liquid feels the fixed walls of a jittered scene from their lattice (model 8.4).
namespace tripoint::lattice_walls {
namespace {

class LatticeWalls : public Effect {
 public:
  explicit LatticeWalls(const Scene& scene) : kernels_(liquid::pair_kernels(scene)) {}
  void densities(State& state, const Rows&) override { sums_.lay_densities(state, kernels_); }
  void bonds(State& state, const Rows& rows) override { sums_.lay_forces(state, kernels_, rows); }
  void adopt(State& state) override {
    if (liquid::groups_changed(state)) sums_.clear();
  }
  void happen(State&, const Happening&) override { sums_.clear(); }
  void renumber(State&) override { sums_.clear(); }

 private:
  PairKernels kernels_;
  LatticeSums sums_;
};

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{"lattice_walls",
               Mode::corrected,
               {},
               fields::joined({fields::position(),
                               {field::id, field::body, field::source, field::group, field::number_density,
                                field::pressure_share, field::force}})};
  s.reads_if_there = fields::image();
  s.skips_sleeping = true;
  s.own_sums = {.densities = columns_of_all(field::number_density), .bonds = columns_of_all(field::force)};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<LatticeWalls>(scene); }

}  // namespace tripoint::lattice_walls
