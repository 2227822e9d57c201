// SPDX-License-Identifier: BSD-3-Clause
#include "tables/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/errors.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

using Op = Expression::Op;

struct Function {
  std::string_view name;
  Op op;
  int arguments;
};
constexpr std::array functions{Function{"sin", Op::sine, 1},
                               Function{"cos", Op::cosine, 1},
                               Function{"tan", Op::tangent, 1},
                               Function{"exp", Op::exponential, 1},
                               Function{"log", Op::logarithm, 1},
                               Function{"sqrt", Op::root, 1},
                               Function{"abs", Op::absolute, 1},
                               Function{"erf", Op::error, 1},
                               Function{"erfc", Op::error_complement, 1},
                               Function{"sinh", Op::hyperbolic_sine, 1},
                               Function{"cosh", Op::hyperbolic_cosine, 1},
                               Function{"tanh", Op::hyperbolic_tangent, 1},
                               Function{"min", Op::least, 2},
                               Function{"max", Op::greatest, 2}};
constexpr long most_terms = 10000;  ///< of a sum

/// sum = product {(+|-) product}; product = signed {(*|/) signed}; signed = [-|+] signed | power; power =
/// atom [^ signed].
class Compiler {
 public:
  Compiler(std::string_view text, Expression::Time time, std::vector<Expression::Step>& steps,
           std::vector<Expression::Sum>& sums)
      : text_(text), time_(time), steps_(&steps), sums_(sums) {}

  void compile() {
    if (text_.size() > 1000) throw InputError("the expression is longer than 1000 bytes: shorten it");
    sum();
    if (!ends())
      refuse(fmt::format("`{}` does not belong here: remove it, or write an operator before it",
                         printable(text_.substr(at_, 12))));
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("column {} of the expression: {}", at_ + 1, what));
  }
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
  void emit(Op op, double value = 0.0) { steps_->push_back({op, value}); }

  void sum() {
    if (++depth_ > 50) refuse("nested deeper than 50 brackets: write it flatter");
    product();
    for (;;) {
      if (take('+')) {
        product();
        emit(Op::add);
      } else if (take('-')) {
        product();
        emit(Op::subtract);
      } else
        break;
    }
    --depth_;
  }
  void product() {
    signed_power();
    for (;;) {
      if (take('*')) {
        signed_power();
        emit(Op::multiply);
      } else if (take('/')) {
        signed_power();
        emit(Op::divide);
      } else
        break;
    }
  }
  void signed_power() {
    if (++depth_ > 50) refuse("nested deeper than 50 signs and brackets: write it flatter");
    if (take('-')) {
      signed_power();
      emit(Op::negate);
    } else if (take('+'))
      signed_power();
    else
      power();
    --depth_;
  }
  void power() {
    atom();
    if (take('^')) {
      signed_power();
      emit(Op::power);
    }
  }
  void atom() {
    if (ends()) refuse("it ends where a value belongs: write a number, x, y, z, a function or a bracket");
    const char c = text_[at_];
    if (take('(')) {
      sum();
      return expect(')');
    }
    if ((c >= '0' && c <= '9') || c == '.') return number();
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) return name();
    refuse(fmt::format("`{}` stands where a value belongs: write a number, x, y, z, a function or a bracket",
                       printable(text_.substr(at_, 1))));
  }
  void number() {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{} || !std::isfinite(value))
      refuse("this is no finite number: write a smaller one");
    at_ = static_cast<std::size_t>(end - text_.data());
    emit(Op::number, value);
  }
  void name() {
    const auto begin = at_;
    const std::string word = this->word();
    if (word == "x") return emit(Op::x);
    if (word == "y") return emit(Op::y);
    if (word == "z") return emit(Op::z);
    if (word == "t" && time_ == Expression::Time::known) return emit(Op::t);
    if (word == "pi") return emit(Op::number, std::numbers::pi);
    if (!index_.empty() && word == index_) return emit(Op::index);
    if (word == "sum") return series(begin);
    for (const auto& f : functions) {
      if (f.name != word) continue;
      expect('(');
      sum();
      if (f.arguments == 2) {
        expect(',');
        sum();
      }
      expect(')');
      return emit(f.op);
    }
    at_ = begin;
    std::vector<std::string> known{"x", "y", "z", "pi", "sum"};
    if (time_ == Expression::Time::known)
      known.emplace_back("t");
    else if (word == "t")
      refuse("`t` is unknown here: this is of the start, and a formula of x, y and z");
    for (const auto& f : functions) known.emplace_back(f.name);
    refuse(fmt::format("`{}` is unknown{}", printable(word), suggestion(word, known)));
  }
  /// sum(n, 1, 40, f): n is a name that stands in f.
  void series(std::size_t begin) {
    if (!index_.empty()) {
      at_ = begin;
      refuse("a sum stands in a sum: write the inner one out");
    }
    expect('(');
    if (ends() || !((text_[at_] >= 'a' && text_[at_] <= 'z') || (text_[at_] >= 'A' && text_[at_] <= 'Z')))
      refuse("a sum begins with the name of its index: sum(n, 1, 40, ...)");
    index_ = word();
    for (const std::string_view taken : {"x", "y", "z", "t", "pi", "sum"})
      if (index_ == taken)
        refuse(fmt::format("`{}` has a meaning already: give the index of the sum another name", taken));
    expect(',');
    Expression::Sum series{whole(), 0, {}};
    expect(',');
    series.last = whole();
    if (series.last < series.first || series.last - series.first >= most_terms)
      refuse(fmt::format("the sum runs from {} to {}: at least 1 and at most {} terms", series.first,
                         series.last, most_terms));
    expect(',');
    auto* outer = std::exchange(steps_, &series.steps);
    sum();
    steps_ = outer;
    expect(')');
    index_.clear();
    emit(Op::sum, static_cast<double>(sums_.size()));
    sums_.push_back(std::move(series));
  }
  std::string word() {
    const auto begin = at_;
    while (at_ < text_.size() &&
           ((text_[at_] >= 'a' && text_[at_] <= 'z') || (text_[at_] >= 'A' && text_[at_] <= 'Z') ||
            (text_[at_] >= '0' && text_[at_] <= '9') || text_[at_] == '_'))
      ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  long whole() {
    spaces();
    long value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{} || std::abs(value) > 1000000) refuse("the ends of a sum are whole numbers");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view text_;
  Expression::Time time_;
  std::vector<Expression::Step>* steps_;
  std::vector<Expression::Sum>& sums_;
  std::string index_;  ///< of the sum that is being read; empty = none
  std::size_t at_ = 0;
  int depth_ = 0;
};

