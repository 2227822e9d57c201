// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <set>
#include <type_traits>

#include "core/errors.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

/// Shows each part of a snapshot to a visitor. A part more or less does not compile.
template <class Snapshot_, class Visit>
void each_part(Snapshot_& s, Visit&& visit) {
  auto& [time, step, position, velocity, temperature, temperature_error, density, pressure, liquid_fraction,
         id, phase, body, material, mass, bodies, total_mass, momentum, angular_momentum, energy, counts,
         heat_given, gauges] = s;
  const auto all = [&](auto&... part) { (visit(part), ...); };
  all(time, step, position, velocity, temperature, temperature_error, density, pressure, liquid_fraction, id,
      phase, body);
  all(material, mass, bodies, total_mass, momentum, angular_momentum, energy, counts, heat_given, gauges);
}

/// Puts the parts of a snapshot one after the other. @tparam Sink takes bytes: void(const void*, std::size_t)
template <class Sink>
class Packer {
 public:
  explicit Packer(Sink& sink) : sink_(sink) {}
  template <class T>
  void operator()(const T& value) {
    add(&value, sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& column) {
    (*this)(column.size());
    add(column.data(), column.size() * sizeof(T));
  }
  void operator()(const std::map<std::string, double>& named) {
    (*this)(named.size());
    for (const auto& [name, value] : named) {
      (*this)(name.size());
      add(name.data(), name.size());
      (*this)(value);
    }
  }

 private:
  void add(const void* from, std::size_t size) { sink_(from, size); }
  Sink& sink_;
};

template <class Sink>
void pack(const Trajectory& trajectory, Sink sink) {
  Packer<Sink> packer(sink);
  packer(trajectory.frames.size());
  for (const Snapshot& s : trajectory.frames) each_part(s, packer);
}

/// Takes no size on trust. An item that claims more than the remaining bytes is refused before memory is
/// asked for.
class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    take(&value, sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& column) {
    static_assert(std::is_trivially_copyable_v<T>);
    column.resize(count(sizeof(T)));
    take(column.data(), column.size() * sizeof(T));
  }
  void operator()(std::map<std::string, double>& named) {
    for (std::size_t left = count(sizeof(std::size_t) + sizeof(double)); left > 0; --left) {
      std::string name(count(1), '\0');
      take(name.data(), name.size());
      (*this)(named[name]);
    }
  }
  [[nodiscard]] std::size_t count(std::size_t size_of_one) {
    std::size_t n = 0;
    (*this)(n);
    if (n > (bytes_.size() - at_) / size_of_one) refuse();
    return n;
  }
  void expect_end() const {
    if (at_ != bytes_.size()) refuse();
  }

 private:
  [[noreturn]] static void refuse() {
    throw InputError("the reader of a trajectory handed back what is none");
  }
  void take(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) refuse();
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// @throws InputError where a column of particles is neither empty nor as long as the longest
void expect_equal_columns(const Snapshot& s) {
  std::set<std::size_t> lengths{s.position.size(), s.velocity.size()};
  for (const auto* column :
       {&s.temperature, &s.temperature_error, &s.density, &s.pressure, &s.liquid_fraction, &s.mass})
    lengths.insert(column->size());
  for (const auto* column : {&s.id, &s.phase, &s.body, &s.material}) lengths.insert(column->size());
  lengths.erase(0);
  if (lengths.size() > 1)
    throw InputError("the reader of a trajectory handed back columns of unequal length");
}

}  // namespace

std::string packed(const Trajectory& trajectory) {
  std::size_t total = 0;
  pack(trajectory, [&](const void*, std::size_t size) { total += size; });
  std::string bytes;
  bytes.reserve(total);  // a string that grows is in memory twice
  pack(trajectory,
       [&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); });
  return bytes;
}

Trajectory unpacked(const std::string& bytes, std::size_t most_frames) {
  Unpacker unpack(bytes);
  const std::size_t frames = unpack.count(1);
  if (frames > most_frames)
    throw InputError("the reader of a trajectory handed back more frames than there can be");
  Trajectory trajectory;
  trajectory.frames.resize(frames);
  for (Snapshot& s : trajectory.frames) each_part(s, unpack);
  unpack.expect_end();
  for (const Snapshot& s : trajectory.frames) expect_equal_columns(s);
  return trajectory;
}

}  // namespace tripoint
