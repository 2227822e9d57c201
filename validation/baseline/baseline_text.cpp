// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/whole_number.hpp"
#include "files/job.hpp"
#include "tables/toml_node.hpp"
#include "validation/baseline/baseline_records.hpp"

/// The file of a baseline, written and read by one list of fields.
namespace tripoint {
namespace {

std::string toml(const std::string& text) {
  TomlNode node;
  node.kind = TomlNode::Kind::text;
  node.text = text;
  return to_toml(node);
}

/// A number that always holds a point or an exponent.
std::string toml(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string toml(std::integral auto value) { return fmt::format("{}", value); }
std::string toml(const std::array<double, 2>& pair) {
  return fmt::format("[{}, {}]", toml(pair[0]), toml(pair[1]));
}

std::string toml(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "" : ", ") + toml(word);
  return "[" + list + "]";
}

/// Lines of a table, or a row of a list on one line. A row leaves out what is empty.
class Writer {
 public:
  explicit Writer(bool is_row = false) : is_row_(is_row) {}

  template <class T>
  void operator()(const Key& key, const T& value) {
    if constexpr (requires { value.empty(); })
      if (is_row_ && value.empty()) return;
    add(key, toml(value));
  }
  template <class T>
  void operator()(const Key& key, const T&, const T& instead) {
    (*this)(key, instead);
  }
  template <HasWords E>
  void operator()(const Key& key, const E& word) {
    (*this)(key, std::string(to_string(word)));
  }
  template <class T>
  void operator()(const Key& key, const std::optional<T>& value) {
    if (value) (*this)(key, *value);
  }
  template <Described T>
  void operator()(const Key& key, const std::vector<T>& list) {
    if (list.empty()) return;
    text_ += fmt::format("\n{} = [\n", key.name);
    for (const T& item : list) {
      Writer row(true);
      fields(row, item);
      text_ += "  { " + row.text_ + " },\n";
    }
    text_ += "]\n";
  }
  template <class T>
  void unless(const T& known, const Key& key, const T& value) {
    if (value != known) (*this)(key, value);
  }
  template <class Each>
  void block(bool is_there, Each each) {
    if (is_there) each(*this);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add(const Key& key, const std::string& value) {
    text_ += fmt::format("{}{} = {}{}", is_row_ && !text_.empty() ? ", " : "", key.name, value,
                         is_row_ ? "" : "\n");
  }
  std::string text_;
  bool is_row_;
};

/// What a table does not have is empty, or follows from the fields before it.
class Reader {
 public:
  explicit Reader(const TomlNode& from) : from_(from) {}

  void operator()(const Key& key, std::string& to) const {
    const auto* v = from_.find(key.name);
    to = v && v->kind == TomlNode::Kind::text ? v->text : std::string();
  }
  void operator()(const Key& key, std::optional<double>& to) const {
    const auto* v = from_.find(key.name);
    if (!v) return to.reset();
    if (v->kind != TomlNode::Kind::integer && v->kind != TomlNode::Kind::real)
      throw InputError(v->place, fmt::format("{} is no number", key.name));
    to = number(*v);
  }
  void operator()(const Key& key, double& to) const { unless(0.0, key, to); }
  template <std::integral T>
  void operator()(const Key& key, T& to) const {
    double value = 0.0;
    (*this)(key, value);
    to = whole_number<T>(value);
  }
  void operator()(const Key& key, std::optional<std::array<double, 2>>& to) const {
    const auto* v = from_.find(key.name);
    if (!v) return;
    if (v->kind != TomlNode::Kind::array || v->items.size() != 2)
      throw InputError(v->place, fmt::format("{} is not [low, high]", key.name));
    to = {number(v->items[0]), number(v->items[1])};
  }
  template <HasWords E>
  void operator()(const Key& key, E& to) const {
    std::string word;
    (*this)(key, word);
    const auto found = find_word<E>(word);
    if (!found)
      throw InputError(from_.place,
                       fmt::format("{}: `{}` is no {}", key.name, printable(word), word_table(E{}).what));
    to = *found;
  }
  template <HasWords E>
  void operator()(const Key& key, std::optional<E>& to) const {
    std::string word;
    (*this)(key, word);
    if (!word.empty()) (*this)(key, to.emplace());
  }
  void operator()(const Key& key, std::vector<std::string>& to) const {
    for (const TomlNode& item : items(key)) to.push_back(item.text);
  }
  template <Described T>
  void operator()(const Key& key, std::vector<T>& to) const {
    for (const TomlNode& item : items(key)) {
      const Reader row(item);
      fields(row, to.emplace_back());
    }
  }
  template <class T>
  void operator()(const Key& key, T& to, const T& /*what is written*/) const {
    (*this)(key, to);
  }
  void unless(double known, const Key& key, double& to) const {
    std::optional<double> value;
    (*this)(key, value);
    to = value.value_or(known);
  }
  template <class T>
  void unless(const T& known, const Key& key, T& to) const {
    if (from_.find(key.name))
      (*this)(key, to);
    else
      to = known;
  }
  template <class Each>
  void block(bool /*is_there*/, Each each) const {
    each(*this);
  }

 private:
  [[nodiscard]] static double number(const TomlNode& v) {
    return v.kind == TomlNode::Kind::integer ? static_cast<double>(v.integer) : v.real;
  }
  [[nodiscard]] const std::vector<TomlNode>& items(const Key& key) const {
    static const std::vector<TomlNode> none;
    const auto* v = from_.find(key.name);
    return v && v->kind == TomlNode::Kind::array ? v->items : none;
  }
  const TomlNode& from_;
};

constexpr std::string_view seal_key = "seal = \"";

/// The text without its line `seal`, which holds the hash of the rest.
std::string unsealed(const std::string& text) {
  const auto before = text.find(fmt::format("\n{}", seal_key));  // of a line: a name may hold these words
  if (before == std::string::npos) return text;
  const auto end = text.find('\n', before + 1);
  return text.substr(0, before + 1) + (end == std::string::npos ? "" : text.substr(end + 1));
}

}  // namespace

Baseline read_baseline(const std::string& file) {
  const auto top = read_toml(file);
  const Reader reader(top);
  double format = 0.0;
  reader(named("format"), format);
  if (format != 1.0) throw InputError(file + ": has not format = 1");
  Baseline b;
  fields(reader, b);
  std::string seal;
  reader(named("seal"), seal);  // older versions wrote neither hashes nor seal
  b.sealed = seal.empty() ? b.scene.empty() : seal == text_hash(unsealed(text_of_file(file)));
  return b;
}

std::string baseline_text(const Baseline& b) {
  Writer writer;
  fields(writer, b);
  const std::string out =
      "# Accepted figures. `tripoint gate accept --reason TEXT` writes this file; nothing else does.\nformat "
      "= 1\n" +
      writer.text();
  const auto after = out.find("\nseed = ") + 1;
  return out.substr(0, after) + fmt::format("seal = {}\n", toml(text_hash(out))) + out.substr(after);
}

}  // namespace tripoint
