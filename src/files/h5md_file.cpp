// SPDX-License-Identifier: BSD-3-Clause
#include "files/h5md_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>

#include "core/errors.hpp"
#include "files/ordered_file.hpp"

namespace tripoint::h5 {
namespace {

// 16 GiB of doubles: a file that claims more is refused
constexpr std::size_t greatest_elements = std::size_t{1} << 31;

hid_t native(Type type) {
  return type == Type::float64 ? H5T_NATIVE_DOUBLE
         : type == Type::int32 ? H5T_NATIVE_INT32
                               : H5T_NATIVE_INT64;
}

void set_fill_value(hid_t properties, Type type) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const long long none = -1;
  if (type == Type::float64)
    check(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &nan), "fill value");
  else
    check(H5Pset_fill_value(properties, H5T_NATIVE_LLONG, &none), "fill value");
}

/// A dataset of this very file: neither a link out of it nor raw data kept elsewhere.
Handle open_own_dataset(hid_t file, const std::string& path, const std::string& name_of_file) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    H5L_info_t link;
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) throw InputError(name_of_file + ": has no " + part);
    check(H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT), part);
    if (link.type != H5L_TYPE_HARD)
      throw InputError(name_of_file + ": " + part + " is a link; links are refused");
    if (end == std::string::npos) break;
  }
  const hid_t id = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  if (id < 0) throw InputError(name_of_file + ": " + path + " is no dataset");
  Handle dataset(id, H5Dclose, path);
  const Handle properties(H5Dget_create_plist(dataset.get()), H5Pclose, path);
  if (H5Pget_external_count(properties.get()) > 0 || H5Pget_layout(properties.get()) == H5D_VIRTUAL)
    throw InputError(name_of_file + ": " + path + " keeps its data in another file; refused");
  return dataset;
}

std::vector<std::size_t> shape_of(hid_t dataset, const std::string& what) {
  const Handle space(H5Dget_space(dataset), H5Sclose, what);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1 || rank > 3)
    throw InputError(what + ": has " + std::to_string(rank) + " dimensions, expected 1 to 3");
  hsize_t dims[3] = {1, 1, 1};
  H5Sget_simple_extent_dims(space.get(), dims, nullptr);
  std::size_t total = 1;
  for (int k = 0; k < rank; ++k) {
    if (dims[k] > greatest_elements || (dims[k] > 0 && total > greatest_elements / dims[k]))
      throw InputError(what + ": is absurdly large; refused");
    total *= dims[k];
  }
  return {dims, dims + rank};
}

/// A small file can claim a great dataset: parts never written read as fill values, and zeros pack a
/// thousandfold.
void refuse_bombs(hid_t dataset, const std::vector<std::size_t>& shape, const std::string& what) {
  constexpr double harmless = 1e9, packed = 64.0;  // [bytes], and as dense as particles ever pack
  double bytes = 8.0;
  for (const std::size_t s : shape) bytes *= static_cast<double>(s);
  if (bytes > harmless && bytes > packed * static_cast<double>(H5Dget_storage_size(dataset)))
    throw InputError(what + ": claims far more than the file holds; refused");
}

std::size_t count(const std::vector<std::size_t>& shape) {
  std::size_t n = 1;
  for (const std::size_t s : shape) n *= s;
  return n;
}

/// All frames at once; where that fails, frame by frame up to the first that is torn, which may be the first
/// of all.
template <class T>
void read_whole_frames(hid_t dataset, hid_t type, std::vector<std::size_t>& shape, std::vector<T>& values,
                       const std::string& what, bool may_be_none) {
  values.resize(count(shape));
  if (values.empty() || H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0) return;
  const std::size_t frames = shape[0], row = values.size() / frames;
  hsize_t start[3] = {0, 0, 0}, size[3] = {1, 1, 1};
  for (std::size_t k = 1; k < shape.size(); ++k) size[k] = shape[k];
  const Handle file_space(H5Dget_space(dataset), H5Sclose, what),
      memory(H5Screate_simple(static_cast<int>(shape.size()), size, nullptr), H5Sclose, what);
  for (shape[0] = 0; shape[0] < frames; ++shape[0]) {
    start[0] = shape[0];
    check(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start, nullptr, size, nullptr), what);
    if (H5Dread(dataset, type, memory.get(), file_space.get(), H5P_DEFAULT, values.data() + shape[0] * row) <
        0)
      break;
  }
  values.resize(shape[0] * row);
  if (shape[0] == 0 && !may_be_none)
    throw InputError(what + ": cannot be read (torn, or a checksum does not match)");
}

void expect_class(hid_t dataset, H5T_class_t wanted, const std::string& what) {
  const Handle type(H5Dget_type(dataset), H5Tclose, what);
  if (H5Tget_class(type.get()) != wanted)
    throw InputError(what + ": is of the wrong type, expected " +
                     (wanted == H5T_FLOAT ? "floating point" : "integers"));
}

