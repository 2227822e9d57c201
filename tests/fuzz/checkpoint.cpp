// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints. First byte even: the rest is the file. Odd: the rest makes arrays, which are written and must
// read back; then the file is damaged here and there, and must be refused.
#include <iterator>

#include "core/errors.hpp"
#include "files/checkpoint_file.hpp"
#include "fuzz/input.hpp"

using namespace tripoint;

namespace {

Checkpoint made_of(fuzz::Bytes& bytes) {
  Checkpoint made;
  const char* names[] = {"particles/mass", "particles/id", "run/time", "run/words", "bonds/rest"};
  while (!bytes.empty() && made.real.size() + made.whole.size() + made.text.size() < 8) {
    const std::string name = names[bytes.one_of(5)];
    const unsigned kind = bytes.one_of(3), n = bytes.one_of(9);
    for (unsigned k = 0; k < n; ++k) {
      if (kind == 0) made.real[name].push_back(bytes.real());
      if (kind == 1) made.whole[name].push_back(bytes.byte() - 128);
      if (kind == 2)
        made.text[name].push_back(std::string(bytes.one_of(4), static_cast<char>('a' + bytes.one_of(26))));
    }
  }
  return made;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// @return whether it was refused
bool is_refused(const std::string& path) {
  try {
    static_cast<void>(read_checkpoint(path));
    return false;
  } catch (const InputError&) {
    return true;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::Bytes bytes(data, size);
  if (!bytes.flag()) {
    static_cast<void>(
        is_refused(folder.write("foreign.h5", fuzz::text_of(data + (size > 0), size - (size > 0)))));
    return 0;
  }
  const unsigned places = bytes.one_of(4), first = bytes.byte() * 256u + bytes.byte(),
                 change = 1 + bytes.one_of(255);
  const Checkpoint made = made_of(bytes);
  write_checkpoint(folder / "own.h5", made);
  fuzz::expect(same_bits(read_checkpoint(folder / "own.h5"), made),
               "a checkpoint reads back with the same bits");
  std::string damaged = bytes_of(folder / "own.h5");
  for (unsigned k = 0; k < places; ++k)
    damaged[(first + 977u * k) % damaged.size()] ^= static_cast<char>(change);
  if (damaged != bytes_of(folder / "own.h5"))
    fuzz::expect(is_refused(folder.write("damaged.h5", damaged)), "a damaged checkpoint is refused");
  return 0;
}
