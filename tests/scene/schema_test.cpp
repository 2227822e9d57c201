// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "case_file.hpp"
#include "sampling/sample.hpp"
#include "tables/key_table.hpp"
#include "validation/case/case_keys.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/schema.hpp"

namespace tripoint::test {
namespace {

using json = nlohmann::json;

TEST(KeyTable, NamesEveryKeyOnceWithAMeaningAndAReasonForItsDefault) {
  std::set<std::string> seen;
  for (const auto& k : case_keys().rows()) {
    EXPECT_TRUE(seen.insert(std::string(k.table) + "." + std::string(k.name)).second)
        << k.table << "." << k.name;
    EXPECT_FALSE(k.meaning.empty()) << k.name;
    EXPECT_TRUE(k.old || k.required() || !k.note.empty()) << k.table << "." << k.name;
  }
  for (const auto& t : case_keys().tables()) EXPECT_FALSE(case_keys().of(t.name).empty()) << t.name;
}

TEST(Schema, HoldsEveryKeyOfTheTable) {
  const auto s = json::parse(case_schema());
  for (const auto& k : case_keys().rows()) {
    const auto& table = k.table.empty() ? s : s.at("$defs").at(std::string(k.table));
    ASSERT_TRUE(table.at("properties").contains(std::string(k.name))) << k.table << "." << k.name;
    EXPECT_FALSE(table.at("additionalProperties").get<bool>());
  }
}

/// Every $ref leads somewhere.
void check_references(const json& node, const json& root) {
  if (node.is_object() && node.contains("$ref")) {
    EXPECT_TRUE(root.contains(json::json_pointer(node.at("$ref").get<std::string>().substr(1)))) << node;
  }
  if (node.is_structured())
    for (const auto& child : node) check_references(child, root);
}

TEST(Schema, RefersOnlyToWhatItDefines) {
  const auto s = json::parse(case_schema());
  check_references(s, s);
}

TEST(ReferencePage, NamesEveryKeyOfTheTable) {
  const auto page = case_reference_page();
  for (const auto& k : case_keys().rows()) {
    const bool is_table = k.table.empty() && (k.type == ValueType::table || k.type == ValueType::tables);
    const std::string heading = "[" + std::string(k.name),
                      line = "- `" + std::string(k.name) + (k.name == "modes" ? "." : "`: ");
    const std::string row = "| `" + std::string(k.name) + "` |";
    EXPECT_NE(page.find(is_table                  ? heading
                        : k.table == "invariants" ? row
                                                  : line),
              std::string::npos)
        << k.table << "." << k.name;
  }
}

TEST(NewCase, RunsAsItIsAndNeedsNoOtherFile) {
  const auto r = read_text(new_case_text("my/case"));
  EXPECT_EQ(r.value.id, "my/case");
  const auto scene = scene_for(r.value, {});
  EXPECT_TRUE(preflight(r.value, scene, sample(scene)).empty());
}

}  // namespace
}  // namespace tripoint::test
