// SPDX-License-Identifier: BSD-3-Clause
//! Rapier in double precision: a world that engine_rapier_f64.py drives. One JSON document a line on stdin, one answer a line on stdout.
//!   {"open": {gravity, dt, preset, friction, restitution, laws, gyroscopic, settings, bodies}} -> {version, gravity, states, bodies: [{mass, inertia, ...}]}
//!   {"step": [dt, count]}   -> [[x, y, z, vx, vy, vz, qw, qx, qy, qz, wx, wy, wz], ...]
//! SI units; bodies are in their principal frames. Only free bodies are answered for, in the order of `bodies`.
use rapier3d_f64::prelude::*;
use serde_json::{json, Value};
use std::collections::HashMap;
use std::io::{BufRead, Write};

/// Of the two documents above; engine_rapier_f64.py asks for the same number.
const PROTOCOL: u32 = 2;

fn number(v: &Value) -> f64 {
    v.as_f64().expect("a number")
}

fn vector(v: &Value) -> Vector {
    Vector::new(number(&v[0]), number(&v[1]), number(&v[2]))
}

/// A job's quaternion is (w, x, y, z).
fn pose(at: &Value, turn: &Value) -> Pose {
    let rotation = Rotation::from_xyzw(number(&turn[1]), number(&turn[2]), number(&turn[3]), number(&turn[0]));
    Pose::from_parts(vector(at), rotation)
}

/// Friction and restitution of pairs of materials, for contacts of the colliders whose user data is the row of their body.
struct Laws {
    materials: Vec<String>,
    of: HashMap<(String, String), (f64, f64)>,
}

impl Laws {
    fn read(scene: &Value) -> Laws {
        let word = |v: &Value| v.as_str().expect("a material").to_string();
        let mut of = HashMap::new();
        for law in scene["laws"].as_array().expect("laws") {
            of.insert((word(&law[0]), word(&law[1])), (number(&law[2]), number(&law[3])));
            of.insert((word(&law[1]), word(&law[0])), (number(&law[2]), number(&law[3])));
        }
        let bodies = scene["bodies"].as_array().expect("bodies");
        Laws { materials: bodies.iter().map(|body| word(&body["material"])).collect(), of }
    }
}

impl PhysicsHooks for Laws {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let material = |handle: ColliderHandle| self.materials[context.colliders[handle].user_data as usize].clone();
        let pair = (material(context.collider1), material(context.collider2));
        if let (Some(&(friction, restitution)), Some(contact)) = (self.of.get(&pair), context.rigid_mut()) {
            (*contact.friction, *contact.restitution) = (friction, restitution);
        }
    }
}

struct World {
    physics: PhysicsWorld,
    laws: Laws,
    free: Vec<RigidBodyHandle>,
}

fn corners(piece: &Value) -> Vec<Vector> {
    piece["corners"].as_array().expect("corners").iter().map(vector).collect()
}

fn faces(piece: &Value) -> Vec<[u32; 3]> {
    let corner = |v: &Value| v.as_u64().expect("a corner") as u32;
    piece["faces"].as_array().expect("faces").iter().map(|f| [corner(&f[0]), corner(&f[1]), corner(&f[2])]).collect()
}

fn collider(piece: &Value, row: usize, scene: &Value) -> Collider {
    let size = &piece["size"];
    let shape = match piece["kind"].as_str().expect("a kind") {
        "sphere" => SharedShape::ball(number(&size[0])),
        "plane" => SharedShape::halfspace(Vector::new(0.0, 0.0, 1.0)),
        "cylinder" => SharedShape::cylinder(number(&size[2]), number(&size[0])),
        "capsule" => SharedShape::capsule_y(number(&size[2]), number(&size[0])),
        "hull" => SharedShape::convex_hull(&corners(piece)).expect("a hull"),
        "surface" => SharedShape::trimesh(corners(piece), faces(piece)).expect("a mesh"),
        _ => SharedShape::cuboid(number(&size[0]), number(&size[1]), number(&size[2])),
    };
    let hooks = if scene["laws"].as_array().is_some_and(|laws| !laws.is_empty()) { ActiveHooks::MODIFY_SOLVER_CONTACTS } else { ActiveHooks::empty() };
    // No density: the mass is the job's alone.
    ColliderBuilder::new(shape)
        .position(pose(&piece["centre"], &piece["rotation"]))
        .density(0.0)
        .friction(number(&scene["friction"]))
        .restitution(number(&scene["restitution"]))
        .user_data(row as u128)
        .active_hooks(hooks)
        .build()
}

fn rigid_body(body: &Value, scene: &Value) -> RigidBody {
    let at = pose(&body["centre"], &body["frame"]);
    if body["moves"] == true {
        return RigidBodyBuilder::kinematic_velocity_based().pose(at).linvel(vector(&body["velocity"])).build();
    }
    if !body["free"].as_bool().expect("free or not") {
        return RigidBodyBuilder::fixed().pose(at).build();
    }
    let mass = MassProperties::new(Vector::new(0.0, 0.0, 0.0), number(&body["mass"]), vector(&body["inertia"]));
    RigidBodyBuilder::dynamic()
        .pose(at)
        .can_sleep(false)
        .linvel(vector(&body["velocity"]))
        .angvel(vector(&body["spin"]))
        .additional_mass_properties(mass)
        .gyroscopic_forces_enabled(scene["gyroscopic"].as_bool().expect("gyroscopic or not"))
        .build()
}