double unary(Op op, double a) {
  switch (op) {
    case Op::negate:
      return -a;
    case Op::sine:
      return std::sin(a);
    case Op::cosine:
      return std::cos(a);
    case Op::tangent:
      return std::tan(a);
    case Op::exponential:
      return std::exp(a);
    case Op::logarithm:
      return std::log(a);
    case Op::error:
      return std::erf(a);
    case Op::error_complement:
      return std::erfc(a);
    case Op::hyperbolic_sine:
      return std::sinh(a);
    case Op::hyperbolic_cosine:
      return std::cosh(a);
    case Op::hyperbolic_tangent:
      return std::tanh(a);
    case Op::root:
      return std::sqrt(a);
    default:
      return std::abs(a);
  }
}

double binary(Op op, double a, double b) {
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::power:
      return std::pow(a, b);
    case Op::least:
      return std::min(a, b);
    default:
      return std::max(a, b);
  }
}

bool is_binary(Op op) { return op >= Op::add && op <= Op::greatest; }

/// Where a formula is evaluated.
struct Point {
  const Vec3& r;
  double t, index;
  const std::vector<Expression::Sum>& sums;
};

double value_of(const std::vector<Expression::Step>& steps, const Point& at) {
  std::vector<double> stack;
  stack.reserve(steps.size());
  for (const auto& [op, value] : steps) {
    if (op == Op::number)
      stack.push_back(value);
    else if (op == Op::x)
      stack.push_back(at.r.x);
    else if (op == Op::y)
      stack.push_back(at.r.y);
    else if (op == Op::z)
      stack.push_back(at.r.z);
    else if (op == Op::t)
      stack.push_back(at.t);
    else if (op == Op::index)
      stack.push_back(at.index);
    else if (op == Op::sum) {
      const Expression::Sum& series = at.sums[static_cast<std::size_t>(value)];
      double total = 0.0;
      for (long n = series.first; n <= series.last; ++n)
        total += value_of(series.steps, {at.r, at.t, static_cast<double>(n), at.sums});
      stack.push_back(total);
    } else if (is_binary(op)) {
      const double b = stack.back();
      stack.pop_back();
      stack.back() = binary(op, stack.back(), b);
    } else {
      stack.back() = unary(op, stack.back());
    }
  }
  return stack.back();
}

}  // namespace

Expression::Expression(std::string_view text, Time time) { Compiler(text, time, steps_, sums_).compile(); }

double Expression::operator()(const Vec3& r, double t) const { return value_of(steps_, {r, t, 0.0, sums_}); }

}  // namespace tripoint
