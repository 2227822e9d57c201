// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <string>

#include "fakes.hpp"
#include "judged.hpp"
#include "validation/baseline/baseline.hpp"

namespace tripoint {

/// A suite in a folder of its own, which keeps baselines.
struct Kept {
  TestFolder folder;
  Results r = green();
  Kept() {
    write_text(folder / "cases/test/one.toml", "format = 1\n");
    std::filesystem::create_directories(folder / "baselines");
    r.cases[0].file = folder / "cases/test/one.toml";
    engine(r).runs[0].cost.pairs = 1000.0;
    engine(r).runs[0].cost.steps = 10.0;
    engine(r).runs[0].folder = "runs/test/one/tripoint/corrected";
    judge(r);
  }
  std::string accept_all(const Lacking& lacking = {}) {
    return accept(r, {}, {"2026-11-21", "abc", "a test"}, lacking);
  }
};

}  // namespace tripoint
