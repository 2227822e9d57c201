// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

/// What the fuzz targets share: bytes as values, bytes as a file, and the end where a property does not hold.
namespace tripoint::fuzz {

/// A property that must hold of every input. @param what it is, for the crash's report
inline void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Under the fuzzer toml++ runs without the child that takes its known faults, which need a letter beyond
/// ASCII (docs/fuzz.md).
inline constexpr bool parser_has_no_child() {
#if defined(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
  return true;
#else
  return false;
#endif
}
inline bool is_ascii(const std::uint8_t* data, std::size_t size) {
  return std::all_of(data, data + size, [](std::uint8_t c) { return c < 128; });
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder for the input as a file, gone at the end.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tripoint-fuzz-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  /// Writes a file of this name. @return its path
  std::string write(const std::string& name, const std::string& bytes) const {
    const std::string path = (path_ / name).string();
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Values taken from the front of the input; when it is used up, zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  [[nodiscard]] bool empty() const { return at_ == end_; }
  std::uint8_t byte() { return at_ == end_ ? std::uint8_t{0} : *at_++; }
  bool flag() { return byte() & 1; }
  /// 0 .. below - 1; 1 <= below <= 256
  unsigned one_of(unsigned below) { return byte() % below; }
  /// Any bits, so also inf, NaN, denormal; every second one a plain number.
  double real() {
    if (flag()) return (static_cast<double>(byte()) - 128.0) / 16.0;
    double value = 0.0;
    std::uint8_t bits[sizeof value];
    for (auto& b : bits) b = byte();
    std::memcpy(&value, bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t *at_, *end_;
};

}  // namespace tripoint::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
