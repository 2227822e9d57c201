// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/effect_rule.hpp"

/// The table [model]: every term of the model with its forms, each by a word. The reader, the schema, the
/// page, jobs, `explain` and `ablate` go over this one list.
namespace tripoint {

struct ModelTerm {
  std::string_view name;             ///< key of [model]
  std::optional<Term> term;          ///< of those with a printed form, whose last form is "paper"
  std::vector<ModelForm> forms;      ///< the last has no correction
  const EffectRule* rule = nullptr;  ///< whose term it is; none of the kernel and of time
  std::string_view why{};            ///< reason of its default; none of those with a printed form
  bool has_equation = true;          ///< that the paper prints (DeclaredTerm)
};
/// All that effects declare: those with a printed form first.
[[nodiscard]] std::span<const ModelTerm> model_terms();

/// The form that a scene has, none where a key of [scene] gives a coefficient that no form has.
[[nodiscard]] const ModelForm* form_in(const Scene&, const ModelTerm&);
/// The form of a word, none where the term has no such form.
[[nodiscard]] const ModelForm* form_of_word(const ModelTerm&, std::string_view word);
/// Gives a scene this form of a term, whatever its mode.
void choose(Scene&, const ModelTerm&, const ModelForm&);
/// Why a form changes nothing in a scene, as none of its keys acts there; "" where it acts.
[[nodiscard]] std::string why_idle(const Scene&, const ModelTerm&, const ModelForm&);

/// Keys of [scene] by which old files say the form of a term: "core_reach", "modes.heat", "clamp".
[[nodiscard]] std::vector<std::string> old_keys_of(const ModelTerm&);
/// The term that an old key is of; none where no term has it.
[[nodiscard]] const ModelTerm* term_of_old_key(std::string_view key);

/// The rows of the table.
[[nodiscard]] std::vector<Key> model_keys();

/// Takes the form of a term that leads, where the file names none, its effect would act, and no given key is
/// one of the term's own form. @param top the case file   @param in its table [scene]
/// @pre all of the scene but its modes is read   @return why each of those terms has its form
std::map<std::string_view, std::string> take_leading_forms(TableReader& top, const TableReader& in, Scene&);

}  // namespace tripoint