fn set(parameters: &mut IntegrationParameters, key: &str, given: &Value) {
    let value = given.as_f64().unwrap_or(0.0);
    match key {
        "contact_recycling" => parameters.contact_recycling = given == true,
        "friction_in_bias_pass" => parameters.friction_in_bias_pass = given == true,
        "contact_natural_frequency" => parameters.contact_softness.natural_frequency = value,
        "contact_damping_ratio" => parameters.contact_softness.damping_ratio = value,
        "static_contact_natural_frequency" => parameters.static_contact_softness.natural_frequency = value,
        "static_contact_damping_ratio" => parameters.static_contact_softness.damping_ratio = value,
        "num_internal_pgs_iterations" => parameters.num_internal_pgs_iterations = value as usize,
        "num_solver_iterations" => parameters.num_solver_iterations = value as usize,
        "num_internal_stabilization_iterations" => parameters.num_internal_stabilization_iterations = value as usize,
        "normalized_allowed_linear_error" => parameters.normalized_allowed_linear_error = value,
        "normalized_prediction_distance" => parameters.normalized_prediction_distance = value,
        "normalized_max_corrective_velocity" => parameters.normalized_max_corrective_velocity = value,
        "warmstart_coefficient" => parameters.warmstart_coefficient = value,
        _ => panic!("no setting {key}"),
    }
}

impl World {
    fn open(scene: &Value) -> World {
        let mut physics = PhysicsWorld::new();
        physics.gravity = vector(&scene["gravity"]);
        physics.integration_parameters.dt = number(&scene["dt"]);
        if scene["preset"] == "COULOMB" {
            physics.integration_parameters.friction_model = FrictionModel::Coulomb;
        }
        for (key, value) in scene["settings"].as_object().expect("settings") {
            set(&mut physics.integration_parameters, key, value);
        }
        let mut free = Vec::new();
        for (row, body) in scene["bodies"].as_array().expect("bodies").iter().enumerate() {
            let handle = physics.insert_body(rigid_body(body, scene));
            for piece in body["pieces"].as_array().expect("pieces") {
                physics.colliders.insert_with_parent(collider(piece, row, scene), handle, &mut physics.bodies);
            }
            // Else the mass would be 0 until the first step, and could not be read back.
            physics.bodies[handle].recompute_mass_properties_from_colliders(&physics.colliders);
            if body["free"] == true {
                physics.bodies[handle].add_force(vector(&body["force"]), true); // Rapier keeps it
                free.push(handle);
            }
        }
        World { physics, laws: Laws::read(scene), free }
    }

    fn held(&self, scene: &Value) -> Value {
        let rows: Vec<Value> = self.free.iter().map(|&handle| {
            let body = &self.physics.bodies[handle];
            let own = body.mass_properties().local_mprops;
            let inertia = own.principal_inertia();
            json!({"mass": body.mass(), "inertia": [inertia.x, inertia.y, inertia.z], "friction": scene["friction"], "restitution": scene["restitution"],
                   "linear_damping": body.linear_damping(), "angular_damping": body.angular_damping()})
        }).collect();
        let g = self.physics.gravity;
        json!({"protocol": PROTOCOL, "gravity": [g.x, g.y, g.z], "bodies": rows, "states": self.states()})
    }

    fn states(&self) -> Value {
        let rows: Vec<Value> = self.free.iter().map(|&handle| {
            let body = &self.physics.bodies[handle];
            let (x, v, q, w) = (body.center_of_mass(), body.linvel(), body.position().rotation, body.angvel());
            let columns = [x.x, x.y, x.z, v.x, v.y, v.z, q.w, q.x, q.y, q.z, w.x, w.y, w.z];
            Value::Array(columns.iter().map(|&c| if f64::is_finite(c) { json!(c) } else { json!("NaN") }).collect())
        }).collect();
        Value::Array(rows)
    }

    fn step(&mut self, dt: f64, count: u64) -> Value {
        self.physics.integration_parameters.dt = dt;
        for _ in 0..count {
            self.physics.step_with_events(&self.laws, &());
        }
        self.states()
    }
}

fn main() {
    let mut world: Option<World> = None;
    let mut out = std::io::stdout();
    for line in std::io::stdin().lock().lines() {
        let call: Value = serde_json::from_str(&line.expect("a line")).expect("one JSON document a line");
        let answer = if call["open"].is_object() {
            let opened = World::open(&call["open"]);
            let held = opened.held(&call["open"]);
            world = Some(opened);
            held
        } else {
            let step = &call["step"];
            world.as_mut().expect("open comes first").step(number(&step[0]), step[1].as_u64().expect("a count"))
        };
        writeln!(out, "{answer}").expect("a reader");
        out.flush().expect("a reader");
    }
}
