// SPDX-License-Identifier: BSD-3-Clause
#include "mutator.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace tripoint::test {
namespace {

/// splitmix64: no library distribution, so that the mutants stay the same.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>((z ^ (z >> 31)) % n);
  }
  template <class T, std::size_t n>
  const T& of(const std::array<T, n>& list) {
    return list[below(n)];
  }

 private:
  std::uint64_t state_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) text += (i ? "\n" : "") + lines[i];
  return text;
}

/// Positions where one of the letters stands, outside comments.
std::vector<std::size_t> places(const std::string& text, const std::string& letters) {
  std::vector<std::size_t> at;
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') comment = false;
    if (text[i] == '#') comment = true;
    if (!comment && letters.find(text[i]) != std::string::npos) at.push_back(i);
  }
  return at;
}

constexpr const char* structure = "[]{}=,\"\n.";

Mutant drop(std::string text, Dice& dice) {
  const auto at = places(text, structure);
  const auto i = at[dice.below(at.size())];
  const std::string what = "dropped byte " + std::to_string(i);
  return {text.erase(i, 1), what};
}

Mutant twice(std::string text, Dice& dice) {
  const auto at = places(text, structure);
  const auto i = at[dice.below(at.size())];
  return {text.insert(i, 1, text[i]), "doubled byte " + std::to_string(i)};
}

Mutant insert(std::string text, Dice& dice) {
  static constexpr std::array<std::string_view, 14> bits{"[", "]",  "{",    "}",    ",",   "=",   "\"",
                                                         "'", "\\", "\x01", "\xff", "[,]", "{,}", "\"\"\""};
  const auto i = dice.below(text.size());
  const auto bit = dice.of(bits);
  return {text.insert(i, bit), "inserted " + std::string(bit) + " at byte " + std::to_string(i)};
}

Mutant swap_bytes(std::string text, Dice& dice) {
  const auto at = places(text, structure);
  const auto i = at[dice.below(at.size())], j = at[dice.below(at.size())];
  std::swap(text[i], text[j]);
  return {text, "swapped bytes " + std::to_string(i) + " and " + std::to_string(j)};
}

Mutant cut(const std::string& text, Dice& dice) {
  const auto n = dice.below(text.size());
  return {text.substr(0, n), "cut at byte " + std::to_string(n)};
}

Mutant drop_line(const std::string& text, Dice& dice) {
  auto lines = lines_of(text);
  const auto i = dice.below(lines.size());
  lines.erase(lines.begin() + static_cast<long>(i));
  return {joined(lines), "dropped line " + std::to_string(i + 1)};
}

Mutant repeat_line(const std::string& text, Dice& dice) {
  auto lines = lines_of(text);
  const auto i = dice.below(lines.size());
  lines.insert(lines.begin() + static_cast<long>(i), lines[i]);
  return {joined(lines), "repeated line " + std::to_string(i + 1)};
}

Mutant move_line(const std::string& text, Dice& dice) {
  auto lines = lines_of(text);
  const auto i = dice.below(lines.size()), j = dice.below(lines.size());
  std::swap(lines[i], lines[j]);
  return {joined(lines), "swapped lines " + std::to_string(i + 1) + " and " + std::to_string(j + 1)};
}

/// A line "key = value" at random, split at its `=`.
bool pick(std::vector<std::string>& lines, Dice& dice, std::size_t& line, std::size_t& equals) {
  for (int tries = 0; tries < 200; ++tries) {
    line = dice.below(lines.size());
    equals = lines[line].find('=');
    if (equals != std::string::npos && lines[line].find('#') != 0) return true;
  }
  return false;
}

