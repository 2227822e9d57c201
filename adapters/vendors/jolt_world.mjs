// SPDX-License-Identifier: BSD-3-Clause
// Jolt Physics on node: a world that engine_jolt.py drives. One JSON document a line on stdin, one answer a line on stdout.
//   {"open": {gravity, gyroscopic, friction, restitution, laws, rounded, touches, settings, bodies, joints}} -> {gravity, bodies: [{mass, inertia, ...}]}
//   {"step": [dt, count]}                                                    -> [[x, y, z, vx, vy, vz, qw, qx, qy, qz, wx, wy, wz], ...]
// SI units; bodies are in their principal frames. Only free bodies are answered for, in the order of `bodies`.
import { createInterface } from 'node:readline';
import { pathToFileURL } from 'node:url';

const J = await (await import(pathToFileURL(process.argv[2]))).default();
const FIXED = 0, FREE = 1, NOWHERE = 2; // layers; two fixed bodies never meet, and nothing meets the last

const vec = (v) => new J.Vec3(v[0], v[1], v[2]);
const vec3r = (v) => new J.RVec3(v[0], v[1], v[2]);
const quat = (q) => new J.Quat(q[1], q[2], q[3], q[0]);
const xyz = (v) => [v.GetX(), v.GetY(), v.GetZ()];

function openWorld(settings, touches) {
  const jolt = new J.JoltSettings();
  jolt.mMaxWorkerThreads = 0;
  const pairs = new J.ObjectLayerPairFilterTable(3);
  if (touches) pairs.EnableCollision(FIXED, FREE);
  if (touches) pairs.EnableCollision(FREE, FREE);
  const layers = new J.BroadPhaseLayerInterfaceTable(3, 3);
  for (const layer of [FIXED, FREE, NOWHERE]) layers.MapObjectToBroadPhaseLayer(layer, new J.BroadPhaseLayer(layer));
  jolt.mObjectLayerPairFilter = pairs;
  jolt.mBroadPhaseLayerInterface = layers;
  jolt.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 3, pairs, 3);
  const world = new J.JoltInterface(jolt);
  const system = world.GetPhysicsSystem();
  const physics = system.GetPhysicsSettings();
  for (const [key, value] of Object.entries(settings)) {
    if (physics[key] === undefined) throw new Error(`this release has no setting ${key}`);
    physics[key] = value;
  }
  system.SetPhysicsSettings(physics);
  return world;
}

function hullSettings(piece, rounded) {
  const hull = new J.ConvexHullShapeSettings();
  for (const corner of piece.corners) hull.mPoints.push_back(vec(corner));
  hull.mMaxConvexRadius = rounded;
  return hull;
}

function surfaceSettings(piece) {
  const corners = new J.VertexList(), faces = new J.IndexedTriangleList();
  for (const corner of piece.corners) corners.push_back(new J.Float3(...corner));
  for (const face of piece.faces) faces.push_back(new J.IndexedTriangle(...face, 0));
  return new J.MeshShapeSettings(corners, faces, new J.PhysicsMaterialList());
}

function pieceSettings(piece, rounded) {
  if (piece.kind === 'sphere') return new J.SphereShapeSettings(piece.size[0]);
  if (piece.kind === 'plane') return new J.PlaneShapeSettings(new J.Plane(vec(piece.normal), piece.constant), null, 1000.0);
  if (piece.kind === 'hull') return hullSettings(piece, rounded);
  if (piece.kind === 'surface') return surfaceSettings(piece);
  const [radius, , half] = piece.size;
  if (piece.kind === 'capsule') return new J.CapsuleShapeSettings(half, radius);
  if (piece.kind === 'cylinder') return new J.CylinderShapeSettings(half, radius, Math.min(rounded, 0.5 * half, 0.5 * radius));
  return new J.BoxShapeSettings(vec(piece.size), Math.min(rounded, 0.5 * Math.min(...piece.size))); // flat sides stay where they are
}

function made(settings) {
  const result = settings.Create();
  if (result.HasError()) throw new Error(result.GetError().c_str());
  return result.Get();
}

