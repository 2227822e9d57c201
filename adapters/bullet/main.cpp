// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/bullet_engine.hpp"

int main(int argc, char** argv) {
  return tripoint::serve(
      argc, argv, [] { return std::unique_ptr<tripoint::Engine>(new tripoint::bullet::BulletEngine); });
}
