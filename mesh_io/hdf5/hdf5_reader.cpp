// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <new>
#include <tuple>
#include <utility>

#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

// HDF5 takes the bytes of a file through these, and copies none: each call gives the one place where they are.
void* same_bytes(std::size_t, H5FD_file_image_op_t, void* bytes) {
  return bytes;
}
void* copy_nothing(void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) {
  return to;
}
void* never_grow(void*, std::size_t, H5FD_file_image_op_t, void*) {
  return nullptr;
}
herr_t keep_bytes(void*, H5FD_file_image_op_t, void*) {
  return 0;
}
void* same_data(void* data) {
  return data;
}
herr_t keep_data(void*) {
  return 0;
}

Hdf5Handle open_bytes(std::string_view bytes) {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  // Only read: HDF5 asks for memory that could be written to.
  void* const place = const_cast<char*>(bytes.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  H5FD_file_image_callbacks_t callbacks{&same_bytes, &copy_nothing, &never_grow, &keep_bytes,
                                        &same_data,  &keep_data,    place};
  if (H5Pset_fapl_core(access.get(), std::size_t{1} << 16, false) < 0 ||
      H5Pset_file_image_callbacks(access.get(), &callbacks) < 0 ||
      H5Pset_file_image(access.get(), place, bytes.size()) < 0) {
    return {};
  }
  // Files of one name are one file to HDF5.
  static std::atomic<std::uint64_t> opened{0};
  return {H5Fopen(("trismooth bytes " + std::to_string(opened++)).c_str(), H5F_ACC_RDONLY, access.get()), &H5Fclose};
}

/// One of the ordinary types, in either order of bytes: of others, which damaged files describe, HDF5's conversions
/// make anything.
std::optional<ScalarType> number_type(hid_t type) {
  const std::array types{
      std::tuple(ScalarType::int8, H5T_STD_I8LE, H5T_STD_I8BE),
      std::tuple(ScalarType::uint8, H5T_STD_U8LE, H5T_STD_U8BE),
      std::tuple(ScalarType::int16, H5T_STD_I16LE, H5T_STD_I16BE),
      std::tuple(ScalarType::uint16, H5T_STD_U16LE, H5T_STD_U16BE),
      std::tuple(ScalarType::int32, H5T_STD_I32LE, H5T_STD_I32BE),
      std::tuple(ScalarType::uint32, H5T_STD_U32LE, H5T_STD_U32BE),
      std::tuple(ScalarType::int64, H5T_STD_I64LE, H5T_STD_I64BE),
      std::tuple(ScalarType::uint64, H5T_STD_U64LE, H5T_STD_U64BE),
      std::tuple(ScalarType::float32, H5T_IEEE_F32LE, H5T_IEEE_F32BE),
      std::tuple(ScalarType::float64, H5T_IEEE_F64LE, H5T_IEEE_F64BE),
  };
  for (const auto& [number, little, big] : types) {
    if (H5Tequal(type, little) > 0 || H5Tequal(type, big) > 0) {
      return number;
    }
  }
  return std::nullopt;
}

bool is_real(ScalarType type) {
  return type == ScalarType::float32 || type == ScalarType::float64;
}

/// Without the zeros that end it, or the blanks that fill it up.
std::string trimmed(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  while (text.ends_with(' ')) {
    text.remove_suffix(1);
  }
  return std::string(text);
}

/// Deflate, which compresses most of what files use, makes at most so many bytes of one.
constexpr std::uint64_t most_bytes_of_one = 1040;
/// More texts of any length than an attribute has.
constexpr std::uint64_t most_attribute_texts = 4096;

}  // namespace

/// A dataset or an attribute that is open.
struct Hdf5Reader::Source {
  std::string name;  ///< for messages
  Hdf5Handle handle;
  Hdf5Handle type;
  Hdf5Shape shape;
  bool is_attribute = false;

  bool read(hid_t memory_type, void* values) const {
    return (is_attribute ? H5Aread(handle.get(), memory_type, values)
                         : H5Dread(handle.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values)) >= 0;
  }
};

std::uint64_t Hdf5Shape::count() const {
  std::uint64_t product = 1;
  for (const std::uint64_t extent : extents) {
    product = saturating_product(product, extent);
  }
  return product;
}

Hdf5Reader::Hdf5Reader(std::filesystem::path file, std::string_view bytes) : file_(std::move(file)), bytes_(bytes) {
  const Hdf5Lock lock;
  if (!bytes.empty()) {
    handle_ = open_bytes(bytes);
  }
  if (!handle_.is_valid()) {
    throw ReadError(file_, "is no whole HDF5 file" + hdf5_reason());
  }
}

Hdf5Reader::~Hdf5Reader() {
  const Hdf5Lock lock;
  handle_.close();
}

