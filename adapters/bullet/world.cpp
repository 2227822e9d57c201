// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/world.hpp"

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <cmath>

#include "adapters/bullet/constraints.hpp"
#include "adapters/engine/loaded_library.hpp"

namespace tripoint::bullet {

/// A body with its shapes, freed in the right order.
struct Solid {
  std::vector<std::unique_ptr<btTriangleMesh>> meshes;
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::unique_ptr<btCompoundShape> shape;
  std::unique_ptr<btRigidBody> body;
};

namespace {

static_assert(sizeof(btScalar) == 8, "Bullet must be the float64 build");

btVector3 bt(const Vec3& v) { return {v.x, v.y, v.z}; }
btQuaternion bt(const Quaternion& q) { return {q.x, q.y, q.z, q.w}; }
Vec3 vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// Bullet keeps rotations as matrices; the way back is normalised, as matrices drift by round-off.
Quaternion quaternion(const btTransform& t) {
  const btQuaternion q = t.getRotation();
  return normalised({q.w(), q.x(), q.y(), q.z()});
}

int flags(Gyro gyro) {
  switch (gyro) {
    case Gyro::implicit_body:
      return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
    case Gyro::implicit_world:
      return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD;
    case Gyro::explicit_world:
      return BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT;
    case Gyro::off:
      break;
  }
  return 0;
}

double inverse_or_zero(double x) { return x > 0.0 ? 1.0 / x : 0.0; }

}  // namespace

namespace {

/// Bullet asks free functions for the values of a pair. A process has one world.
const PairLaws* laws_in_use = nullptr;

double of_pair(const std::vector<std::vector<double>>& table, const btCollisionObject* a,
               const btCollisionObject* b) {
  return table.at(static_cast<std::size_t>(a->getUserIndex()))
      .at(static_cast<std::size_t>(b->getUserIndex()));
}

btScalar friction_of(const btCollisionObject* a, const btCollisionObject* b) {
  return of_pair(laws_in_use->friction, a, b);
}
btScalar restitution_of(const btCollisionObject* a, const btCollisionObject* b) {
  return of_pair(laws_in_use->restitution, a, b);
}

}  // namespace

struct World::Impl {
  Preset preset;
  PairLaws laws;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<Solid> solids;
  std::vector<std::unique_ptr<btTypedConstraint>> constraints;
  double contact_points = 0.0;

  explicit Impl(const Preset& p) : preset(p) {}
  ~Impl() {
    for (const auto& c : constraints) world.removeConstraint(c.get());
    for (Solid& s : solids)
      if (s.body) world.removeRigidBody(s.body.get());
  }
  [[nodiscard]] btRigidBody& at(int handle) const {
    return *solids.at(static_cast<std::size_t>(handle)).body;
  }
};

World::World(const Preset& preset, const Vec3& gravity) : impl_(std::make_unique<Impl>(preset)) {
  impl_->world.setGravity(bt(gravity));
  btContactSolverInfo& info = impl_->world.getSolverInfo();
  info.m_numIterations = preset.iterations;
  info.m_erp2 = preset.erp2;
  info.m_splitImpulsePenetrationThreshold = preset.split_threshold;
  info.m_restitutionVelocityThreshold = preset.restitution_threshold;
  info.m_maxGyroscopicForce = 1e30;  // Bullet's 100 N m would silently cut the explicit form of heavy bodies
}

World::~World() = default;

namespace {

std::unique_ptr<btCollisionShape> hull_of(const Piece& piece) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& corner : piece.corners) hull->addPoint(bt(corner), false);
  hull->recalcLocalAabb();
  hull->setMargin(0.0);  // Bullet's 4 cm would lie outside the faces
  hull->initializePolyhedralFeatures();
  return hull;
}

std::unique_ptr<btCollisionShape> surface_of(const Piece& piece, btTriangleMesh& mesh) {
  for (const auto& t : piece.triangles)
    mesh.addTriangle(bt(piece.corners[t[0]]), bt(piece.corners[t[1]]), bt(piece.corners[t[2]]));
  auto surface = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
  surface->setMargin(0.0);
  return surface;
}

Solid build_shapes(const std::vector<Piece>& pieces) {
  Solid solid;
  solid.shape = std::make_unique<btCompoundShape>(true, static_cast<int>(pieces.size()));
  for (const Piece& piece : pieces) {
    std::unique_ptr<btCollisionShape> part;
    switch (piece.kind) {
      case Piece::Kind::sphere:
        part = std::make_unique<btSphereShape>(piece.half_extents.x);
        break;
      case Piece::Kind::box:
        part = std::make_unique<btBoxShape>(bt(piece.half_extents));
        break;
      case Piece::Kind::cylinder:
        part = std::make_unique<btCylinderShapeZ>(bt(piece.half_extents));
        break;
      case Piece::Kind::capsule:
        part = std::make_unique<btCapsuleShapeZ>(piece.half_extents.x, 2.0 * piece.half_extents.z);
        break;
      case Piece::Kind::hull:
        part = hull_of(piece);
        break;
      case Piece::Kind::surface:
        solid.meshes.push_back(std::make_unique<btTriangleMesh>());
        part = surface_of(piece, *solid.meshes.back());
    }
    solid.shape->addChildShape(btTransform(bt(piece.rotation), bt(piece.centre)), part.get());
    solid.parts.push_back(std::move(part));
  }
  return solid;
}

/// A moment of 0 cannot turn: Bullet reads it as infinite, so the spin about that axis, which carries no
/// momentum, goes.
Vec3 spin_with_momentum(const RigidPart& part) {
  Vec3 w = rotate_back(part.motion.orientation, part.motion.angular_velocity);
  for (std::size_t k = 0; k < 3; ++k)
    if (part.principal_inertia[k] <= 0.0) w[k] = 0.0;
  return rotate(part.motion.orientation, w);
}

