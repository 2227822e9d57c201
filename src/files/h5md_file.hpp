// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <hdf5.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/vec3.hpp"

/// The HDF5 calls behind trajectories: handles that close themselves, growing datasets, bounded reads. For
/// src/files only.
namespace tripoint::h5 {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "a Vec3 column is an n x 3 array");

/// Owns an HDF5 id. @throws EngineError in the constructor, with the system's reason, when the call that made
/// the id failed
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer, const std::string& what);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }
  void reset() noexcept;
  /// The library writes its remaining data when it closes: where that fails, reset() would not say so.
  /// @throws EngineError as above
  void close(const std::string& what);
  [[nodiscard]] hid_t get() const noexcept { return id_; }
  [[nodiscard]] explicit operator bool() const noexcept { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

/// Called at once after a call of the library. @throws EngineError with the system's reason when status < 0
void check(herr_t status, const std::string& what);

enum class Type { float64, int32, int64 };

/// A dataset that grows by one frame at a time. Its shape is frames x rows x width (width 0: frames x rows;
/// rows 0 as well: frames).
class Column {
 public:
  /// Rows that are not written hold NaN (or -1 for integers). The unit, if any, is an attribute of the
  /// dataset.
  Column(hid_t group, const std::string& name, Type type, std::size_t rows, std::size_t width,
         const std::string& unit);
  /// Appends frame number `frame` of `rows` rows; earlier frames keep their rows, missing ones read as NaN or
  /// -1.
  void append(std::size_t frame, std::size_t rows, const void* data);
  [[nodiscard]] hid_t id() const noexcept { return dataset_.get(); }

 private:
  Handle dataset_;
  std::string name_;
  Type type_;
  std::size_t rows_, width_;
  int rank_;
};

/// Opens or makes a group below `parent`, intermediate groups too.
[[nodiscard]] Handle make_group(hid_t parent, const std::string& path);
void write_text_attribute(hid_t object, const std::string& name, const std::string& text);
void write_text_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);
void write_whole_attribute(hid_t object, const std::string& name, const std::vector<int>& values);

/// Values of a dataset with its shape, as double or int. @throws InputError: missing, linked to another file,
/// of another type or absurdly large
struct Block {
  /// shape[0] counts whole frames: one that a killed writer left torn ends the block
  std::vector<std::size_t> shape;
  std::vector<double> real;
  std::vector<int> whole;
  std::string unit;  ///< of real values, as the file says; "" where it says none
};
[[nodiscard]] bool has(hid_t file, const std::string& path);
/// Whether two paths are hard links to one object: its values need not be read twice.
[[nodiscard]] bool is_linked_to_one(hid_t file, const std::string& a, const std::string& b);
/// Extents of a dataset. @throws InputError where it is none of this file
[[nodiscard]] std::vector<std::size_t> shape(hid_t file, const std::string& path,
                                             const std::string& name_of_file);
/// @throws InputError also when not even the first frame is whole
/// @param may_be_none a first frame that cannot be read is no error: there is none, as where a writer was
/// killed within it
[[nodiscard]] Block read_real(hid_t file, const std::string& path, const std::string& name_of_file,
                              bool may_be_none = false);
[[nodiscard]] Block read_whole(hid_t file, const std::string& path, const std::string& name_of_file,
                               bool may_be_none = false);
/// Names of the members of a group, sorted; empty when the group is not there.
[[nodiscard]] std::vector<std::string> members(hid_t file, const std::string& path);
/// @throws InputError when it is no readable HDF5 file
[[nodiscard]] Handle open_for_reading(const std::string& path);
[[nodiscard]] Handle open_for_change(const std::string& path);
/// When a writer is killed, all frames flushed before stay readable (io/ordered_file.hpp).
[[nodiscard]] Handle create_file(const std::string& path);
/// Creates a file of the library's latest format, whose own structures carry checksums, after `user_block`
/// bytes left free.
[[nodiscard]] Handle create_latest(const std::string& path, std::size_t user_block);

}  // namespace tripoint::h5
