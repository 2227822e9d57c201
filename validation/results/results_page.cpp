// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "validation/results/results_schema.hpp"

/// docs/results.md: its lists of keys are the schema in words.
namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view introduction = R"(# results.json

Written by `tripoint schema --results --page` from the records that write and read the file; without
`--page` it prints the JSON Schema.

`tripoint validate` leaves `results.json` in the folder of the report. It holds every number, limit
and verdict. Pages, `junit.xml` and `summary.md`
are made from it. `tripoint validate --json` prints it.

    tripoint validate rigid/ballistic --no-report --out numbers
    tripoint export numbers/results.json --to csv --out tables    # cases.csv, gates.csv ...
    tripoint gate numbers/results.json                         # the verdicts once more; runs nothing

Rules for readers:

- `format` is 1. New keys may appear; none is renamed or removed.
- A number that is not finite is `null`, with `"finite": false` beside it where the key is called
  `value`. It never passes. A number that does not exist is `null` alone.
- Units are SI, except for metrics: their unit is that of the metric, after its scale.
- An uncertainty is one standard deviation.
- Optional keys are marked *opt*. They are left out where they would be empty.

)";

/// The words of an enumeration: "pass, fail or missing".
std::string choice(const Json& words) {
  std::vector<std::string> list;
  for (const auto& word : words)
    if (!word.get<std::string>().empty()) list.push_back(word);
  const std::string last = list.back();
  list.pop_back();
  return fmt::format("{} or {}", fmt::join(list, ", "), last);
}

std::string type_words(const Json& value) {
  if (value.contains("anyOf")) return type_words(value["anyOf"][0]) + " or null";
  if (value.contains("enum")) return "text";
  const std::string type = value.value("type", "any");
  if (type == "string") return "text";
  const char* items = type == "array" ? "items" : "additionalProperties";
  if (!value.contains(items)) return type;
  const Json& item = value[items].contains("anyOf") ? value[items]["anyOf"][0] : value[items];
  const std::string of = type_words(item), one = type == "array" ? "list" : type;
  return of == "object" ? one : fmt::format("{} of {}", one, of);
}

std::string meaning(const Json& value) {
  const Json& one = value.contains("anyOf") ? value["anyOf"][0] : value;
  return value.contains("description") ? value["description"].get<std::string>()
         : one.contains("enum")        ? choice(one["enum"])
                                       : "";
}

struct Row {
  std::string keys, type, meaning;
};

/// The objects of these paths have lists of their own.
bool has_own_list(const std::string& path) { return path == "cases" || path == "engines" || path == "runs"; }

/// The list of the keys of an object and of those in it.
class KeyList {
 public:
  explicit KeyList(const Json& object) { add(object, ""); }

  [[nodiscard]] std::string text(const std::string& title) const {
    std::string out = fmt::format("## {}\n\n", title);
    for (const Row& row : rows_) out += fmt::format("- {} ({}): {}\n", row.keys, row.type, row.meaning);
    return out + "\n";
  }

 private:
  /// Keys of one type and meaning that follow each other share a row.
  void add(const Json& object, const std::string& prefix) {
    bool joins = false;
    for (const auto& [name, value] : object["properties"].items()) {
      const auto& required = object["required"];
      const bool is_there = std::find(required.begin(), required.end(), name) != required.end();
      const Row row{fmt::format("`{}{}`", prefix, name), type_words(value) + (is_there ? "" : ", *opt*"),
                    meaning(value)};
      if (joins && rows_.back().type == row.type && rows_.back().meaning == row.meaning)
        rows_.back().keys += ", " + row.keys;
      else
        rows_.push_back(row);
      const std::size_t before = rows_.size();
      if (!has_own_list(prefix + name)) add_inner(value, prefix + name);
      joins = rows_.size() == before;
    }
  }
  /// Keys of the objects that a value holds. Keys that are listed already are those of that place.
  void add_inner(const Json& value, const std::string& path) {
    if (value.contains("properties")) {
      const auto [at, is_new] = listed_.try_emplace(value["properties"].dump(), path);
      if (is_new)
        add(value, path + ".");
      else
        rows_.back().meaning += fmt::format("; keys as of `{}`", at->second);
    } else if (value.contains("items")) {
      add_inner(value["items"], path + "[]");
    } else if (value.contains("additionalProperties")) {
      add_inner(value["additionalProperties"], path + ".NAME");
    }
  }

  std::vector<Row> rows_;
  std::map<std::string, std::string> listed_;  ///< properties -> where they are listed
};

}  // namespace

std::string results_page() {
  const Json whole = results_schema();
  const Json& of_case = whole["properties"]["cases"]["items"];
  const Json& engine = of_case["properties"]["engines"]["items"];
  const Json& run = engine["properties"]["runs"]["items"];
  std::string out(introduction);
  out += KeyList(whole).text("The whole") + KeyList(of_case).text("A case: `cases[]`");
  out += KeyList(engine).text("An engine and preset: `cases[].engines[]`");
  out += KeyList(run).text("A run: `cases[].engines[].runs[]`");
  out.pop_back();
  return out;
}

}  // namespace tripoint
