// SPDX-License-Identifier: BSD-3-Clause
#include "scene/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <type_traits>

#include "scene/effect_keys.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

const ModelForm printed{"paper", ""};

const EffectRule* owner_of(const Term& t) {
  const auto has = [&](const EffectRule& rule) {
    return std::ranges::find(rule.terms, t, &DeclaredTerm::term) != rule.terms.end();
  };
  const auto owner = std::ranges::find_if(effect_rules(), has);
  return owner == effect_rules().end() ? nullptr : &*owner;
}

ModelTerm term_of(const DeclaredTerm& one) {
  ModelTerm t{one.name.empty() ? one.term.name : one.name,
              one.term,
              one.forms,
              owner_of(one.term),
              "",
              one.has_equation};
  for (const EffectRule& rule : effect_rules())
    for (const BroughtForm& brought : rule.forms)
      if (brought.term == one.term) t.forms.push_back(brought.form);
  t.forms.push_back(printed);
  return t;
}

std::vector<ModelTerm> collected_terms() {
  std::vector<ModelTerm> list;
  for (const DeclaredTerm& one : declared_terms()) list.push_back(term_of(one));
  for (const EffectRule& rule : effect_rules())
    for (const ModelChoice& one : rule.choices) list.push_back({one.name, {}, one.forms, &rule, one.why});
  return list;
}

/// Whether another effect than the owner of the term brings the form.
bool is_brought(const Term& t, std::string_view word) {
  return std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
    return std::ranges::any_of(rule.forms,
                               [&](const BroughtForm& f) { return f.term == t && f.form.word == word; });
  });
}

/// Calls visit(value) with the value that keeps a key of [scene].
template <class Owner, class Visit>
void visit_key(Owner& scene, std::string_view key, Visit visit) {
  each_effect_key(scene, "scene", [&](const Key& row, auto&& value) {
    if (row.name == key) visit(value);
  });
}

double number_in(const Scene& scene, std::string_view key) {
  double number = 0.0;
  visit_key(scene, key, [&](const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>> ||
                  std::is_enum_v<std::decay_t<decltype(value)>>)
      number = static_cast<double>(value);
  });
  return number;
}

void set_number(Scene& scene, std::string_view key, double number) {
  visit_key(scene, key, [&](auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>)
      value = number != 0.0;
    else if constexpr (std::is_enum_v<Value>)
      value = static_cast<Value>(static_cast<int>(number));
    else if constexpr (std::is_same_v<Value, double>)
      value = number;
  });
}

bool has_values(const Scene& scene, const ModelForm& form) {
  return std::ranges::all_of(form.values,
                             [&](const auto& one) { return number_in(scene, one.first) == one.second; });
}

const EffectKey* key_of(const EffectRule& rule, std::string_view name) {
  const auto key = std::ranges::find_if(
      rule.keys, [&](const EffectKey& one) { return one.row.table == "scene" && one.row.name == name; });
  return key == rule.keys.end() ? nullptr : &*key;
}

}  // namespace

std::span<const ModelTerm> model_terms() {
  static const std::vector<ModelTerm> all = collected_terms();
  return all;
}

const ModelForm* form_of_word(const ModelTerm& t, std::string_view word) {
  const auto form = std::ranges::find(t.forms, word, &ModelForm::word);
  return form == t.forms.end() ? nullptr : &*form;
}

const ModelForm* form_in(const Scene& scene, const ModelTerm& t) {
  if (t.term && scene.mode_of(*t.term) == Mode::paper) return &t.forms.back();
  if (t.term && scene.has_brought_form(*t.term)) return form_of_word(t, scene.forms.at(*t.term));
  const auto form =
      std::ranges::find_if(t.forms, [&](const ModelForm& one) { return has_values(scene, one); });
  return form == t.forms.end() ? nullptr : &*form;
}

void choose(Scene& scene, const ModelTerm& t, const ModelForm& form) {
  if (t.term) {
    scene.modes_given[*t.term] = form.word == printed.word ? Mode::paper : Mode::corrected;
    scene.forms.erase(*t.term);
    if (is_brought(*t.term, form.word)) scene.forms[*t.term] = form.word;
  }
  for (const auto& [key, number] : form.values) set_number(scene, key, number);
}

std::string why_idle(const Scene& scene, const ModelTerm& t, const ModelForm& form) {
  if (!t.rule) return "";
  std::string why;
  for (const auto& [name, number] : form.values) {
    const EffectKey* key = key_of(*t.rule, name);
    why = key && key->idle ? key->idle(scene) : "";
    if (why.empty()) return "";
  }
  return why;
}

std::vector<std::string> old_keys_of(const ModelTerm& t) {
  std::vector<std::string> keys;
  if (t.term) keys.push_back(fmt::format("modes.{}", t.term->name));
  if (t.term == term::clamp) keys.emplace_back("clamp");
  for (const ModelForm& form : t.forms)
    for (const auto& [key, number] : form.values)
      if (std::ranges::find(keys, key) == keys.end()) keys.emplace_back(key);
  return keys;
}

const ModelTerm* term_of_old_key(std::string_view key) {
  const auto has = [&](const ModelTerm& t) {
    const auto keys = old_keys_of(t);
    return std::ranges::find(keys, key) != keys.end();
  };
  const auto found = std::ranges::find_if(model_terms(), has);
  return found == model_terms().end() ? nullptr : &*found;
}

std::vector<Key> model_keys() {
  static std::deque<std::string> texts;  // as long as the program
  const auto kept = [&](std::string text) -> std::string_view { return texts.emplace_back(std::move(text)); };
  std::vector<Key> rows;
  for (const ModelTerm& t : model_terms()) {
    std::string words, meaning;
    for (const ModelForm& form : t.forms) {
      words += fmt::format("{}{}", words.empty() ? "" : " ", form.word);
      if (form.meaning.empty()) continue;
      meaning += fmt::format("{}`{}`: {}", meaning.empty() ? "" : ". ", form.word, form.meaning);
    }
    const ModelForm* usual = t.term ? nullptr : form_in(Scene{}, t);
    const std::string_view note =
        usual ? kept(fmt::format("`{}`, {}", usual->word, t.why)) : "as scene.mode says";
    rows.push_back({"model", t.name, ValueType::word, "", Range::any, "=", note, kept(words), kept(meaning)});
  }
  return rows;
}

}  // namespace tripoint
