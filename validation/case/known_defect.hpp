// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace tripoint {

struct Gate;

/// NAME, one word, of a gate whose reason begins "known defect NAME:": a defect of the engine that its band
/// measures. The engine is then excused from the limit that any engine must hold on this metric, and must
/// exceed it. Empty = the gate declares none.
[[nodiscard]] std::string known_defect(const Gate&);

/// The same, or "printed-form" of a gate whose reason begins "predicted defect".
[[nodiscard]] std::string declared_defect(const Gate&);

}  // namespace tripoint