void Hdf5Reader::fail(const std::string& object, const std::string& message) const {
  throw ReadError(file_, quoted(std::string_view(object)) + " " + message);
}

Hdf5Handle Hdf5Reader::open(const std::string& object) const {
  Hdf5Handle at(H5Gopen2(handle_.get(), "/", H5P_DEFAULT), &H5Gclose);
  for (std::size_t begin = 0; begin < object.size() && at.is_valid();) {
    const std::size_t end = std::min(object.find('/', begin), object.size());
    const std::string name = object.substr(begin, end - begin);
    begin = end + 1;
    if (name.empty()) {
      continue;
    }
    H5L_info_t link;
    if (H5Iget_type(at.get()) != H5I_GROUP || H5Lexists(at.get(), name.c_str(), H5P_DEFAULT) <= 0 ||
        H5Lget_info(at.get(), name.c_str(), &link, H5P_DEFAULT) < 0) {
      return {};
    }
    if (link.type != H5L_TYPE_HARD) {
      fail(object, "leads through " + quoted(std::string_view(name)) +
                       ", a link, which is not followed: 'h5repack' or a copy makes one file without links of it");
    }
    at = Hdf5Handle(H5Oopen(at.get(), name.c_str(), H5P_DEFAULT), &H5Oclose);
  }
  return at;
}

std::vector<Hdf5Member> Hdf5Reader::members(const std::string& group) const {
  const Hdf5Lock lock;
  const Hdf5Handle at = open(group);
  if (!at.is_valid() || H5Iget_type(at.get()) != H5I_GROUP) {
    fail(group, "is no group of the file");
  }
  const Hdf5Handle properties(H5Gget_create_plist(at.get()), &H5Pclose);
  unsigned order = 0;
  H5Pget_link_creation_order(properties.get(), &order);
  std::vector<Hdf5Member> found;
  const auto add = [](hid_t, const char* name, const H5L_info_t* link, void* data) -> herr_t {
    try {
      static_cast<std::vector<Hdf5Member>*>(data)->push_back(
          {name, link->type == H5L_TYPE_HARD ? Hdf5Kind::other : Hdf5Kind::link});
      return 0;
    } catch (const std::bad_alloc&) {
      return -1;
    }
  };
  if (H5Literate(at.get(), (order & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME, H5_ITER_INC,
                 nullptr, add, &found) < 0) {
    fail(group, "cannot be listed" + hdf5_reason());
  }
  for (Hdf5Member& member : found) {
    if (member.kind != Hdf5Kind::link) {
      const Hdf5Handle object(H5Oopen(at.get(), member.name.c_str(), H5P_DEFAULT), &H5Oclose);
      const H5I_type_t type = object.is_valid() ? H5Iget_type(object.get()) : H5I_BADID;
      member.kind = type == H5I_GROUP ? Hdf5Kind::group : type == H5I_DATASET ? Hdf5Kind::dataset : Hdf5Kind::other;
    }
  }
  return found;
}

std::optional<Hdf5Kind> Hdf5Reader::kind_of(const std::string& object) const {
  const Hdf5Lock lock;
  const Hdf5Handle at = open(object);
  if (!at.is_valid()) {
    return std::nullopt;
  }
  const H5I_type_t type = H5Iget_type(at.get());
  return type == H5I_GROUP ? Hdf5Kind::group : type == H5I_DATASET ? Hdf5Kind::dataset : Hdf5Kind::other;
}

namespace {

Hdf5Shape shape_in(hid_t type, hid_t space) {
  Hdf5Shape shape;
  shape.type = number_type(type);
  shape.is_text = H5Tget_class(type) == H5T_STRING;
  if (H5Sget_simple_extent_type(space) == H5S_NULL) {
    shape.extents = {0};
    return shape;
  }
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extents(static_cast<std::size_t>(std::max(rank, 0)));
  H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  shape.extents.assign(extents.begin(), extents.end());
  return shape;
}

}  // namespace

Hdf5Reader::Source Hdf5Reader::open_dataset(const std::string& dataset) const {
  Source source{dataset, open(dataset), {}, {}, false};
  if (!source.handle.is_valid() || H5Iget_type(source.handle.get()) != H5I_DATASET) {
    fail(dataset, "is no dataset of the file");
  }
  source.type = Hdf5Handle(H5Dget_type(source.handle.get()), &H5Tclose);
  const Hdf5Handle space(H5Dget_space(source.handle.get()), &H5Sclose);
  if (!source.type.is_valid() || !space.is_valid()) {
    fail(dataset, "cannot be read" + hdf5_reason());
  }
  source.shape = shape_in(source.type.get(), space.get());
  return source;
}

Hdf5Reader::Source Hdf5Reader::open_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle at = open(object);
  Source source{object + ":" + name, {}, {}, {}, true};
  if (at.is_valid() && H5Aexists(at.get(), name.c_str()) > 0) {
    source.handle = Hdf5Handle(H5Aopen(at.get(), name.c_str(), H5P_DEFAULT), &H5Aclose);
  }
  if (!source.handle.is_valid()) {
    fail(source.name, "is no attribute of the file");
  }
  source.type = Hdf5Handle(H5Aget_type(source.handle.get()), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(source.handle.get()), &H5Sclose);
  if (!source.type.is_valid() || !space.is_valid()) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  source.shape = shape_in(source.type.get(), space.get());
  return source;
}

