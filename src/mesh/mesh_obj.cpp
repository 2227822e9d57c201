// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <vector>

#include "core/errors.hpp"
#include "mesh/mesh_files.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

constexpr std::size_t most_corners = 1000;  // of one face: the library's time to cut it goes by the square

/// strtod, not from_chars: a number below the least is 0. It reads hexadecimal too, which no mesh has.
bool is_number(const std::string& word) {
  char* stop = nullptr;
  const double value = std::strtod(word.c_str(), &stop);
  return *stop == '\0' && std::isfinite(value) && word.find_first_of("xX") == std::string::npos;
}

/// The first number of "7", "7/", "7/2", "7//3" or "7/2/3"; nothing where one of them is no whole number, or
/// 0.
std::optional<long> corner_of(const std::string& word) {
  std::istringstream parts(word);
  std::optional<long> first;
  int number = 0;
  for (std::string part; std::getline(parts, part, '/'); ++number) {
    if (part.empty() && number > 0) continue;
    long value = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || stop != part.data() + part.size() || value == 0) return {};
    if (number == 0) first = value;
  }
  return number <= 3 ? first : std::nullopt;
}

/// Text with the ends of lines of any system, each as one '\n', and without a mark of the byte order.
std::string with_plain_ends(const std::string& bytes) {
  std::string text;
  for (std::size_t i = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < bytes.size(); ++i) {
    const bool carriage_return = bytes[i] == '\r';
    if (carriage_return && i + 1 < bytes.size() && bytes[i + 1] == '\n') continue;
    text += carriage_return ? '\n' : bytes[i];
  }
  return text;
}

/// Corners and faces as the library understands them. It reads text that is no number as 0, and not every
/// valid line.
class PlainObj {
 public:
  explicit PlainObj(std::string file) : file_(std::move(file)) {}

  /// @throws InputError naming file and line
  std::string of(const std::string& bytes) {
    std::istringstream in(with_plain_ends(bytes));
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      line_ = ++number;
      for (std::string more; line.ends_with('\\') && std::getline(in, more); ++number) {
        line.back() = ' ';
        line += more;
      }
      one(line);
    }
    if (greatest_ > corners_)
      throw InputError({file_, line_of_greatest_, 0},
                       fmt::format("a face names corner {}, but there are {}", greatest_, corners_));
    return std::move(text_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw InputError({file_, line_, 0}, why); }

  void one(const std::string& line) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string kind;
    if (!(words >> kind) || (kind != "v" && kind != "f")) return;
    std::vector<std::string> rest;
    for (std::string word; words >> word;) rest.push_back(word);
    text_ += kind;
    if (kind == "v")
      corner(line, rest);
    else
      face(line, rest);
    text_ += '\n';
  }

  void corner(const std::string& line, const std::vector<std::string>& words) {
    if (words.size() < 3 || !std::ranges::all_of(words, is_number))
      refuse(fmt::format("\"{}\" is no corner: write v and three finite numbers", printable(line)));
    for (std::size_t k = 0; k < 3; ++k) text_ += " " + words[k];
    ++corners_;
  }

  void face(const std::string& line, const std::vector<std::string>& words) {
    if (words.size() > most_corners)
      refuse(
          fmt::format("a face of {} corners; at most {}: cut it into triangles", words.size(), most_corners));
    std::vector<long> named;
    for (const auto& word : words)
      if (const auto n = corner_of(word)) named.push_back(*n < 0 ? corners_ + 1 + *n : *n);
    if (words.size() < 3 || named.size() != words.size())
      refuse(
          fmt::format("\"{}\" is no face: write f and three or more numbers of corners, as 7, 7/2 or 7/2/3; "
                      "corners are counted "
                      "from 1, or from -1 backwards",
                      printable(line)));
    for (const long n : named) {
      if (n < 1)
        refuse(fmt::format("a face names corner {} before the first of the {} above it", n - 1 - corners_,
                           corners_));
      if (n > greatest_) {
        greatest_ = n;
        line_of_greatest_ = line_;
      }
      text_ += fmt::format(" {}", n);
    }
  }

  std::string file_, text_;
  long corners_ = 0, greatest_ = 0;
  int line_ = 0, line_of_greatest_ = 0;
};

}  // namespace

Mesh parse_obj(const std::string& bytes, const std::string& file) {
  tinyobj::attrib_t corners;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream in(PlainObj(file).of(bytes));
  if (!tinyobj::LoadObj(&corners, &shapes, &materials, &warning, &error, &in, nullptr, true))
    throw InputError({file, 0, 0}, fmt::format("no valid OBJ: {}", printable(error, 200)));
  Mesh mesh;
  for (std::size_t i = 0; i + 2 < corners.vertices.size(); i += 3)
    mesh.points.push_back({corners.vertices[i], corners.vertices[i + 1], corners.vertices[i + 2]});
  for (const auto& shape : shapes) {
    const auto& index = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
      std::array<std::uint32_t, 3> t{};
      // Checked above
      for (std::size_t c = 0; c < 3; ++c) t[c] = static_cast<std::uint32_t>(index[i + c].vertex_index);
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace tripoint
