// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/results_schema.hpp"

#include <nlohmann/json.hpp>

#include "validation/results/results_records.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

Json of_type(const char* type) { return {{"type", type}}; }
Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
Json object_of(Json values) { return {{"type", "object"}, {"additionalProperties", std::move(values)}}; }
Json or_null(Json value) { return {{"anyOf", {std::move(value), of_type("null")}}}; }

template <HasWords E>
Json enumeration() {
  Json words = Json::array();
  for (const E e : all_of<E>()) words.push_back(std::string(to_string(e)));
  return {{"enum", words}};
}

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};
template <class T>
struct IsMap : std::false_type {};
template <class K, class T>
struct IsMap<std::map<K, T>> : std::true_type {};

template <Described R>
Json object();

/// A value as results_write.cpp writes it.
template <class T>
Json schema_of() {
  if constexpr (Described<T>) {
    return object<T>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return of_type("boolean");
  } else if constexpr (std::is_arithmetic_v<T>) {
    return of_type("number");
  } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, StudyAxes>) {
    return of_type("string");
  } else if constexpr (HasWords<T>) {
    return enumeration<T>();
  } else if constexpr (std::is_same_v<T, Setting>) {
    return Json::object();
  } else if constexpr (std::is_same_v<T, std::array<double, 2>>) {
    return list_of(of_type("number"));
  } else if constexpr (IsList<T>::value) {
    using Item = typename T::value_type;
    return list_of(std::is_same_v<Item, double> ? or_null(of_type("number")) : schema_of<Item>());
  } else if constexpr (IsMap<T>::value) {
    return object_of(schema_of<typename T::mapped_type>());
  } else if constexpr (HasWords<typename T::value_type>) {  // an optional word: empty where it is none
    Json words = enumeration<typename T::value_type>();
    words["enum"].push_back("");
    return words;
  } else {
    return or_null(schema_of<typename T::value_type>());
  }
}

/// Collects the properties of an object.
class Properties {
 public:
  template <class T>
  void operator()(const Key& key, T& /*value*/) {
    if constexpr (requires {
                    typename T::value_type;
                    requires Described<typename T::value_type>;
                    requires !IsList<T>::value;
                  })
      add(key, schema_of<typename T::value_type>(), false);
    else
      add(key, schema_of<T>());
  }
  template <class T>
  void operator()(const Key& key, T& value, const T& /*what is written*/) {
    (*this)(key, value);
  }
  template <class T>
  void operator()(const Key& key, NumberOrNull<T> /*form*/) {
    add(key, or_null(of_type("number")));
  }
  template <class T>
  void operator()(const Key& key, Stated<T> /*form*/) {
    add(key, or_null(of_type("number")));
  }
  template <class T>
  void operator()(const Key& key, Judged<T> /*form*/) {
    add(key, or_null(of_type("number")));
    add(named("finite", "false where the value is not finite"), of_type("boolean"), false);
  }
  template <class T>
  void operator()(const Key& key, OrNull<T> /*form*/) {
    add(key, or_null(schema_of<T>()));
  }
  template <class T>
  void operator()(const Key& key, IfAny<T> /*form*/) {
    if constexpr (requires {
                    typename T::value_type;
                    T{}.has_value();
                  })
      add(key, schema_of<typename T::value_type>(), false);
    else
      add(key, schema_of<T>(), false);
  }
  template <class Form>
  void written(const Key& key, Form /*form*/) {
    add(key, schema_of<std::remove_cvref_t<std::invoke_result_t<Form>>>());
  }
  template <class Each>
  void part(const Key& key, bool is_there, Each each) {
    Properties inner;
    each(inner);
    add(key, std::move(inner.whole_), is_there);
  }
  void end(const Key& status, Status, const Key& reason, const std::string&) {
    add(status, enumeration<Status>());
    add(reason, of_type("string"));
  }
  [[nodiscard]] Json take() { return std::move(whole_); }

 private:
  void add(const Key& key, Json value, bool required = true) {
    const std::string name(key.name);
    if (!key.meaning.empty() || !key.unit.empty())
      value["description"] =
          std::string(key.meaning) + (key.unit.empty() ? "" : " [" + std::string(key.unit) + "]");
    whole_["properties"][name] = std::move(value);
    if (required) whole_["required"].push_back(name);
  }
  Json whole_{{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
};

template <Described R>
Json object() {
  R empty;
  Properties properties;
  fields(properties, empty);
  return properties.take();
}

}  // namespace

Json results_schema() {
  Json out{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
           {"title", "results.json of tripoint, format 1"}};
  out.update(object<Results>());
  return out;
}

}  // namespace tripoint
