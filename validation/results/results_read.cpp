// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/foreign_json.hpp"
#include "core/whole_number.hpp"
#include "files/foreign_file.hpp"
#include "validation/results/results_records.hpp"

namespace tripoint {
namespace {

using ReadJson = nlohmann::json;
constexpr std::uintmax_t largest_file = 512u << 20;

/// Reads the fields of a record from an object. An absent field, or one of another kind, leaves the member's
/// default (of a text: it is empty). A word that names nothing is an error, which says where it stands.
class Reader {
 public:
  explicit Reader(const ReadJson& from) : from_(from) {}

  void operator()(const Key& key, std::string& to) const {
    const auto& v = member(key);
    to = v.is_string() ? v.get<std::string>() : std::string();
  }
  void operator()(const Key& key, bool& to) const {
    if (const auto& v = member(key); v.is_boolean()) to = v.get<bool>();
  }
  void operator()(const Key& key, double& to) const {
    if (const auto& v = member(key); v.is_number()) to = v.get<double>();
  }
  template <std::integral T>
  void operator()(const Key& key, T& to) const {
    if (const auto& v = member(key); v.is_number()) to = whole_number<T>(v.get<double>());
  }
  void operator()(const Key& key, std::optional<double>& to) const {
    if (const auto& v = member(key); v.is_number()) to = v.get<double>();
  }
  void operator()(const Key& key, std::array<double, 2>& to) const {
    std::optional<std::array<double, 2>> pair;
    (*this)(key, pair);
    if (pair) to = *pair;
  }
  void operator()(const Key& key, std::optional<std::array<double, 2>>& to) const {
    std::vector<double> list;
    (*this)(key, list);
    if (list.size() == 2) to = {list[0], list[1]};
  }
  template <HasWords E>
  void operator()(const Key& key, E& to) const {
    std::optional<E> word;
    (*this)(key, word);
    if (word) to = *word;
  }
  template <HasWords E>
  void operator()(const Key& key, std::optional<E>& to) const {
    std::string word;
    (*this)(key, word);
    if (!word.empty()) within(std::string(key.name), [&] { to = from_word<E>(word); });
  }
  void operator()(const Key& key, StudyAxes& to) const {
    std::string words;
    (*this)(key, words);
    if (!words.empty()) within(std::string(key.name), [&] { to = study_axes_from(words); });
  }
  template <class T>
  void operator()(const Key& key, std::vector<T>& to) const {
    const auto& v = member(key);
    if (!v.is_array()) return;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if constexpr (std::is_same_v<T, double>)
        to.push_back(number(v[i]));
      else if constexpr (!std::is_same_v<T, std::string>)
        within(fmt::format("{}[{}]", key.name, i), [&] { to.push_back(record<T>(v[i])); });
      else if (v[i].is_string())
        to.push_back(v[i].template get<std::string>());
    }
  }
  template <class T>
  void operator()(const Key& key, std::map<std::string, T>& to) const {
    const auto& v = member(key);
    if (!v.is_object()) return;
    for (const auto& [name, value] : v.items()) {
      if constexpr (std::is_same_v<T, double>)
        to[name] = number(value);
      else if constexpr (std::is_same_v<T, std::string>)
        to[name] = value.is_string() ? value.template get<std::string>() : std::string();
      else if constexpr (std::is_same_v<T, Setting>)
        to[name] = setting(value);
      else
        to[name] = record<T>(value);
    }
  }
  void operator()(const Key& key, std::map<StudyAxes, double>& to) const {
    std::map<std::string, double> levels;
    (*this)(key, levels);
    for (const auto& one : levels)
      within(std::string(key.name), [&] { to[study_axes_from(one.first)] = one.second; });
  }
  template <Described T>
  void operator()(const Key& key, T& to) const {
    const Reader inner(member(key));
    within(std::string(key.name), [&] { fields(inner, to); });
  }
  template <Described T>
  void operator()(const Key& key, std::optional<T>& to) const {
    if (member(key).is_object()) (*this)(key, to.emplace());
  }
  template <class T>
  void operator()(const Key& key, T& to, const T& /*what is written*/) const {
    (*this)(key, to);
  }
  void operator()(const Key& key, NumberOrNull<double> to) const { to.value = number(member(key)); }
  void operator()(const Key& key, Stated<double> to) const {
    if (from_.is_object() && from_.contains(std::string(key.name))) to.value = number(member(key));
  }
  void operator()(const Key& key, Judged<double> to) const {
    to.value = member(named("finite")) == ReadJson(false) ? not_a_number : number(member(key));
  }
  template <class T>
  void operator()(const Key& key, OrNull<T> to) const {
    (*this)(key, to.value);
  }
  template <class T>
  void operator()(const Key& key, IfAny<T> to) const {
    (*this)(key, to.value);
  }
  template <class Form>
  void written(const Key& /*key*/, Form /*form*/) const {}
  template <class Each>
  void part(const Key& key, bool /*is_there*/, Each each) const {
    const Reader inner(member(key));
    each(inner);
  }
  void end(const Key& status_key, Status& status, const Key& reason_key, std::string& reason) const {
    std::optional<Status> word;
    (*this)(status_key, word);
    (*this)(reason_key, reason);
    status = word.value_or(Status::error);
    if (!word) reason = "the results give no status";
  }

