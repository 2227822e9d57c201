// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/not_a_number.hpp"
#include "files/h5md_file.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

/// One trajectory.h5 open for reading; every block is checked against the number of frames.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(h5::open_for_reading(path)) {
    if (!h5::has(file_.get(), "/h5md")) throw InputError(path + ": is no H5MD file (it has no group h5md)");
    time_ = h5::read_real(file_.get(), "/particles/all/position/time", path, true).real;
    step_ = h5::read_whole(file_.get(), "/particles/all/position/step", path, true).whole;
    frames_ = std::min(time_.size(), step_.size());
    while (frames_ > 0 && std::isnan(time_[frames_ - 1]))
      --frames_;  // the writer was killed before it wrote the time, its last act
    whole_ = frames_;
    for (const char* group : {"particles/all", "particles/bodies"}) look_over(group);
  }

  /// Frames that every block read so far holds whole.
  [[nodiscard]] std::size_t whole() const { return whole_; }

  [[nodiscard]] std::size_t frames() const { return frames_; }
  [[nodiscard]] double time(std::size_t f) const { return time_[f]; }
  [[nodiscard]] long step(std::size_t f) const { return step_[f]; }
  [[nodiscard]] bool has(const std::string& element) const {
    return h5::has(file_.get(), "/" + element + "/value");
  }
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const {
    return h5::members(file_.get(), group);
  }

  /// Real values of an element, frames x rows x width flattened. The unit must be the contract's.
  h5::Block real(const std::string& element, std::size_t width, const std::string& unit) {
    const std::string value = "/" + element + "/value";
    h5::Block block = h5::read_real(file_.get(), value, path_, frames_ == 0);
    if (block.unit != unit)
      throw InputError(path_ + ": " + value + " is in \"" + block.unit + "\", expected \"" + unit + "\"");
    expect(block, width, value);
    block.real.resize(total(block), not_a_number);
    widen(element, block, block.real, not_a_number);
    expect_own_times(element);
    return block;
  }
  h5::Block whole(const std::string& element) {
    const std::string value = "/" + element + "/value";
    h5::Block block = h5::read_whole(file_.get(), value, path_, frames_ == 0);
    expect(block, 1, value);
    block.whole.resize(total(block), -1);
    widen(element, block, block.whole, -1);
    expect_own_times(element);
    return block;
  }

 private:
  static std::size_t total(const h5::Block& block) {
    return block.shape[0] * block.shape[1] * block.shape[2];
  }

  /// Blocks that a killed writer left torn are padded with a marker that is never a valid value. Their frames
  /// are cut off at the end.
  void expect(h5::Block& block, std::size_t width, const std::string& what) {
    if (block.shape.size() < 3) block.shape.resize(3, 1);
    whole_ = std::min(whole_, block.shape[0]);
    block.shape[0] = std::max(block.shape[0], frames_);
    if (block.shape[2] != width)
      throw InputError(path_ + ": " + what + " has " + std::to_string(block.shape[2]) +
                       " components, expected " + std::to_string(width));
  }

  /// How wide a group's columns are, and whether one of them holds more frames than there are times.
  void look_over(const std::string& group) {
    for (const std::string& name : h5::members(file_.get(), "/" + group)) {
      const std::string value = "/" + group + "/" + name + "/value";
      if (!h5::has(file_.get(), value)) continue;
      const std::vector<std::size_t> shape = h5::shape(file_.get(), value, path_);
      is_torn_ = is_torn_ || shape[0] > frames_;
      if (name != "box" && shape.size() > 1) rows_[group] = std::max(rows_[group], shape[1]);
    }
  }

  /// A writer makes the columns wider for particles born in its last frame. Where it was killed meanwhile,
  /// the columns that it had not come to are still narrow.
  template <class T>
  void widen(const std::string& element, h5::Block& block, std::vector<T>& values, T nothing) {
    const std::size_t rows = rows_[element.substr(0, element.rfind('/'))], row = block.shape[2];
    if (!is_torn_ || block.shape[1] >= rows) return;
    std::vector<T> wide(block.shape[0] * rows * row, nothing);
    for (std::size_t f = 0; f < block.shape[0]; ++f)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(f * block.shape[1] * row),
                  block.shape[1] * row, wide.begin() + static_cast<std::ptrdiff_t>(f * rows * row));
    values = std::move(wide);
    block.shape[1] = rows;
  }

  /// H5MD gives each element times of its own. An element without the times of the positions is not of these
  /// frames.
  void expect_own_times(const std::string& element) const {
    const std::string name = "/" + element + "/time";
    if (!h5::has(file_.get(), name) ||
        h5::is_linked_to_one(file_.get(), name, "/particles/all/position/time"))
      return;
    const std::vector<double> own = h5::read_real(file_.get(), name, path_, true).real;
    for (std::size_t f = 0; f < std::min(own.size(), frames_); ++f)
      if (own[f] != time_[f])
        throw InputError(path_ + ": " + element + " is of " + std::to_string(own[f]) + " s in frame " +
                         std::to_string(f) + ", and position of " + std::to_string(time_[f]) + " s");
  }

  std::string path_;
  h5::Handle file_;
  std::vector<double> time_;
  std::vector<int> step_;
  std::size_t frames_ = 0, whole_ = 0;
  bool is_torn_ = false;                     ///< a column holds more frames than there are times
  std::map<std::string, std::size_t> rows_;  ///< of each group's widest column
};

