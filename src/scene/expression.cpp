// SPDX-License-Identifier: BSD-3-Clause
#include "scene/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "scene/nearest.hpp"

namespace tripoint {
namespace {

using Op = Expression::Op;

struct Function {
  std::string_view name;
  Op op;
  int arguments;
};
constexpr std::array functions{Function{"sin", Op::sine, 1}, Function{"cos", Op::cosine, 1},   Function{"exp", Op::exponential, 1}, Function{"sqrt", Op::root, 1},
                               Function{"abs", Op::absolute, 1}, Function{"min", Op::least, 2}, Function{"max", Op::greatest, 2}};

/// sum = product {(+|-) product}; product = signed {(*|/) signed}; signed = [-|+] signed | power; power = atom [^ signed].
class Compiler {
 public:
  Compiler(std::string_view text, std::vector<Expression::Step>& steps) : text_(text), steps_(steps) {}

  void compile() {
    if (text_.size() > 1000) throw InputError("the expression is longer than 1000 bytes: shorten it");
    sum();
    if (!ends()) refuse(fmt::format("`{}` does not belong here: remove it, or write an operator before it", printable(text_.substr(at_, 12))));
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(fmt::format("column {} of the expression: {}", at_ + 1, what)); }
  void spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool ends() {
    spaces();
    return at_ >= text_.size();
  }
  bool take(char c) {
    if (ends() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) refuse(fmt::format("`{}` is missing: write it", c));
  }
  void emit(Op op, double value = 0.0) { steps_.push_back({op, value}); }

  void sum() {
    if (++depth_ > 50) refuse("nested deeper than 50 brackets: write it flatter");
    product();
    for (;;) {
      if (take('+')) product(), emit(Op::add);
      else if (take('-')) product(), emit(Op::subtract);
      else break;
    }
    --depth_;
  }
  void product() {
    signed_power();
    for (;;) {
      if (take('*')) signed_power(), emit(Op::multiply);
      else if (take('/')) signed_power(), emit(Op::divide);
      else break;
    }
  }
  void signed_power() {
    if (++depth_ > 50) refuse("nested deeper than 50 signs and brackets: write it flatter");
    if (take('-')) signed_power(), emit(Op::negate);
    else if (take('+')) signed_power();
    else power();
    --depth_;
  }
  void power() {
    atom();
    if (take('^')) signed_power(), emit(Op::power);
  }
  void atom() {
    if (ends()) refuse("it ends where a value belongs: write a number, x, y, z, a function or a bracket");
    const char c = text_[at_];
    if (take('(')) return sum(), expect(')');
    if ((c >= '0' && c <= '9') || c == '.') return number();
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) return name();
    refuse(fmt::format("`{}` stands where a value belongs: write a number, x, y, z, a function or a bracket", printable(text_.substr(at_, 1))));
  }
  void number() {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) refuse("this is no finite number: write a smaller one");
    at_ = static_cast<std::size_t>(end - text_.data());
    emit(Op::number, value);
  }
  void name() {
    const auto begin = at_;
    while (at_ < text_.size() && ((text_[at_] >= 'a' && text_[at_] <= 'z') || (text_[at_] >= 'A' && text_[at_] <= 'Z') || (text_[at_] >= '0' && text_[at_] <= '9') || text_[at_] == '_')) ++at_;
    const auto word = text_.substr(begin, at_ - begin);
    if (word == "x") return emit(Op::x);
    if (word == "y") return emit(Op::y);
    if (word == "z") return emit(Op::z);
    if (word == "pi") return emit(Op::number, std::numbers::pi);
    for (const auto& f : functions) {
      if (f.name != word) continue;
      expect('(');
      sum();
      if (f.arguments == 2) expect(','), sum();
      expect(')');
      return emit(f.op);
    }
    at_ = begin;
    refuse(fmt::format("`{}` is unknown{}", printable(word), suggestion(word, {"x", "y", "z", "pi", "sin", "cos", "exp", "sqrt", "abs", "min", "max"})));
  }

  std::string_view text_;
  std::vector<Expression::Step>& steps_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

double unary(Op op, double a) {
  switch (op) {
    case Op::negate: return -a;
    case Op::sine: return std::sin(a);
    case Op::cosine: return std::cos(a);
    case Op::exponential: return std::exp(a);
    case Op::root: return std::sqrt(a);
    default: return std::abs(a);
  }
}

double binary(Op op, double a, double b) {
  switch (op) {
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return a / b;
    case Op::power: return std::pow(a, b);
    case Op::least: return std::min(a, b);
    default: return std::max(a, b);
  }
}

bool is_binary(Op op) { return (op >= Op::add && op <= Op::power) || op == Op::least || op == Op::greatest; }

}  // namespace

Expression::Expression(std::string_view text) { Compiler(text, steps_).compile(); }

double Expression::operator()(const Vec3& r) const {
  std::vector<double> stack;
  stack.reserve(steps_.size());
  for (const auto& [op, value] : steps_) {
    if (op == Op::number) stack.push_back(value);
    else if (op == Op::x) stack.push_back(r.x);
    else if (op == Op::y) stack.push_back(r.y);
    else if (op == Op::z) stack.push_back(r.z);
    else if (is_binary(op)) {
      const double b = stack.back();
      stack.pop_back();
      stack.back() = binary(op, stack.back(), b);
    } else {
      stack.back() = unary(op, stack.back());
    }
  }
  return stack.back();
}

}  // namespace tripoint
