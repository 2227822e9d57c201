// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tables/toml_node.hpp"
#include "validation/case/case_words.hpp"

/// A case file as one plain document: its base is merged in, and its short forms are written out as
/// [[metric]] and [[gate]]. The reader of a case then knows one form alone. Every value keeps the file and
/// the line that it was written in.
namespace tripoint {

struct CaseReading;

/// The case of a file, with everything that it extends.
/// @throws InputError with the file and the line of the wrong key, be it in the case or in the file that it
/// extends
[[nodiscard]] TomlNode read_case_document(const std::string& file);

/// The whole case as the text of a case file that extends nothing, its short forms written out. It loads as
/// the same case, by the same name, from the case's folder, where its data and meshes lie.
[[nodiscard]] std::string resolved_case(const CaseReading&, const std::vector<std::string>& set = {});

/// The document as the text of a case file. Each top table and each table of an array stands under its
/// header, all else on one line a key.
[[nodiscard]] std::string document_text(const TomlNode&);

// The steps of the way, in their order.

/// The file that `extends` names: "other.toml" in the folder of the case, or a path or a case's name. The
/// path or name must lead into the folder `cases` around the case, or into that of the shipped cases. A
/// third-party case can name no other file, and no file that is no case.
/// @throws InputError at the place of `extends`
[[nodiscard]] std::string extended_file(const TomlNode& extends, const std::string& file);

/// Gates within metrics, and limits by level, become tables of `gate`; `invariants` stay, one table each.
void write_out_gates(TomlNode& document);

/// Puts what `own` says over `base`: tables key by key, tables of arrays by what tells them apart. @throws
/// InputError at the place in `own`
void merge_case(TomlNode& base, TomlNode own);

/// Takes out of the document the keys that `remove` names: "scene.jitter", "engines.lammps",
/// "metric.overlap", "study".
void remove_keys(TomlNode& document, const TomlNode& remove);

/// Whether a path is that of a key of [scene] that a word of [model] has replaced: "scene.core_reach".
[[nodiscard]] bool is_old_key(std::string_view path);
/// Erases what `base` says of the form of each term that `own` says anew, be it by a word or by an old key.
void forget_forms(TomlNode& base, TomlNode& own);
/// Erases an old key, and the word that says the same; nothing where neither is given. @pre is_old_key(path)
void remove_form(TomlNode& document, std::string_view path);

/// `invariants` become tables of `metric` and `gate`.
void write_out_invariants(TomlNode& document);

/// Puts "a.b=VALUE" into the document. Tables of an array are found by their `name`, or by their number
/// from 1.
void apply_override(TomlNode& document, const std::string& set);

/// Whether a file says something by a short form, or by another file.
[[nodiscard]] bool has_short_forms(const TomlNode& document);

/// Refuses short forms: `--set` changes a document after they have been written out. @throws InputError at
/// their place
void check_written_out(const TomlNode& document);

/// A quantity that a run must keep, by the name that `invariants` knows it by.
struct Invariant {
  std::string_view name, quantity;
  Norm norm;
  /// The value that it is compared with: "" by the case's reference, "!" must be given, else the default
  std::string_view value;
  std::string_view reason;  ///< of its limit where the case gives none; "" it must be given
  std::string_view meaning;
};
[[nodiscard]] const std::vector<Invariant>& invariants();

}  // namespace tripoint
