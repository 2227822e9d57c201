// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace tripoint {

/// Two layers in perfect contact, each uniform at the start, ends insulated.
struct TwoLayers {
  double interface = 0.0;                                ///< place of the contact [m]
  double length_low = 0.0, length_high = 0.0;            ///< thickness of each layer [m]
  double diffusivity_low = 0.0, diffusivity_high = 0.0;  ///< [m2/s]
  double effusivity_low = 0.0, effusivity_high = 0.0;    ///< sqrt(k rho c_p) [W s^0.5/m2/K]
  double start_low = 0.0, start_high = 0.0;              ///< [K]
};

/// Temperature of two layers, by whichever of the two exact forms converges. While both fronts are further
/// than 6 sqrt(4 D t) from their ends, it is that of half spaces in contact. They have the contact
/// temperature (e1 T1 + e2 T2)/(e1 + e2) and erfc profiles. Later it is a sum of eigenfunctions.
class TwoLayerSolution {
 public:
  explicit TwoLayerSolution(const TwoLayers&);
  [[nodiscard]] double at(double x, double time) const;

  /// The two forms by themselves, for the check of one by the other where both hold.
  [[nodiscard]] double half_spaces(double x, double time) const;
  /// Series over the modes cos(w x1/sqrt D1), cos(w x2/sqrt D2), x1, x2 counted from the ends. The
  /// frequencies w [1/sqrt s] are the roots of e1 sin p cos q + e2 cos p sin q = 0. p = w L1/sqrt D1, q = w
  /// L2/sqrt D2. There is one in each ((n - 1/2) pi, (n
  /// + 1/2) pi) of p + q. Enough modes are kept for a quarter of the time from which at() uses them.
  [[nodiscard]] double series(double x, double time) const;

 private:
  struct Mode {
    double w, low, high;  ///< frequency [1/sqrt s], weight of either side's cosine in the solution [K]
  };
  [[nodiscard]] Mode mode(int n) const;
  TwoLayers s_;
  double reach_low_, reach_high_;  ///< L/sqrt D of each layer [sqrt s]
  double mean_, switch_time_;
  std::vector<Mode> modes_;
};

}  // namespace tripoint
