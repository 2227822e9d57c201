// SPDX-License-Identifier: BSD-3-Clause
#include "program/predict/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "tables/nearest.hpp"
#include "tables/toml_node.hpp"

namespace tripoint::predict {
namespace {

constexpr double usual_pack_rate = 4e9;  ///< [bytes/s]
/// [bytes] of the probe's exchanges that the bandwidth is read from
constexpr double least_for_rate = 1 << 16;

const std::vector<std::string> keys{"name",      "cores_a_node", "latency",       "bandwidth", "allreduce",
                                    "pack_rate", "core_speed",   "speed_at_once", "waiting"};

double number(const TomlNode& file, const std::string& key, double otherwise, bool may_be_zero = false) {
  const TomlNode* node = file.find(key);
  if (!node && std::isnan(otherwise))
    throw InputError(file.place, "a machine file needs the key " + key + " (" +
                                     (key == "latency"     ? "seconds of one message"
                                      : key == "bandwidth" ? "bytes a second between two ranks"
                                                           : "cores of a node") +
                                     ")");
  if (!node) return otherwise;
  const bool is_number = node->kind == TomlNode::Kind::integer || node->kind == TomlNode::Kind::real;
  const double value =
      node->kind == TomlNode::Kind::integer ? static_cast<double>(node->integer) : node->real;
  if (!is_number || !std::isfinite(value) || value < 0.0 || (value == 0.0 && !may_be_zero))
    throw InputError(node->place, key + ": write a number above 0, in SI units");
  return value;
}

}  // namespace

Machine read_machine(const std::string& path) {
  const TomlNode file = read_toml(path);
  for (const auto& [key, value] : file.members) {
    bool known = false;
    for (const auto& k : keys) known = known || k == key;
    if (!known)
      throw InputError(value.key_place,
                       "a machine file has no key " + printable(key) + suggestion(key, keys));
  }
  Machine m;
  m.source = path;
  if (const TomlNode* name = file.find("name")) {
    if (name->kind != TomlNode::Kind::text) throw InputError(name->place, "name: write a text");
    m.name = name->text;
  }
  m.cores_a_node = static_cast<int>(std::min(1e6, number(file, "cores_a_node", NAN)));
  m.latency = number(file, "latency", NAN);
  m.bandwidth = number(file, "bandwidth", NAN);
  m.allreduce = number(file, "allreduce", m.latency);
  m.pack_rate = number(file, "pack_rate", usual_pack_rate);
  m.core_speed = number(file, "core_speed", 1.0);
  if (file.find("speed_at_once")) m.speed_at_once = number(file, "speed_at_once", 1.0);
  m.waiting = number(file, "waiting", m.waiting, true);
  return m;
}

Machine machine_of_probe(const std::string& text, int cores) {
  try {
    const auto o = nlohmann::json::parse(text);
    Machine m;
    m.cores_a_node = cores;
    m.source = "a probe of " + o.at("mpi").get<std::string>() + " between two ranks";
    // On a machine that is not quiet a small exchange may take longer than a large one. No exchange is faster
    // than the latency, and the best rate was possible.
    m.latency = INFINITY;
    for (const auto& e : o.at("exchanges")) m.latency = std::min(m.latency, e.at("seconds").get<double>());
    for (const auto& e : o.at("exchanges")) {
      const double bytes = e.at("bytes"), moving = e.at("seconds").get<double>() - m.latency;
      if (bytes >= least_for_rate && moving > 0.0) m.bandwidth = std::max(m.bandwidth, bytes / moving);
    }
    m.allreduce = o.at("allreduce").at(0).at("seconds");
    m.pack_rate = o.at("pack_rate");
    if (!(m.latency > 0.0 && m.bandwidth > 0.0 && m.allreduce > 0.0 && m.pack_rate > 0.0))
      throw EngineError("the probe of MPI gave times that cannot be: " + text);
    return m;
  } catch (const nlohmann::json::exception& e) {
    throw EngineError(std::string("the probe of MPI gave no answer that can be read: ") + e.what());
  }
}

}  // namespace tripoint::predict
