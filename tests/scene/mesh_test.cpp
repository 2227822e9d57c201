// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>

#include "case_file.hpp"
#include "mesh/mesh.hpp"
#include "sampling/sample.hpp"

namespace tripoint::test {
namespace {

using std::numbers::pi;

const char* const cube_faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

/// Cube of side 1 from the origin; corners in the order of their bits zyx.
std::string cube_obj(const std::string& faces = cube_faces) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " +
            std::to_string(i >> 2 & 1) + "\n";
  return text + faces;
}

/// Sphere of triangles by longitude and latitude, as an OBJ.
std::string sphere_obj(int rings, int sectors) {
  std::string text = "v 0 0 1\nv 0 0 -1\n";
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double a = pi * i / rings, b = 2 * pi * j / sectors;
      text += "v " + std::to_string(std::sin(a) * std::cos(b)) + " " +
              std::to_string(std::sin(a) * std::sin(b)) + " " + std::to_string(std::cos(a)) + "\n";
    }
  const auto at = [&](int i, int j) { return std::to_string(3 + (i - 1) * sectors + j % sectors); };
  for (int j = 0; j < sectors; ++j) {
    text += "f 1 " + at(1, j) + " " + at(1, j + 1) + "\nf 2 " + at(rings - 1, j + 1) + " " +
            at(rings - 1, j) + "\n";
    for (int i = 1; i + 1 < rings; ++i)
      text += "f " + at(i, j) + " " + at(i + 1, j) + " " + at(i + 1, j + 1) + " " + at(i, j + 1) + "\n";
  }
  return text;
}