/// A shape whose centre of mass is the body's, at the origin.
function shapeOf(pieces, rounded) {
  if (pieces.length === 0) return made(new J.SphereShapeSettings(0.5)); // alone in its world: never touched
  if (pieces[0].kind === 'plane') return made(pieceSettings(pieces[0], rounded));
  let settings;
  if (pieces.length === 1) {
    settings = new J.RotatedTranslatedShapeSettings(vec(pieces[0].centre), quat(pieces[0].rotation), pieceSettings(pieces[0], rounded));
  } else {
    settings = new J.StaticCompoundShapeSettings();
    for (const piece of pieces) settings.AddShapeShapeSettings(vec(piece.centre), quat(piece.rotation), pieceSettings(piece, rounded), 0);
  }
  const off = xyz(made(settings).GetCenterOfMass());
  if (Math.hypot(...off) === 0) return made(settings);
  return made(new J.OffsetCenterOfMassShapeSettings(vec(off.map((c) => -c)), settings));
}

function addBody(interface_, given, scene) {
  const motion = given.free ? J.EMotionType_Dynamic : given.moves ? J.EMotionType_Kinematic : J.EMotionType_Static;
  const c = new J.BodyCreationSettings(shapeOf(given.pieces, scene.rounded), new J.RVec3(...given.centre), quat(given.frame), motion, given.free ? FREE : FIXED);
  c.mLinearDamping = 0; // Jolt's default is 0.05, which no scene asks for
  c.mAngularDamping = 0;
  c.mAllowSleeping = false;
  c.mMaxLinearVelocity = 1e9; // Jolt's bounds of 500 m/s and 47 rad/s would silently change a scene
  c.mMaxAngularVelocity = 1e9;
  c.mFriction = scene.friction;
  c.mRestitution = scene.restitution;
  c.mApplyGyroscopicForce = scene.gyroscopic;
  const body = interface_.CreateBody(c);
  if (given.free) {
    const held = body.GetMotionProperties();
    held.SetInverseMass(1 / given.mass);
    held.SetInverseInertia(vec(given.inertia.map((i) => 1 / i)), quat([1, 0, 0, 0]));
  }
  interface_.AddBody(body.GetID(), J.EActivation_Activate);
  if (given.free || given.moves) {
    interface_.SetLinearVelocity(body.GetID(), vec(given.velocity));
    interface_.SetAngularVelocity(body.GetID(), vec(given.spin));
  }
  return body;
}

function heldBy(body) {
  const held = body.GetMotionProperties();
  return { mass: 1 / held.GetInverseMass(), inertia: xyz(held.GetInverseInertiaDiagonal()).map((i) => 1 / i), friction: body.GetFriction(),
           restitution: body.GetRestitution(), linear_damping: held.GetLinearDamping(), angular_damping: held.GetAngularDamping() };
}

function stateOf(body) {
  const q = body.GetRotation();
  return [...xyz(body.GetCenterOfMassPosition()), ...xyz(body.GetLinearVelocity()), q.GetW(), q.GetX(), q.GetY(), q.GetZ(), ...xyz(body.GetAngularVelocity())];
}

/// Hands each contact the friction and restitution of its pair of materials; Jolt's own rule combines two values.
function listen(system, laws, bodies, scene) {
  if (laws.length === 0) return;
  const materials = new Map(bodies.map((body, k) => [body.GetID().GetIndexAndSequenceNumber(), scene.bodies[k].material]));
  const named = new Map(laws.flatMap(([a, b, friction, restitution]) => [[`${a}/${b}`, [friction, restitution]], [`${b}/${a}`, [friction, restitution]]]));
  const meet = (one, other, _, settings) => {
    const material = (pointer) => materials.get(J.wrapPointer(pointer, J.Body).GetID().GetIndexAndSequenceNumber());
    const law = named.get(`${material(one)}/${material(other)}`);
    if (!law) return;
    const held = J.wrapPointer(settings, J.ContactSettings);
    [held.mCombinedFriction, held.mCombinedRestitution] = law;
  };
  const listener = new J.ContactListenerJS();
  listener.OnContactValidate = () => J.ValidateResult_AcceptAllContactsForThisBodyPair;
  listener.OnContactAdded = meet;
  listener.OnContactPersisted = meet;
  listener.OnContactRemoved = () => {};
  system.SetContactListener(listener);
}

