// SPDX-License-Identifier: BSD-3-Clause
// same_trajectory A.h5 B.h5: exit 0 when both show the same frames, bit for bit, else 1 with the first frame
// that differs.
#include <cstdio>

#include "files/trajectory.hpp"

int main(int argc, char** argv) {
  using namespace tripoint;
  if (argc != 3) return 2;
  const Trajectory a = read_trajectory(argv[1]), b = read_trajectory(argv[2]);
  for (std::size_t f = 0; f < a.frames.size() && f < b.frames.size(); ++f) {
    FramesHash x, y;
    x.add(a.frames[f]);
    y.add(b.frames[f]);
    if (x.text() == y.text() && a.frames[f].bodies.size() == b.frames[f].bodies.size() &&
        a.frames[f].energy.size() == b.frames[f].energy.size())
      continue;
    std::printf("frame %zu differs\n", f);
    return 1;
  }
  if (a.frames.size() != b.frames.size())
    std::printf("%zu frames against %zu\n", a.frames.size(), b.frames.size());
  return a.frames.size() == b.frames.size() ? 0 : 1;
}
