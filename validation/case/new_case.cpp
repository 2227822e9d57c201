// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"
#include "validation/case/schema.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

/// Template by template, sorted by name.
std::vector<std::string> templates(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

/// What holds for the template alone: the line on itself, and the suite that it belongs to.
bool is_of_template(const std::string& line) {
  for (const char* begin : {"# `tripoint new", "requirement =", "profiles =", "tags ="})
    if (line.starts_with(begin)) return true;
  return false;
}

}  // namespace

std::string new_case_text(const std::string& id, const std::string& from) {
  const fs::path folder = fs::path(share_folder()) / "cases" / "templates";
  const auto names = templates(folder);
  if (std::ranges::find(names, from) == names.end())
    throw InputError(fmt::format("no template is named `{}`{}", printable(from), suggestion(from, names)));
  std::ifstream in(folder / (from + ".toml"));
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (is_of_template(line)) continue;
    text += line + "\n";
    if (line == "[case]") text += fmt::format("id = \"{}\"\n", id);
  }
  return text;
}

std::string new_case_text(const std::string& id) {
  return fmt::format(
      R"(# A case of tripoint. `tripoint explain FILE` prints the meaning of each key and default,
# `tripoint schema --page` all keys.
# Numbers are SI, or texts with a unit: "3 mm", "20 degC".
format = 1

[case]
id = "{}"
title = "A steel block is thrown and falls"

[scene]
end_time = 1.0
gravity = [0.0, 0.0, -9.81]
spacing = 0.05
time_step = 0.01

[[body]]
name = "block"
material = "steel"                 # of the library: water ice wax steel rubber; or a [[material]] of your own
shape = {{kind = "box", min = [-0.1, -0.1, -0.1], max = [0.1, 0.1, 0.1]}}
velocity = [1.0, 0.0, 3.0]

# Judged against free flight, whose exact solution the engines share.
[reference]
kind = "analytic"
function = "ballistic"

[[metric]]
name = "position"
quantity = "position"
norm = "max"
unit = "m"

[[gate]]
metric = "position"
engine = "tripoint"
limit = 1e-10
reason = "kick-drift-kick is exact in a uniform field, but for round-off"

# A gate without engine judges every engine that runs, yours too (--engines all,PATH). `tripoint gate
# adopt` writes tighter ones for it.
[[gate]]
metric = "position"
limit = 0.05
reason = "a sound scheme of first order lags by g dt T/2 = 0.04905 m at this step"
date = "2026-11-22" # it is loose for an engine that does better, and stays
)",
      id);
}

}  // namespace tripoint