/// The angle or way of a constraint is that of its second body against the first: the job's first against its second.
function constraintOf(joint) {
  if (joint.kind === 'hinge' || joint.kind === 'slider') {
    const turns = joint.kind === 'hinge';
    const c = turns ? new J.HingeConstraintSettings() : new J.SliderConstraintSettings();
    c.mPoint1 = c.mPoint2 = vec3r(joint.place);
    c.mNormalAxis1 = c.mNormalAxis2 = vec(joint.across);
    if (joint.limits) [c.mLimitsMin, c.mLimitsMax] = joint.limits;
    const [axis1, axis2, friction] = turns
      ? ['mHingeAxis1', 'mHingeAxis2', 'mMaxFrictionTorque']
      : ['mSliderAxis1', 'mSliderAxis2', 'mMaxFrictionForce'];
    c[axis1] = c[axis2] = vec(joint.axis);
    c[friction] = joint.friction;
    return c;
  }
  if (joint.kind === 'fixed') {
    const c = new J.FixedConstraintSettings();
    c.mPoint1 = c.mPoint2 = vec3r(joint.place);
    return c;
  }
  const c = joint.kind === 'ball' ? new J.PointConstraintSettings() : new J.DistanceConstraintSettings();
  c.mPoint1 = vec3r(joint.other_place);
  c.mPoint2 = vec3r(joint.place);
  return c;
}

/// A body that stays: Jolt's own of the world has no orientation, and angles of hinges are wrong against it.
function ground(interface_) {
  const c = new J.BodyCreationSettings(made(new J.SphereShapeSettings(0.5)), new J.RVec3(0, 0, 0), quat([1, 0, 0, 0]), J.EMotionType_Static, NOWHERE);
  const body = interface_.CreateBody(c);
  interface_.AddBody(body.GetID(), J.EActivation_DontActivate);
  return body;
}

/// @returns what Jolt itself holds of each joint
function addJoints(system, joints, bodies) {
  const world = joints.some((joint) => Math.min(...joint.numbers) < 0) ? ground(system.GetBodyInterface()) : null;
  return joints.map((joint) => {
    const end = (number) => (number < 0 ? world : bodies[number]);
    const made = constraintOf(joint).Create(end(joint.numbers[1]), end(joint.numbers[0]));
    system.AddConstraint(made);
    const hinge = joint.kind === 'hinge' ? J.castObject(made, J.HingeConstraint).GetMaxFrictionTorque() : 0;
    const slider = joint.kind === 'slider' ? J.castObject(made, J.SliderConstraint).GetMaxFrictionForce() : 0;
    return { name: joint.name, friction: hinge + slider };
  });
}

let world = null, free = [], pushed = [];
const calls = {
  open(scene) {
    world = openWorld(scene.settings, scene.touches);
    const system = world.GetPhysicsSystem();
    system.SetGravity(vec(scene.gravity));
    const bodies = scene.bodies.map((given) => addBody(system.GetBodyInterface(), given, scene));
    listen(system, scene.laws, bodies, scene);
    const joints = addJoints(system, scene.joints, bodies);
    free = bodies.filter((_, k) => scene.bodies[k].free);
    pushed = bodies.map((body, k) => [body, scene.bodies[k].force]).filter(([, force]) => Math.hypot(...force) > 0).map(([body, force]) => [body, vec(force)]);
    return { gravity: xyz(system.GetGravity()), bodies: free.map(heldBy), joints, states: free.map(stateOf) };
  },
  step([dt, count]) {
    for (let k = 0; k < count; ++k) {
      for (const [body, force] of pushed) body.AddForce(force); // Jolt forgets forces after each step
      world.Step(dt, 1);
    }
    return free.map(stateOf);
  },
};

for await (const line of createInterface({ input: process.stdin })) {
  const [[name, words]] = Object.entries(JSON.parse(line));
  let answer;
  try {
    answer = calls[name](words);
  } catch (error) {
    answer = { error: String(error.message ?? error) };
  }
  // JSON has no word for what is not finite: it goes as a text.
  process.stdout.write(JSON.stringify(answer, (_, v) => (typeof v === 'number' && !Number.isFinite(v) ? String(v) : v)) + '\n');
}
