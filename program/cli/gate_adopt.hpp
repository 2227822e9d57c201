// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace tripoint {

/// Adds `gate adopt`. @return the subcommand, so that `gate` sees whether it was called
CLI::App* add_gate_adopt(CLI::App& gate, int& exit_code);

}  // namespace tripoint
