// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/measuring.hpp"

namespace tripoint {
namespace {

/// A case's own statement: a claim, and the data that a quantity must know to be measured. It computes
/// nothing, so that the case file itself states the value that a metric is compared with. Numbers: value, and
/// those of measuring.hpp.
using Stated = NumberTable;

std::unique_ptr<Reference> make_stated(const ReferenceInput& in) {
  Numbers n = stated_numbers(in, "stated");
  if (const auto value = in.args.number("value")) n["value"] = *value;
  return std::make_unique<Stated>(std::move(n), stated_measuring(in, "stated"));
}

/// No truth is known: a metric is the value itself.
std::unique_ptr<Reference> make_self(const ReferenceInput& in) {
  Numbers n = stated_numbers(in, "self");
  n["value"] = 0.0;
  n.emplace("stated_frequency", 0.0);
  n.emplace("stated_amplitude", 0.0);
  return std::make_unique<Stated>(std::move(n), stated_measuring(in, "self"));
}

}  // namespace

ReferenceEntry self_entry() {
  return {{"self", "self", "the run itself, by `tripoint converge`",
           "no truth is known: metrics are the values themselves, and `tripoint converge CASE --metric M` "
           "says how "
           "far the finest is from its limit",
           measuring_arguments()},
          make_self};
}

ReferenceEntry stated_entry() {
  std::vector<ReferenceArgument> args{{"value", "", "what the quantity is compared with, in its unit"}};
  for (const auto& a : measuring_arguments()) args.push_back(a);
  return {
      {"stated", "bound", "the case's own claim", "a number that the case states; nothing is computed", args},
      make_stated};
}

}  // namespace tripoint