void Hdf5Reader::require_numbers(const Source& source, ScalarType type) const {
  if (!source.shape.type) {
    fail(source.name, "holds no numbers of a type that is read");
  }
  if (is_real(*source.shape.type) && !is_real(type)) {
    fail(source.name, "holds " + std::string(to_string(*source.shape.type)) + ", where whole numbers are expected");
  }
  require_bytes(source);
}

void Hdf5Reader::require_bytes(const Source& source) const {
  const std::uint64_t wanted = saturating_product(source.shape.count(), H5Tget_size(source.type.get()));
  if (source.is_attribute) {
    if (wanted > bytes_.size()) {
      fail(source.name, "declares more than the file holds");
    }
    return;
  }
  const Hdf5Handle properties(H5Dget_create_plist(source.handle.get()), &H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(properties.get());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(properties.get()) > 0) {
    fail(source.name, "is kept in other files, which are not read: 'h5repack' makes one file of them");
  }
  const std::uint64_t stored = std::min<std::uint64_t>(H5Dget_storage_size(source.handle.get()), bytes_.size());
  const bool is_filtered = layout == H5D_CHUNKED && H5Pget_nfilters(properties.get()) > 0;
  const std::uint64_t most = is_filtered ? saturating_product(most_bytes_of_one, stored) : stored;
  // A chunk at the edge is as large as all others, and taken to memory as a whole.
  std::uint64_t chunk = 0;
  if (layout == H5D_CHUNKED) {
    std::vector<hsize_t> extents(source.shape.extents.size());
    H5Pget_chunk(properties.get(), static_cast<int>(extents.size()), extents.data());
    chunk = H5Tget_size(source.type.get());
    for (const hsize_t extent : extents) {
      chunk = saturating_product(chunk, extent);
    }
  }
  if (wanted > 0 && std::max(wanted, chunk) > most) {
    fail(source.name, "declares " + std::to_string(source.shape.count()) + " values, more than the " +
                          std::to_string(stored) + " bytes that the file has of them can hold");
  }
}

void Hdf5Reader::read_numbers(const Source& source, ScalarType type, void* values) const {
  if (source.shape.count() > 0 && !source.read(hdf5_memory_type(type), values)) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
}

std::vector<std::string> Hdf5Reader::read_texts_of(const Source& source) const {
  if (!source.shape.is_text) {
    fail(source.name, "holds no texts");
  }
  require_bytes(source);
  const auto count = static_cast<std::size_t>(source.shape.count());
  std::vector<std::string> texts(count);
  if (count == 0) {
    return texts;
  }
  if (H5Tis_variable_str(source.type.get()) <= 0) {
    const std::size_t size = H5Tget_size(source.type.get());
    std::string all(count * size, '\0');
    if (!source.read(source.type.get(), all.data())) {
      fail(source.name, "cannot be read" + hdf5_reason());
    }
    for (std::size_t i = 0; i < count; ++i) {
      texts[i] = trimmed(std::string_view(all).substr(i * size, size));
    }
    return texts;
  }
  // Texts of any length lie in one heap, and many may be the same one.
  const Hdf5Handle space(source.is_attribute ? H5Aget_space(source.handle.get()) : H5Dget_space(source.handle.get()),
                         &H5Sclose);
  hsize_t wanted = 0;
  if (source.is_attribute ? count > most_attribute_texts
                          : H5Dvlen_get_buf_size(source.handle.get(), source.type.get(), space.get(), &wanted) < 0 ||
                                wanted > saturating_product(16, bytes_.size())) {
    fail(source.name, "declares more text than the file holds");
  }
  std::vector<char*> read(count, nullptr);
  if (!source.read(source.type.get(), static_cast<void*>(read.data()))) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  for (std::size_t i = 0; i < count; ++i) {
    texts[i] = read[i] == nullptr ? std::string() : trimmed(read[i]);
  }
  H5Dvlen_reclaim(source.type.get(), space.get(), H5P_DEFAULT, static_cast<void*>(read.data()));
  return texts;
}

