// SPDX-License-Identifier: BSD-3-Clause
// A case file: read, resolved, asked for its effects, and where it is small sampled and checked.
#include "core/errors.hpp"
#include "fuzz/input.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  if (fuzz::parser_has_no_child() && !fuzz::is_ascii(data, size)) return 0;
  try {
    const CaseReading reading = read_case(folder.write("case.toml", fuzz::text_of(data, size)));
    const Scene scene = scene_for(reading.value, {});
    static_cast<void>(called_effects(scene));
    static_cast<void>(idle_effects(scene));
    // How long a large scene takes is not what is asked here
    if (scene.bodies.size() > 4 || !(scene.spacing > 0.05)) return 0;
    const InitialState initial = sample(scene);
    if (initial.size() < 3000) static_cast<void>(preflight(reading.value, scene, initial));
  } catch (const InputError&) {
  }
  return 0;
}