Mutant misspell(const std::string& text, Dice& dice) {
  auto lines = lines_of(text);
  std::size_t i = 0, equals = 0;
  if (!pick(lines, dice, i, equals)) return cut(text, dice);
  const auto before = lines[i];
  auto& line = lines[i];
  const auto at = dice.below(std::max<std::size_t>(1, line.find_last_not_of(' ', equals - 1) + 1));
  switch (dice.below(3)) {
    case 0:
      line.erase(at, 1);
      break;
    case 1:
      line.insert(at, 1, 'q');
      break;
    default:
      line[at] = line[at] == 'x' ? 'y' : 'x';
      break;
  }
  return {joined(lines), "key on line " + std::to_string(i + 1) + ": " + before + " -> " + line};
}

Mutant other_value(const std::string& text, Dice& dice) {
  static constexpr std::array<std::string_view, 34> values{"nan",
                                                           "inf",
                                                           "-inf",
                                                           "-1.0",
                                                           "0",
                                                           "-0.0",
                                                           "1e308",
                                                           "1e999",
                                                           "5e-324",
                                                           "9223372036854775807",
                                                           "9223372036854775808",
                                                           "3.25",
                                                           "true",
                                                           "\"\"",
                                                           "\"nonsense\"",
                                                           "\"3 kg\"",
                                                           "\"3 furlong\"",
                                                           "\"nan m\"",
                                                           "[]",
                                                           "[1]",
                                                           "[1, 2]",
                                                           "[1, 2, 3, 4]",
                                                           "[nan, 0, 0]",
                                                           "[\"a\", 1, 2]",
                                                           "{}",
                                                           "{kind = \"box\"}",
                                                           "{kind = \"torus\"}",
                                                           "[[1, 2], [3]]",
                                                           "1979-05-27",
                                                           "0x10",
                                                           "1_000",
                                                           "{a = 1, a = 2}",
                                                           "\"\\u0000\"",
                                                           "-7"};
  auto lines = lines_of(text);
  std::size_t i = 0, equals = 0;
  if (!pick(lines, dice, i, equals)) return cut(text, dice);
  const auto before = lines[i];
  lines[i] = lines[i].substr(0, equals + 1) + " " + std::string(dice.of(values));
  return {joined(lines), "value on line " + std::to_string(i + 1) + ": " + before + " -> " + lines[i]};
}

/// One number of the file becomes another.
Mutant other_number(std::string text, Dice& dice) {
  static constexpr std::array<std::string_view, 12> numbers{
      "nan", "inf", "-3.5", "0.0", "1e29", "1e-300", "7", "-1e-9", "1e9", "0.4999", "0.5", "1..2"};
  std::vector<std::pair<std::size_t, std::size_t>> found;
  const auto digits = places(text, "0123456789");
  for (std::size_t k = 0; k < digits.size(); ++k) {
    const auto at = digits[k];
    if (at > 0 && std::string(" [,=\"-").find(text[at - 1]) == std::string::npos) continue;
    const auto end = text.find_first_not_of("0123456789.e-", at);
    found.emplace_back(at, (end == std::string::npos ? text.size() : end) - at);
  }
  const auto [at, length] = found[dice.below(found.size())];
  const auto number = dice.of(numbers);
  const std::string what =
      "number at byte " + std::to_string(at) + ": " + text.substr(at, length) + " -> " + std::string(number);
  return {text.replace(at, length, number), what};
}

/// One quoted word of the file becomes a near or a wild one.
Mutant other_word(std::string text, Dice& dice) {
  const auto quotes = places(text, "\"");
  if (quotes.size() < 2) return cut(text, dice);
  const auto k = 2 * dice.below(quotes.size() / 2);
  const auto begin = quotes[k] + 1, length = quotes[k + 1] - begin;
  auto word = text.substr(begin, length);
  const auto before = word;
  if (word.empty() || dice.below(3) == 0)
    word += "zz";
  else
    word.erase(dice.below(word.size()), 1);
  return {text.replace(begin, length, word),
          "word at byte " + std::to_string(begin) + ": " + before + " -> " + word};
}

using Change = std::function<Mutant(const std::string&, Dice&)>;

}  // namespace

