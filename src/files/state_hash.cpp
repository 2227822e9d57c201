// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "files/trajectory.hpp"

namespace tripoint {
namespace {

class Fnv {
 public:
  explicit Fnv(std::uint64_t start = 1469598103934665603ULL) : hash_(start) {}
  void add(double v) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    for (int k = 0; k < 8; ++k) hash_ = (hash_ ^ ((bits >> (8 * k)) & 0xffU)) * 1099511628211ULL;
  }
  void add(const Vec3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_;
};

}  // namespace

void FramesHash::add(const Snapshot& s) {
  Fnv hash(hash_);
  hash.add(s.time);
  hash.add(static_cast<double>(s.step));
  const auto exists = [&](std::size_t i) { return s.id.empty() || s.id[i] >= 0; };
  const auto add_column = [&](const auto& column) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!exists(i)) continue;
      if constexpr (std::is_same_v<decltype(column[i]), const int&>)
        hash.add(static_cast<double>(column[i]));
      else
        hash.add(column[i]);
    }
  };
  add_column(s.position);
  add_column(s.velocity);
  add_column(s.mass);
  for (const auto* column :
       {&s.temperature, &s.temperature_error, &s.density, &s.pressure, &s.liquid_fraction})
    add_column(*column);
  for (const auto* column : {&s.id, &s.phase, &s.body, &s.material}) add_column(*column);
  for (const BodyState& b : s.bodies) {
    if (std::isnan(b.mass)) continue;
    for (const Vec3& v : {b.position, b.velocity, b.angular_velocity, b.force, b.torque}) hash.add(v);
    for (const double q : {b.orientation.w, b.orientation.x, b.orientation.y, b.orientation.z, b.mass})
      hash.add(q);
  }
  hash.add(s.total_mass);
  hash.add(s.momentum);
  hash.add(s.angular_momentum);
  for (const auto& [term, joule] : s.energy) hash.add(joule);
  for (const auto& [body, joule] : s.heat_given) hash.add(joule);
  for (const auto& [name, value] : s.gauges) hash.add(value);
  hash_ = hash.value();
}

std::string state_hash(const InitialState& s) {
  Fnv hash;
  for (const auto* column : {&s.position, &s.velocity})
    for (const Vec3& v : *column) hash.add(v);
  for (const auto* column : {&s.mass, &s.temperature})
    for (const double v : *column) hash.add(v);
  for (const auto* column : {&s.phase, &s.body, &s.material, &s.source})
    for (const int v : *column) hash.add(static_cast<double>(v));
  return hash.text();
}

std::string FramesHash::text() const { return fmt::format("{:016x}", hash_); }

std::string state_hash(const Snapshot& s) {
  Fnv hash;
  hash.add(s.time);
  for (const Vec3& r : s.position) hash.add(r);
  for (const Vec3& v : s.velocity) hash.add(v);
  for (const double T : s.temperature) hash.add(T);
  for (const auto& [name, value] : s.gauges) hash.add(value);
  for (const BodyState& b : s.bodies) {
    hash.add(b.position);
    hash.add(b.velocity);
    hash.add(b.angular_velocity);
    hash.add(b.mass);
    hash.add(b.orientation.w);
    hash.add(b.orientation.x);
    hash.add(b.orientation.y);
    hash.add(b.orientation.z);
  }
  return hash.text();
}

}  // namespace tripoint