using Frames = std::vector<Snapshot>;

void read_vectors(Reader& in, const std::string& element, const std::string& unit, Frames& frames,
                  std::vector<Vec3> Snapshot::*column) {
  const h5::Block b = in.real(element, 3, unit);
  const std::size_t n = b.shape[1];
  for (std::size_t f = 0; f < frames.size(); ++f) {
    auto& out = frames[f].*column;
    out.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      out[i] = {b.real[(f * n + i) * 3], b.real[(f * n + i) * 3 + 1], b.real[(f * n + i) * 3 + 2]};
  }
}

void read_reals(Reader& in, const std::string& name, const std::string& unit, Frames& frames,
                std::vector<double> Snapshot::*column) {
  if (!in.has("particles/all/" + name)) return;
  const h5::Block b = in.real("particles/all/" + name, 1, unit);
  const auto n = static_cast<std::ptrdiff_t>(b.shape[1]);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto first = b.real.begin() + static_cast<std::ptrdiff_t>(f) * n;
    (frames[f].*column).assign(first, first + n);
  }
}

void read_wholes(Reader& in, const std::string& name, Frames& frames, std::vector<int> Snapshot::*column) {
  if (!in.has("particles/all/" + name)) return;
  const h5::Block b = in.whole("particles/all/" + name);
  const auto n = static_cast<std::ptrdiff_t>(b.shape[1]);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto first = b.whole.begin() + static_cast<std::ptrdiff_t>(f) * n;
    (frames[f].*column).assign(first, first + n);
  }
}

void read_bodies(Reader& in, Frames& frames) {
  if (!in.has("particles/bodies/position")) return;
  const auto vectors = [&](const char* name, const char* unit, Vec3 BodyState::*member, bool needed) {
    const std::string element = std::string("particles/bodies/") + name;
    if (!needed && !in.has(element)) {  // not shown is not zero
      for (auto& frame : frames)
        for (BodyState& b : frame.bodies) b.*member = {not_a_number, not_a_number, not_a_number};
      return;
    }
    const h5::Block b = in.real(element, 3, unit);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      if (frames[f].bodies.empty()) frames[f].bodies.resize(b.shape[1]);
      if (frames[f].bodies.size() != b.shape[1]) throw InputError("bodies: columns of unequal length");
      for (std::size_t i = 0; i < b.shape[1]; ++i) {
        const double* v = &b.real[(f * b.shape[1] + i) * 3];
        frames[f].bodies[i].*member = {v[0], v[1], v[2]};
      }
    }
  };
  vectors("position", "m", &BodyState::position, true);
  vectors("velocity", "m s-1", &BodyState::velocity, true);
  vectors("angular_velocity", "rad s-1", &BodyState::angular_velocity, true);
  vectors("force", "N", &BodyState::force, false);
  vectors("torque", "N m", &BodyState::torque, false);
  const h5::Block q = in.real("particles/bodies/orientation", 4, "1");
  const h5::Block m = in.real("particles/bodies/mass", 1, "kg");
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (q.shape[1] != frames[f].bodies.size() || m.shape[1] != q.shape[1])
      throw InputError("bodies: columns of unequal length");
    for (std::size_t i = 0; i < q.shape[1]; ++i) {
      const double* v = &q.real[(f * q.shape[1] + i) * 4];
      frames[f].bodies[i].orientation = {v[0], v[1], v[2], v[3]};
      frames[f].bodies[i].mass = m.real[f * q.shape[1] + i];
    }
  }
}

