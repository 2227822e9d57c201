// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "program/predict/machine.hpp"

namespace tripoint::predict {
namespace {

struct File {
  std::string path =
      (std::filesystem::temp_directory_path() /
       ("tripoint-machine-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
        ".toml"))
          .string();
  explicit File(const std::string& text) { std::ofstream(path) << text; }
  ~File() { std::remove(path.c_str()); }
};

TEST(Machine, AFileSaysWhatDiffersFromTheUsual) {
  const File f("name = \"cluster\"\ncores_a_node = 64\nlatency = 2e-6\nbandwidth = 1e9\n");
  const Machine m = read_machine(f.path);
  EXPECT_EQ(m.name, "cluster");
  EXPECT_EQ(m.cores_a_node, 64);
  EXPECT_EQ(m.allreduce, 2e-6);
  EXPECT_EQ(m.pack_rate, 4e9);
  EXPECT_EQ(m.core_speed, 1.0);
  EXPECT_FALSE(m.speed_at_once);  // as measured here
  EXPECT_EQ(m.waiting, 0.05);
}

TEST(Machine, AMistakeIsNamedWithItsPlace) {
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"cores_a_node = 64\nlatency = 2e-6\n", "bandwidth"},
           {"cores_a_node = 64\nlatencyy = 2e-6\nbandwidth = 1e9\n", "did you mean"},
           {"cores_a_node = 64\nlatency = -1\nbandwidth = 1e9\n", "above 0"}}) {
    const File f(text);
    try {
      static_cast<void>(read_machine(f.path));
      FAIL() << text;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  }
}

constexpr const char* probed =
    R"({"ranks": 2, "mpi": "MPICH 5.0.2", "exchanges": [{"bytes": 8, "seconds": 1e-6},
     {"bytes": 1048576, "seconds": 5.25288e-4}], "allreduce": [{"doubles": 1, "seconds": 2e-6},
     {"doubles": 1024, "seconds": 6e-6}], "pack_rate": 3e9})";

TEST(Machine, AProbeGivesLatencyAndBandwidth) {
  const Machine m = machine_of_probe(probed, 8);
  EXPECT_EQ(m.latency, 1e-6);
  EXPECT_NEAR(m.bandwidth, 1048576 / 5.24288e-4, 1.0);  // 2 GB/s
  EXPECT_EQ(m.allreduce, 2e-6);
  EXPECT_EQ(m.cores_a_node, 8);
}

/// Another program had its turn in every small exchange.
TEST(Machine, AProbeOfABusyMachineStillHasARate) {
  std::string busy = probed;
  busy.replace(busy.find("1e-6"), 4, "9e-3");
  const Machine m =
      machine_of_probe(busy.insert(busy.find("{\"bytes\": 8"), R"({"bytes": 65536, "seconds": 1e-4}, )"), 8);
  EXPECT_EQ(m.latency, 1e-4);
  EXPECT_NEAR(m.bandwidth, 1048576 / 4.25288e-4, 1.0);
}

TEST(Machine, AProbeThatCannotBeIsAnError) {
  EXPECT_THROW(static_cast<void>(machine_of_probe("{}", 8)), EngineError);
  std::string zero = probed;
  zero.replace(zero.find("1e-6"), 4, "0e-6");
  EXPECT_THROW(static_cast<void>(machine_of_probe(zero, 8)), EngineError);
}

}  // namespace
}  // namespace tripoint::predict
