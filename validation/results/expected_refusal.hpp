// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/results/results.hpp"

namespace tripoint {

/// The harness's own setting in which a case keeps `refuses` of an engine; no job has it.
inline constexpr const char* refuses_setting = "refuses";

/// Words that the engine's refusal must have, as `refuses` of [engines.NAME] states them. Empty = the case
/// declares no refusal.
[[nodiscard]] std::string declared_refusal(const Settings&);

/// Whether the engine refused the case for the declared reason.
[[nodiscard]] bool refuses_as_expected(const EngineRow&);

/// Fault of a declared refusal: the engine ran, or refused for another reason. Empty where it holds, where
/// none is declared and where the engine is not here.
[[nodiscard]] std::string broken_refusal(const EngineRow&);

}  // namespace tripoint
