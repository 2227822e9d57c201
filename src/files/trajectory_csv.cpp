// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "core/errors.hpp"
#include "core/not_a_number.hpp"
#include "files/gauge_error.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

constexpr std::size_t greatest_line = 4096;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// Column numbers by name, and one line's cells as numbers.
class Table {
 public:
  Table(const std::string& path, const std::string& header) : path_(path) {
    const auto names = split(header);
    for (std::size_t k = 0; k < names.size(); ++k)
      if (!column_.emplace(names[k], k).second)
        throw InputError({path, 1, 0}, "the header names the column \"" + names[k] + "\" twice");
  }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(place_, what); }
  void line(const std::string& text, int number) {
    place_ = {path_, number, 0};
    const auto cells = split(text);
    if (cells.size() != column_.size())
      throw InputError(place_, "has " + std::to_string(cells.size()) + " cells, the header has " +
                                   std::to_string(column_.size()));
    value_.assign(cells.size(), 0.0);
    for (std::size_t k = 0; k < cells.size(); ++k) value_[k] = number_in(cells[k]);
  }
  [[nodiscard]] bool has(const std::string& name) const { return column_.count(name) > 0; }
  [[nodiscard]] double operator[](const std::string& name) const {
    const auto at = column_.find(name);
    if (at == column_.end()) throw InputError(place_, "the column " + name + " is missing");
    return value_[at->second];
  }
  [[nodiscard]] Vec3 vector(const char* x, const char* y, const char* z) const {
    return {(*this)[x], (*this)[y], (*this)[z]};
  }
  [[nodiscard]] std::size_t row(const std::string& name, std::size_t rows) const {
    const double v = (*this)[name];
    if (!(v >= 0.0 && v < static_cast<double>(rows)) || v != std::floor(v))
      throw InputError(
          place_, name + " " + std::to_string(v) + " is not one of 0 to " + std::to_string(rows) + " - 1");
    return static_cast<std::size_t>(v);
  }

 private:
  [[nodiscard]] double number_in(const std::string& cell) const {
    double v = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), v);
    if (error != std::errc() || end != cell.data() + cell.size())
      throw InputError(place_, "\"" + cell + "\" is no number");
    return v;
  }
  std::string path_;
  SourcePlace place_;
  std::map<std::string, std::size_t> column_;
  std::vector<double> value_;
};

Snapshot empty_frame(double time, const InitialState& initial, std::size_t bodies) {
  const Vec3 nan{not_a_number, not_a_number, not_a_number};
  Snapshot s;
  s.time = time;
  s.position.assign(initial.size(), nan);
  s.velocity.assign(initial.size(), nan);
  s.mass = initial.mass;
  s.phase = initial.phase;
  s.body = initial.body;
  s.material = initial.material;
  s.id.assign(initial.size(), -1);
  s.bodies.assign(
      bodies,
      BodyState{
          nan, nan, nan, {not_a_number, not_a_number, not_a_number, not_a_number}, not_a_number, nan, nan});
  return s;
}

void put_particle(const Table& row, const InitialState& initial, Snapshot& s) {
  const std::size_t i = row.row("id", initial.size());
  if (s.id[i] >= 0) row.refuse("particle " + std::to_string(i) + " has a row already at this time");
  s.id[i] = static_cast<int>(i);
  s.position[i] = row.vector("x", "y", "z");
  s.velocity[i] = row.vector("vx", "vy", "vz");
  if (!row.has("temperature")) return;
  s.temperature.resize(initial.size(), not_a_number);
  s.temperature[i] = row["temperature"];
}

/// A body before the run: its mass [kg], its centre [m], and the numbers of its particles.
struct Start {
  double mass = 0.0;
  Vec3 centre;
  std::vector<std::size_t> members;
};

/// A row of a body places its particles too: they move rigidly with it from where they started.
void put_body(const Table& row, const InitialState& initial, const std::vector<Start>& start, Snapshot& s) {
  const std::size_t b = row.row("body", s.bodies.size());
  BodyState& body = s.bodies[b];
  if (std::isfinite(body.mass)) row.refuse("body " + std::to_string(b) + " has a row already at this time");
  body.mass = start[b].mass;
  body.position = row.vector("x", "y", "z");
  body.velocity = row.vector("vx", "vy", "vz");
  body.orientation = {};
  body.angular_velocity = {};  // an engine that writes none does not turn
  if (row.has("qw")) body.orientation = {row["qw"], row["qx"], row["qy"], row["qz"]};
  if (row.has("wx")) body.angular_velocity = row.vector("wx", "wy", "wz");
  for (const std::size_t i : start[b].members) {
    const Vec3 arm = rotate(body.orientation, initial.position[i] - start[b].centre);
    s.id[i] = static_cast<int>(i);
    s.position[i] = body.position + arm;
    s.velocity[i] = body.velocity + cross(body.angular_velocity, arm);
  }
}