bool singular(const Vec3& inertia) { return inertia.x <= 0.0 || inertia.y <= 0.0 || inertia.z <= 0.0; }

}  // namespace

int World::add(const RigidPart& part) {
  Solid solid = build_shapes(part.pieces);
  const bool dynamic = part.drive == Drive::dynamic;
  // The particles' own moments; never calculateLocalInertia(), which would see the shapes.
  const btRigidBody::btRigidBodyConstructionInfo info(
      dynamic ? part.mass : 0.0, nullptr, solid.shape.get(),
      dynamic ? bt(part.principal_inertia) : btVector3(0, 0, 0));
  solid.body = std::make_unique<btRigidBody>(info);
  btRigidBody& body = *solid.body;
  body.setCenterOfMassTransform(btTransform(bt(part.motion.orientation), bt(part.motion.centre)));
  if (part.drive != Drive::fixed) {
    body.setLinearVelocity(bt(part.motion.velocity));
    body.setAngularVelocity(bt(dynamic ? spin_with_momentum(part) : part.motion.angular_velocity));
  }
  if (part.drive == Drive::kinematic)
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setFlags(singular(part.principal_inertia) ? 0 : flags(impl_->preset.gyro));
  body.setActivationState(DISABLE_DEACTIVATION);
  body.setDamping(0.0, 0.0);
  body.setFriction(std::sqrt(impl_->preset.friction));  // a pair's value is the product of both
  body.setUserIndex(part.material);
  body.setRollingFriction(0.0);
  body.setSpinningFriction(0.0);
  body.setRestitution(std::sqrt(impl_->preset.restitution));
  if (impl_->preset.contact_threshold < 1e30)
    body.setContactProcessingThreshold(impl_->preset.contact_threshold);
  const int all = -1, none = 0;
  impl_->world.addRigidBody(&body, btBroadphaseProxy::DefaultFilter,
                            impl_->preset.collision == Collision::none ? none : all);
  impl_->solids.push_back(std::move(solid));
  return static_cast<int>(impl_->solids.size()) - 1;
}

void World::remove(int handle) {
  impl_->world.removeRigidBody(&impl_->at(handle));
  impl_->solids[static_cast<std::size_t>(handle)] = Solid{};
}

void World::join(const Joint& joint, int one, int other) {
  btRigidBody& ground = btTypedConstraint::getFixedBody();
  auto made = constraint_of(joint, one < 0 ? ground : impl_->at(one), other < 0 ? ground : impl_->at(other));
  if (!made) return;
  impl_->world.addConstraint(made.get(), true);
  impl_->constraints.push_back(std::move(made));
}

void World::drive(int handle, const Vec3& centre, const Quaternion& orientation) {
  impl_->at(handle).setWorldTransform(btTransform(bt(orientation), bt(centre)));
}

void World::use(PairLaws laws) {
  impl_->laws = std::move(laws);
  laws_in_use = &impl_->laws;
  gCalculateCombinedFrictionCallback = friction_of;
  gCalculateCombinedRestitutionCallback = restitution_of;
}

void World::push(int handle, const Vec3& force, const Vec3& arm) {
  impl_->at(handle).applyForce(bt(force), bt(arm));
}

void World::step(double dt) {
  impl_->world.stepSimulation(dt, 0);  // 0 substeps: exactly one step of dt, no interpolation
  for (int i = 0; i < impl_->dispatcher.getNumManifolds(); ++i)
    impl_->contact_points += impl_->dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
}

RigidMotion World::motion(int handle) const {
  const btRigidBody& body = impl_->at(handle);
  return {vec(body.getCenterOfMassPosition()), quaternion(body.getCenterOfMassTransform()),
          vec(body.getLinearVelocity()), vec(body.getAngularVelocity())};
}

HeldBody World::held(int handle) const {
  const btRigidBody& body = impl_->at(handle);
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  return {inverse_or_zero(body.getInvMass()),
          vec(body.getCenterOfMassPosition()),
          {inverse_or_zero(inverse.x()), inverse_or_zero(inverse.y()), inverse_or_zero(inverse.z())},
          body.getFriction() * body.getFriction(),
          body.getRestitution() * body.getRestitution(),
          body.getLinearDamping(),
          body.getAngularDamping()};
}

Vec3 World::gravity() const { return vec(impl_->world.getGravity()); }

Wrench World::contact(int handle, double dt) const {
  const btRigidBody* const body = &impl_->at(handle);
  Wrench sum;
  for (int i = 0; i < impl_->dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *impl_->dispatcher.getManifoldByIndexInternal(i);
    const bool first = manifold.getBody0() == body;
    if (!first && manifold.getBody1() != body) continue;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      const btVector3 impulse = point.getAppliedImpulse() * point.m_normalWorldOnB +
                                point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
      const Vec3 force = ((first ? 1.0 : -1.0) / dt) * vec(impulse);
      const Vec3 arm = vec(first ? point.getPositionWorldOnA() : point.getPositionWorldOnB()) -
                       vec(body->getCenterOfMassPosition());
      sum.force += force;
      sum.torque += cross(arm, force);
    }
  }
  return sum;
}

double World::contact_points() const { return impl_->contact_points; }

std::string World::version() {
  return fmt::format("{}.{:02d}", BT_BULLET_VERSION / 100, BT_BULLET_VERSION % 100);
}

std::string World::library_path() { return loaded_library("libBulletDynamics"); }

}  // namespace tripoint::bullet