Hdf5Shape Hdf5Reader::shape_of(const std::string& dataset) const {
  const Hdf5Lock lock;
  return open_dataset(dataset).shape;
}

template <class T>
std::vector<T> Hdf5Reader::read(const std::string& dataset) const {
  const Hdf5Lock lock;
  const Source source = open_dataset(dataset);
  require_numbers(source, scalar_type_of<T>());
  std::vector<T> values(static_cast<std::size_t>(source.shape.count()));
  read_numbers(source, scalar_type_of<T>(), values.data());
  return values;
}

DataArray Hdf5Reader::read_array(const std::string& dataset, std::string name, std::size_t components) const {
  const Hdf5Shape shape = shape_of(dataset);
  return visit_scalar_type(shape.type.value_or(ScalarType::float64), [&](auto number) {
    return make_data_array(std::move(name), components, read<decltype(number)>(dataset));
  });
}

std::string Hdf5Reader::read_bytes(const std::string& dataset) const {
  const Hdf5Lock lock;
  const Source source = open_dataset(dataset);
  // Of others memory holds addresses.
  if (H5Tdetect_class(source.type.get(), H5T_VLEN) != 0 || H5Tdetect_class(source.type.get(), H5T_REFERENCE) != 0 ||
      (source.shape.is_text && H5Tis_variable_str(source.type.get()) != 0)) {
    fail(dataset, "holds values of a type that is not read");
  }
  require_bytes(source);
  std::string bytes(static_cast<std::size_t>(source.shape.count()) * H5Tget_size(source.type.get()), '\0');
  if (!bytes.empty() && !source.read(source.type.get(), bytes.data())) {
    fail(dataset, "cannot be read" + hdf5_reason());
  }
  return bytes;
}

std::vector<std::string> Hdf5Reader::read_texts(const std::string& dataset) const {
  const Hdf5Lock lock;
  return read_texts_of(open_dataset(dataset));
}

std::vector<std::string> Hdf5Reader::attribute_names(const std::string& object) const {
  const Hdf5Lock lock;
  const Hdf5Handle at = open(object);
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    try {
      static_cast<std::vector<std::string>*>(data)->emplace_back(name);
      return 0;
    } catch (const std::bad_alloc&) {
      return -1;
    }
  };
  if (!at.is_valid() || H5Aiterate2(at.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names) < 0) {
    fail(object, "has no attributes that can be listed");
  }
  return names;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Lock lock;
  const Hdf5Handle at = open(object);
  return at.is_valid() && H5Aexists(at.get(), name.c_str()) > 0;
}

Hdf5Shape Hdf5Reader::attribute_shape(const std::string& object, const std::string& name) const {
  const Hdf5Lock lock;
  return open_attribute(object, name).shape;
}

template <class T>
std::vector<T> Hdf5Reader::read_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Lock lock;
  const Source source = open_attribute(object, name);
  require_numbers(source, scalar_type_of<T>());
  std::vector<T> values(static_cast<std::size_t>(source.shape.count()));
  read_numbers(source, scalar_type_of<T>(), values.data());
  return values;
}

std::vector<std::string> Hdf5Reader::read_attribute_texts(const std::string& object, const std::string& name) const {
  const Hdf5Lock lock;
  return read_texts_of(open_attribute(object, name));
}

bool is_hdf5_with(std::string_view bytes, const std::string& object) {
  using namespace std::string_view_literals;
  // Behind a block of a program's own, which has some power of two of bytes.
  constexpr std::size_t first_place = 512;
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n"sv;
  for (std::size_t at = 0; at < bytes.size(); at = std::max(first_place, 2 * at)) {
    if (bytes.substr(at).starts_with(signature)) {
      try {
        return Hdf5Reader({}, bytes).kind_of(object).has_value();
      } catch (const ReadError&) {
        return false;
      }
    }
  }
  return false;
}

#define TRISMOOTH_HDF5_READ(T)                                                \
  template std::vector<T> Hdf5Reader::read(const std::string& dataset) const; \
  template std::vector<T> Hdf5Reader::read_attribute(const std::string& object, const std::string& name) const;
TRISMOOTH_HDF5_READ(std::int8_t)
TRISMOOTH_HDF5_READ(std::uint8_t)
TRISMOOTH_HDF5_READ(std::int16_t)
TRISMOOTH_HDF5_READ(std::uint16_t)
TRISMOOTH_HDF5_READ(std::int32_t)
TRISMOOTH_HDF5_READ(std::uint32_t)
TRISMOOTH_HDF5_READ(std::int64_t)
TRISMOOTH_HDF5_READ(std::uint64_t)
TRISMOOTH_HDF5_READ(float)
TRISMOOTH_HDF5_READ(double)
#undef TRISMOOTH_HDF5_READ

}  // namespace trismooth
