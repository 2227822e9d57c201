// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/errors.hpp"
#include "files/h5md_file.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

// tests/files/foreign_filter.cpp sets it as it is loaded
constexpr const char* mark = "TRIPOINT_FOREIGN_FILTER";
constexpr const char* position = "/particles/all/position/value";

struct ForeignFile : ::testing::Test {
  ForeignFile()
      : folder(std::filesystem::temp_directory_path() / ("tripoint foreign " + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~ForeignFile() override { std::filesystem::remove_all(folder); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }

  /// A trajectory of one frame of one particle at (1, 2, 3).
  [[nodiscard]] std::string whole(const std::string& name) const {
    Snapshot s;
    s.position = {{1.0, 2.0, 3.0}};
    s.velocity = {{}};
    s.mass = {1.0};
    s.id = {0};
    TrajectoryWriter writer(path(name));
    writer.append(s);
    writer.close();
    return path(name);
  }

  /// Puts another dataset of one frame of one vector in the place of the positions.
  static void replace_position(const std::string& path, const h5::Handle& properties, bool write) {
    h5::Handle file = h5::open_for_change(path);
    ASSERT_GE(H5Ldelete(file.get(), position, H5P_DEFAULT), 0);
    const hsize_t shape[3] = {1, 1, 3};
    const h5::Handle space(H5Screate_simple(3, shape, nullptr), H5Sclose, path);
    {
      const h5::Handle dataset(H5Dcreate2(file.get(), position, H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                                          properties.get(), H5P_DEFAULT),
                               H5Dclose, path);
      const double values[3] = {7.0, 8.0, 9.0};
      if (write)
        h5::check(H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
      h5::write_text_attribute(dataset.get(), "unit", "m");
    }
    file.close(path);
  }
  static h5::Handle properties() { return {H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties"}; }

  /// What is said of a file that is not read; empty = it is read.
  static std::string refusal(const std::string& path) {
    try {
      static_cast<void>(read_trajectory(path));
      return "";
    } catch (const InputError& e) {
      return e.what();
    }
  }

  std::filesystem::path folder;
};

std::size_t unchanged(unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) {
  return bytes;
}

/// Puts positions there that only the foreign filter can read. In another process, so that the library knows
/// no such filter here: to forget one again it looks at every file, also at those that other tests left half
/// closed.
void write_filtered(const std::string& file) {
  const pid_t child = ::fork();
  if (child == 0) {
    const H5Z_class2_t own{H5Z_CLASS_T_VERS, FOREIGN_FILTER, 1, 1, "foreign", nullptr, nullptr, unchanged};
    const h5::Handle filtered(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
    const hsize_t chunk[3] = {1, 1, 3};
    const bool done = H5Zregister(&own) >= 0 && H5Pset_chunk(filtered.get(), 3, chunk) >= 0 &&
                      H5Pset_filter(filtered.get(), FOREIGN_FILTER, H5Z_FLAG_MANDATORY, 0, nullptr) >= 0;
    if (done) ForeignFile::replace_position(file, filtered, true);
    ::_exit(done && !::testing::Test::HasFailure() ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
}

TEST_F(ForeignFile, AFilterThatIsNotBuiltInIsNotLoadedFromAPlugin) {
  ASSERT_EQ(::getenv(mark), nullptr);
  const std::string file = whole("filtered.h5");
  write_filtered(file);

  // As the library starts, or as another user of it leaves it
  ASSERT_GE(H5PLset_loading_state(H5PL_ALL_PLUGIN), 0);
  ASSERT_GE(H5PLprepend(FOREIGN_FILTERS), 0);
  EXPECT_NE(refusal(file).find("cannot be read"), std::string::npos) << refusal(file);
  EXPECT_EQ(::getenv(mark), nullptr) << "a file had the library load and run a shared object";

  // The library itself would have loaded it: what was looked for above is there.
  const h5::Handle open = h5::open_for_reading(file);
  ASSERT_GE(H5PLset_loading_state(H5PL_ALL_PLUGIN), 0);
  EXPECT_EQ(h5::read_real(open.get(), position, file).real, (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_NE(::getenv(mark), nullptr);
}

TEST_F(ForeignFile, NoWayOfOpeningAFileLeavesPluginsOn) {
  const auto state_after = [](const auto& open) {
    H5PLset_loading_state(H5PL_ALL_PLUGIN);
    static_cast<void>(open());
    unsigned state = 1;
    H5PLget_loading_state(&state);
    return state;
  };
  const std::string file = path("any.h5");
  EXPECT_EQ(state_after([&] { return h5::create_file(file); }), 0U);
  EXPECT_EQ(state_after([&] { return h5::create_latest(file, 512); }), 0U);
  EXPECT_EQ(state_after([&] { return h5::open_for_change(file); }), 0U);
  EXPECT_EQ(state_after([&] { return h5::open_for_reading(file); }), 0U);
}

TEST_F(ForeignFile, DataThatLieInAnotherFileAreRefused) {
  const std::string other = whole("other.h5");
  std::ofstream(path("raw"), std::ios::binary) << std::string(24, '\0');

  const std::string raw = whole("raw.h5");
  const h5::Handle outside = properties();
  ASSERT_GE(H5Pset_external(outside.get(), path("raw").c_str(), 0, 24), 0);
  replace_position(raw, outside, false);
  EXPECT_NE(refusal(raw).find("keeps its data in another file; refused"), std::string::npos) << refusal(raw);

  const std::string pieced = whole("pieced.h5");
  const h5::Handle pieces = properties();
  const hsize_t shape[3] = {1, 1, 3};
  const h5::Handle space(H5Screate_simple(3, shape, nullptr), H5Sclose, pieced);
  ASSERT_GE(H5Pset_virtual(pieces.get(), space.get(), other.c_str(), position, space.get()), 0);
  replace_position(pieced, pieces, false);
  EXPECT_NE(refusal(pieced).find("keeps its data in another file; refused"), std::string::npos)
      << refusal(pieced);
}

TEST_F(ForeignFile, NoLinkOpensAnotherFile) {
  // A group `elsewhere` that is /particles of other.h5 beside it; the library that refuses such links makes
  // none either.
  std::filesystem::copy_file(std::string(FOREIGN_FILES) + "/linked-elsewhere.h5", path("linked.h5"));
  ASSERT_EQ(refusal(whole("other.h5")), "");
  const h5::Handle file = h5::open_for_reading(path("linked.h5"));
  EXPECT_TRUE(h5::has(file.get(), "/elsewhere"));
  EXPECT_FALSE(h5::has(file.get(), "/elsewhere/all")) << "a link was followed into another file";
  EXPECT_THROW(static_cast<void>(h5::shape(file.get(), "/elsewhere/all/position/value", "linked.h5")),
               InputError);
}

}  // namespace
}  // namespace tripoint