void read_observables(Reader& in, Frames& frames) {
  const auto numbers = [&](const std::string& name, const std::string& unit, auto&& put) {
    if (!in.has("observables/" + name)) return;
    const h5::Block b = in.real("observables/" + name, 1, unit);
    if (b.shape[1] == 0) throw InputError("observables/" + name + " has no components");
    for (std::size_t f = 0; f < frames.size(); ++f) put(frames[f], &b.real[f * b.shape[1]], b.shape[1]);
  };
  const auto three = [](const double* v, std::size_t n) {
    return n == 3 ? Vec3{v[0], v[1], v[2]} : Vec3{not_a_number, not_a_number, not_a_number};
  };
  numbers("mass", "kg", [](Snapshot& s, const double* v, std::size_t) { s.total_mass = *v; });
  numbers("momentum", "kg m s-1",
          [&](Snapshot& s, const double* v, std::size_t n) { s.momentum = three(v, n); });
  numbers("angular_momentum", "kg m2 s-1",
          [&](Snapshot& s, const double* v, std::size_t n) { s.angular_momentum = three(v, n); });
  const auto family = [&](const std::string& prefix, const std::string& unit,
                          std::map<std::string, double> Snapshot::*members) {
    for (const std::string& name : in.members("/observables"))
      if (name.rfind(prefix, 0) == 0)
        numbers(name, unit, [&](Snapshot& s, const double* v, std::size_t) {
          (s.*members)[name.substr(prefix.size())] = *v;
        });
  };
  family("energy_", "J", &Snapshot::energy);
  family("heat_", "J", &Snapshot::heat_given);
  family("count_", "1", &Snapshot::counts);
}

void expect_equal_lengths(const std::string& path, const Snapshot& s) {
  const std::size_t n = s.position.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == n; };
  if (!fits(s.velocity.size()) || !fits(s.temperature.size()) || !fits(s.temperature_error.size()) ||
      !fits(s.density.size()) || !fits(s.pressure.size()) || !fits(s.liquid_fraction.size()) ||
      !fits(s.id.size()) || !fits(s.phase.size()) || !fits(s.body.size()) || !fits(s.material.size()) ||
      !fits(s.mass.size()))
    throw InputError(path + ": columns of particles/all have unequal lengths");
}

}  // namespace

Trajectory read_trajectory(const std::string& path, std::size_t most_frames) {
  Reader in(path);
  if (in.frames() > most_frames)
    throw InputError(fmt::format("{}: has {} frames, more than the {} that it can need; refused", path,
                                 in.frames(), most_frames));
  Trajectory trajectory;
  Frames& frames = trajectory.frames;
  frames.resize(in.frames());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].time = in.time(f);
    frames[f].step = in.step(f);
  }
  read_vectors(in, "particles/all/position", "m", frames, &Snapshot::position);
  read_vectors(in, "particles/all/velocity", "m s-1", frames, &Snapshot::velocity);
  read_reals(in, "mass", "kg", frames, &Snapshot::mass);
  read_reals(in, "temperature", "K", frames, &Snapshot::temperature);
  read_reals(in, "temperature_error", "K", frames, &Snapshot::temperature_error);
  read_reals(in, "density", "kg m-3", frames, &Snapshot::density);
  read_reals(in, "pressure", "Pa", frames, &Snapshot::pressure);
  read_reals(in, "liquid_fraction", "1", frames, &Snapshot::liquid_fraction);
  read_wholes(in, "id", frames, &Snapshot::id);
  read_wholes(in, "phase", frames, &Snapshot::phase);
  read_wholes(in, "body", frames, &Snapshot::body);
  read_wholes(in, "material", frames, &Snapshot::material);
  read_bodies(in, frames);
  read_observables(in, frames);
  frames.resize(in.whole());
  for (const Snapshot& s : frames) expect_equal_lengths(path, s);
  return trajectory;
}

}  // namespace tripoint
