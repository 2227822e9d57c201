// SPDX-License-Identifier: BSD-3-Clause
// Meshes of bodies whose volume, area and distance are known.
#include "surface/surface_mesh.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "surface/mesh_files.hpp"
#include "surface/shapes.hpp"

namespace tripoint {
namespace {

constexpr double spacing = 0.01;

Mesh mesh_of(const std::vector<Vec3>& places, bool detector = true, int threads = 2,
             double voxel = 0.5 * spacing) {
  SurfaceOptions o = SurfaceOptions::for_spacing(spacing);
  o.detector = detector;
  return surface_mesh(ImplicitSurface(places, o), voxel, threads);
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(SurfaceMesh, OfABallConvergesInVolumeAndPlace) {
  const auto body = shapes::ball(1.0);
  const auto five = shapes::errors_at(body, 1.0 / 5), ten = shapes::errors_at(body, 1.0 / 10),
             twenty = shapes::errors_at(body, 1.0 / 20);
  EXPECT_LT(ten.volume, 0.02);
  EXPECT_GT(order(five.volume, twenty.volume) / 2.0, 1.0);
  // The lattice's own steps: half a spacing, order 1
  EXPECT_GT(order(five.hausdorff, twenty.hausdorff) / 2.0, 0.7);
  EXPECT_LT(twenty.hausdorff, 0.6 / 20);
}

TEST(SurfaceMesh, OfATorusAndASlabConverges) {
  for (const auto& body : {shapes::torus(2.0, 1.0), shapes::slab(4.0, 1.0)}) {
    const auto coarse = shapes::errors_at(body, body.size / 4),
               fine = shapes::errors_at(body, body.size / 12);
    EXPECT_GT(order(coarse.volume, fine.volume) / std::log2(3.0), 0.9) << body.name;
    EXPECT_GT(order(coarse.hausdorff, fine.hausdorff) / std::log2(3.0), 0.8) << body.name;
  }
}

TEST(SurfaceMesh, IsClosedAndHasTheGenusOfItsBody) {
  const auto ball =
      measures_of(mesh_of(shapes::lattice(shapes::ball(8 * spacing), spacing, {0.5, 0.5, 0.5})));
  EXPECT_EQ(ball.open_edges, 0U);
  EXPECT_EQ(ball.euler, 2);
  EXPECT_EQ(ball.pieces, 1U);
  const auto torus = measures_of(
      mesh_of(shapes::lattice(shapes::torus(8 * spacing, 4 * spacing), spacing, {0.21, 0.37, 0.11})));
  EXPECT_EQ(torus.open_edges, 0U);
  EXPECT_EQ(torus.euler, 0);
  EXPECT_EQ(torus.pieces, 1U);
}

TEST(SurfaceMesh, TurnsOutwards) {
  const Mesh mesh = mesh_of(shapes::lattice(shapes::ball(5 * spacing), spacing, {0.5, 0.5, 0.5}));
  EXPECT_GT(volume(mesh), 0.0);
  EXPECT_NO_THROW(check_closed(mesh, "ball"));
}

TEST(SurfaceMesh, LiesOnTheSurfaceFunction) {
  const auto places = shapes::lattice(shapes::ball(6 * spacing), spacing, {0.5, 0.5, 0.5});
  const ImplicitSurface surface(places, SurfaceOptions::for_spacing(spacing));
  SurfaceProbe probe(surface);
  const Mesh mesh = surface_mesh(surface, 0.5 * spacing, 2);
  for (const Vec3& r : mesh.points) EXPECT_LT(std::abs(probe.phi(r)), 1e-4 * spacing);
}

TEST(SurfaceMesh, HasTheSameBitsForAnyNumberOfThreads) {
  const auto places = shapes::lattice(shapes::torus(6 * spacing, 3 * spacing), spacing, {0.21, 0.37, 0.11});
  const Mesh one = mesh_of(places, true, 1);
  ASSERT_GT(one.points.size(), 1000U);
  for (const int threads : {2, 3, 7}) {
    const Mesh other = mesh_of(places, true, threads);
    EXPECT_EQ(one.points, other.points) << threads;
    EXPECT_EQ(one.triangles, other.triangles) << threads;
  }
}

std::vector<Vec3> two_balls(double gap) {
  std::vector<Vec3> places;
  for (const Vec3& r : shapes::lattice(shapes::ball(5 * spacing), spacing, {0.5, 0.5, 0.5})) {
    places.push_back(r - Vec3{0, 0, 5 * spacing + 0.5 * gap});
    places.push_back(r + Vec3{0, 0, 5 * spacing + 0.5 * gap});
  }
  return places;
}

TEST(SurfaceMesh, OfTwoNearBallsIsTwoPiecesAndWithoutTheDetectorIsNot) {
  const auto with = measures_of(mesh_of(two_balls(2.0 * spacing))),
             without = measures_of(mesh_of(two_balls(2.0 * spacing), false));
  EXPECT_EQ(with.pieces, 2U);
  EXPECT_EQ(with.euler, 4);
  EXPECT_FALSE(without.pieces == 2U && without.euler == 4);
  EXPECT_EQ(with.open_edges + without.open_edges, 0U);
}

/// Random drops: what OpenVDB has to close where cells are ambiguous.
TEST(SurfaceMesh, OfASplashIsClosed) {
  std::vector<Vec3> places;
  std::uint64_t state = 5;
  const auto random = [&] {
    return static_cast<double>((state = state * 6364136223846793005ULL + 1442695040888963407ULL) >> 11) /
           9007199254740992.0;
  };
  for (int n = 0; n < 1500; ++n) places.push_back(16 * spacing * Vec3{random(), random(), random()});
  for (const bool detector : {true, false})
    EXPECT_EQ(measures_of(mesh_of(places, detector)).open_edges, 0U) << detector;
}

TEST(SurfaceMesh, OfNothingIsEmptyAndOfABadVoxelRefused) {
  EXPECT_TRUE(mesh_of({}).triangles.empty());
  EXPECT_THROW((void)mesh_of({{0, 0, 0}}, true, 1, 0.0), InputError);
  EXPECT_THROW((void)mesh_of({{0, 0, 0}, {1e3, 0, 0}}, true, 1, 1e-5), InputError);
}

TEST(SurfaceMesh, KnowsWhatItsParticlesKnow) {
  std::vector<Vec3> places =
      shapes::lattice(shapes::slab(12 * spacing, 6 * spacing), spacing, {0.5, 0.5, 0.5});
  std::vector<double> T;
  std::vector<int> body;
  for (const Vec3& r : places) {
    T.push_back(300.0 + 1000.0 * r.x);
    body.push_back(r.x < 0.0 ? 4 : 7);
  }
  T.front() = std::nan("");
  const ImplicitSurface surface(places, SurfaceOptions::for_spacing(spacing));
  const Vec3 top{0.02, 0.01, 3 * spacing};
  EXPECT_NEAR(mean_at(surface, std::vector<Vec3>{top}, T, 1).front(), 320.0,
              0.5);  // linear along the face: kept but for the lattice
  EXPECT_EQ(label_at(surface, std::vector<Vec3>{top, {-0.02, 0.0, 3 * spacing}, {5.0, 5.0, 5.0}}, body, 1),
            (std::vector<int>{7, 4, -1}));
  EXPECT_TRUE(std::isnan(mean_at(surface, std::vector<Vec3>{{5.0, 5.0, 5.0}}, T, 1).front()));
}

class MeshFiles : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tripoint-mesh-" + std::to_string(::getpid()));
  std::vector<SurfacePart> parts;
  void SetUp() override {
    std::filesystem::create_directories(folder);
    for (const double z : {-0.2, 0.2}) {
      std::vector<Vec3> places;
      for (const Vec3& r : shapes::lattice(shapes::ball(5 * spacing), spacing, {0.5, 0.5, 0.5}))
        places.push_back(r + Vec3{0, 0, z});
      SurfacePart part{z < 0 ? "body 0" : "liquid wax", mesh_of(places), {}, {}, {}};
      part.temperature.assign(part.mesh.points.size(), 300.0);
      part.phase.assign(part.mesh.points.size(), 2);
      part.body.assign(part.mesh.points.size(), z < 0 ? 0 : -1);
      parts.push_back(part);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(MeshFiles, ObjIsReadBackClosedWithItsVolume) {
  const auto file = (folder / "two.obj").string();
  write_obj(file, parts);
  const Mesh back = read_mesh(file, 1.0);  // checks that it is closed
  EXPECT_EQ(back.triangles.size(), parts[0].mesh.triangles.size() + parts[1].mesh.triangles.size());
  EXPECT_NEAR(volume(back), volume(parts[0].mesh) + volume(parts[1].mesh),
              1e-7 * volume(back));  // the reader of OBJ has seven digits
}

TEST_F(MeshFiles, PlyHasARecordForEachCornerAndTriangle) {
  const auto file = (folder / "two.ply").string();
  write_ply(file, parts);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto head = bytes.find("end_header\n") + 11;
  const std::size_t corners = parts[0].mesh.points.size() + parts[1].mesh.points.size(),
                    triangles = parts[0].mesh.triangles.size() + parts[1].mesh.triangles.size();
  EXPECT_NE(bytes.find("element vertex " + std::to_string(corners) + "\n"), std::string::npos);
  EXPECT_EQ(bytes.size() - head, corners * (3 * 8 + 4 + 3 * 4) + triangles * (1 + 3 * 4));
  double x = 0.0;
  std::memcpy(&x, bytes.data() + head, sizeof x);
  EXPECT_EQ(x, parts[0].mesh.points[0].x);
}

TEST_F(MeshFiles, SayWhereTheyCannotBeWritten) {
  EXPECT_THROW(write_ply((folder / "none" / "a.ply").string(), parts), EngineError);
}

}  // namespace
}  // namespace tripoint
