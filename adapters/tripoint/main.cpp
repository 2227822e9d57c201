// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/tripoint/tripoint_engine.hpp"

int main(int argc, char** argv) {
  return tripoint::serve(argc, argv, [] { return std::unique_ptr<tripoint::Engine>(new tripoint::TripointEngine); });
}
