// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/region.hpp"

#include <algorithm>

namespace tripoint {

bool inside(const Shape& shape, const Vec3& r) {
  const auto in = [&](const Shape& s) { return inside(s, r); };
  switch (shape.kind) {
    case Shape::Kind::box:
      return r.x >= shape.min.x && r.y >= shape.min.y && r.z >= shape.min.z && r.x <= shape.max.x &&
             r.y <= shape.max.y && r.z <= shape.max.z;
    case Shape::Kind::sphere:
      return norm(r - shape.centre) <= shape.radius;
    case Shape::Kind::cylinder: {
      const double along = dot(r - shape.base, shape.axis) / norm(shape.axis);
      const Vec3 across = (r - shape.base) - (along / norm(shape.axis)) * shape.axis;
      return along >= 0.0 && along <= shape.length && norm(across) <= shape.radius;
    }
    case Shape::Kind::half_space:
      return dot(r - shape.point, shape.normal) <= 0.0;
    case Shape::Kind::unite:
      return std::any_of(shape.of.begin(), shape.of.end(), in);
    case Shape::Kind::difference:
      return in(shape.of.at(0)) && std::none_of(shape.of.begin() + 1, shape.of.end(), in);
    case Shape::Kind::mesh:
      break;
  }
  throw InputError(
      "the region of an event with an exact solution cannot be a mesh: use a box, sphere, cylinder or half "
      "space");
}

}  // namespace tripoint
