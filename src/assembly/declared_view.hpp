// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "assembly/all_effects.hpp"

namespace tripoint {

/// While it lives, the columns of the state are those that this effect has declared: any other is refused, in
/// the test build.
class DeclaredView {
 public:
  DeclaredView([[maybe_unused]] const State& state, [[maybe_unused]] const Active& a) {
#ifdef TRIPOINT_DEFECTS
    state_ = &state;
    show(&a.declared);
#endif
  }
#ifdef TRIPOINT_DEFECTS
  ~DeclaredView() { show(nullptr); }
  DeclaredView(const DeclaredView&) = delete;
  DeclaredView& operator=(const DeclaredView&) = delete;

 private:
  void show(const DeclaredFields* declared) const {
    state_->particles.show_only(declared);
    state_->bodies.show_only(declared);
  }
  const State* state_;
#endif
};

}  // namespace tripoint
