// SPDX-License-Identifier: BSD-3-Clause
#include "files/job.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/rigid_body.hpp"

namespace tripoint {
namespace {

/// Statements of the conservation laws alone about any scene. There are no positions, hence no frozen run
/// that looks perfect by them.
class Invariant : public Reference {
 public:
  Invariant(const Job& job, const InitialState& initial) : gravity_(job.scene.gravity) {
    for (std::size_t i = 0; i < initial.size(); ++i) {
      mass_ += initial.mass[i];
      momentum_ += initial.mass[i] * initial.velocity[i];
    }
    kinetic_ = kinetic_energy(initial.velocity, initial.mass);
  }
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    out.total_mass = mass_;
    out.momentum = momentum_ + (time * mass_) * gravity_;
    return out;
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "mass") return mass_;
    if (quantity == "kinetic_energy") return kinetic_;
    return {};
  }

 private:
  Vec3 gravity_, momentum_;
  double mass_ = 0.0, kinetic_ = 0.0;
};

std::unique_ptr<Reference> make_invariant(const ReferenceInput& in) {
  return std::make_unique<Invariant>(in.job, in.initial);
}

}  // namespace

ReferenceEntry invariant_entry() {
  return {{"invariant",
           "invariant",
           "conservation of mass, momentum, angular momentum and energy",
           "initial mass, momentum (with gravity's impulse), angular momentum, energy and shape are kept; no "
           "positions",
           {}},
          make_invariant};
}

}  // namespace tripoint
