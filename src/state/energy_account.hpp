// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/field.hpp"
#include "core/vec3.hpp"

/// Energies that a run sums as it goes. Accounts are typed keys, as fields are: an effect declares its own in
/// its folder.
namespace tripoint {

/// A sum of energy over the run [J]: the work of a force, energy that an event has let go, energy stored at
/// time 0.
struct EnergyAccount {
  std::string_view name;
  std::uint64_t key = key_of(name);
  bool operator==(const EnergyAccount& other) const noexcept { return key == other.key; }
};

/// Energy accounts that every scene has, since several effects accumulate on them.
namespace account {
inline constexpr EnergyAccount gravity_work{"gravity_work"};  ///< done by gravity on liquids and free bodies
inline constexpr EnergyAccount start_potential{"start_potential"};
/// Change of the potential energy of driven bodies
inline constexpr EnergyAccount driven_potential{"driven_potential"};
/// Change of kinetic energy by the free rotation of bodies, which a scheme does not keep exactly
inline constexpr EnergyAccount rotation_drift{"rotation_drift"};
/// Elastic and hourglass energy that events turned into heat, plastic or fracture entries
inline constexpr EnergyAccount deformation_released{"deformation_released"};
inline constexpr EnergyAccount inflow{"inflow"};    ///< kinetic, potential and thermal energy that flowed in
inline constexpr EnergyAccount outflow{"outflow"};  ///< the same that flowed out
inline constexpr EnergyAccount merging{"merging"};  ///< kinetic energy lost as bodies became one
inline constexpr EnergyAccount walls{"walls"};  ///< taken by bodies held, fixed or prescribed from outside
}  // namespace account

/// An energy account that no effect of this scene has declared: a fault of the program, so it
/// says the energy account by name.
class MissingEnergyAccount : public std::logic_error {
 public:
  explicit MissingEnergyAccount(std::string_view name)
      : std::logic_error("no effect of this scene has declared the energy account " + std::string(name)) {}
};

/// The energy accounts of a scene and what stands on them.
class EnergyAccounts {
 public:
  EnergyAccounts();
  /// Adds an energy account at 0; one that is there stays as it is.
  void open(const EnergyAccount&);
  [[nodiscard]] bool has(const EnergyAccount& a) const noexcept { return find(a.key) >= 0; }
  /// [J] @throws MissingEnergyAccount
  [[nodiscard]] double& operator[](const EnergyAccount& a) { return values_[place(a)]; }
  [[nodiscard]] double operator[](const EnergyAccount& a) const { return values_[place(a)]; }

  /// In the order in which they were opened.
  [[nodiscard]] std::span<const std::string_view> names() const noexcept { return names_; }
  [[nodiscard]] std::span<const double> values() const noexcept { return values_; }
  [[nodiscard]] std::span<double> values() noexcept { return values_; }

  /// Nothing stands on any energy account.
  void clear() {
    values_.assign(values_.size(), 0.0);
    undelivered_spin = {};
  }

  Vec3 undelivered_spin;  ///< angular momentum about truncated axes that a split could not hand on [kg m2/s]

 private:
  /// Several times as many as there are energy accounts: few keys share a place
  static constexpr std::size_t places = 128;
  [[nodiscard]] int find(std::uint64_t key) const noexcept {
    for (std::size_t s = key % places;; s = (s + 1) % places) {
      if (number_[s] == 0) return -1;
      if (keys_[number_[s] - 1u] == key) return number_[s] - 1;
    }
  }
  [[nodiscard]] std::size_t place(const EnergyAccount& a) const {
    const int n = find(a.key);
    if (n < 0) throw MissingEnergyAccount(a.name);
    return static_cast<std::size_t>(n);
  }

  std::vector<std::string_view> names_;
  std::vector<std::uint64_t> keys_;
  std::vector<double> values_;
  /// Open addressing: 1 + the energy account whose key has, or shares, this place
  std::array<std::uint8_t, places> number_{};
};

}  // namespace tripoint
