// SPDX-License-Identifier: BSD-3-Clause
// Every key of a scene that a member keeps goes into a job and comes back.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "files/job.hpp"
#include "scene/place_records.hpp"
#include "scene/scene_records.hpp"

namespace tripoint {
namespace {

// --- another value than the default, by type

void change(double& v) { v += 0.625; }
void change(std::uint64_t& v) { v += 5; }
void change(bool& v) { v = !v; }
void change(std::string& v) { v += "x"; }
void change(Vec3& v) { v += Vec3{1, 2, 3}; }
void change(Quaternion& v) { v = {0, 1, 0, 0}; }
void change(std::vector<std::string>& v) { v = {"a", "b"}; }
void change(std::array<bool, 3>& v) { v = {true, false, true}; }
void change(std::array<std::string, 3>& v) { v = {"x", "2*y", "z"}; }
void change(std::array<Vec3, 3>& v) { v = {Vec3{1, 2, 3}, Vec3{4, 5, 6}, Vec3{7, 8, 9}}; }
template <class E>
requires std::is_enum_v<E>
void change(E& v) { v = static_cast<E>(1); }

template <class E>
requires std::is_enum_v<E>
void change(std::vector<E>& v) { v = {static_cast<E>(1), static_cast<E>(2)}; }

template <class Owner>
void change_all(Owner& owner);

void change(Shape& v) {
  v.kind = Shape::Kind::cylinder;
  change_all(v);
}
void change(TemperatureField& v) {
  v.kind = TemperatureField::Kind::step;
  change_all(v);
}
void change(VelocityField& v) {
  v.kind = VelocityField::Kind::linear;
  change_all(v);
}
void change(std::vector<Keyframe>& v) { change_all(v.emplace_back()); }
template <class T>
void change(std::optional<T>& v) {
  change(v.emplace());
}

template <class Owner>
void change_all(Owner& owner) {
  each_kept_of(owner, [&](const auto& entry) { change(owner.*entry.member); });
}

// --- the same value, by type

template <class Owner>
std::string different(const Owner& a, const Owner& b);

template <class T>
bool is_same(const T& a, const T& b) {
  if constexpr (std::is_same_v<T, Shape> || std::is_same_v<T, TemperatureField> ||
                std::is_same_v<T, VelocityField>)
    return a.kind == b.kind && different(a, b).empty();
  else if constexpr (std::is_same_v<T, Keyframe>)
    return different(a, b).empty();
  else if constexpr (requires { a.has_value(); })
    return a.has_value() == b.has_value() && (!a || is_same(*a, *b));
  else if constexpr (std::is_same_v<T, std::vector<Keyframe>>)
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), is_same<Keyframe>);
  else
    return a == b;
}

/// Keys whose values differ.
template <class Owner>
std::string different(const Owner& a, const Owner& b) {
  std::string names;
  each_kept_of(a, [&](const auto& entry) {
    if (!is_same(a.*entry.member, b.*entry.member))
      names += std::string(entry.key.table) + "." + std::string(entry.key.name) + " ";
  });
  return names;
}

Scene sent_and_received(const Scene& scene) {
  Job job;
  job.case_id = "a/b";
  job.scene = scene;
  job.times = {0.0};
  for (const Body& b : scene.bodies) {
    JobBody& j = job.bodies.emplace_back();
    j.name = b.name;
    j.material = b.material;
    j.angular_velocity = b.angular_velocity;
  }
  const auto path = std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "-every-key.json");
  write_job(path.string(), job);
  Scene received = read_job(path.string()).scene;
  std::filesystem::remove(path);
  return received;
}

template <class Owner>
Owner changed() {
  Owner owner;
  change_all(owner);
  return owner;
}

TEST(EveryKey, GoesIntoAJobAndComesBack) {
  Scene sent = changed<Scene>();
  sent.materials = {changed<Material>()};
  sent.bodies = {changed<Body>()};
  sent.events = {changed<Event>()};
  sent.inflows = {changed<Inflow>()};
  const Scene received = sent_and_received(sent);
  EXPECT_EQ(different(sent, received), "");
  EXPECT_EQ(different(sent.materials[0], received.materials.at(0)), "");
  EXPECT_EQ(different(sent.bodies[0], received.bodies.at(0)), "");
  EXPECT_EQ(different(sent.events[0], received.events.at(0)), "");
  EXPECT_EQ(different(sent.inflows[0], received.inflows.at(0)), "");
  EXPECT_NE(different(Scene(), received), "");
}

/// A body of each kind of an Owner, kept by this member.
template <class Owner, class T>
std::vector<Body> one_a_kind(T Body::*member) {
  std::vector<Body> bodies;
  const auto add = [&](const auto& kind) {
    Owner owner;
    owner.kind = kind.kind;
    change_all(owner);
    // Others turn about the centre of parts or of a file, which are not here
    if constexpr (std::is_same_v<Owner, Shape>)
      if (owner.kind != Shape::Kind::box && owner.kind != Shape::Kind::cylinder) owner.rotation = {};
    Body& b = bodies.emplace_back();
    b.name = kind.word;
    b.*member = owner;
  };
  std::apply([&](const auto&... all) { (add(all), ...); }, kinds<Owner>);
  return bodies;
}

TEST(EveryKey, OfEachKindGoesIntoAJobAndComesBack) {
  for (const auto& bodies :
       {one_a_kind<Shape>(&Body::shape), one_a_kind<TemperatureField>(&Body::temperature),
        one_a_kind<VelocityField>(&Body::velocity)}) {
    Scene sent;
    sent.bodies = bodies;
    const Scene received = sent_and_received(sent);
    for (std::size_t k = 0; k < bodies.size(); ++k)
      EXPECT_EQ(different(bodies[k], received.bodies.at(k)), "") << bodies[k].name;
  }
}

}  // namespace
}  // namespace tripoint
