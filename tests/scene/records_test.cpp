// SPDX-License-Identifier: BSD-3-Clause
// A default is written in the row of its key; a scene that no reader made has the same.
#include <gtest/gtest.h>

#include "scene/effect_keys.hpp"
#include "scene/place_records.hpp"
#include "scene/scene_keys.hpp"
#include "scene/scene_records.hpp"

namespace tripoint {
namespace {

/// Whether a row says its default, and not a rule or that there is none.
bool has_default(const Key& key) { return !key.required() && !key.fallback.empty() && key.fallback != "="; }

/// What reading an empty table makes of a value.
template <class T, class... Yes>
T read_of_nothing(const Key& key, T value, Yes... yes) {
  TomlNode empty;
  empty.kind = TomlNode::Kind::table;
  Reading reading;
  TableReader in(empty, key.table, "", reading.decisions, scene_keys(), {"kind"});
  ValueReader(in, reading)(key, value, yes...);
  return value;
}

template <class T>
constexpr bool is_comparable = std::equality_comparable<T> && !std::is_same_v<T, std::vector<Keyframe>>;

/// Compares each default of a record with that of its member. @return how many there are
long compare(const auto& owner) {
  long count = 0;
  each_kept_of(owner, [&](const auto& entry) {
    const auto& own = owner.*entry.member;
    using T = std::remove_cvref_t<decltype(own)>;
    if constexpr (is_comparable<T>) {
      if (!has_default(entry.key)) return;
      ++count;
      if constexpr (std::is_same_v<T, bool>)
        EXPECT_EQ(read_of_nothing(entry.key, own, entry.yes), own)
            << entry.key.table << "." << entry.key.name;
      else
        EXPECT_TRUE(read_of_nothing(entry.key, own) == own) << entry.key.table << "." << entry.key.name;
    }
  });
  return count;
}

template <class Owner>
long compare_kinds() {
  long count = 0;
  const auto one = [&](const auto& kind) {
    Owner owner;
    owner.kind = kind.kind;
    count += compare(owner);
  };
  std::apply([&](const auto&... all) { (one(all), ...); }, kinds<Owner>);
  return count;
}

long compare_effect_keys(const auto& owner, std::string_view table) {
  long count = 0;
  each_effect_key(owner, table, [&](const Key& key, const auto& own) {
    if (!has_default(key)) return;
    ++count;
    EXPECT_TRUE(read_of_nothing(key, std::remove_cvref_t<decltype(own)>(own)) == own)
        << key.table << "." << key.name;
  });
  return count;
}

TEST(Records, ADefaultOfAMemberIsThatOfItsKey) {
  EXPECT_GT(compare(Scene()), 8);
  EXPECT_GT(compare(Body()), 3);
  EXPECT_GT(compare(Keyframe()) + compare(Event()) + compare(Inflow()), 2);
  EXPECT_GT(compare_kinds<Shape>() + compare_kinds<TemperatureField>() + compare_kinds<VelocityField>(), 4);
  EXPECT_GT(compare_effect_keys(Scene(), "scene") + compare_effect_keys(Material(), "material"), 8);
}

TEST(Records, RowsSayTheDefaultsThatFollowFromTheFormOfATerm) {
  const std::string note(key_row("scene", "support_ratio").note),
      merge(key_row("scene", "merge_distance").note);
  EXPECT_NE(note.find(show(printed_support) + " where every term is paper, else " + show(corrected_support)),
            std::string::npos);
  EXPECT_EQ(merge.find(show(lattice_reach) + ","), 0u);
  EXPECT_NE(merge.find("where phase is paper " + show(bond_reach(Scene())) + ", the reach of its bonds"),
            std::string::npos);
  EXPECT_EQ(bond_reach(Scene()), printed_support);
}

}  // namespace
}  // namespace tripoint
