// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scene/model.hpp"
#include "scene/scene_keys.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"

/// Keys of [scene] of which [model] now says the same by a word.
namespace tripoint {
namespace {

constexpr std::string_view of_scene = "scene.";

/// "scene.core_reach = 0 is now model.core = "none"".
std::string said_now(const Scene& s, const Decision& d, const ModelTerm* t) {
  if (!t) return fmt::format("{} = {} acts, and no word of [model] says it", d.key, d.value);
  if (const ModelForm* form = form_in(s, *t))
    return fmt::format("{} = {} is now model.{} = \"{}\"", d.key, d.value, t->name, form->word);
  std::vector<std::string_view> words;
  for (const ModelForm& form : t->forms) words.push_back(form.word);
  return fmt::format("{} = {} acts, and no word of model.{} says it: {}", d.key, d.value, t->name,
                     fmt::join(words, ", "));
}

TomlNode* table_at(TomlNode& document, std::string_view name) {
  TomlNode* table = document.find(name);
  return table && table->kind == TomlNode::Kind::table ? table : nullptr;
}

/// The table of an old key in a document, and its name there; none where it is not given.
std::pair<TomlNode*, std::string> given_at(TomlNode& document, const std::string& key) {
  TomlNode* table = table_at(document, "scene");
  const auto dot = key.find('.');
  if (table && dot != std::string::npos) table = table_at(*table, key.substr(0, dot));
  const std::string name = dot == std::string::npos ? key : key.substr(dot + 1);
  return {table && table->find(name) ? table : nullptr, name};
}

void drop_key(TomlNode& table, std::string_view key) {
  std::erase_if(table.members, [&](const auto& m) { return m.first == key; });
}

}  // namespace

bool is_old_key(std::string_view path) {
  if (!path.starts_with(of_scene)) return false;
  const std::string_view key = path.substr(of_scene.size());
  return term_of_old_key(key) || (scene_keys().has("scene", key) && key_row("scene", key).old);
}

std::vector<Finding> old_keys(const CaseReading& reading) {
  std::vector<Finding> found;
  for (const Decision& d : reading.decisions)
    if (d.given && is_old_key(d.key))
      found.push_back(
          {false,
           said_now(reading.value.scene, d, term_of_old_key(std::string_view(d.key).substr(of_scene.size()))),
           d.place});
  return found;
}

void forget_forms(TomlNode& base, TomlNode& own) {
  TomlNode *words = table_at(base, "model"), *new_words = table_at(own, "model");
  for (const ModelTerm& t : model_terms())
    for (const std::string& key : old_keys_of(t)) {
      if (words && given_at(own, key).first) drop_key(*words, t.name);
      if (!new_words || !new_words->find(t.name)) continue;
      if (const auto [table, name] = given_at(base, key); table) drop_key(*table, name);
    }
}

void remove_form(TomlNode& document, std::string_view path) {
  const std::string key(path.substr(of_scene.size()));
  if (const auto [table, name] = given_at(document, key); table) drop_key(*table, name);
  if (const ModelTerm* t = term_of_old_key(key))
    if (TomlNode* words = table_at(document, "model")) drop_key(*words, t->name);
}

}  // namespace tripoint