std::string as_stl(const Mesh& m, bool binary) {
  std::string text = binary ? std::string(80, ' ') : "solid s\n";
  const auto count = static_cast<std::uint32_t>(m.triangles.size());
  if (binary) text.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : m.triangles) {
    if (!binary) text += "facet normal 0 0 0\nouter loop\n";
    if (binary) text.append(12, '\0');
    for (const auto c : t) {
      const auto& p = m.points[c];
      const float xyz[3]{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
      if (binary)
        text.append(reinterpret_cast<const char*>(xyz), 12);
      else
        text +=
            "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    if (binary)
      text.append(2, '\0');
    else
      text += "endloop\nendfacet\n";
  }
  return binary ? text : text + "endsolid s\n";
}

std::string refused(const Folder& folder, const std::string& name, const std::string& bytes) {
  try {
    static_cast<void>(read_mesh(folder.write(name, bytes), 1.0));
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(Mesh, OfACubeHasItsVolumeFromEveryFormat) {
  const Folder folder;
  const auto cube = read_mesh(folder.write("cube.obj", cube_obj()), 2.0);
  EXPECT_EQ(cube.points.size(), 8U);
  EXPECT_EQ(cube.triangles.size(), 12U);
  EXPECT_DOUBLE_EQ(volume(cube), 8.0);
  EXPECT_DOUBLE_EQ(volume(read_mesh(folder.write("cube.stl", as_stl(cube, true)), 1.0)), 8.0);
  EXPECT_DOUBLE_EQ(volume(read_mesh(folder.write("text.stl", as_stl(cube, false)), 1.0)), 8.0);
}

TEST(Mesh, ThatIsOpenIsRefusedWithItsOpenEdges) {
  const Folder folder;
  const std::string faces = cube_faces;
  const auto open = refused(folder, "open.obj", cube_obj(faces.substr(faces.find('\n') + 1)));
  EXPECT_NE(open.find("4 open edges"), std::string::npos) << open;
  EXPECT_NE(open.find("open.obj"), std::string::npos);
  EXPECT_NE(open.find("(0, 0, 0) to (1, 0, 0)"), std::string::npos) << open;
  const auto flipped =
      refused(folder, "flipped.obj", cube_obj("f 2 4 3 1\n" + faces.substr(faces.find('\n') + 1)));
  EXPECT_NE(flipped.find("some of the mesh's faces turn inward"), std::string::npos) << flipped;
  EXPECT_NE(flipped.find("4 edges between them"), std::string::npos) << flipped;
  EXPECT_EQ(flipped.find("hole"), std::string::npos) << "a false reason: " << flipped;
}

TEST(Mesh, ThatTurnsInwardIsRefused) {
  const Folder folder;
  EXPECT_NE(refused(folder, "in.obj",
                    cube_obj("f 2 4 3 1\nf 7 8 6 5\nf 5 6 2 1\nf 4 8 7 3\nf 3 7 5 1\nf 6 8 4 2\n"))
                .find("turn inward"),
            std::string::npos);
}

TEST(Mesh, OfAThirdPartyIsRefusedWithoutACrash) {
  const Folder folder;
  const auto cube = read_mesh(folder.write("cube.obj", cube_obj()), 1.0);
  auto lying = as_stl(cube, true);
  const std::uint32_t many = 0xffffffffU;
  std::memcpy(lying.data() + 80, &many, 4);
  EXPECT_NE(refused(folder, "a.stl", lying), "");
  EXPECT_NE(refused(folder, "b.stl", as_stl(cube, true).substr(0, 300)), "");
  EXPECT_NE(refused(folder, "c.stl", "solid x\nfacet\nvertex 1 2\n"), "");
  EXPECT_NE(refused(folder, "d.stl", "short"), "");
  EXPECT_NE(refused(folder, "e.obj", "v 0 0 0\nf 1 2 3\n"), "");
  EXPECT_NE(refused(folder, "f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n"), "");
  EXPECT_NE(refused(folder, "g.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
  EXPECT_NE(refused(folder, "h.obj", ""), "");
  EXPECT_NE(refused(folder, "i.ply", "ply"), "");
}

TEST(Mesh, WithACornerThatIsNoNumberIsRefusedByItsLine) {
  const Folder folder;
  const auto broken = [&](const std::string& line) {
    std::string text = cube_obj();
    const auto third = text.find("v 0 1 0");
    return refused(folder, "cube.obj", text.replace(third, text.find('\n', third) - third, line));
  };
  for (const char* line : {"v abc 1 1", "v nan 1 0", "v 0 1", "v inf 1 0", "v 0 1 1e999", "v 0 1x 0", "v"})
    EXPECT_NE(broken(line).find("cube.obj:3: "), std::string::npos) << line << ": " << broken(line);
  EXPECT_EQ(broken("v 0 1 0 # corner"), "");
  for (const char* faces : {"f 1 3 x 2\n", "f 1 3\n", "f 1 3 0 2\n", "f 1/a 3/2 4/2\n"})
    EXPECT_NE(refused(folder, "face.obj", cube_obj(faces)).find("face.obj:9: "), std::string::npos) << faces;
  EXPECT_EQ(refused(folder, "textured.obj",
                    cube_obj("vt 0 0\nvn 0 0 1\nf 1/1 3/1 4/1 2/1\nf 5//1 6//1 8//1 7//1\nf 1/1/1 2/1/1 "
                             "6/1/1 5/1/1\nf 3 7 8 "
                             "4\nf 1 5 7 3\nf 2 4 8 6\n")),
            "");
}

TEST(Mesh, WithCornersThatDifferByRoundOffIsClosed) {
  const Folder folder;
  const auto cube = read_mesh(folder.write("cube.obj", cube_obj()), 1.0);
  for (const double noise : {1e-17, 1e-9, 3e-7}) {
    std::string text = "solid s\n";
    int n = 0;
    for (const auto& t : cube.triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const auto c : t) {
        std::ostringstream line;
        line.precision(17);
        const double off = noise * (++n % 3 - 1);
        line << "vertex " << cube.points[c].x + off << ' ' << cube.points[c].y - off << ' '
             << cube.points[c].z << '\n';
        text += line.str();
      }
      text += "endloop\nendfacet\n";
    }
    const auto mesh = read_mesh(folder.write("noisy.stl", text), 1.0);
    EXPECT_EQ(mesh.points.size(), 8U) << noise;
    EXPECT_NEAR(volume(mesh), 1.0, 3e-6) << noise;
  }
}

TEST(Mesh, WhoseEdgesAreUsedTwiceEachWayIsClosed) {
  const Folder folder;
  std::string two = cube_obj();  // a second cube at (1, 1, 0): both share the edge at x = y = 1
  for (int i = 0; i < 8; ++i)
    two += "v " + std::to_string(1 + (i & 1)) + " " + std::to_string(1 + (i >> 1 & 1)) + " " +
           std::to_string(i >> 2 & 1) + "\n";
  two += "f 9 11 12 10\nf 13 14 16 15\nf 9 10 14 13\nf 11 15 16 12\nf 9 13 15 11\nf 10 12 16 14\n";
  EXPECT_DOUBLE_EQ(volume(read_mesh(folder.write("two.obj", two), 1.0)), 2.0);
  const auto twice = refused(folder, "twice.obj", cube_obj(std::string(cube_faces) + cube_faces));
  EXPECT_NE(twice.find("written twice"), std::string::npos) << "its volume would count twice: " << twice;
}

TEST(Mesh, AsObjMayBeWrittenInEveryValidWay) {
  const Folder folder;
  const auto volume_of = [&](const std::string& text) {
    return volume(read_mesh(folder.write("way.obj", text), 1.0));
  };
  const std::string rest = "f 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  for (const char* first :
       {"f 1/ 3/ 4/ 2/\n", "f 1// 3// 4// 2//\n", "f 1 3 \\\n4 2\n", "f 1 3 \\\r\n4 \\\r\n2\r\n",
        "f -8 -6 -5 -7\n", "  f\t1 3 4 2 # base\n", "f 1/7/7 3/7/7 4/7/7 2/7/7\n",
        "g base\nusemtl x\ns off\nf 1 3 4 2\n", "f 1 3 4 2\nl 1 2\nf 1 1 2\n"})
    EXPECT_DOUBLE_EQ(volume_of(cube_obj(first + rest)), 1.0) << first;
  std::string mac = cube_obj();
  std::ranges::replace(mac, '\n', '\r');
  EXPECT_DOUBLE_EQ(volume_of(mac), 1.0);
  EXPECT_DOUBLE_EQ(volume_of("\xEF\xBB\xBF" + cube_obj()), 1.0) << "with a mark of the byte order";
  std::string tiny = cube_obj();
  tiny.replace(tiny.find("v 0 0 0"), 7, "v -0 1e-400 +0");
  EXPECT_DOUBLE_EQ(volume_of(tiny), 1.0) << "a number below the least is 0";
}

TEST(Mesh, IsRefusedForItsTrueReason) {
  const Folder folder;
  const std::string rest = "f 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const auto says = [&](const std::string& faces, const char* what) {
    const auto why = refused(folder, "why.obj", cube_obj(faces));
    EXPECT_NE(why.find(what), std::string::npos) << faces << why;
  };
  says("f 1 3 9 2\n" + rest, "why.obj:9: a face names corner 9, but there are 8");
  says("f 1 3 -9 2\n" + rest, "why.obj:9: a face names corner -9 before the first of the 8 above it");
  says("f 1 3 0 2\n" + rest, "counted from 1");
  says("f 1 1 1\nf 2 2 3\n", "lines or points");
  EXPECT_NE(refused(folder, "text.stl", std::string(200, 'a')).find("no text STL either"), std::string::npos);
}

TEST(Mesh, AsStlMayBeWrittenInEveryValidWay) {
  const Folder folder;
  const auto cube = read_mesh(folder.write("cube.obj", cube_obj()), 1.0);
  const auto volume_of = [&](const std::string& bytes) {
    return volume(read_mesh(folder.write("way.stl", bytes), 1.0));
  };
  std::string zeros = as_stl(cube, true);
  const float minus = -0.0F;
  for (std::size_t t = 0; t < 12; t += 2)
    for (std::size_t n = 0; n < 9; ++n) {
      float x = 1.0F;
      char* at = zeros.data() + 84 + 50 * t + 12 + 4 * n;
      std::memcpy(&x, at, sizeof x);
      if (x == 0.0F) std::memcpy(at, &minus, sizeof minus);
    }
  EXPECT_DOUBLE_EQ(volume_of(zeros), 1.0) << "binary with negative zeros";
  EXPECT_DOUBLE_EQ(volume_of(as_stl(cube, true) + "more of some program"), 1.0);
  std::string header = as_stl(cube, true);
  header.replace(0, 11, "solid facet");
  EXPECT_DOUBLE_EQ(volume_of(header), 1.0) << "binary whose header begins as a text";
  std::string text = as_stl(cube, false);
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  EXPECT_DOUBLE_EQ(volume_of("\r\n " + text), 1.0) << "in capitals, after blanks";
}

TEST(Mesh, HasTheMassCentreAndMomentsOfItsBody) {
  const Folder folder;
  const auto p = mass_properties(read_mesh(folder.write("cube.obj", cube_obj()), 2.0), 500.0);
  EXPECT_NEAR(p.mass, 4000.0, 1e-9);
  EXPECT_NEAR(norm(p.centre - Vec3{1, 1, 1}), 0.0, 1e-12);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p.principal_inertia[k], 4000.0 * 4.0 / 6.0, 1e-9);
  const auto ball = mass_properties(read_mesh(folder.write("ball.obj", sphere_obj(48, 96)), 1.0), 1.0);
  EXPECT_NEAR(ball.principal_inertia.x, 8.0 * pi / 15.0, 0.01) << "facets lie within the ball";
}

TEST(Mesh, WithAFaceOfVeryManyCornersIsRefused) {
  const Folder folder;
  std::string face = "f";
  for (int n = 0; n < 1001; ++n) face += " 1";
  EXPECT_NE(refused(folder, "round.obj", cube_obj(face + "\n")).find("round.obj:9: a face of 1001 corners"),
            std::string::npos)
      << refused(folder, "round.obj", cube_obj(face + "\n"));
}

TEST(Mesh, AsStlWithACornerThatIsNoNumberIsRefusedByItsPlace) {
  const Folder folder;
  const auto cube = read_mesh(folder.write("cube.obj", cube_obj()), 1.0);
  std::string text = as_stl(cube, false);
  const auto first = text.find("vertex");
  for (const char* line : {"vertex nan 0 0", "vertex 0 0", "vertex 0 0 0x", "vertex 0 0 0 7"}) {
    std::string broken = text;
    EXPECT_NE(refused(folder, "text.stl", broken.replace(first, text.find('\n', first) - first, line))
                  .find("text.stl:4: "),
              std::string::npos)
        << line;
  }
  std::string bytes = as_stl(cube, true);
  const float nan = std::nanf("");
  std::memcpy(bytes.data() + 84 + 50 + 12, &nan, sizeof nan);
  EXPECT_NE(refused(folder, "bytes.stl", bytes).find("corner 1 of triangle 2"), std::string::npos);
}

TEST(MeshInterior, OfACubeHoldsJustItsLattice) {
  const Folder folder;
  static_cast<void>(folder.write("cube.obj", cube_obj()));
  const auto file = folder.write("case.toml",
                                 "[scene]\nend_time=1\nspacing=0.2\n[[body]]\nname='b'\nmaterial='steel'"
                                 "\nshape={kind='mesh',file='cube.obj',scale=2}\n");
  const auto scene = scene_for(read_case(file).value, {});
  const auto s = sample(scene);
  EXPECT_EQ(s.size(), 1000U);
  EXPECT_NEAR(mass_properties(s.position, s.mass).mass, 8.0 * 7850.0, 1e-8);
}

TEST(MeshInterior, OfASphereTendsToItsVolume) {
  const Folder folder;
  const auto mesh = read_mesh(folder.write("ball.obj", sphere_obj(24, 48)), 1.0);
  const MeshInterior interior(mesh, 0.025, "ball.obj");
  double inside = 0.0;
  for (double x = -0.975; x < 1.0; x += 0.05)
    for (double y = -0.975; y < 1.0; y += 0.05)
      for (double z = -0.975; z < 1.0; z += 0.05)
        inside += interior.holds({x, y, z}) ? 0.05 * 0.05 * 0.05 : 0.0;
  EXPECT_NEAR(inside / volume(mesh), 1.0, 0.01);  // lattice point discrepancy of a ball of 20 spacings
}

TEST(MeshInterior, GivesASecondAlarmWhenThereIsNoInside) {
  Mesh sheet;  // a triangle used from both sides: every edge matches, nothing is enclosed
  sheet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_NO_THROW(check_closed(sheet, "sheet.obj"));
  EXPECT_THROW(MeshInterior(sheet, 0.05, "sheet.obj"), InputError);
}

}  // namespace
}  // namespace tripoint::test
