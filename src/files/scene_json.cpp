// SPDX-License-Identifier: BSD-3-Clause
#include "files/scene_json.hpp"

#include <initializer_list>

#include <nlohmann/json.hpp>

#include "files/job_records.hpp"
#include "files/record_json.hpp"
#include "scene/effect_keys.hpp"
#include "scene/model.hpp"
#include "scene/place_records.hpp"
#include "scene/scene_records.hpp"

/// Only fields that a job states otherwise than a case file are written by hand.
namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
using namespace record_json;

/// An object whose first members are these, in this order, which jobs have had from the start.
json beginning_with(std::initializer_list<const char*> names) {
  json out = json::object();
  for (const char* name : names) out[name] = nullptr;
  return out;
}

/// Values of keys that effects bring, as they are kept in a scene or a material.
template <class Owner>
void put_effect_values(const Owner& owner, std::string_view table, json& out) {
  each_effect_key(owner, table, [&](const Key& key, const auto& value) {
    out[std::string(key.name)] = put(key, "", value);
  });
}

/// A missing value stays as the owner has it.
template <class Owner>
void take_effect_values(const JsonObject& o, std::string_view table, Owner& owner) {
  each_effect_key(owner, table, [&](const Key& key, auto& value) {
    const std::string name(key.name);
    take({o, name, key, "", true}, value);
  });
}

// --- materials, bodies, events

json material_json(const Material& m) {
  json out =
      beginning_with({"name", "density", "solid", "stiffness", "solid_conductivity", "solid_heat_capacity"});
  put_record(m, out);
  put_effect_values(m, "material", out);
  return out;
}

Material material_from(const JsonObject& o) {
  Material m;
  take_record(o, m);
  take_effect_values(o, "material", m);
  return m;
}

/// A body as the case file says it and as its particles are: `velocity` is that of the centre of mass, the
/// field beside it.
json body_json(const Body& b, const JobBody& j) {
  json out = beginning_with({"name", "index", "material", "phase", "motion", "keyframes", "temperature_held",
                             "mass", "centre", "principal_inertia", "principal_axes", "orientation",
                             "velocity", "angular_velocity", "velocity_field", "temperature", "shape"});
  put_record(b, out);
  put_by(records::of_job_body, j, out);
  put_by(records::of_mass, j.properties, out);
  out["angular_velocity"] = to_json(j.angular_velocity);
  return out;
}

void body_from(const JsonObject& o, Scene& scene, std::vector<JobBody>& bodies) {
  Body b;
  take_record(o, b);
  JobBody j;
  j.name = b.name;
  j.material = b.material;
  take_by(records::of_job_body, o, j);
  take_by(records::of_mass, o, j.properties);
  j.phase = b.phase;
  j.motion = b.motion;
  j.keyframes = b.keyframes;
  j.temperature_held = b.temperature_held;
  j.angular_velocity = b.angular_velocity;
  if (!o.has("velocity_field")) b.velocity.value = j.velocity;
  scene.bodies.push_back(std::move(b));
  bodies.push_back(std::move(j));
}

json event_json(const Event& e) {
  json out = beginning_with({"kind"});
  put_record(e, out);
  return out;
}

template <class T>
void take_list(const JsonObject& o, const std::string& name, std::vector<T>& list) {
  for (const JsonObject& one : o.objects(name)) take_record(one, list.emplace_back());
}

json modes_json(const Scene& s) {
  json modes = json::object();
  for (const DeclaredTerm& one : declared_terms())
    modes[std::string(one.term.name)] = to_string(s.mode_of(one.term));
  return modes;
}

json model_json(const Scene& s) {
  json model = json::object();
  for (const ModelTerm& t : model_terms())
    if (const ModelForm* form = form_in(s, t)) model[std::string(t.name)] = form->word;
  return model;
}

/// Forms that other effects bring; all others are in `modes` and in the values of keys.
void take_forms(const JsonObject& o, Scene& s) {
  if (!o.has("model")) return;  // came after the first jobs
  const JsonObject model = o.object("model");
  for (const EffectRule& rule : effect_rules())
    for (const BroughtForm& f : rule.forms)
      for (const ModelTerm& t : model_terms())
        if (t.term == f.term && model.text_or(std::string(t.name), "") == f.form.word)
          s.forms[f.term] = f.form.word;
}

}  // namespace

json scene_to_json(const Scene& s, const std::vector<JobBody>& bodies) {
  json out = beginning_with({"end_time", "gravity", "spacing", "support_ratio", "mode", "modes", "time_step",
                             "seed", "jitter", "min", "max", "periodic", "output_interval", "settle",
                             "merge_distance", "contact", "clamp"});
  put_record(s, out);
  out["modes"] = modes_json(s);
  out["model"] = model_json(s);
  out["clamp"] = s.clamps();
  put_effect_values(s, "scene", out);
  for (const char* list : {"materials", "bodies", "events", "inflows", "contacts", "forces"})
    out[list] = json::array();
  for (const Material& m : s.materials) out["materials"].push_back(material_json(m));
  for (std::size_t k = 0; k < s.bodies.size(); ++k)
    out["bodies"].push_back(body_json(s.bodies[k], bodies.at(k)));
  for (const Event& e : s.events) out["events"].push_back(event_json(e));
  for (const Inflow& f : s.inflows) put_record(f, out["inflows"].emplace_back(json::object()));
  for (const Outflow& f : s.outflows) put_record(f, out["outflows"].emplace_back(json::object()));
  for (const ContactLaw& law : s.contact_laws) put_record(law, out["contacts"].emplace_back(json::object()));
  for (const AppliedForce& f : s.forces) put_record(f, out["forces"].emplace_back(json::object()));
  for (const Spring& one : s.springs) put_record(one, out["springs"].emplace_back(json::object()));
  for (const Joint& one : s.joints) put_record(one, out["joints"].emplace_back(json::object()));
  for (const HeatSource& h : s.sources) put_record(h, out["sources"].emplace_back(json::object()));
  return out;
}

void scene_from_json(const json& value, Scene& s, std::vector<JobBody>& bodies) {
  const JsonObject o(value, "scene");
  take_record(o, s);
  const JsonObject modes = o.object("modes");
  for (const DeclaredTerm& one : declared_terms())
    s.modes[one.term] = mode_from(modes.text_or(std::string(one.term.name), std::string(to_string(s.mode))));
  take_effect_values(o, "scene", s);
  take_forms(o, s);
  for (const JsonObject& m : o.objects("materials")) s.materials.push_back(material_from(m));
  for (const JsonObject& b : o.objects("bodies")) body_from(b, s, bodies);
  take_list(o, "events", s.events);
  take_list(o, "inflows", s.inflows);
  if (o.has("outflows")) take_list(o, "outflows", s.outflows);
  if (o.has("contacts")) take_list(o, "contacts", s.contact_laws);  // came after the first jobs
  if (o.has("forces")) take_list(o, "forces", s.forces);
  if (o.has("springs")) take_list(o, "springs", s.springs);
  if (o.has("joints")) take_list(o, "joints", s.joints);
  if (o.has("sources")) take_list(o, "sources", s.sources);
}

}  // namespace tripoint
