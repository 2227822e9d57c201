// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene.hpp"
#include "tables/record.hpp"

/// The keys of shapes, and of fields of temperature and velocity, each beside the member that keeps it.
namespace tripoint {
namespace records {
using enum ValueType;
using enum Range;

/// The key of each finite kind that turns the shape.
constexpr Kept<Shape, Quaternion> turned(std::string_view kind) {
  return kept(&Shape::rotation,
              {kind, "rotation", numbers, "", any, "", "not turned", "",
               "rotation (w, x, y, z) about the centre of the shape's bounding box"},
              {.later = true});
}

inline constexpr auto of_shape = std::make_tuple(
    kind_record(Shape::Kind::box, "box",
                kept(&Shape::min, {"shape.box", "min", vector, "m", any, "!", "", "", "lower corner"}),
                kept(&Shape::max, {"shape.box", "max", vector, "m", any, "!", "", "", "upper corner"}),
                turned("shape.box")),
    kind_record(
        Shape::Kind::sphere, "sphere",
        kept(&Shape::centre, {"shape.sphere", "centre", vector, "m", any, "!", "", "", "centre"}),
        kept(&Shape::radius, {"shape.sphere", "radius", number, "m", positive, "!", "", "", "radius"})),
    kind_record(
        Shape::Kind::cylinder, "cylinder",
        kept(&Shape::base, {"shape.cylinder", "base", vector, "m", any, "!", "", "", "centre of the base"}),
        kept(&Shape::axis, {"shape.cylinder", "axis", vector, "", any, "[0, 0, 1]", "upright", "",
                            "direction of the axis, from the base on, of any length"}),
        kept(&Shape::length,
             {"shape.cylinder", "length", number, "m", positive, "!", "", "", "length along the axis"}),
        kept(&Shape::radius, {"shape.cylinder", "radius", number, "m", positive, "!", "", "", "radius"}),
        turned("shape.cylinder")),
    kind_record(Shape::Kind::half_space, "half_space",
                kept(&Shape::point,
                     {"shape.half_space", "point", vector, "m", any, "!", "", "", "a point of the plane"}),
                kept(&Shape::normal, {"shape.half_space", "normal", vector, "", any, "!", "", "",
                                      "outward normal of the plane, of any length"})),
    kind_record(Shape::Kind::unite, "union",
                Key{"shape.union", "of", tables, "", any, "!", "", "shape", "shapes to unite, at least one"},
                turned("shape.union")),
    kind_record(Shape::Kind::difference, "difference",
                Key{"shape.difference", "from", shape, "", any, "!", "", "", "shape that is cut"},
                Key{"shape.difference", "minus", shape, "", any, "!", "", "", "shape that is removed"},
                turned("shape.difference")),
    kind_record(Shape::Kind::mesh, "mesh",
                kept(&Shape::file, {"shape.mesh", "file", text, "", any, "!", "", "",
                                    "closed triangle mesh, .obj or .stl, beside the case"}),
                kept(&Shape::scale, {"shape.mesh", "scale", number, "", positive, "1",
                                     "the mesh is in metres", "", "factor to metres"}),
                turned("shape.mesh")));

inline constexpr auto of_temperature = std::make_tuple(
    kind_record(TemperatureField::Kind::constant, "constant"),
    kind_record(
        TemperatureField::Kind::cosine, "cosine",
        kept(&TemperatureField::mean, {"temperature.cosine", "mean", number, "K", any, "!", "", "", "mean"}),
        kept(&TemperatureField::amplitude,
             {"temperature.cosine", "amplitude", number, "K", any, "!", "", "", "amplitude"}),
        kept(&TemperatureField::wave_vector, {"temperature.cosine", "wave_vector", vector, "rad/m", any, "!",
                                              "", "", "2 pi over wavelength, by direction"}),
        kept(&TemperatureField::phase, {"temperature.cosine", "phase", number, "rad", any, "0",
                                        "greatest at the origin", "", "mean + amplitude cos(k.r + phase)"})),
    kind_record(TemperatureField::Kind::step, "step",
                kept(&TemperatureField::point, {"temperature.step", "point", vector, "m", any, "!", "", "",
                                                "a point of the plane of the step"}),
                kept(&TemperatureField::normal, {"temperature.step", "normal", vector, "", any, "!", "", "",
                                                 "normal of the plane, from behind to ahead, of any length"}),
                kept(&TemperatureField::behind, {"temperature.step", "behind", number, "K", positive, "!", "",
                                                 "", "temperature where (r - point).normal < 0"}),
                kept(&TemperatureField::ahead,
                     {"temperature.step", "ahead", number, "K", positive, "!", "", "", "elsewhere"})),
    kind_record(
        TemperatureField::Kind::expression, "expression",
        kept(&TemperatureField::expression,
             {"temperature.expression", "value", text, "", any, "!", "", "",
              "formula of x, y, z in m, with `+ - * / ^ ( )`, `pi` and `sum(n, 1, 40, f)`. Functions: "
              "`sin cos tan exp log sqrt abs erf erfc sinh cosh tanh min max`"})));

inline constexpr auto of_velocity = std::make_tuple(
    kind_record(VelocityField::Kind::constant, "constant"),
    kind_record(
        VelocityField::Kind::cosine, "cosine",
        kept(&VelocityField::mean,
             {"velocity.cosine", "mean", vector, "m/s", any, "[0, 0, 0]", "a wave alone", "", "mean"}),
        kept(&VelocityField::amplitude,
             {"velocity.cosine", "amplitude", vector, "m/s", any, "!", "", "", "amplitude"}),
        kept(&VelocityField::wave_vector, {"velocity.cosine", "wave_vector", vector, "rad/m", any, "!", "",
                                           "", "2 pi over wavelength, by direction"}),
        kept(&VelocityField::phase, {"velocity.cosine", "phase", number, "rad", any, "0",
                                     "greatest at the origin", "", "mean + amplitude cos(k.r + phase)"})),
    kind_record(VelocityField::Kind::linear, "linear",
                kept(&VelocityField::centre, {"velocity.linear", "centre", vector, "m", any, "[0, 0, 0]",
                                              "the origin", "", "point where the velocity is zero"}),
                kept(&VelocityField::gradient, {"velocity.linear", "gradient", tables, "1/s", any, "!", "",
                                                "", "three rows of three: row i gives component i"})),
    kind_record(
        VelocityField::Kind::taylor_green, "taylor_green",
        kept(&VelocityField::speed,
             {"velocity.taylor_green", "speed", number, "m/s", positive, "!", "", "", "greatest speed"}),
        kept(&VelocityField::wavelength, {"velocity.taylor_green", "wavelength", number, "m", positive, "!",
                                          "", "", "side of the periodic cell in x and y"})),
    kind_record(VelocityField::Kind::expression, "expression",
                kept(&VelocityField::expression, {"velocity.expression", "value", texts, "", any, "!", "", "",
                                                  "three expressions of x, y, z in m"})));

}  // namespace records

template <>
inline constexpr auto kinds<Shape> = records::of_shape;
template <>
inline constexpr auto kinds<TemperatureField> = records::of_temperature;
template <>
inline constexpr auto kinds<VelocityField> = records::of_velocity;

}  // namespace tripoint
