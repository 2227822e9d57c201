// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/effect.hpp"
#include "effects/faces/face_pressure.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"
#include "liquids/scene_numbers.hpp"

/// Pressure acts at the faces of elastic solids, and not at the middles of their outer particles (model 8.3).
namespace tripoint::faces {
namespace {

class Faces : public Effect {
 public:
  explicit Faces(const Scene& scene) : kernels_(liquid::pair_kernels(scene)), faces_(scene) {}
  void densities(State& state, const Rows&) override { faces_.add_densities(state, kernels_); }
  void bonds(State& state, const Rows& rows) override { faces_.add_forces(state, rows); }
  void adopt(State& state) override {
    if (liquid::groups_changed(state)) faces_.clear();
  }
  void happen(State&, const Happening&) override { faces_.clear(); }
  void renumber(State&) override { faces_.clear(); }

 private:
  PairKernels kernels_;
  FacePressure faces_;
};

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{"faces",
               Mode::corrected,
               {},
               fields::joined({fields::position(),
                               fields::deformation(),
                               {field::id, field::mass, field::body, field::material, field::group,
                                field::number_density, field::pressure_share, field::force}})};
  s.reads_if_there = fields::image();
  s.skips_sleeping = true;
  s.own_sums = {.densities = columns_of_all(field::number_density), .bonds = columns_of_all(field::force)};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Faces>(scene); }

}  // namespace tripoint::faces
