// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.hpp"
#include "tables/decision.hpp"
#include "tables/key_table.hpp"
#include "tables/settings.hpp"
#include "tables/toml_node.hpp"

namespace tripoint {

/// Whether an array may hold a text more than once: names may not, components of a vector may.
enum class Repeats { refused, allowed };

/// One table of a case file, read by its rows of the key table. Every value is checked for type, unit, range
/// and words. Every key, given or by default, leaves a Decision. Refuses unknown keys when it is made. All
/// functions throw InputError with the place of the value and what to write instead.
class TableReader {
 public:
  /// @param table name in the key table   @param path how decisions and messages name it: "body.block"
  /// @param keys the list that has the table   @param extra keys that are allowed besides: "kind" of a shape
  TableReader(const TomlNode& node, std::string_view table, std::string path,
              std::vector<Decision>& decisions, const KeyTable& keys, std::vector<std::string> extra = {});

  /// Values for keys that the case does not give, with the reason to print (the material library).
  void fall_back_on(const TomlNode& library, std::string reason);

  [[nodiscard]] double number(std::string_view key);
  [[nodiscard]] std::optional<double> maybe_number(
      std::string_view key);  ///< empty when absent; for a key by rule no decision is left
  [[nodiscard]] long integer(std::string_view key);
  [[nodiscard]] bool flag(std::string_view key);
  [[nodiscard]] std::optional<bool> maybe_flag(std::string_view key);
  [[nodiscard]] std::string text(std::string_view key);  ///< also one of the row's words
  [[nodiscard]] std::optional<std::string> maybe_text(std::string_view key);
  [[nodiscard]] Vec3 vector(std::string_view key);
  [[nodiscard]] std::optional<Vec3> maybe_vector(std::string_view key);
  [[nodiscard]] std::vector<double> numbers(std::string_view key);
  [[nodiscard]] std::vector<double> numbers_in(std::string_view unit,
                                               std::string_view key);  ///< where another key decides the unit
  [[nodiscard]] std::optional<std::vector<double>> maybe_numbers(std::string_view key);
  /// Array of texts or words; a single text where the row allows it
  [[nodiscard]] std::vector<std::string> texts(std::string_view key, Repeats = Repeats::refused);
  [[nodiscard]] Settings settings(std::string_view key);
  /// The raw value of a key of a composite type; null when absent. Leaves no decision.
  [[nodiscard]] const TomlNode* composite(std::string_view key) const;
  /// Tables of an array of tables; empty when absent. Leaves no decision.
  [[nodiscard]] std::vector<const TomlNode*> tables(std::string_view key) const;

  /// Records a value that the reader found by a rule of its own.
  void ruled(std::string_view key, std::string value, std::string reason);
  /// Records a given composite value.
  void given(std::string_view key, std::string value);

  [[nodiscard]] bool has(std::string_view key) const { return node_.find(key) != nullptr; }
  [[nodiscard]] SourcePlace place(std::string_view key) const;  ///< of the value, else of the table
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::vector<Decision>& decisions() { return decisions_; }

 private:
  struct Found {
    const TomlNode* value = nullptr;  ///< null = use the row's fallback
    const Key* row = nullptr;
    bool from_case = false;
  };
  [[nodiscard]] Found find(std::string_view key) const;
  void record(const Found&, std::string value);
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }

  const TomlNode& node_;
  const KeyTable& keys_;
  const TomlNode* library_ = nullptr;
  std::string table_, path_, library_reason_;
  std::vector<Decision>& decisions_;
  std::size_t first_;  ///< of the decisions that are this table's
};

/// A value by the unit and range of a row of the key table. @param path names it in messages
/// @throws InputError with the place of the value
[[nodiscard]] double number_of(const TomlNode&, const Key&, const std::string& path);
[[nodiscard]] std::vector<double> numbers_of(const TomlNode&, const Key&, const std::string& path);
[[nodiscard]] Vec3 vector_of(const TomlNode&, const Key&, const std::string& path);

[[nodiscard]] std::string show(double);
[[nodiscard]] std::string show(const Vec3&);
[[nodiscard]] std::string show(const std::vector<double>&);
[[nodiscard]] std::string show(const std::vector<std::string>&);

}  // namespace tripoint