  template <class T>
  [[nodiscard]] static T record(const ReadJson& from) {
    T row;
    const Reader reader(from);
    fields(reader, row);
    return row;
  }

 private:
  [[nodiscard]] const ReadJson& member(const Key& key) const {
    static const ReadJson nothing;
    if (!from_.is_object()) return nothing;
    const auto at = from_.find(std::string(key.name));
    return at == from_.end() ? nothing : *at;
  }
  /// A value that is no number is read as NaN, which never passes.
  static double number(const ReadJson& v) { return v.is_number() ? v.get<double>() : not_a_number; }
  static Setting setting(const ReadJson& v) {
    if (v.is_boolean()) return v.get<bool>();
    if (v.is_number()) return v.get<double>();
    if (!v.is_array()) return v.is_string() ? v.get<std::string>() : v.dump();
    std::vector<double> list;
    for (const auto& x : v) list.push_back(number(x));
    return list;
  }
  /// An error inside says its way there: cases[0].engines[1].status: ...
  template <class Read>
  static void within(const std::string& key, Read read) {
    try {
      read();
    } catch (const InputError& e) {
      const std::string what = e.what();
      throw InputError(key + (what.starts_with('`') ? ": " : ".") + what);
    }
  }
  const ReadJson& from_;
};

/// @throws InputError naming the place
template <class Record>
Record read_record(const ReadJson& from, const std::string& place) {
  try {
    return Reader::record<Record>(from);
  } catch (const InputError& e) {
    throw InputError(place + ": " + e.what());
  }
}

}  // namespace

RunRow read_run_row(const std::string& text_of_row, const std::string& place_of_row) {
  const auto document =
      unfit_json(text_of_row).empty() ? ReadJson::parse(text_of_row, nullptr, false) : ReadJson();
  if (!document.is_object()) throw InputError(place_of_row + ": holds no run of a results.json");
  return read_record<RunRow>(document, place_of_row);
}

Results read_results(const std::string& path) {
  const std::string text_of_file = text_of_regular_file(path, largest_file);
  if (const std::string why = unfit_json(text_of_file); !why.empty())
    throw InputError(fmt::format("{}: {}, which no results file does", path, why));
  const auto document = ReadJson::parse(text_of_file, nullptr, false);
  if (!document.is_object())
    throw InputError(path + ": is not a JSON object (a results.json of tripoint validate is wanted)");
  if (!document.contains("format") || document["format"] != 1)
    throw InputError(path + ": has not \"format\": 1");
  if (!document.contains("cases") || !document["cases"].is_array())
    throw InputError(path + ": has no list \"cases\"");
  auto results = read_record<Results>(document, path);
  if (const auto code = document.find("exit_code"); code == document.end() || !code->is_number())
    results.exit_code = exit_missing;
  if (!document.contains("verdict")) results.verdict = verdict_of(results.exit_code);
  if (!document.contains("asked")) results.asked = results.only_engines;
  return results;
}

}  // namespace tripoint
