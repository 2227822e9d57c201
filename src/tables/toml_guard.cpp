// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <vector>

#include "tables/toml_node.hpp"

/// toml++ 3.3 aborts on `[,]` and `v=[1,}` and overflows the stack on a 400 kB dotted key: bounds come before
/// it. A dotted key nests as deep as brackets do, so both count together. The document is walked by
/// recursion, here and by its readers.
namespace tripoint {
namespace {

constexpr std::size_t max_file = std::size_t{1} << 20, max_line = 16384;
constexpr int max_nesting = 24, max_dots = 12;

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void scan() {
    while (at_ < text_.size()) step();
    if (!open_.empty()) refuse(fmt::format("the file ends inside a `{}`: close it", open_.back().bracket));
  }

 private:
  /// A bracket that waits for its other half, and how many brackets and dots of keys lead to its content.
  struct Open {
    char bracket;
    int depth;
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError({file_, line_, static_cast<int>(at_ - line_start_) + 1}, what);
  }
  [[nodiscard]] bool at(std::string_view s) const { return text_.substr(at_, s.size()) == s; }

  void control(char c) const {
    const auto byte = static_cast<unsigned char>(c);
    const bool line_end = c == '\n' || (c == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n');
    if ((byte < 32 && c != '\t' && !line_end) || byte == 127)
      refuse(fmt::format("control byte 0x{:02x}: a case file is plain UTF-8 text", byte));
    if (at_ - line_start_ > max_line)
      refuse(fmt::format("the line is longer than {} bytes: break it", max_line));
  }

  void newline() {
    ++line_;
    line_start_ = at_ + 1;
    if (open_.empty()) forget_key();
  }

  void forget_key() {
    key_dots_ = 0;
    dots_ = 0;
  }
  [[nodiscard]] int depth() const { return (open_.empty() ? 0 : open_.back().depth) + key_dots_; }

  void step() {
    const char c = text_[at_];
    control(c);
    switch (c) {
      case '\n':
        newline();
        break;
      case '#':
        comment();
        return;
      case '"':
      case '\'':
        string(c);
        return;
      case '[':
      case '{':
        open(c);
        break;
      case ']':
      case '}':
        close(c);
        break;
      case ',':
        comma();
        break;
      case '.':
        dot();
        break;
      case '=':
        key_dots_ = dots_;
        dots_ = 0;
        break;
      default:
        break;
    }
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') last_ = c;
    ++at_;
  }

  void dot() {
    if (++dots_ > max_dots)
      refuse(
          fmt::format("more than {} dots in one key or value: a dotted key is at most three names long, "
                      "and numbers have a comma between them",
                      max_dots));
  }

  void comment() {
    while (at_ < text_.size() && text_[at_] != '\n') {
      control(text_[at_]);
      ++at_;
    }
  }

  void string(char quote) {
    const std::string three(3, quote);
    const bool multi = at(three);
    const auto begin = line_;
    at_ += multi ? 3 : 1;
    for (;; ++at_) {
      if (at_ >= text_.size() || (!multi && text_[at_] == '\n'))
        refuse(fmt::format("the text that begins on line {} is not closed: write its closing quote", begin));
      control(text_[at_]);
      if (text_[at_] == '\n') newline();
      if (quote == '"' && text_[at_] == '\\') {
        escaped();
        continue;
      }
      if (multi ? at(three) : text_[at_] == quote) break;
    }
    at_ += multi ? 3 : 1;
    while (multi && at_ < text_.size() && text_[at_] == quote) ++at_;  // """a"""" holds a quote
    last_ = quote;
  }

  /// The letter behind a backslash; the end of a line stands for itself.
  void escaped() {
    if (at_ + 1 < text_.size() && text_[at_ + 1] != '\n' && text_[at_ + 1] != '\r') ++at_;
  }

  void open(char c) {
    const int inside = depth() + 1;
    if (inside > max_nesting)
      refuse(fmt::format("brackets nested deeper than {}: flatten the value", max_nesting));
    open_.push_back({c, inside});
    forget_key();
  }

  void close(char c) {
    const char want = c == ']' ? '[' : '{';
    if (open_.empty() || open_.back().bracket != want)
      refuse(fmt::format("`{}` closes nothing: write the bracket that was opened", c));
    if (c == '}' && last_ == ',') refuse("a comma before `}`: remove the comma");
    open_.pop_back();
    forget_key();
  }

  void comma() {
    if (open_.empty()) return;  // the parser says it better
    if (last_ == '[' || last_ == '{' || last_ == ',' || last_ == '=')
      refuse("a comma where a value belongs: remove the comma, or write the value before it");
    forget_key();
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  int key_dots_ = 0, dots_ = 0;  // of the key before the `=`; since it, or since the key began
  std::vector<Open> open_;
  char last_ = '\n';
};

}  // namespace

void check_size(std::size_t bytes, const std::string& file) {
  if (bytes > max_file)
    throw InputError({file, 0, 0},
                     fmt::format("{} bytes; a case file has at most {}: put data into a file of its own",
                                 bytes, max_file));
}

void check_text(std::string_view text, const std::string& file) {
  check_size(text.size(), file);
  Scanner(text, file).scan();
}

}  // namespace tripoint
