// SPDX-License-Identifier: BSD-3-Clause
// Shards come from other machines, and other hands: what is in them is taken as files and folders, or not at
// all.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/campaign/merge.hpp"
#include "validation/judge/judge.hpp"
#include "validation/run/plain_tree.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Two shards with a file each, and a secret beside them.
struct ThirdPartyShards : ::testing::Test {
  ThirdPartyShards() {
    for (int k = 0; k < 2; ++k) {
      auto part = green();
      part.cases[0].id = "test/" + std::to_string(k);
      part.planned = {part.cases[0].id};
      part.shard = std::to_string(k + 1) + "/2";
      judge(part);
      const std::string shard = "s" + std::to_string(k);
      write_text(folder / (shard + "/results.json"), results_text(part));
      write_text(folder / (shard + "/runs/test/" + std::to_string(k) + "/result.json"), shard);
    }
    write_text(folder / "secret/text", "precious");
  }

  void merge() const {
    fs::create_directories(folder / "out");
    static_cast<void>(merge_shards({folder / "s0", folder / "s1"}));
    copy_runs_of_shards({folder / "s0", folder / "s1"}, folder / "out");
  }

  /// The refusal names this path, and nothing has come to the folder of the merge.
  void expect_refused(const std::string& name) const {
    try {
      merge();
      ADD_FAILURE() << name << " was taken";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(folder / name), std::string::npos) << e.what();
    }
    EXPECT_FALSE(fs::exists(folder / "out/runs")) << name;
  }

  TestFolder folder;
};

TEST_F(ThirdPartyShards, OfFilesAndFoldersAreCopiedWithTheirRuns) {
  fs::create_hard_link(folder / "s0/runs/test/0/result.json", folder / "s0/runs/test/0/again.json");
  merge();
  EXPECT_EQ(text_of(folder / "out/runs/test/0/result.json"), "s0");
  EXPECT_EQ(text_of(folder / "out/runs/test/0/again.json"), "s0");
  EXPECT_EQ(text_of(folder / "out/runs/test/1/result.json"), "s1");
  write_text(folder / "s1/runs/test/1/result.json", "made again");
  merge();
  EXPECT_EQ(text_of(folder / "out/runs/test/1/result.json"), "made again");
}

TEST_F(ThirdPartyShards, WithALinkAreRefusedByItsName) {
  for (const std::string to : {"secret/text", "secret", "nowhere"}) {
    fs::create_symlink(folder / to, folder / "s1/runs/test/leak");
    expect_refused("s1/runs/test/leak");
    fs::remove(folder / "s1/runs/test/leak");
  }
}

TEST_F(ThirdPartyShards, ThatAreLinksThemselvesAreRefusedByName) {
  for (const std::string name : {"results.json", "runs"}) {
    fs::rename(folder / ("s1/" + name), folder / ("secret/" + name));
    fs::create_symlink(folder / ("secret/" + name), folder / ("s1/" + name));
    expect_refused("s1/" + name);
    fs::remove(folder / ("s1/" + name));
    fs::rename(folder / ("secret/" + name), folder / ("s1/" + name));
  }
}

TEST_F(ThirdPartyShards, WithAPipeAreRefusedByItsName) {
  ASSERT_EQ(::mkfifo((folder / "s0/runs/pipe").c_str(), 0600), 0);
  expect_refused("s0/runs/pipe");
  fs::remove(folder / "s0/runs/pipe");
  fs::remove(folder / "s0/results.json");
  ASSERT_EQ(::mkfifo((folder / "s0/results.json").c_str(), 0600), 0);
  expect_refused("s0/results.json");
}

TEST(PlainTree, ThatIsCopiedHoldsNoDevice) {
  EXPECT_THROW(expect_plain_tree("/dev/null"), InputError);
  EXPECT_NO_THROW(expect_plain_tree("/no/such/folder"));
}

}  // namespace
}  // namespace tripoint
