// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "tables/nearest.hpp"
#include "validation/case/case.hpp"
#include "validation/case/preflight.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/measured_cells.hpp"

namespace tripoint {
namespace {

constexpr std::uintmax_t largest_file = 1 << 20;  // [bytes]
constexpr std::string_view hash_key = "# hash:";

/// A number as the header words it: `scale` turns values of a column into SI, or says their uncertainty.
struct StatedNumber {
  double number = 0.0;
  std::string rest;
};

/// Reads line by line; whatever is wrong is said with file and line.
class Reader {
 public:
  /// @param first names that the first column may have
  Reader(const std::string& path, std::vector<std::string> first) : place_{path}, first_(std::move(first)) {}

  ExperimentFile read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      ++place_.line;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.starts_with('#'))
        comment(line);
      else if (trimmed(line).empty())
        continue;
      else
        line_of_table(line);
    }
    place_.line = 0;
    check(text);
    return finished();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(place_, what); }

  StatedNumber stated(const std::string& text) const {
    StatedNumber s;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), s.number);
    if (error != std::errc() || !std::isfinite(s.number))
      refuse("`" + printable(text) + "` does not begin with a number");
    s.rest = trimmed(std::string_view(text).substr(static_cast<std::size_t>(end - text.data())));
    return s;
  }

  /// "# source: ...", "# unit COLUMN: ...", "# uncertainty COLUMN: ...", "# hash: ...", "# columns: ..."; all
  /// else is free text.
  void comment(const std::string& line) {
    const auto colon = line.find(':');
    if (colon == std::string::npos) return;
    std::istringstream words(line.substr(1, colon - 1));
    std::string key, column, more;
    words >> key >> column >> more;
    const std::string value = trimmed(std::string_view(line).substr(colon + 1));
    if (!more.empty()) return;
    if (key == "source" && column.empty())
      source_ = value;
    else if (key == "hash" && column.empty())
      hash_ = value;
    else if (key == "columns" && column.empty())
      name_columns(cells_of(value));
    else if (key == "unit" && !column.empty())
      units_[column] = unit(value);
    else if (key == "uncertainty" && !column.empty()) {
      uncertainty_[column] = uncertainty(value);
      words_[column] = value;
    }
  }

  double unit(const std::string& value) const {
    const auto s = stated(value);
    if (!(s.number > 0.0) || s.rest.empty())
      refuse("write a unit as a size greater than 0 in SI and the SI unit's name, like `0.05715 m`");
    return s.number;
  }

  StatedNumber uncertainty(const std::string& value) const {
    const auto s = stated(value);
    if (!(s.number >= 0.0) || (!s.rest.empty() && s.rest != "%"))
      refuse("write a standard uncertainty as `0.05` in the column's unit or as `2 %` of each value");
    return s;
  }

  /// One line that names no columns may stand above the table: a title.
  void line_of_table(const std::string& line) {
    const auto cells = cells_of(line);
    if (checked_) return row(cells);
    if (are_numbers(cells) && !columns_.empty()) {
      check_columns();
      return row(cells);
    }
    if (are_numbers(cells) || (title_ && !names_columns(cells))) {
      place_ = title_.value_or(place_);
      refuse(
          fmt::format("the first line of the table names the columns: `{}` and at least one more; a table "
                      "without such a line "
                      "has `# columns: {}, ...` above it",
                      fmt::join(first_, "`, `"), first_.front()));
    }
    if (!names_columns(cells)) {
      title_ = place_;
      return;
    }
    name_columns(cells);
    check_columns();
  }

  [[nodiscard]] bool names_columns(const std::vector<std::string>& cells) const {
    if (cells.size() < 2) return false;
    try {
      return std::ranges::find(first_, named_column(cells.front()).name) != first_.end();
    } catch (const std::invalid_argument&) {
      return true;  // it says a unit, and a wrong one
    }
  }

  void name_columns(const std::vector<std::string>& cells) {
    columns_.clear();
    for (const auto& cell : cells) {
      try {
        const NamedColumn column = named_column(cell);
        columns_.push_back(column.name);
        if (column.unit) units_.try_emplace(column.name, *column.unit);
      } catch (const std::invalid_argument& e) {
        refuse(e.what());
      }
    }
  }

  /// Says all that is missing at once.
  void check_columns() {
    checked_ = true;
    std::vector<std::string> lacks;
    if (std::ranges::find(first_, columns_.front()) == first_.end() || columns_.size() < 2)
      refuse(fmt::format("the first column is `{}`, and at least one more follows",
                         fmt::join(first_, "` or `")));
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string& name = columns_[c];
      if (name.empty() || std::ranges::count(columns_, name) > 1)
        refuse(fmt::format("column {} has no name of its own", c + 1));
      if (!units_.contains(name)) lacks.push_back(fmt::format("`# unit {}: ...`", printable(name)));
      if (c > 0 && !uncertainty_.contains(name))
        lacks.push_back(fmt::format("`# uncertainty {}: ...`", printable(name)));
    }
    if (lacks.empty()) return;
    if (source_.empty()) lacks.emplace_back("`# source: ...`");
    refuse(fmt::format("no line {} stands above the table", fmt::join(lacks, ", no line ")));
  }

  void row(const std::vector<std::string>& cells) {
    if (cells.size() != columns_.size())
      refuse(fmt::format("{} values where the table has {} columns", cells.size(), columns_.size()));
    std::vector<double> values;
    for (const auto& cell : cells) {
      const auto s = stated(cell);
      if (!s.rest.empty()) refuse("`" + printable(cell) + "` is not a number");
      values.push_back(s.number);
    }
    if (!rows_.empty() && !(values[0] > rows_.back()[0]))
      refuse(fmt::format("{} must rise from row to row",
                         columns_.front() == "time" ? "times" : columns_.front()));
    rows_.push_back(std::move(values));
  }

  void check(const std::string& text) const {
    if (source_.empty()) refuse("no line `# source: ...`: where do the data come from?");
    if (columns_.empty() || rows_.empty()) refuse("the table has no row");
    const auto now = experiment_hash(text);
    if (hash_.empty()) refuse(fmt::format("no line `# hash: ...`; of these data it is {}", now));
    if (hash_ != now)
      refuse(fmt::format("the data hash to {}, the file says {}: they changed since they were entered", now,
                         printable(hash_)));
  }

  [[nodiscard]] ExperimentFile finished() const {
    ExperimentFile file;
    file.source = source_;
    file.uncertainty = words_;
    file.first = columns_.front();
    for (std::size_t c = 1; c < columns_.size(); ++c) {
      const auto& u = uncertainty_.at(columns_[c]);
      const double unit = units_.at(columns_[c]);
      auto& curve = file.curves[columns_[c]];
      for (const auto& values : rows_) {
        curve.time.push_back(values[0] * units_.at(columns_.front()));
        curve.value.push_back(values[c] * unit);
        curve.uncertainty.push_back(u.rest == "%" ? 0.01 * u.number * std::abs(values[c]) * unit
                                                  : u.number * unit);
      }
    }
    return file;
  }

  SourcePlace place_;
  std::vector<std::string> first_;
  std::string source_, hash_;
  std::map<std::string, double> units_;
  std::map<std::string, StatedNumber> uncertainty_;
  std::map<std::string, std::string> words_;
  std::vector<std::string> columns_;
  bool checked_ = false;              ///< the columns are known, with units and uncertainties
  std::optional<SourcePlace> title_;  ///< of a line above the table that names no columns
  std::vector<std::vector<double>> rows_;
};

