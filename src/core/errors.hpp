// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdexcept>
#include <string>

namespace tripoint {

/// A place in a text file; line and column count from 1, 0 = unknown.
struct SourcePlace {
  std::string file;
  int line = 0, column = 0;
};

/// "file:line:column", without the parts that are unknown.
inline std::string to_string(const SourcePlace& p) {
  std::string text = p.file;
  if (p.line > 0) text += ":" + std::to_string(p.line);
  if (p.line > 0 && p.column > 0) text += ":" + std::to_string(p.column);
  return text;
}

/// Bad input or usage (exit code 2): says where, what was wrong and what to write instead.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what) : std::runtime_error(what) {}
  InputError(const SourcePlace& place, const std::string& what)
      : std::runtime_error(place.file.empty() ? what : to_string(place) + ": " + what), place_(place) {}
  [[nodiscard]] const SourcePlace& place() const noexcept { return place_; }

 private:
  SourcePlace place_;
};

/// An engine failed by no fault of the job: carries the engine's own words.
class EngineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run blew up, or left what its equations hold for (exit code 7).
class Diverged : public std::runtime_error {
 public:
  Diverged(long id, long row, std::string what_field, std::string at_stage, double when,
           const std::string& what, std::string by_guard = "finite")
      : std::runtime_error(what),
        particle(id),
        body(row),
        field(std::move(what_field)),
        stage(std::move(at_stage)),
        guard(std::move(by_guard)),
        time(when) {}
  long particle;  ///< id, -1 if it is no single particle
  long body;      ///< row of the body, -1 for none
  std::string field, stage;
  std::string guard;  ///< a word of GuardName (scene/guard_name.hpp)
  double time;        ///< [s]
};

}  // namespace tripoint
