// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/baseline/baseline.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/fields.hpp"

/// The fields of a baseline's file. Beside those of results/fields.hpp:
///
///   v.unless(known, "key", member)   left out where it is `known`, which follows from the fields before it
///   v.block(is_there, f)             further fields of the same record, left out where `is_there` is false
namespace tripoint {

/// The edges that were accepted, as the gate of a case.
[[nodiscard]] inline Gate edges_of(const AcceptedGate& accepted) {
  Gate gate;
  gate.limit = accepted.limit;
  gate.at_least = accepted.at_least;
  gate.band = accepted.band;
  return gate;
}

template <class V>
void fields(V& v, RecordOf<AcceptedGate> auto& g) {
  v("metric", g.metric);
  v("engine", g.engine);
  v("preset", g.preset, preset_unless_default(g.preset));
  v("mode", g.mode);
  v("level", g.level);
  v("limit", g.limit);
  v("at_least", g.at_least);
  v("band", g.band);
  v("drift", g.drift);
  v.unless(describe(edges_of(g)), "allows", g.allows);
  v.unless(room_of(edges_of(g)), "room", g.room);
  v("value", g.value);
  v.unless(0.0, "uncertainty", g.uncertainty);
  v("class", g.fit_class);
  v.unless(g.room, "first_room", g.first_room);
  v.unless(g.value, "first_value", g.first_value);
  v.unless(0.0, "loosened", g.loosened);
  v("measures", g.measures);
}

template <class V>
void fields(V& v, RecordOf<Acceptance> auto& a) {
  v("date", a.date);
  v("commit", a.commit);
  v("reason", a.reason);
}

template <class V>
void fields(V& v, RecordOf<AcceptedCost> auto& c) {
  v("run", c.run);
  v("pairs", c.pairs);
  v("steps", c.steps);
  v.unless(0.0, "instructions", c.instructions);
  v("counted_on", c.counted_on);
}

template <class V>
void fields(V& v, RecordOf<AcceptedEngine> auto& e) {
  v("name", e.name);
  v("version", e.version);
  v("executable", e.executable);
}

template <class V>
void fields(V& v, RecordOf<Baseline> auto& b) {
  v("case", b.id);
  v("case_hash", b.case_hash);
  v("seed", b.seed);
  v.block(!b.scene.empty(), [&](auto& hashed) {
    hashed("scene", b.scene);
    hashed("reference", b.reference);
    hashed("profiles", b.profiles);
    hashed("required", b.required);
  });
  v.unless(0, "removed", b.removed);
  v("accepted", b.accepted);
  v("engines", b.engines);
  v("gate", b.gates);
  v("cost", b.cost);
}

}  // namespace tripoint
