// SPDX-License-Identifier: BSD-3-Clause
// What a confined copy hands back in place of a trajectory, where somebody else steers it.
#include "core/errors.hpp"
#include "files/trajectory.hpp"
#include "fuzz/input.hpp"

using namespace tripoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most_frames = 100;
  try {
    const Trajectory read = unpacked(fuzz::text_of(data, size), most_frames);
    fuzz::expect(read.frames.size() <= most_frames, "there are no more frames than there can be");
    for (const Snapshot& s : read.frames)
      for (const auto* column : {&s.temperature, &s.density, &s.mass})
        fuzz::expect(column->empty() || s.position.empty() || column->size() == s.position.size(),
                     "columns have one length");
    const std::string bytes = packed(read);
    fuzz::expect(packed(unpacked(bytes)) == bytes, "what was read is packed and read as the same");
  } catch (const InputError&) {
  }
  return 0;
}
