// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <nlohmann/json.hpp>

#include "validation/references/reference.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/results_records.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

/// Writes a record as an object, its fields in their order. A number that is not finite is null (contracts).
class Writer {
 public:
  template <class T>
  void operator()(const Key& key, const T& value) {
    to_[std::string(key.name)] = json(value);
  }
  template <class T>
  void operator()(const Key& key, const T&, const T& instead) {
    to_[std::string(key.name)] = json(instead);
  }
  template <class T>
  void operator()(const Key& key, NumberOrNull<T> m) {
    to_[std::string(key.name)] = json_number(m.value);
  }
  template <class T>
  void operator()(const Key& key, Stated<T> s) {
    to_[std::string(key.name)] = json_number(s.value);
  }
  template <class T>
  void operator()(const Key& key, Judged<T> j) {
    to_[std::string(key.name)] = json_number(j.value);
    if (!std::isfinite(j.value)) to_["finite"] = false;
  }
  void operator()(const Key& key, OrNull<const double> x) {
    to_[std::string(key.name)] = x.value > 0.0 ? Json(x.value) : Json(nullptr);
  }
  template <HasWords E>
  void operator()(const Key& key, OrNull<const E> x) {
    to_[std::string(key.name)] = to_string(x.value).empty() ? Json(nullptr) : Json(x.value);
  }
  template <class T>
  void operator()(const Key& key, IfAny<T> any) {
    if constexpr (requires { any.value.empty(); }) {
      if (any.value.empty()) return;
    } else if (!any.value) {
      return;
    }
    (*this)(key, any.value);
  }
  template <class Form>
  void written(const Key& key, Form form) {
    to_[std::string(key.name)] = json(form());
  }
  template <class Each>
  void part(const Key& key, bool is_there, Each each) {
    if (!is_there) return;
    Writer inner;
    each(inner);
    to_[std::string(key.name)] = std::move(inner.to_);
  }
  template <Described T>
  void operator()(const Key& key, const std::optional<T>& record) {
    if (record) to_[std::string(key.name)] = json(*record);
  }
  void end(const Key& status_key, Status status, const Key& reason_key, const std::string& reason) {
    (*this)(status_key, status);
    (*this)(reason_key, reason);
  }

  template <class T>
  static Json json(const T& value) {
    if constexpr (Described<T>) {
      Writer inner;
      fields(inner, value);
      return std::move(inner.to_);
    } else {
      return Json(value);
    }
  }
  static Json json(const std::optional<double>& value) { return json_number(value); }
  static Json json(const std::vector<double>& values) { return json_numbers(values); }
  static Json json(const std::optional<std::array<double, 2>>& pair) {
    return pair ? Json(*pair) : Json(nullptr);
  }
  template <HasWords E>
  static Json json(const std::optional<E>& word) {
    return word ? Json(*word) : Json("");
  }
  static Json json(const StudyAxes& axes) { return to_string(axes); }
  static Json json(const Setting& setting) {
    return std::visit([](const auto& v) { return Json(v); }, setting);
  }
  template <class T>
  static Json json(const std::vector<T>& list) {
    Json out = Json::array();
    for (const auto& x : list) out.push_back(json(x));
    return out;
  }
  template <class T>
  static Json json(const std::map<std::string, T>& map) {
    Json out = Json::object();
    for (const auto& [key, value] : map) out[key] = json(value);
    return out;
  }
  static Json json(const std::map<StudyAxes, double>& levels) {
    Json out = Json::object();
    for (const auto& [axes, level] : levels) out[to_string(axes)] = json(level);
    return out;
  }

 private:
  Json to_ = Json::object();
};

template <class Record>
std::string text_of(const Record& record) {
  return json_text(Writer::json(record));
}

}  // namespace

std::string source_of(const ReferenceChoice& r) {
  if (!r.source.empty()) return r.source;
  const auto& all = reference_functions();
  const std::string name = r.function.empty() ? std::string(to_string(r.kind)) : r.function;
  const auto f =
      std::find_if(all.begin(), all.end(), [&](const ReferenceFunction& g) { return g.name == name; });
  return f == all.end() ? "" : f->source;
}

std::string run_row_text(const RunRow& row) { return text_of(row); }
std::string results_text(const Results& results) { return text_of(results); }

}  // namespace tripoint