std::vector<Start> starts(const InitialState& initial, std::size_t bodies) {
  std::vector<Start> all(bodies);
  for (std::size_t i = 0; i < initial.size(); ++i) {
    if (initial.body[i] < 0 || static_cast<std::size_t>(initial.body[i]) >= bodies) continue;
    Start& body = all[static_cast<std::size_t>(initial.body[i])];
    body.mass += initial.mass[i];
    body.centre += initial.mass[i] * initial.position[i];
    body.members.push_back(i);
  }
  for (Start& body : all) body.centre *= body.mass > 0.0 ? 1.0 / body.mass : 0.0;
  return all;
}

/// A read that fails would look like the end of the file.
void expect_read_whole(const std::ifstream& file, const std::string& path) {
  if (file.bad()) throw InputError(path + ": cannot be read to its end");
}

/// The frame of a time, made where there is none. @throws InputError where there are too many
template <class Make>
Snapshot& frame_at(double time, std::map<double, Snapshot>& frames, std::size_t most, const Table& row,
                   const Make& make) {
  const auto at = frames.find(time);
  if (at != frames.end()) return at->second;
  if (frames.size() >= most)
    row.refuse("has more than " + std::to_string(most) + " different times, more than it can need");
  return frames.emplace(time, make()).first->second;
}

}  // namespace

Trajectory read_trajectory_csv(const std::string& path, const InitialState& initial, std::size_t bodies,
                               std::size_t most_frames) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read");
  std::string text;
  if (!std::getline(file, text) || text.size() > greatest_line)
    throw InputError(path + ": has no header line");
  Table row(path, text);
  const std::vector<Start> start = starts(initial, bodies);
  std::map<double, Snapshot> frames;
  for (int number = 2; std::getline(file, text); ++number) {
    if (text.empty()) continue;
    if (text.size() > greatest_line) throw InputError({path, number, 0}, "the line is too long");
    row.line(text, number);
    const double time = row["time"];
    if (!std::isfinite(time)) throw InputError({path, number, 0}, "the time is not finite");
    Snapshot& frame =
        frame_at(time, frames, most_frames, row, [&] { return empty_frame(time, initial, bodies); });
    row.has("body") ? put_body(row, initial, start, frame) : put_particle(row, initial, frame);
  }
  expect_read_whole(file, path);
  Trajectory trajectory;
  for (auto& [time, frame] : frames) {
    for (std::size_t i = 0; i < initial.size(); ++i) {
      frame.total_mass += frame.mass[i];
      frame.momentum += frame.mass[i] * frame.velocity[i];
      frame.angular_momentum += frame.mass[i] * cross(frame.position[i], frame.velocity[i]);
    }
    trajectory.frames.push_back(std::move(frame));
  }
  return trajectory;
}

void read_gauges_csv(const std::string& path, const std::vector<std::string>& names, Trajectory& trajectory,
                     std::size_t most_frames) {
  std::ifstream file(path);
  std::string text;
  if (!file || !std::getline(file, text) || text.size() > greatest_line)
    throw InputError(path + ": has no header line");
  Table row(path, text);
  std::map<double, Snapshot> frames;
  for (Snapshot& frame : trajectory.frames) frames[frame.time] = std::move(frame);
  for (int number = 2; std::getline(file, text); ++number) {
    if (text.empty()) continue;
    if (text.size() > greatest_line) throw InputError({path, number, 0}, "the line is too long");
    row.line(text, number);
    const double time = row["time"];
    const std::string& name = names.at(row.row("gauge", names.size()));
    if (!std::isfinite(time) || !std::isfinite(row["value"]))
      throw InputError({path, number, 0}, "the gauge `" + name + "` is not finite");
    Snapshot& frame = frame_at(time, frames, most_frames, row, [] { return Snapshot{}; });
    frame.time = time;
    if (!frame.gauges.emplace(name, row["value"]).second)
      throw InputError({path, number, 0}, "the gauge `" + name + "` has two values at this time");
    if (!row.has("standard_error")) continue;
    if (!(row["standard_error"] >= 0.0) || !std::isfinite(row["standard_error"]))
      throw InputError({path, number, 0},
                       "the standard error of the gauge `" + name + "` is no number from 0 on");
    frame.gauges[gauge_error_key(name)] = row["standard_error"];
  }
  expect_read_whole(file, path);
  trajectory.frames.clear();
  for (auto& [time, frame] : frames) trajectory.frames.push_back(std::move(frame));
}

}  // namespace tripoint
