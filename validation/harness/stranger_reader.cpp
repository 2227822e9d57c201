// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/stranger_reader.hpp"

#include <system_error>

#include "foreign/confined_copy.hpp"
#include "validation/harness/sandbox.hpp"

namespace tripoint {

std::string read_of_stranger(const std::function<std::string()>& read, const std::string& what, double limit) {
  CopyBounds bounds{what, limit};
  bounds.must_be_confined = strangers_are_sandboxed();
  CopyEnd end;
  try {
    end = read_in_confined_copy(read, bounds);
  } catch (const std::system_error& e) {
    throw EngineError(e.what());
  }
  if (const auto failure = failure_of(end, bounds); !failure.empty()) throw EngineError(failure);
  rethrow(end);
  return std::move(end.bytes);
}

void try_of_stranger(const std::function<void()>& deed, const std::string& what, double limit) {
  const auto read = [&] {
    deed();
    return std::string();
  };
  try {
    static_cast<void>(read_of_stranger(read, what, limit));
  } catch (const InputError&) {  // a refusal: it is worded where it counts
  }
}

}  // namespace tripoint
