// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "io/trajectory.hpp"

namespace tripoint {
namespace {

class Fnv {
 public:
  void add(double v) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    for (int k = 0; k < 8; ++k) hash_ = (hash_ ^ ((bits >> (8 * k)) & 0xffU)) * 1099511628211ULL;
  }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 1469598103934665603ULL;
};

}  // namespace

std::string state_hash(const Snapshot& s) {
  Fnv hash;
  hash.add(s.time);
  for (const Vec3& r : s.position) hash.add(r);
  for (const Vec3& v : s.velocity) hash.add(v);
  for (const double T : s.temperature) hash.add(T);
  for (const BodyState& b : s.bodies) {
    hash.add(b.position), hash.add(b.velocity), hash.add(b.angular_velocity), hash.add(b.mass);
    hash.add(b.orientation.w), hash.add(b.orientation.x), hash.add(b.orientation.y), hash.add(b.orientation.z);
  }
  return hash.text();
}

}  // namespace tripoint
