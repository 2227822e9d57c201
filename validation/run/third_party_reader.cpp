// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/third_party_reader.hpp"

#include <system_error>

#include "core/confined_copy.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {

namespace {

/// @throws EngineError, InputError as read_of_third_party
std::string read_within(const std::function<std::string()>& read, CopyBounds bounds) {
  bounds.must_be_confined = third_parties_are_sandboxed();
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

}  // namespace

std::string read_of_third_party(const std::function<std::string()>& read, const ThirdPartyFile& file,
                                double limit) {
  CopyBounds bounds{file.what, limit};
  bounds.folder = file.folder;
  return read_within(read, bounds);
}

void try_of_third_party(const std::function<void()>& deed, const ThirdPartyFile& file, double limit) {
  const auto read = [&] {
    deed();
    return std::string();
  };
  try {
    CopyBounds bounds{file.what, limit};
    bounds.folder = file.folder;
    bounds.most_bytes = 0;
    static_cast<void>(read_within(read, bounds));
  } catch (const InputError&) {  // a refusal: it is worded where it counts
  }
}

}  // namespace tripoint
