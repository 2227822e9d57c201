// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/name_checks.hpp"
#include "scene/scene.hpp"

namespace tripoint {

/// Rules of [[joint]] that need the whole scene.
class JointChecks : NameChecks {
 public:
  JointChecks(const Scene&, const Reading&);
  /// @throws InputError for a body that is unknown, not rigid, or cannot be held; for two that do not move
  void check() const;

 private:
  const Scene& scene_;
};

}  // namespace tripoint
