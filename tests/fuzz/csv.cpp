// SPDX-License-Identifier: BSD-3-Clause
// trajectory.csv and, where the first byte is odd, gauges.csv of a small engine.
#include "core/errors.hpp"
#include "files/trajectory.hpp"
#include "fuzz/input.hpp"

using namespace tripoint;

namespace {

InitialState eight_particles() {
  InitialState s;
  for (int k = 0; k < 8; ++k) {
    s.position.push_back({0.1 * k, 0.0, 0.0});
    s.velocity.push_back({});
    s.mass.push_back(1.0);
    s.phase.push_back(2);
    s.body.push_back(k / 4);
    s.material.push_back(0);
    s.source.push_back(0);
  }
  return s;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  static const InitialState initial = eight_particles();
  if (size == 0) return 0;
  const std::string path = folder.write("table.csv", fuzz::text_of(data + 1, size - 1));
  try {
    Trajectory trajectory;
    if (data[0] & 1)
      read_gauges_csv(path, {"height", "force"}, trajectory);
    else
      trajectory = read_trajectory_csv(path, initial, 2);
    for (std::size_t k = 1; k < trajectory.frames.size(); ++k)
      fuzz::expect(trajectory.frames[k - 1].time < trajectory.frames[k].time, "frames are in order of time");
  } catch (const InputError&) {
  }
  return 0;
}
