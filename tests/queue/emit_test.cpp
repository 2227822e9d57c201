// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/emit.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "queue/folder.hpp"

namespace tripoint {
namespace {

EmitOptions options() {
  EmitOptions o;
  o.program = "bin/tripoint";
  o.dir = "it's here";
  o.typed = "suite";
  o.shards = 9;
  o.numbers = {1, 2, 3, 5, 8, 9};
  o.longest = 1000.0;
  return o;
}

TEST(Scripts, NameTheShardsThatAreLeft) {
  EXPECT_NE(script_for("slurm", test::queue_of(3), options()).find("--array=1-3,5,8-9\n"), std::string::npos);
  EXPECT_NE(script_for("hyperqueue", test::queue_of(3), options()).find("--array 1-3,5,8-9 "),
            std::string::npos);
  EXPECT_NE(script_for("parallel", test::queue_of(3), options()).find("::: 1 2 3 5 8 9\n"),
            std::string::npos);
  EXPECT_NE(script_for("snakemake", test::queue_of(3), options()).find("k=[1, 2, 3, 5, 8, 9]"),
            std::string::npos);
  EXPECT_NE(script_for("github", test::queue_of(3), options()).find("k: [1, 2, 3, 5, 8, 9]"),
            std::string::npos);
}

TEST(Scripts, AllotFourTimesWhatIsPredicted) {
  // 4000 s
  EXPECT_NE(script_for("slurm", test::queue_of(3), options()).find("#SBATCH --time=67\n"), std::string::npos);
  auto o = options();
  o.longest = 3.0;
  EXPECT_NE(script_for("slurm", test::queue_of(3), o).find("#SBATCH --time=15\n"), std::string::npos);
}

TEST(Scripts, QuoteAFolderWhateverItIsCalled) {
  EXPECT_NE(script_for("parallel", test::queue_of(3), options()).find(R"(DIR='it'\''s here')"),
            std::string::npos);
}

TEST(Scripts, AreWrittenForNamedSchedulersOnly) {
  EXPECT_THROW(static_cast<void>(script_for("cron", test::queue_of(3), options())), InputError);
}

}  // namespace
}  // namespace tripoint
