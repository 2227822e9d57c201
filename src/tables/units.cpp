// SPDX-License-Identifier: BSD-3-Clause
#include "tables/units.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tables/nearest.hpp"

namespace tripoint {
namespace {

struct NamedUnit {
  std::string_view name;
  double numerator, denominator;
  Dimension dimension;
  bool prefixes;
};

constexpr double pi = std::numbers::pi;
constexpr std::array named_units{
    NamedUnit{"m", 1, 1, {1, 0, 0, 0}, true},
    NamedUnit{"g", 1, 1000, {0, 1, 0, 0}, true},
    NamedUnit{"s", 1, 1, {0, 0, 1, 0}, true},
    NamedUnit{"K", 1, 1, {0, 0, 0, 1}, true},
    NamedUnit{"t", 1000, 1, {0, 1, 0, 0}, false},
    NamedUnit{"min", 60, 1, {0, 0, 1, 0}, false},
    NamedUnit{"h", 3600, 1, {0, 0, 1, 0}, false},
    NamedUnit{"Hz", 1, 1, {0, 0, -1, 0}, true},
    NamedUnit{"N", 1, 1, {1, 1, -2, 0}, true},
    NamedUnit{"Pa", 1, 1, {-1, 1, -2, 0}, true},
    NamedUnit{"bar", 100000, 1, {-1, 1, -2, 0}, true},
    NamedUnit{"J", 1, 1, {2, 1, -2, 0}, true},
    NamedUnit{"W", 1, 1, {2, 1, -3, 0}, true},
    NamedUnit{"L", 1, 1000, {3, 0, 0, 0}, true},
    NamedUnit{"P", 1, 10, {-1, 1, -1, 0}, true},
    NamedUnit{"rad", 1, 1, {}, true},
    NamedUnit{"deg", pi, 180, {}, false},
    NamedUnit{"turn", 2 * pi, 1, {}, false},
    NamedUnit{"rpm", pi, 30, {0, 0, -1, 0}, false},
    NamedUnit{"%", 1, 100, {}, false},
};

struct Prefix {
  std::string_view name;
  double numerator, denominator;
};
constexpr std::array prefixes{Prefix{"n", 1, 1e9}, Prefix{"u", 1, 1e6}, Prefix{"\u00b5", 1, 1e6},
                              Prefix{"m", 1, 1e3}, Prefix{"c", 1, 1e2}, Prefix{"d", 1, 10},
                              Prefix{"h", 1e2, 1}, Prefix{"k", 1e3, 1}, Prefix{"M", 1e6, 1},
                              Prefix{"G", 1e9, 1}};

Unit named(std::string_view name) {
  for (const auto& u : named_units)
    if (u.name == name) return {u.numerator, u.denominator, 0.0, u.dimension};
  for (const auto& p : prefixes)
    for (const auto& u : named_units)
      if (u.prefixes && name.size() == p.name.size() + u.name.size() && name.starts_with(p.name) &&
          name.ends_with(u.name))
        return {p.numerator * u.numerator, p.denominator * u.denominator, 0.0, u.dimension};
  throw std::invalid_argument(fmt::format(
      "`{}` is no known unit (known: {}; with prefixes n u m c d h k M G)", printable(name), known_units()));
}

void multiply(Unit& into, Unit factor, int power) {
  if (power < 0) std::swap(factor.numerator, factor.denominator);
  for (int i = 0; i < std::abs(power); ++i) {
    into.numerator *= factor.numerator;
    into.denominator *= factor.denominator;
  }
  for (std::size_t i = 0; i < 4; ++i) into.dimension[i] += power * factor.dimension[i];
}

/// unit = factor {("*" | "/" | " ") factor};  factor = NAME [["^"] [-] DIGIT] | "1" | "(" unit ")", one level
/// deep.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : text_(text) {}

  Unit read() {
    Unit unit = product(true);
    if (at_ < text_.size())
      throw std::invalid_argument(
          fmt::format("`{}` is no unit: write one like m, kg/m3, W/m/K", printable(text_)));
    return unit;
  }

