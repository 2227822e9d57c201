// SPDX-License-Identifier: BSD-3-Clause
// The stored map (validation/stability/frontiers.csv) is what the solver did when it was accepted: a change
// that shrinks a stable region fails here. TRIPOINT_STABILITY_MAP=PATH writes the map anew.
#include "step/stability_map.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

namespace tripoint::stability {
namespace {

std::string name_of(const Point& p) {
  return fmt::format("{},{},{},{:g}", p.map, p.mode, p.parameter, p.value);
}

/// map,mode,parameter,value -> measured frontier [s]
std::map<std::string, double> stored_map() {
  std::ifstream in(STABILITY_MAP);
  std::map<std::string, double> rows;
  for (std::string line; std::getline(in, line);) {
    std::stringstream cells(line);
    std::string name, cell;
    for (int k = 0; k < 4 && std::getline(cells, cell, ','); ++k) name += (k ? "," : "") + cell;
    if (std::getline(cells, cell, ',') && !line.starts_with("map,")) rows[name] = std::stod(cell);
  }
  return rows;
}

TEST(StabilityMap, TheFrontierIsThePredictedOneTheStoredOneAndTwiceTheStepThatTheSolverTakes) {
  const auto stored = stored_map();
  const char* path = std::getenv("TRIPOINT_STABILITY_MAP");
  std::string text = "map,mode,parameter,value,frontier [s],predicted [s],own step [s]\n";
  const std::vector<Point> points = all_points();
  for (const Point& p : points) {
    const double measured = frontier(p);
    text += fmt::format("{},{:.5g},{:.5g},{:.5g}\n", name_of(p), measured, p.predicted, p.own);
    EXPECT_NEAR(measured / p.predicted, 1.0, 0.2) << name_of(p);
    // Bodies swing as slowly as they are heavy: their step is that of sound. The bound of stiffer hourglass
    // forces is too careful.
    const bool careful =
        p.map == "contact" || p.map == "afloat" || name_of(p).ends_with("hourglass stiffness,4");
    EXPECT_GE(p.own / measured, careful ? 0.2 : 0.4)
        << name_of(p) << ": the solver's own step wastes what is stable";
    EXPECT_LE(p.own / measured, 0.8) << name_of(p) << ": the solver's own step is too near to the frontier";
    if (path) continue;
    ASSERT_TRUE(stored.contains(name_of(p))) << name_of(p);
    // Bisected to 0.5 %
    EXPECT_GE(measured, 0.98 * stored.at(name_of(p))) << name_of(p) << ": a stable region has shrunk";
  }
  if (path)
    std::ofstream(path) << text;
  else
    EXPECT_EQ(stored.size(), points.size());
}

}  // namespace
}  // namespace tripoint::stability
