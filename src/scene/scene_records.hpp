// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/guard_name.hpp"
#include "scene/scene.hpp"
#include "tables/record.hpp"

/// The keys of [scene], materials, bodies, events and inflows, each beside the member that keeps it. Effects
/// bring more (effect_rule.hpp).
namespace tripoint {
namespace records {
using enum ValueType;
using enum Range;

inline constexpr auto of_scene = std::make_tuple(
    kept(&Scene::end_time, {"scene", "end_time", number, "s", positive, "!", "", "", "simulated time"}),
    kept(&Scene::gravity,
         {"scene", "gravity", vector, "m/s2", any, "[0, 0, 0]", "free space: a case says when bodies fall",
          "", "acceleration of every free particle"}),
    kept(&Scene::dimensions,
         {"scene", "dimensions", integer, "", positive, "3", "matter fills space", "",
          "2: one layer of particles in the plane of x and z. Shapes lose their y, and masses and forces are "
          "those of a layer 1 m deep"},
         {.later = true}),
    kept(&Scene::plane_stress,
         {"scene", "plane", word, "", any, "\"strain\"", "held", "strain stress",
          "elastic solids in two dimensions: held across the plane, or free as sheets are"},
         {.yes = "stress", .later = true}),
    kept(&Scene::spacing,
         {"scene", "spacing", number, "m", positive, "=", "a tenth of the smallest extent of a body", "",
          "distance dx of the particles, the same in the whole scene"}),
    kept(&Scene::support_ratio, {"scene", "support_ratio", number, "", above_one, "=",
                                 "2.12 where every term is paper, else 2.6 (about 40 and 74 neighbours)", "",
                                 "support radius of the kernel divided by the spacing, h/dx"}),
    kept(&Scene::mode, {"scene", "mode", word, "", any, "\"corrected\"", "the best known form of each term",
                        "corrected paper", "form of every term of the model"}),
    Key{"scene", "modes", table, "", any, "=", "every term as `mode` says", "modes",
        "form of single terms of the model", true},
    Key{"scene", "clamp", flag, "", any, "=", "as model.clamp says", "", "no negative pressure", true},
    kept(&Scene::time_step, {"scene", "time_step", number_or_auto, "s", positive, "\"auto\"",
                             "the least bound of the effects that are on", "", "time step, or \"auto\""}),
    kept(&Scene::seed, {"scene", "seed", integer, "", not_negative, "1",
                        "any number serves; kept so that runs repeat", "", "seed of jitter and walkers"}),
    kept(&Scene::jitter,
         {"scene", "jitter", number, "", fraction, "0", "an undisturbed lattice", "",
          "random shift of each particle, uniform in +-jitter in each direction, in spacings"}),
    kept(&Scene::min, {"scene", "min", vector, "m", any, "", "no bounds: no direction is periodic", "",
                       "lower corner of the domain"}),
    kept(&Scene::max, {"scene", "max", vector, "m", any, "", "no bounds: no direction is periodic", "",
                       "upper corner of the domain"}),
    kept(&Scene::periodic, {"scene", "periodic", words, "", any, "[]", "open in every direction", "x y z",
                            "periodic directions of the domain"}),
    kept(&Scene::output_interval, {"scene", "output_interval", number, "s", positive, "=",
                                   "a twentieth of end_time", "", "time between frames"}),
    kept(&Scene::settle, {"scene", "settle", flag, "", any, "false", "liquids start on a lattice", "",
                          "liquids settle under gravity before time 0, between solids at rest"}),
    kept(&Scene::merge_distance,
         {"scene", "merge_distance", number, "", positive, "=",
          "1.5, nearest and diagonal neighbours of the lattice; where phase is paper 2.12, the reach of its "
          "bonds",
          "", "distance within which a freezing particle joins, in spacings"},
         {.later = true}),
    kept(&Scene::contact,
         {"scene", "contact", word, "", any, "\"auto\"", "solids meet wherever their paths can cross",
          "auto none", "none: solids pass through each other; not in a scene with liquid"},
         {.yes = "auto"}),
    kept(&Scene::recovers,
         {"scene", "on_failure", word, "", any, "\"stop\"", "a run that has gone wrong is no result",
          "stop recover",
          "action of a guard that trips. stop: exit code 7. recover: back to the last good state and on with "
          "half the step"},
         {.yes = "recover"}),
    kept(&Scene::removes_escaped,
         {"scene", "on_escape", word, "", any, "\"stop\"", "what leaves the domain is a fault of the run",
          "stop remove",
          "where a particle leaves min..max. stop: the guard escape trips. remove: liquid is dropped and "
          "counted (model 8.14); of a solid the guard trips"},
         {.yes = "remove", .later = true}),
    kept(&Scene::unguarded,
         {"scene", "unguarded", words, "", any, "[]", "every guard is on", words_of_optional_guards,
          "guards that are off: det F <= 0, more than two coinciding layers, a particle outside min..max, "
          "energy of the scheme, a collapsing time step"}));

inline constexpr auto of_material = std::make_tuple(
    kept(&Material::name, {"material", "name", text, "", any, "!", "", "",
                           "its name; a name of the library brings values, which keys here replace"}),
    kept(&Material::density, {"material", "density", number, "kg/m3", positive, "!", "", "",
                              "rest density, one for both phases"}),
    kept(&Material::solid,
         {"material", "solid", word, "", any, "=", "elastic where young_modulus is given, else rigid",
          "elastic rigid", "kind of the solid"},
         {.later = true}),
    Key{"material", "source", text, "", any, "", "the case's own values", "", "where the values come from"});

inline constexpr auto of_body = std::make_tuple(
    kept(&Body::name, {"body", "name", text, "", any, "!", "", "", "name of the body"}),
    kept(&Body::material, {"body", "material", text, "", any, "!", "", "",
                           "name of a [[material]], or of one of the library"}),
    kept(&Body::phase, {"body", "phase", word, "", any, "=", "from the material and the temperature",
                        "liquid elastic rigid", "phase at the start"}),
    kept(&Body::shape, {"body", "shape", shape, "", any, "!", "", "", "region that the body fills"}),
    Key{"body", "rotation", numbers, "", any, "", "not turned", "",
        "turns shape and particles at the start: (w, x, y, z) about the centre of the shape's bounding box"},
    kept(&Body::velocity,
         {"body", "velocity", velocity, "m/s", any, "[0, 0, 0]", "at rest", "",
          "velocity at the start; of a prescribed body constant for ever"},
         {.in_job = "velocity_field"}),
    kept(&Body::angular_velocity,
         {"body", "angular_velocity", vector, "rad/s", any, "[0, 0, 0]", "no spin", "",
          "angular velocity at the start about the centre of mass, in the world frame; for liquids too"}),
    kept(&Body::temperature, {"body", "temperature", temperature, "K", positive, "",
                              "its heat is not followed", "", "temperature at the start"}),
    kept(&Body::temperature_held,
         {"body", "temperature_held", flag, "", any, "false", "free to warm and cool", "",
          "true: the temperature of the body never changes"}),
    kept(&Body::motion,
         {"body", "motion", word, "", any, "\"free\"", "bodies move by their forces", "free fixed prescribed",
          "free: moved by forces; fixed: at rest; prescribed: moved by keyframes or constant velocities"}),
    kept(&Body::keyframes,
         {"body", "keyframes", tables, "", any, "[]", "prescribed: constant velocity and angular_velocity",
          "keyframe", "motion of a prescribed body"}),
    kept(&Body::free_slip,
         {"body", "slip", word, "", any, "\"no\"", "liquid sticks to solids", "no free",
          "no: liquid sticks to the body; free: liquid glides along it"},
         {.yes = "free"}),
    kept(&Body::jitters, {"body", "jitters", flag, "", any, "true", "as scene.jitter says", "",
                          "false: scene.jitter does not shift its particles; smooth walls cost less"}),
    kept(&Body::joins, {"body", "joins", flag, "", any, "=", "true where the material melts", "",
                        "true: matter that freezes in contact with the body joins it"}),
    kept(&Body::joined_to, {"body", "joined_to", texts, "", any, "[]", "bonded to nothing", "",
                            "bodies that the body is bonded to from the start"}),
    kept(&Body::mass,
         {"body", "mass", number, "kg", positive, "", "that of its particles", "",
          "mass of a rigid body, by the masses of its particles; not in a scene with liquid"},
         {.in_job = "given_mass", .later = true}),
    kept(&Body::centre,
         {"body", "centre", vector, "m", any, "", "that of its particles", "",
          "its centre of mass at the start, the same way"},
         {.in_job = "given_centre", .later = true}),
    kept(&Body::inertia,
         {"body", "inertia", vector, "kg m2", any, "", "that of its particles", "",
          "its moments xx, yy, zz about that centre at the start, the same way"},
         {.in_job = "given_inertia", .later = true}),
    kept(&Body::products,
         {"body", "products", vector, "kg m2", any, "[0, 0, 0]", "x, y and z are principal axes", "",
          "xy, xz, yz of the tensor whose diagonal is `inertia`"},
         {.later = true}),
    kept(&Body::shape_mass,
         {"body", "shape_mass", flag, "", any, "false", "each particle weighs density times spacing cubed",
          "", "true: the particles of a rigid body have the mass, centre and moments of its shape"},
         {.later = true}));

inline constexpr auto of_keyframe = std::make_tuple(
    kept(&Keyframe::time, {"keyframe", "time", number, "s", not_negative, "!", "", "",
                           "time of the keyframe; keyframes are in rising order"}),
    kept(&Keyframe::position, {"keyframe", "position", vector, "m", any, "!", "", "",
                               "position of the centre of mass; linear between keyframes"}),
    kept(&Keyframe::rotation,
         {"keyframe", "rotation", numbers, "", any, "[1, 0, 0, 0]", "not turned", "",
          "rotation (w, x, y, z) since the start; slerp, less than half a turn between keyframes"}));

inline constexpr auto of_event = std::make_tuple(
    kept(&Event::time,
         {"event", "time", number, "s", not_negative, "!", "", "", "time at which the event begins"}),
    kept(&Event::kind,
         {"event", "kind", word, "", any, "!", "", "merge split release heat hold grip",
          "`merge`: bodies[0] absorbs the rest. `split`: members in region become body `name`. `heat`: holds "
          "`temperature` until "
          "`until`. `hold`: pauses bodies. `grip`: moves solids in region by keyframes until release"}),
    kept(&Event::name,
         {"event", "name", text, "", any, "=", "none", "", "name of the new body, or of the grip"}),
    kept(&Event::bodies,
         {"event", "bodies", texts, "", any, "[]", "all in the region", "", "bodies that the event acts on"}),
    kept(&Event::region,
         {"event", "region", shape, "", any, "", "everywhere", "", "region that the event acts in"}),
    kept(&Event::temperature,
         {"event", "temperature", number, "K", positive, "", "none", "", "temperature that is held"}),
    kept(&Event::until,
         {"event", "until", number, "s", positive, "", "to the end", "", "time at which the event ends"}),
    kept(&Event::keyframes,
         {"event", "keyframes", tables, "", any, "[]", "none", "keyframe", "motion of the grip"}));

inline constexpr auto of_inflow = std::make_tuple(
    kept(&Inflow::material,
         {"inflow", "material", text, "", any, "!", "", "", "name of the material that flows in"}),
    kept(&Inflow::shape, {"inflow", "shape", shape, "", any, "!", "", "", "region through which it enters"}),
    kept(&Inflow::velocity, {"inflow", "velocity", vector, "m/s", any, "!", "", "",
                             "velocity of the liquid that enters, along an axis"}),
    kept(&Inflow::temperature, {"inflow", "temperature", number, "K", positive, "",
                                "its heat is not followed", "", "temperature of the liquid that enters"}),
    kept(&Inflow::start, {"inflow", "start", number, "s", not_negative, "0", "from the start", "",
                          "time at which the inflow begins"}),
    kept(&Inflow::stop,
         {"inflow", "stop", number, "s", positive, "=", "end_time", "", "time at which the inflow ends"}),
    kept(&Inflow::rate, {"inflow", "rate", number, "m3/s", positive, "", "by the speed", "",
                         "volume per second; replaces the magnitude of velocity"}),
    kept(&Inflow::profile,
         {"inflow", "profile", text, "", any, "\"\"", "the same velocity everywhere", "",
          "formula of x, y, z: factor on velocity, 0 to 1"},
         {.later = true}),
    kept(&Inflow::ramp,
         {"inflow", "ramp", number, "s", not_negative, "0", "full velocity from the start", "",
          "time in which the velocity grows from 0"},
         {.later = true}));

inline constexpr auto of_outflow = std::make_tuple(kept(
    &Outflow::shape, {"outflow", "shape", shape, "", any, "!", "", "", "region in which liquid is removed"}));

inline constexpr auto of_contact_law = std::make_tuple(
    kept(&ContactLaw::materials,
         {"contact", "materials", texts, "", any, "!", "", "", "the two materials that meet"}),
    kept(&ContactLaw::friction, {"contact", "friction", number, "", not_negative, "", "none", "",
                                 "Coulomb's coefficient of friction"}),
    kept(&ContactLaw::restitution, {"contact", "restitution", number, "", fraction, "", "none", "",
                                    "normal speed after a hit divided by the speed before it"}));

inline constexpr auto of_force = std::make_tuple(
    kept(&AppliedForce::body, {"force", "body", text, "", any, "!", "", "", "name of a free rigid body"}),
    kept(&AppliedForce::value, {"force", "value", vector, "N", any, "[0, 0, 0]", "a torque alone", "",
                                "constant force in the world frame"}),
    kept(&AppliedForce::point,
         {"force", "place", vector, "m", any, "", "the centre of mass", "",
          "point of the body that it acts on, where it is at the start; it moves with the body"}),
    kept(&AppliedForce::torque,
         {"force", "torque", vector, "N m", any, "[0, 0, 0]", "no torque of its own", "",
          "constant torque in the world frame"},
         {.later = true}),
    kept(&AppliedForce::start,
         {"force", "start", number, "s", not_negative, "0", "from the start", "", "time at which it begins"},
         {.later = true}),
    kept(&AppliedForce::stop,
         {"force", "stop", number, "s", positive, "", "to the end", "", "time at which it ends"}));

inline constexpr auto of_spring = std::make_tuple(
    kept(&Spring::body, {"spring", "body", text, "", any, "!", "", "", "name of a free rigid body"}),
    kept(&Spring::point, {"spring", "point", vector, "m", any, "!", "", "",
                          "point of the body, where it is at the start; it moves with the body"}),
    kept(&Spring::other, {"spring", "other", text, "", any, "\"world\"", "a fixed point", "",
                          "name of another rigid body, or world"}),
    kept(&Spring::other_point,
         {"spring", "other_point", vector, "m", any, "!", "", "", "point of the other, likewise"}),
    kept(&Spring::stiffness, {"spring", "stiffness", number, "N/m", not_negative, "0", "a damper alone", "",
                              "force per length beyond `length`, along the line of the points"}),
    kept(&Spring::damping, {"spring", "damping", number, "N s/m", not_negative, "0", "undamped", "",
                            "force per speed at which the points part"}),
    kept(&Spring::length, {"spring", "length", number, "m", not_negative, "", "distance at the start", "",
                           "distance of the points at which the spring has no force"}));

inline constexpr auto of_joint = std::make_tuple(
    kept(&Joint::name,
         {"joint", "name", text, "", any, "!", "", "", "name of the joint, which metrics refer to"}),
    kept(&Joint::kind, {"joint", "kind", word, "", any, "!", "", "hinge ball slider fixed distance universal",
                        "freedom that it leaves: a hinge turns about the axis, a ball at will, a universal "
                        "about two axes, and a "
                        "slider slides"}),
    kept(&Joint::bodies, {"joint", "bodies", texts, "", any, "!", "", "",
                          "two rigid bodies, or one and \"world\". They do not touch each other"}),
    kept(&Joint::point, {"joint", "place", vector, "m", any, "!", "", "", "point of the joint at the start"}),
    kept(&Joint::other_point, {"joint", "other_place", vector, "m", any, "", "of a distance alone", "",
                               "point of the second body; `place` is that of the first"}),
    kept(&Joint::axis, {"joint", "axis", vector, "", any, "", "of a hinge, slider or universal", "",
                        "direction of the axis at the start; of a universal, that of the first body"}),
    kept(&Joint::other_axis, {"joint", "other_axis", vector, "", any, "", "of a universal alone", "",
                              "axis of the second body, across `axis`"}),
    kept(&Joint::limits,
         {"joint", "limits", numbers, "rad or m", any, "", "none", "",
          "range [low, high] of its coordinate: the angle or way of the first body against the "
          "second, 0 at the start"}),
    kept(&Joint::restitution, {"joint", "restitution", number, "", fraction, "0", "none", "",
                               "of its limits: rate after a hit over that before"}),
    kept(&Joint::friction, {"joint", "friction", number, "N m or N", not_negative, "0", "none", "",
                            "greatest torque or force of Coulomb's friction"}),
    kept(&Joint::damping, {"joint", "damping", number, "N m s/rad or N s/m", not_negative, "0", "undamped",
                           "", "torque per rate of turn, or force per speed"}),
    kept(&Joint::spring,
         {"joint", "spring", table, "", any, "", "none", "joint.spring", "along its coordinate"}),
    kept(&Joint::motor,
         {"joint", "motor", table, "", any, "", "none", "joint.motor", "along its coordinate"}));

inline constexpr auto of_joint_spring = std::make_tuple(
    kept(&JointSpring::stiffness,
         {"joint.spring", "stiffness", number, "N m/rad or N/m", positive, "!", "", "", "of the spring"}),
    kept(&JointSpring::rest, {"joint.spring", "rest", number, "rad or m", any, "0", "as at the start", "",
                              "coordinate at which it has no force"}));

inline constexpr auto of_joint_motor = std::make_tuple(
    kept(&JointMotor::effort, {"joint.motor", "effort", number, "N m or N", any, "", "with a speed", "",
                               "constant, on the first body; its opposite acts on the second"}),
    kept(&JointMotor::speed, {"joint.motor", "speed", number, "rad/s or m/s", any, "", "with an effort", "",
                              "that it keeps, whatever it needs"}));

inline constexpr auto of_source = std::make_tuple(
    kept(&HeatSource::bodies,
         {"source", "bodies", texts, "", any, "[]", "all in the region", "", "bodies that it heats"}),
    kept(&HeatSource::region,
         {"source", "region", shape, "", any, "", "everywhere", "",
          "region that it heats: matter that is in it now, or surfaces that were laid in it"}),
    kept(&HeatSource::heat, {"source", "heat", number, "W", any, "", "none", "",
                             "heat per second, shared by volume; of a region, by the matter in it at the "
                             "start. Below 0 it cools"}),
    kept(&HeatSource::density,
         {"source", "heat_density", number, "W/m3", any, "", "none", "", "heat per second and volume"}),
    kept(&HeatSource::flux,
         {"source", "flux", number, "W/m2", any, "", "none", "",
          "heat per second and area, into the body through its outer surface (model 8.6)"}),
    kept(&HeatSource::transfer_coefficient,
         {"source", "transfer_coefficient", number, "W/m2/K", not_negative, "", "no convection", "",
          "heat transfer coefficient of the outer surface, to ambient_temperature"}),
    kept(&HeatSource::emissivity,
         {"source", "emissivity", number, "", fraction, "", "no radiation", "",
          "emissivity of the outer surface, to surroundings of ambient_temperature"}),
    kept(&HeatSource::ambient, {"source", "ambient_temperature", number, "K", not_negative, "", "none", "",
                                "temperature of the fluid and of the surroundings"}),
    kept(&HeatSource::start, {"source", "start", number, "s", not_negative, "0", "from the start", "",
                              "time at which it begins"}),
    kept(&HeatSource::stop,
         {"source", "stop", number, "s", positive, "=", "end_time", "", "time at which it ends"}));

}  // namespace records

template <>
inline constexpr auto record<Scene> = records::of_scene;
template <>
inline constexpr auto record<Material> = records::of_material;
template <>
inline constexpr auto record<Body> = records::of_body;
template <>
inline constexpr auto record<Keyframe> = records::of_keyframe;
template <>
inline constexpr auto record<Event> = records::of_event;
template <>
inline constexpr auto record<Inflow> = records::of_inflow;
template <>
inline constexpr auto record<Outflow> = records::of_outflow;
template <>
inline constexpr auto record<ContactLaw> = records::of_contact_law;
template <>
inline constexpr auto record<AppliedForce> = records::of_force;
template <>
inline constexpr auto record<Spring> = records::of_spring;
template <>
inline constexpr auto record<Joint> = records::of_joint;
template <>
inline constexpr auto record<JointSpring> = records::of_joint_spring;
template <>
inline constexpr auto record<JointMotor> = records::of_joint_motor;
template <>
inline constexpr auto record<HeatSource> = records::of_source;

}  // namespace tripoint
