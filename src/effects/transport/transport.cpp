// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/effect.hpp"
#include "effects/transport/transport_forces.hpp"
#include "liquids/fields.hpp"

/// Motion by the transport velocity (model 8.3).
namespace tripoint::transport {
namespace {

class Transport : public Effect {
 public:
  explicit Transport(const Scene& scene)
      : numbers_(liquid::numbers_of(scene)), kernels_(liquid::pair_kernels(scene)) {}
  void drift(State& state, double dt) override { set_shift(state, dt); }
  void state(State& state, const Rows&) override { set_transport_forces(state, numbers_, kernels_); }

 private:
  liquid::SceneNumbers numbers_;
  PairKernels kernels_;
};

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"transport",
               Mode::corrected,
               {field::shift, field::background, field::transport_force},
               fields::joined({fields::position(),
                               fields::velocity(),
                               {field::mass, field::group, field::volume, field::density, field::rest_density,
                                field::pressure, field::viscous_velocity}})};
  if (liquid::has_transport_means(liquid::numbers_of(scene)))
    s.owns.insert(s.owns.end(), {field::pressure_around, field::nearing, field::bulk_pressure});
  Force stress{field::transport_force, {"transport_work"}};
  stress.entry = "transport";
  stress.feels = Feels::particles;
  s.forces = {stress};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Transport>(scene); }

}  // namespace tripoint::transport