/// The attribute `unit` of a dataset; empty where it has none, or one that is no text.
std::string unit_of(hid_t dataset, const std::string& what) {
  if (H5Aexists(dataset, "unit") <= 0) return "";
  const Handle attribute(H5Aopen(dataset, "unit", H5P_DEFAULT), H5Aclose, what);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose, what);
  if (H5Tget_class(type.get()) != H5T_STRING) return "";
  if (H5Tis_variable_str(type.get()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.get(), type.get(), static_cast<void*>(&text)) < 0 || text == nullptr) return "";
    const std::string unit = text;
    H5free_memory(text);
    return unit;
  }
  std::string text(std::min<std::size_t>(H5Tget_size(type.get()), 256), '\0');
  if (text.size() != H5Tget_size(type.get()) || H5Aread(attribute.get(), type.get(), text.data()) < 0)
    return "";
  return text.c_str();
}

/// errno of the system call that failed. The library writes it into the text of its last error, innermost
/// first, and so does io/ordered_file.cpp. @return 0 where no such call failed
int errno_of_last_error() {
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    constexpr std::string_view key = "errno = ";
    const std::string_view words = error->desc ? error->desc : "";
    const std::size_t at = words.rfind(key);  // the name of a file comes before it
    if (at == std::string_view::npos) return 0;
    *static_cast<int*>(found) = std::atoi(words.data() + at + key.size());
    return 1;
  };
  int why = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &why);
  return why;
}

}  // namespace

Handle::Handle(hid_t id, Closer closer, const std::string& what) : id_(id), closer_(closer) {
  if (id >= 0) return;
  const int why = errno_of_last_error();
  throw EngineError(
      what + (why != 0 ? std::string(": ") + std::strerror(why) : ": HDF5 refused (damaged, or a link?)"));
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, -1);
    closer_ = other.closer_;
  }
  return *this;
}

void Handle::reset() noexcept {
  if (id_ >= 0) closer_(id_);
  id_ = -1;
}

void Handle::close(const std::string& what) {
  if (id_ >= 0) check(closer_(std::exchange(id_, -1)), what);
}

void check(herr_t status, const std::string& what) {
  if (status >= 0) return;
  const int why = errno_of_last_error();
  throw EngineError(what + (why != 0 ? std::string(": cannot be written: ") + std::strerror(why)
                                     : ": HDF5 could not write"));
}

Column::Column(hid_t group, const std::string& name, Type type, std::size_t rows, std::size_t width,
               const std::string& unit)
    : name_(name),
      type_(type),
      rows_(rows),
      width_(width),
      rank_(width > 0                                         ? 3
            : rows == std::numeric_limits<std::size_t>::max() ? 1
                                                              : 2) {
  if (rank_ == 1) rows_ = 0;
  const hsize_t dims[3] = {0, rows_, width_};
  const hsize_t limits[3] = {H5S_UNLIMITED, H5S_UNLIMITED, width_};
  // One frame: a frame half written then spoils no other
  const hsize_t chunk[3] = {1, std::max<hsize_t>(rows_, 1), width_};
  const Handle space(H5Screate_simple(rank_, dims, limits), H5Sclose, name);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  check(H5Pset_chunk(properties.get(), rank_, chunk), name);
  check(H5Pset_fletcher32(properties.get()), name);
  set_fill_value(properties.get(), type);
  dataset_ = Handle(
      H5Dcreate2(group, name.c_str(), native(type), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      H5Dclose, name);
  if (!unit.empty()) write_text_attribute(dataset_.get(), "unit", unit);
}

void Column::append(std::size_t frame, std::size_t rows, const void* data) {
  rows_ = std::max(rows_, rows);
  const hsize_t extent[3] = {frame + 1, rows_, width_};
  check(H5Dset_extent(dataset_.get(), extent), name_);
  if (rank_ > 1 && rows == 0) return;
  const Handle space(H5Dget_space(dataset_.get()), H5Sclose, name_);
  const hsize_t start[3] = {frame, 0, 0}, size[3] = {1, rows, width_};
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start, nullptr, size, nullptr), name_);
  const Handle memory(H5Screate_simple(rank_, size, nullptr), H5Sclose, name_);
  check(H5Dwrite(dataset_.get(), native(type_), memory.get(), space.get(), H5P_DEFAULT, data), name_);
}

Handle make_group(hid_t parent, const std::string& path) {
  const Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose, path);
  check(H5Pset_create_intermediate_group(properties.get(), 1), path);
  return {H5Gcreate2(parent, path.c_str(), properties.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path};
}

namespace {

/// The type is UTF-8 of variable length: Python's readers take a string of fixed length for bytes.
void write_texts(hid_t object, const std::string& name, const Handle& space, const char* const* texts) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  check(H5Tset_size(type.get(), H5T_VARIABLE), name);
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), name);
  const Handle attribute(H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, name);
  check(H5Awrite(attribute.get(), type.get(), static_cast<const void*>(texts)), name);
}

}  // namespace

