// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "assembly/all_effects.hpp"

namespace tripoint {

/// While it lives, the columns of the world are those that this effect has declared: any other is refused, in
/// the test build.
class DeclaredView {
 public:
  DeclaredView([[maybe_unused]] const World& world, [[maybe_unused]] const Active& a) {
#ifdef TRIPOINT_DEFECTS
    world_ = &world;
    show(&a.declared);
#endif
  }
#ifdef TRIPOINT_DEFECTS
  ~DeclaredView() { show(nullptr); }
  DeclaredView(const DeclaredView&) = delete;
  DeclaredView& operator=(const DeclaredView&) = delete;

 private:
  void show(const DeclaredFields* declared) const {
    world_->particles.show_only(declared);
    world_->bodies.show_only(declared);
  }
  const World* world_;
#endif
};

}  // namespace tripoint
