// SPDX-License-Identifier: BSD-3-Clause
#include "files/checkpoint_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "core/written_file.hpp"
#include "files/h5md_file.hpp"

namespace tripoint {
namespace {

constexpr std::size_t first_block = 512;  // the smallest user block of HDF5
constexpr std::string_view magic = "tripoint checkpoint 1\n";

/// FNV-1a over what follows the first block: each byte is taken by a bijection, so no single change goes
/// unseen.
std::string checksum_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  in.seekg(first_block);
  std::uint64_t hash = 1469598103934665603ULL;
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    for (std::streamsize k = 0; k < in.gcount(); ++k)
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(k)])) * 1099511628211ULL;
  return fmt::format("fnv1a64:{:016x}", hash);
}

/// The whole first block: name and version, checksum, the rest zero.
std::string sealed_block(const std::string& path) {
  std::string block = fmt::format("{}{}\n", magic, checksum_of(path));
  block.resize(first_block, '\0');
  return block;
}

void seal(const std::string& path) {
  const std::string block = sealed_block(path);
  const auto fail = [&](int why) { throw EngineError(path + ": cannot be written: " + std::strerror(why)); };
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail(errno);
  off_t at = 0;
  const int why = write_whole(block, [&](std::string_view rest) {
    const ssize_t n = ::pwrite(file, rest.data(), rest.size(), at);
    if (n > 0) at += n;
    return n;
  });
  ::close(file);
  if (why != 0) fail(why);
}

void expect_seal(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": there is no such checkpoint, or it cannot be read");
  std::string block(first_block, '\0');
  in.read(block.data(), first_block);
  const std::string_view kind = magic.substr(0, magic.size() - 2);
  if (in.gcount() != static_cast<std::streamsize>(first_block) || !block.starts_with(kind))
    throw InputError(path + ": is no checkpoint of tripoint");
  if (!block.starts_with(magic))
    throw InputError(path + ": is a checkpoint of another version; this build reads version 1");
  if (block != sealed_block(path))
    throw InputError(path + ": is torn or altered: its checksum does not match; take an earlier checkpoint");
}

void write_bytes(hid_t group, const std::string& path, const std::string& name, hid_t type, std::size_t count,
                 const void* data) {
  const std::string what = path + ": " + name;
  const hsize_t n = count;
  const h5::Handle space(count > 0 ? H5Screate_simple(1, &n, nullptr) : H5Screate(H5S_NULL), H5Sclose, what);
  const h5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  if (count > 0) {
    const hsize_t chunk = std::min<hsize_t>(n, 1 << 20);
    h5::check(H5Pset_chunk(properties.get(), 1, &chunk), what);
    h5::check(H5Pset_fletcher32(properties.get()), what);
  }
  const h5::Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  h5::check(H5Pset_create_intermediate_group(links.get(), 1), what);
  h5::Handle dataset(
      H5Dcreate2(group, name.c_str(), type, space.get(), links.get(), properties.get(), H5P_DEFAULT),
      H5Dclose, what);
  if (count > 0) h5::check(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), what);
  dataset.close(what);
}

template <class T>
std::vector<T> read_values(hid_t group, const std::string& name, hid_t type, const std::string& path) {
  const h5::Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, path);
  const h5::Handle space(H5Dget_space(dataset.get()), H5Sclose, path);
  std::vector<T> values(
      static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0)));
  if (!values.empty() && H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw InputError(path + ": " + name + " cannot be read");
  return values;
}

/// Strings as bytes, each ended by a zero.
std::vector<char> joined(const std::vector<std::string>& lines) {
  std::vector<char> bytes;
  for (const std::string& line : lines)
    bytes.insert(bytes.end(), line.c_str(), line.c_str() + line.size() + 1);
  return bytes;
}
std::vector<std::string> split_at_zeros(const std::vector<char>& bytes) {
  std::vector<std::string> lines;
  for (auto from = bytes.begin(); from != bytes.end();) {
    const auto to = std::find(from, bytes.end(), '\0');
    lines.emplace_back(from, to);
    from = to == bytes.end() ? to : to + 1;
  }
  return lines;
}

void write_all(const std::string& path, const Checkpoint& kept) {
  h5::Handle file = h5::create_latest(path, first_block);
  for (const auto& [name, values] : kept.real)
    write_bytes(file.get(), path, "real/" + name, H5T_NATIVE_DOUBLE, values.size(), values.data());
  for (const auto& [name, values] : kept.whole)
    write_bytes(file.get(), path, "whole/" + name, H5T_NATIVE_INT64, values.size(), values.data());
  for (const auto& [name, lines] : kept.text) {
    const std::vector<char> bytes = joined(lines);
    write_bytes(file.get(), path, "text/" + name, H5T_NATIVE_CHAR, bytes.size(), bytes.data());
  }
  h5::check(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path);
  file.close(path);
}

bool is_group(hid_t file, const std::string& path) {
  const h5::Handle object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose, path);
  return H5Iget_type(object.get()) == H5I_GROUP;
}

constexpr int most_groups = 4;  ///< one within the other: the states that a run can go back to are four deep

/// Calls visit(name below the group) for every dataset, e.g. "particles/mass" of /real. @param path of a
/// group in it, ended by a stroke; empty: the whole   @param depth of that group
void for_each_dataset(hid_t file, const std::string& group,
                      const std::function<void(const std::string&)>& visit, const std::string& path = "",
                      int depth = 1) {
  for (const std::string& name : h5::members(file, "/" + group + "/" + path)) {
    if (depth < most_groups && is_group(file, "/" + group + "/" + path + name))
      for_each_dataset(file, group, visit, path + name + "/", depth + 1);
    else
      visit(path + name);
  }
}

template <class T>
bool same_arrays(const std::map<std::string, std::vector<T>>& a,
                 const std::map<std::string, std::vector<T>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first && x.second.size() == y.second.size() &&
           (x.second.empty() ||
            std::memcmp(x.second.data(), y.second.data(), x.second.size() * sizeof(T)) == 0);
  });
}

}  // namespace

bool same_bits(const Checkpoint& a, const Checkpoint& b) {
  return same_arrays(a.real, b.real) && same_arrays(a.whole, b.whole) && a.text == b.text;
}

Checkpoint read_checkpoint(const std::string& path) {
  expect_seal(path);
  const h5::Handle file = h5::open_for_reading(path);
  Checkpoint kept;
  for_each_dataset(file.get(), "real", [&](const std::string& name) {
    kept.real[name] = read_values<double>(file.get(), "real/" + name, H5T_NATIVE_DOUBLE, path);
  });
  for_each_dataset(file.get(), "whole", [&](const std::string& name) {
    kept.whole[name] = read_values<std::int64_t>(file.get(), "whole/" + name, H5T_NATIVE_INT64, path);
  });
  for_each_dataset(file.get(), "text", [&](const std::string& name) {
    kept.text[name] = split_at_zeros(read_values<char>(file.get(), "text/" + name, H5T_NATIVE_CHAR, path));
  });
  return kept;
}

void write_checkpoint(const std::string& path, const Checkpoint& kept) {
  const std::string temporary = path + ".part";
  write_all(temporary, kept);
  seal(temporary);
  try {
    if (!same_bits(read_checkpoint(temporary), kept))
      throw EngineError(path + ": does not read back as it was written");
  } catch (const InputError& e) {
    throw EngineError(std::string("a new checkpoint does not read back: ") + e.what());
  }
  make_durable(temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
    throw EngineError(path + ": cannot be written: " + std::strerror(errno));
  make_durable(std::filesystem::absolute(path).parent_path().string());
}

}  // namespace tripoint
