// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "validation/case/choices.hpp"

/// The checked case: a scene, and how its runs are judged. SI, with every default filled in.
namespace tripoint {

struct Case {
  std::string id, title, requirement, claims;
  CaseKind kind = CaseKind::verification;
  std::vector<std::string> profiles{"commit"}, tags;
  Expect expect = Expect::pass;
  std::vector<Mode> modes{Mode::corrected};
  Scene scene;
  std::vector<EngineChoice> engines;
  ReferenceChoice reference;
  std::vector<MetricChoice> metrics;
  std::vector<Study> studies;
  std::vector<Gate> gates;
  std::vector<UncertainInput> inputs;
  std::vector<Defect> defects;
  std::vector<std::string> harmless;
  std::string file;  ///< the path it was read from
};

}  // namespace tripoint