std::vector<Mutant> mutants(const std::vector<std::string>& sources, std::size_t count, std::uint64_t seed) {
  const std::array<Change, 8> grammar{drop, twice,     insert,      swap_bytes,
                                      cut,  drop_line, repeat_line, move_line};
  const std::array<Change, 4> values{misspell, other_value, other_number, other_word};
  Dice dice(seed);
  std::vector<Mutant> out;
  for (std::size_t n = 0; n < count; ++n) {
    const auto& source = sources[n % sources.size()];
    const auto& change = (n / sources.size()) % 2 == 0 ? grammar[dice.below(grammar.size())]
                                                       : values[dice.below(values.size())];
    auto m = change(source, dice);
    m.what =
        "mutant " + std::to_string(n) + " of source " + std::to_string(n % sources.size()) + ": " + m.what;
    out.push_back(std::move(m));
  }
  return out;
}

std::vector<Mutant> parser_breakers() {
  const auto many = [](const std::string& bit, int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += bit;
    return text;
  };
  const std::string scene = "[scene]\nend_time = 1\n";
  const std::string path = many("a.", 6000) + "a";  // 12 kB, so that a line holds it
  return {
      {"[,]\n", "[,]"},
      {"v = [,]\n", "v = [,]"},
      {"v=[1,}\n", "v=[1,}"},
      {"v={a=1,}\n", "v={a=1,}"},
      {"v=[1,,2]\n", "v=[1,,2]"},
      {scene + "v = " + many("[", 100000) + "\n", "100000 open brackets"},
      {scene + "v = " + many("[", 20) + many("]", 20) + "\n", "20 empty brackets"},
      {scene + "v = " + many("{a=", 2000) + "1" + many("}", 2000) + "\n", "2000 nested tables"},
      {many("a.", 200000) + "b = 1\n", "a dotted key of 400 kB"},
      {"[" + many("a.", 200000) + "b]\n", "a dotted table of 400 kB"},
      {"v = {" + path + " = [\n{" + path + " = [\n]}]}\n", "two dotted keys of 6000 names in each other"},
      {"v = " + many("{" + path + " = [\n", 8) + many("]}", 8) + "\n",
       "eight dotted keys of 6000 names in each other"},
      {"v = [\n{" + path + " = 1},\n{" + path + " = 1}]\n", "dotted keys of 6000 names beside each other"},
      {"[" + path + "]\n" + path + " = 1\n", "a dotted table of 6000 names, and a key in it"},
      {many("[[" + path + "]]\nb = 1\n", 8), "a dotted array of tables of 6000 names, eight times"},
      {many("[[a]]\n", 20000), "20000 tables"},
      {many("a", 400000) + " = 1\n", "a key of 400 kB"},
      {"v = \"" + many("a", 400000) + "\"\n", "a text of 400 kB"},
      {"v = " + many("9", 10000) + "\n", "a number of 10000 digits"},
      {"v = \"\"\"" + many("\\", 999) + "\n", "an open text of backslashes"},
      {"v = '''\n" + many("'", 2000) + "\n", "an open text of quotes"},
      {std::string("\0\0\0\0", 4), "zeros"},
      {"\xef\xbb\xbf", "a byte order mark alone"},
      {"\xff\xfe\xfd = 1\n", "no UTF-8"},
      {many("#\n", 400000), "800 kB of comments"},
      {many("\n", 2000000), "2 MB of nothing"},
      {"a = 1\r\nb = 2\rc = 3\n", "a lone carriage return"},
      {"a = 0x\n", "a prefix without digits"},
      {"a = 1e\n", "an exponent without digits"},
      {"a = \"\\u12\"\n", "half an escape"},
      {"a = 2026-13-45T99:99:99Z\n", "no date"},
      {"[a]\n[a]\n", "a table twice"},
      {"a = {b = 1}\n[a]\nc = 2\n", "a closed table reopened"},
      {"a = [1]\n[[a]]\n", "a closed array extended"},
      {"", "nothing"}};
}

}  // namespace tripoint::test
