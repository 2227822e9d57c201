// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "scene/effect_rule.hpp"
#include "scene/model.hpp"
#include "scene/value_reader.hpp"

namespace tripoint {
namespace {

/// The scene as it is where every term takes its corrected form, and this one leads.
Scene led(Scene s, const BroughtForm& lead) {
  s.mode = Mode::corrected;
  s.forms[lead.term] = lead.form.word;
  s.resolve_modes();
  return s;
}

/// Whether no term with an equation of the paper that the rule's forms read is as printed.
bool none_printed(const Scene& s, const EffectRule& rule) {
  return std::ranges::none_of(declared_terms(), [&](const DeclaredTerm& one) {
    return one.has_equation && s.mode_of(one.term) == Mode::paper && reads_term(rule, one.term);
  });
}

/// The term of [model] whose given form sets the key; none where no word does.
const ModelTerm* set_by_form(const TomlNode* model, std::string_view key) {
  if (!model) return nullptr;
  for (const ModelTerm& t : model_terms()) {
    const TomlNode* word = model->find(t.name);
    if (!word) continue;
    const ModelForm* form = form_of_word(t, word->text);
    if (form && std::ranges::find(form->values, key, &std::pair<std::string_view, double>::first) !=
                    form->values.end())
      return &t;
  }
  return nullptr;
}

/// A given word or old key that acts in the term's own form alone; empty where there is none.
std::string word_of_own_form(const TableReader& in, const TomlNode* model, const Scene& own,
                             const Scene& with) {
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& key : rule.keys) {
      if (key.row.table != "scene" || !key.idle || !key.idle(own).empty() || key.idle(with).empty()) continue;
      if (in.has(key.row.name)) return fmt::format("scene.{}", key.row.name);
      if (const ModelTerm* t = set_by_form(model, key.row.name)) return fmt::format("model.{}", t->name);
    }
  return "";
}

}  // namespace

std::map<std::string_view, std::string> take_leading_forms(TableReader& top, const TableReader& in,
                                                           Scene& s) {
  std::map<std::string_view, std::string> reasons;
  const TomlNode* model = top.composite("model");
  for (const EffectRule& rule : effect_rules())
    for (const BroughtForm& lead : rule.forms) {
      if (!lead.leads || s.forms.contains(lead.term) || (model && model->find(lead.term.name))) continue;
      const Scene with = led(s, lead);
      if (!with.has_brought_form(lead.term) || !none_printed(with, rule) || rule.called_for(with).empty())
        continue;
      const auto brought =
          std::ranges::find_if(rule.terms_shared, [&](const Term& t) { return s.forms.contains(t); });
      if (brought != rule.terms_shared.end()) {
        reasons[lead.term.name] = fmt::format("model.{} is another effect's form", brought->name);
        continue;
      }
      Scene own = with;
      own.forms.erase(lead.term);
      const std::string word = word_of_own_form(in, model, own, with);
      if (word.empty()) s.forms[lead.term] = lead.form.word;
      reasons[lead.term.name] =
          word.empty() ? "leads where liquid flows" : fmt::format("{} is of this form", word);
    }
  return reasons;
}

}  // namespace tripoint