std::string text_of(const std::string& path) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  if (none) throw InputError(path + ": cannot be read");
  if (size > largest_file)
    throw InputError(path + ": is larger than 1 MiB, which no table of measured values is");
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Measured curves in time.
class Experiment : public Reference {
 public:
  Experiment(ExperimentFile file, std::optional<std::size_t> axis) : file_(std::move(file)), axis_(axis) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] const MeasuredCurve* measured(std::string_view column) const override {
    const auto found = file_.curves.find(std::string(column));
    return found == file_.curves.end() ? nullptr : &found->second;
  }

 private:
  ExperimentFile file_;
  std::optional<std::size_t> axis_;
};

std::unique_ptr<Reference> make_experiment(const ReferenceInput& in) {
  if (in.file.empty())
    throw InputError("reference function experiment needs the key `file`: the data beside the case");
  return std::make_unique<Experiment>(read_experiment(in.file), in.args.axis("axis"));
}

}  // namespace

std::string experiment_hash(const std::string& text) {
  std::uint64_t hash = 1469598103934665603ULL;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(hash_key)) continue;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    for (const char c : line + "\n") hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("fnv1a64:{:016x}", hash);
}

ExperimentFile read_experiment(const std::string& path) { return Reader(path, {"time"}).read(text_of(path)); }

ExperimentFile read_table_text(const std::string& path, const std::string& text) {
  return Reader(path, {"time", "x", "y", "z"}).read(text);
}

ExperimentFile read_table(const std::string& path) { return read_table_text(path, text_of(path)); }

void check_data_files(const Case& value) {
  const auto check = [](const ReferenceChoice& choice) {
    if (choice.function == "table")
      (void)read_table(choice.file);
    else if (choice.kind == ReferenceKind::experiment)
      (void)read_experiment(choice.file);
  };
  check(value.reference);
  for (const auto& m : value.metrics)
    if (m.reference) check(*m.reference);
}

std::vector<Finding> data_after_the_end(const Case& value) {
  std::vector<Finding> found;
  std::set<std::string> seen;
  const double end = value.scene.end_time;
  const auto look = [&](const ReferenceChoice& choice, const SourcePlace& place) {
    if (choice.file.empty() || !seen.insert(choice.file).second) return;
    const ExperimentFile file =
        choice.function == "table" ? read_table(choice.file) : read_experiment(choice.file);
    const double last = file.curves.begin()->second.time.back();
    if (file.first == "time" && last > end * (1.0 + 1e-9))
      found.push_back({false,
                       fmt::format("the data go on until {} s, and the run ends at end_time = {} s: what was "
                                   "measured later is compared with nothing",
                                   last, end),
                       place});
  };
  const auto measured = [](const ReferenceChoice& c) {
    return c.function == "table" || c.kind == ReferenceKind::experiment;
  };
  if (measured(value.reference)) look(value.reference, {value.file, 0, 0});
  for (const auto& m : value.metrics)
    if (m.reference && measured(*m.reference)) look(*m.reference, m.place);
  return found;
}

ReferenceChoice with_source_of_file(ReferenceChoice choice) {
  if ((choice.kind != ReferenceKind::experiment && choice.function != "table") || !choice.source.empty())
    return choice;
  try {
    const auto file = choice.function == "table" ? read_table(choice.file) : read_experiment(choice.file);
    choice.source = file.source;
    for (const auto& [column, words] : file.uncertainty)
      choice.source += fmt::format("; standard uncertainty of {}: {}", column, words);
  } catch (const InputError&) {  // gone or changed since the case began: check_data_files() saw it whole
    choice.source.clear();
  }
  return choice;
}

ReferenceEntry experiment_entry() {
  return {{"experiment",
           "experiment",
           "the source that the data file states",
           "measured values in time, from the file beside the case",
           {{"axis", "", "x, y or z: along which the measured length runs", ArgumentType::axis}}},
          make_experiment};
}

}  // namespace tripoint