void write_text_attribute(hid_t object, const std::string& name, const std::string& text) {
  const char* const one = text.c_str();
  write_texts(object, name, Handle(H5Screate(H5S_SCALAR), H5Sclose, name), &one);
}

void write_text_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts) {
  std::vector<const char*> all;
  for (const std::string& text : texts) all.push_back(text.c_str());
  const hsize_t count = all.size();
  write_texts(object, name, Handle(H5Screate_simple(1, &count, nullptr), H5Sclose, name), all.data());
}

void write_whole_attribute(hid_t object, const std::string& name, const std::vector<int>& values) {
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  const Handle attribute(
      H5Acreate2(object, name.c_str(), H5T_NATIVE_INT, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      name);
  check(H5Awrite(attribute.get(), H5T_NATIVE_INT, values.data()), name);
}

bool has(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

bool is_linked_to_one(hid_t file, const std::string& a, const std::string& b) {
  H5L_info_t one, other;
  if (H5Lget_info(file, a.c_str(), &one, H5P_DEFAULT) < 0 ||
      H5Lget_info(file, b.c_str(), &other, H5P_DEFAULT) < 0)
    return false;
  return one.type == H5L_TYPE_HARD && other.type == H5L_TYPE_HARD && one.u.address == other.u.address;
}

std::vector<std::size_t> shape(hid_t file, const std::string& path, const std::string& name_of_file) {
  return shape_of(open_own_dataset(file, path, name_of_file).get(), name_of_file + ": " + path);
}

Block read_real(hid_t file, const std::string& path, const std::string& name_of_file, bool may_be_none) {
  const std::string what = name_of_file + ": " + path;
  const Handle dataset = open_own_dataset(file, path, name_of_file);
  expect_class(dataset.get(), H5T_FLOAT, what);
  Block block;
  block.shape = shape_of(dataset.get(), what);
  block.unit = unit_of(dataset.get(), what);
  refuse_bombs(dataset.get(), block.shape, what);
  read_whole_frames(dataset.get(), H5T_NATIVE_DOUBLE, block.shape, block.real, what, may_be_none);
  return block;
}

Block read_whole(hid_t file, const std::string& path, const std::string& name_of_file, bool may_be_none) {
  const std::string what = name_of_file + ": " + path;
  const Handle dataset = open_own_dataset(file, path, name_of_file);
  expect_class(dataset.get(), H5T_INTEGER, what);
  Block block;
  block.shape = shape_of(dataset.get(), what);
  refuse_bombs(dataset.get(), block.shape, what);
  read_whole_frames(dataset.get(), H5T_NATIVE_INT, block.shape, block.whole, what, may_be_none);
  return block;
}

std::vector<std::string> members(hid_t file, const std::string& path) {
  std::vector<std::string> names;
  if (!has(file, path)) return names;
  const Handle group(H5Gopen2(file, path.c_str(), H5P_DEFAULT), H5Gclose, path);
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  // Uses the file's own order. Where a read fails, the library frees the table of a sorted order before it
  // has filled it.
  if (H5Literate(group.get(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names) < 0)
    throw InputError("the group " + path + " of an HDF5 file cannot be read");
  std::ranges::sort(names);
  return names;
}

namespace {

/// A file names the filters of its data by number. For a number that it does not know the library would load
/// a shared object from HDF5_PLUGIN_PATH or its own folder, and run it. Done at each opening, since another
/// user of the library may ask for more.
void load_no_plugins() { check(H5PLset_loading_state(0), "HDF5: its plugins cannot be switched off"); }

/// On the way to a dataset the library would open whatever file a link names.
void follow_no_links_into_other_files() {
  static const herr_t no_such_links = H5Lunregister(H5L_TYPE_EXTERNAL);
  static_cast<void>(no_such_links);
}

/// Opens without HDF5's lock on the file. A process just started holds a copy of every open file, and the
/// lock with it, until it runs its own program. A file closed here would for a moment be refused to the next
/// that opens it.
Handle unlocked_access(const std::string& path) {
  static const herr_t no_clean_up_at_exit =
      H5dont_atexit();  // it ends by a signal where a file could not be written; handles close their files
  static_cast<void>(no_clean_up_at_exit);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  load_no_plugins();
  follow_no_links_into_other_files();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path);
  H5Pset_file_locking(access.get(), false, true);
  return access;
}

}  // namespace

Handle open_for_reading(const std::string& path) {
  const Handle access = unlocked_access(path);
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  if (id < 0) throw InputError(path + ": is no readable HDF5 file");
  return {id, H5Fclose, path};
}

Handle open_for_change(const std::string& path) {
  const Handle access = unlocked_access(path);
  return {H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose, path};
}

Handle create_file(const std::string& path) {
  const Handle access = unlocked_access(path);
  write_in_order(access.get());
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose, path};
}

Handle create_latest(const std::string& path, std::size_t user_block) {
  const Handle access = unlocked_access(path);
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST), path);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, path);
  check(H5Pset_userblock(creation.get(), user_block), path);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, path};
}

}  // namespace tripoint::h5