 private:
  void spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  [[nodiscard]] bool take(char c) {
    spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  Unit product(bool outer) {
    Unit unit = factor(outer);
    for (;;) {
      spaces();
      if (at_ >= text_.size() || text_[at_] == ')') return unit;
      const bool over = take('/');
      if (!over) (void)take('*');
      multiply(unit, factor(outer), over ? -1 : 1);
    }
  }

  Unit factor(bool outer) {
    if (outer && take('(')) {
      const Unit inner = product(false);
      if (!take(')'))
        throw std::invalid_argument(fmt::format("`{}` lacks a `)`: write it", printable(text_)));
      return inner;
    }
    spaces();
    const auto begin = at_;
    while (at_ < text_.size() &&
           std::string_view(" */^()-+.0123456789").find(text_[at_]) == std::string_view::npos)
      ++at_;
    const auto name = text_.substr(begin, at_ - begin);
    if (name.empty()) {
      if (take('1')) return {};
      throw std::invalid_argument(
          fmt::format("`{}` is no unit: write one like m, kg/m3, W/m/K", printable(text_)));
    }
    Unit unit;
    multiply(unit, named(name), power());
    return unit;
  }

  int power() {
    const bool caret = at_ < text_.size() && text_[at_] == '^';
    if (caret) ++at_;
    const bool minus = at_ < text_.size() && text_[at_] == '-';
    if (minus) ++at_;
    if (at_ < text_.size() && text_[at_] >= '1' && text_[at_] <= '9') {
      const int digit = text_[at_++] - '0';
      return minus ? -digit : digit;
    }
    if (caret || minus)
      throw std::invalid_argument(
          fmt::format("`{}` lacks an exponent: write one digit, as in s^-2", printable(text_)));
    return 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

Unit parse_unit(std::string_view text) {
  if (text.empty()) return {};
  if (text == "degC" || text == "\u00b0C") return {1.0, 1.0, 273.15, {0, 0, 0, 1}};
  return UnitReader(text).read();
}

std::string to_string(const Dimension& d) {
  static constexpr std::array names{"m", "kg", "s", "K"};
  std::string over, under;
  for (std::size_t i : {1U, 0U, 2U, 3U}) {
    if (d[i] == 0) continue;
    auto& side = d[i] > 0 ? over : under;
    side += (d[i] > 0 ? (side.empty() ? "" : " ") : "/") + std::string(names[i]) +
            (std::abs(d[i]) > 1 ? std::to_string(std::abs(d[i])) : "");
  }
  return over.empty() ? "1" + under : over + under;
}

double parse_quantity(std::string_view text, std::string_view expected) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  double value = 0.0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
  const auto want =
      expected.empty() ? std::string("a plain number") : fmt::format("a number in {}", expected);
  if (error != std::errc{} || !std::isfinite(value))
    throw std::invalid_argument(
        fmt::format("`{}` is not a finite number with a unit: write {}", printable(text), want));
  auto name = text.substr(static_cast<std::size_t>(end - text.data()));
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  const Unit target = parse_unit(expected);
  if (name.empty())
    throw std::invalid_argument(
        expected.empty() ? fmt::format("`{}` is a text: write the number without quotes", printable(text))
                         : fmt::format("`{}` is a text without a unit: write {} or \"{} {}\"",
                                       printable(text), printable(text), printable(text), expected));
  const Unit unit = parse_unit(name);
  if (unit.dimension != target.dimension)
    throw std::invalid_argument(
        fmt::format("`{}` is in {}, but {} is expected{}", printable(text), to_string(unit.dimension), want,
                    expected.empty() ? ": write it without unit and quotes"
                                     : fmt::format(" (write 3 or \"3 {}\")", expected)));
  const double si = value * unit.numerator / unit.denominator + unit.offset;
  if (!std::isfinite(si))
    throw std::invalid_argument(
        fmt::format("`{}` is too large for a number in SI: write a smaller one", printable(text)));
  return si;
}

std::string known_units() {
  std::string list;
  for (const auto& u : named_units) list += std::string(list.empty() ? "" : " ") + std::string(u.name);
  return list + " degC";
}

}  // namespace tripoint
