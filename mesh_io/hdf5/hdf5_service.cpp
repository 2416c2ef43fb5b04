// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_service.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"
#include "trismooth/mesh_io/hdf5/hdf5_image.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

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

/// A dataset or an attribute that is open.
struct Hdf5Source {
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

Hdf5Kind kind_at(const Hdf5Handle& object) {
  const H5I_type_t type = object.is_valid() ? H5Iget_type(object.get()) : H5I_BADID;
  return type == H5I_GROUP ? Hdf5Kind::group : type == H5I_DATASET ? Hdf5Kind::dataset : Hdf5Kind::other;
}

/// Values of a chunk, of a dataset that has them; else 0. One at the edge is as large as all others, and taken to
/// memory as a whole.
std::uint64_t chunk_values(hid_t properties, std::size_t rank) {
  if (H5Pget_layout(properties) != H5D_CHUNKED) {
    return 0;
  }
  std::vector<hsize_t> extents(rank);
  H5Pget_chunk(properties, static_cast<int>(rank), extents.data());
  return std::accumulate(extents.begin(), extents.end(), std::uint64_t{1}, &saturating_product);
}

class Hdf5Service {
 public:
  explicit Hdf5Service(std::string_view bytes) : bytes_(bytes), image_(bytes) {
    if (!bytes.empty()) {
      handle_ = image_.open();
    }
    if (!handle_.is_valid()) {
      throw Hdf5Refusal("is no whole HDF5 file" + hdf5_reason());
    }
  }

  std::string answer(Hdf5MessageReader request) const;

 private:
  [[noreturn]] static void fail(const std::string& object, const std::string& message) {
    throw Hdf5Refusal(quoted(std::string_view(object)) + " " + message);
  }

  Hdf5Handle open(const std::string& object) const {
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
        fail(object,
             "leads through " + quoted(std::string_view(name)) +
                 ", a link, which is not followed: 'h5repack --merge in.h5 out.h5' makes a file without links of it");
      }
      at = Hdf5Handle(H5Oopen(at.get(), name.c_str(), H5P_DEFAULT), &H5Oclose);
    }
    return at;
  }

  std::vector<Hdf5Member> members(const std::string& group) const {
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
        member.kind = kind_at(object);
      }
    }
    return found;
  }

  Hdf5Source open_dataset(const std::string& dataset) const {
    Hdf5Source source{dataset, open(dataset), {}, {}, false};
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

  Hdf5Source open_attribute(const std::string& object, const std::string& name) const {
    const Hdf5Handle at = open(object);
    Hdf5Source source{object + ":" + name, {}, {}, {}, true};
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

  static void require_numbers(const Hdf5Source& source, ScalarType type) {
    if (!source.shape.type) {
      fail(source.name, "holds no numbers of a type that is read");
    }
    if (is_real(*source.shape.type) && !is_real(type)) {
      fail(source.name, "holds " + std::string(to_string(*source.shape.type)) + ", where whole numbers are expected");
    }
  }

  void require_bytes(const Hdf5Source& source) const {
    const std::uint64_t wanted = saturating_product(source.shape.count(), H5Tget_size(source.type.get()));
    if (source.is_attribute) {
      if (wanted > bytes_.size()) {
        fail(source.name, "declares more than the file holds");
      }
      return;
    }
    const Hdf5Handle properties = own_properties(source);
    const std::uint64_t stored = std::min<std::uint64_t>(H5Dget_storage_size(source.handle.get()), bytes_.size());
    const bool is_filtered = H5Pget_layout(properties.get()) == H5D_CHUNKED && H5Pget_nfilters(properties.get()) > 0;
    const std::uint64_t most = is_filtered ? saturating_product(most_bytes_of_one, stored) : stored;
    const std::uint64_t chunk =
        saturating_product(chunk_values(properties.get(), source.shape.extents.size()), H5Tget_size(source.type.get()));
    if (wanted > 0 && std::max(wanted, chunk) > most) {
      fail(source.name, "declares " + std::to_string(source.shape.count()) + " values, more than the " +
                            std::to_string(stored) + " bytes that the file has of them can hold");
    }
  }

  /// As require_bytes(), of so many values of which the file may have none.
  void require_room(const Hdf5Source& source, std::uint64_t values) const {
    const Hdf5Handle properties = own_properties(source);
    const std::uint64_t most = saturating_product(most_bytes_of_one, bytes_.size()) / H5Tget_size(source.type.get());
    if (std::max(values, chunk_values(properties.get(), source.shape.extents.size())) > most) {
      fail(source.name, "declares more values than a file of this size can hold");
    }
  }

  /// How a dataset is kept: in this file.
  static Hdf5Handle own_properties(const Hdf5Source& source) {
    Hdf5Handle properties(H5Dget_create_plist(source.handle.get()), &H5Pclose);
    if (H5Pget_layout(properties.get()) == H5D_VIRTUAL || H5Pget_external_count(properties.get()) > 0) {
      fail(source.name,
           "is made of other datasets or kept in other files, which are not read: 'h5repack -l CONTI in.h5 out.h5' "
           "makes "
           "one of the former, a program that copies its values one of the latter");
    }
    const int filters = H5Pget_layout(properties.get()) == H5D_CHUNKED ? H5Pget_nfilters(properties.get()) : 0;
    for (int i = 0; i < filters; ++i) {
      std::array<char, 64> name{};
      std::size_t values = 0;
      unsigned flags = 0;
      const H5Z_filter_t filter = H5Pget_filter2(properties.get(), static_cast<unsigned>(i), &flags, &values, nullptr,
                                                 name.size() - 1, name.data(), nullptr);
      if (H5Zfilter_avail(filter) <= 0) {
        fail(source.name,
             "is packed by a filter that HDF5 has only as a plugin (" +
                 (name[0] == '\0' ? "number " + std::to_string(filter) : quoted(std::string_view(name.data()))) +
                 "), and none is loaded: 'h5repack -f GZIP=6 in.h5 out.h5' packs anew where the plugin is");
      }
    }
    return properties;
  }

  std::vector<std::string> read_texts_of(const Hdf5Source& source) const {
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

  std::vector<std::string> attribute_names(const std::string& object) const {
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

  Hdf5Source open_source(const std::string& object, const std::optional<std::string>& attribute) const {
    return attribute ? open_attribute(object, *attribute) : open_dataset(object);
  }
  std::string describe(const Hdf5Source& source) const;
  std::string read_numbers(const Hdf5Source& source, ScalarType type) const;
  std::string read_part(const Hdf5Source& source, ScalarType type, Hdf5MessageReader& request) const;
  std::string read_bytes(const Hdf5Source& source) const;
  std::string read_characters(const Hdf5Source& source) const;
  static std::string read_references(const Hdf5Source& source);
  std::string reference_to(const std::string& object) const;

  std::string_view bytes_;
  Hdf5Image image_;
  Hdf5Handle handle_;
};

/// Where the values of a dataset stand one after the other in the file, nobody else need unpack them.
std::uint64_t place_of(const Hdf5Source& source) {
  if (source.is_attribute || !source.shape.type) {
    return nowhere;
  }
  const Hdf5Handle properties(H5Dget_create_plist(source.handle.get()), &H5Pclose);
  const std::uint64_t size = saturating_product(source.shape.count(), size_of(*source.shape.type));
  const bool is_there = H5Pget_layout(properties.get()) == H5D_CONTIGUOUS &&
                        H5Pget_external_count(properties.get()) == 0 &&
                        H5Dget_storage_size(source.handle.get()) >= size;
  const haddr_t place = is_there ? H5Dget_offset(source.handle.get()) : HADDR_UNDEF;
  return place == HADDR_UNDEF ? nowhere : place;
}

std::string Hdf5Service::describe(const Hdf5Source& source) const {
  Hdf5MessageWriter message;
  message.number(source.shape.extents.size());
  for (const std::uint64_t extent : source.shape.extents) {
    message.number(extent);
  }
  const bool is_number = source.shape.type.has_value();
  const bool is_big = is_number && H5Tget_order(source.type.get()) == H5T_ORDER_BE;
  return message.number(is_number ? static_cast<std::uint64_t>(*source.shape.type) + 1 : 0)
      .number(source.shape.is_text ? 1 : 0)
      .number(H5Tget_size(source.type.get()))
      .number(place_of(source))
      .number(is_big ? 1 : 0)
      .take();
}

std::string Hdf5Service::read_numbers(const Hdf5Source& source, ScalarType type) const {
  require_numbers(source, type);
  require_bytes(source);
  std::string values(static_cast<std::size_t>(source.shape.count()) * size_of(type), '\0');
  if (!values.empty() && !source.read(hdf5_memory_type(type), values.data())) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  return values;
}

std::string Hdf5Service::read_part(const Hdf5Source& source, ScalarType type, Hdf5MessageReader& request) const {
  require_numbers(source, type);
  // The reader has compared them with the extents.
  const std::size_t rank = source.shape.extents.size();
  std::vector<hsize_t> begin(rank);
  std::vector<hsize_t> counts(rank);
  for (std::vector<hsize_t>* const list : {&begin, &counts}) {
    std::ranges::generate(*list, [&request] { return static_cast<hsize_t>(request.number()); });
  }
  const std::uint64_t wanted = std::accumulate(counts.begin(), counts.end(), std::uint64_t{1}, &saturating_product);
  require_room(source, wanted);
  const Hdf5Handle all(H5Dget_space(source.handle.get()), &H5Sclose);
  const Hdf5Handle part(
      rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(rank), counts.data(), nullptr), &H5Sclose);
  if (rank > 0) {
    H5Sselect_hyperslab(all.get(), H5S_SELECT_SET, begin.data(), nullptr, counts.data(), nullptr);
  }
  std::string values(static_cast<std::size_t>(wanted) * size_of(type), '\0');
  if (wanted > 0 &&
      H5Dread(source.handle.get(), hdf5_memory_type(type), part.get(), all.get(), H5P_DEFAULT, values.data()) < 0) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  return values;
}

std::string Hdf5Service::read_characters(const Hdf5Source& source) const {
  if (!source.shape.is_text || H5Tis_variable_str(source.type.get()) != 0 || H5Tget_size(source.type.get()) != 1) {
    fail(source.name, "is of strings, where single characters are expected");
  }
  require_room(source, source.shape.count());
  std::string characters(static_cast<std::size_t>(source.shape.count()), '\0');
  if (!characters.empty() && !source.read(source.type.get(), characters.data())) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  return characters;
}

std::string Hdf5Service::read_references(const Hdf5Source& source) {
  const Hdf5Handle listed(H5Tget_class(source.type.get()) == H5T_VLEN ? H5Tget_super(source.type.get()) : -1,
                          &H5Tclose);
  const std::uint64_t count = source.shape.count();
  if (!listed.is_valid() || H5Tequal(listed.get(), H5T_STD_REF_OBJ) <= 0 || count == 0 || count > H5S_MAX_RANK) {
    fail(source.name, "is no list of references to objects");
  }
  std::vector<hvl_t> lists(static_cast<std::size_t>(count));
  if (!source.read(source.type.get(), lists.data())) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  Hdf5MessageWriter message;
  message.number(count);
  for (const hvl_t& list : lists) {
    message.number(list.len == 0 || list.p == nullptr ? 0 : *static_cast<const hobj_ref_t*>(list.p));
  }
  const Hdf5Handle space(H5Aget_space(source.handle.get()), &H5Sclose);
  H5Dvlen_reclaim(source.type.get(), space.get(), H5P_DEFAULT, lists.data());
  return message.take();
}

std::string Hdf5Service::reference_to(const std::string& object) const {
  hobj_ref_t reference = 0;
  if (!open(object).is_valid() || H5Rcreate(&reference, handle_.get(), object.c_str(), H5R_OBJECT, -1) < 0) {
    fail(object, "is no object of the file");
  }
  return Hdf5MessageWriter().number(reference).take();
}

std::string Hdf5Service::read_bytes(const Hdf5Source& source) const {
  // Of others memory holds addresses.
  if (H5Tdetect_class(source.type.get(), H5T_VLEN) != 0 || H5Tdetect_class(source.type.get(), H5T_REFERENCE) != 0 ||
      (source.shape.is_text && H5Tis_variable_str(source.type.get()) != 0)) {
    fail(source.name, "holds values of a type that is not read");
  }
  require_bytes(source);
  std::string bytes(static_cast<std::size_t>(source.shape.count()) * H5Tget_size(source.type.get()), '\0');
  if (!bytes.empty() && !source.read(source.type.get(), bytes.data())) {
    fail(source.name, "cannot be read" + hdf5_reason());
  }
  return bytes;
}

std::string list_of(const std::vector<std::string>& texts) {
  Hdf5MessageWriter message;
  message.number(texts.size());
  for (const std::string& text : texts) {
    message.text(text);
  }
  return message.take();
}

std::string Hdf5Service::answer(Hdf5MessageReader request) const {
  const auto kind = static_cast<Hdf5Request>(request.number());
  const auto type = static_cast<ScalarType>(request.number());
  const std::string object = request.text();
  const bool is_of_attribute = request.number() != 0;
  const std::string name = request.text();
  const std::optional<std::string> attribute = is_of_attribute ? std::optional(name) : std::nullopt;
  switch (kind) {
    case Hdf5Request::members: {
      const std::vector<Hdf5Member> found = members(object);
      Hdf5MessageWriter message;
      message.number(found.size());
      for (const Hdf5Member& member : found) {
        message.text(member.name).number(static_cast<std::uint64_t>(member.kind));
      }
      return message.take();
    }
    case Hdf5Request::kind: {
      const Hdf5Handle at = open(object);
      return Hdf5MessageWriter().number(at.is_valid() ? static_cast<std::uint64_t>(kind_at(at)) + 1 : 0).take();
    }
    case Hdf5Request::description:
      return describe(open_source(object, attribute));
    case Hdf5Request::numbers:
      return read_numbers(open_source(object, attribute), type);
    case Hdf5Request::part:
      return read_part(open_dataset(object), type, request);
    case Hdf5Request::bytes:
      return read_bytes(open_dataset(object));
    case Hdf5Request::characters:
      return read_characters(open_dataset(object));
    case Hdf5Request::texts:
      return list_of(read_texts_of(open_source(object, attribute)));
    case Hdf5Request::attribute_names:
      return list_of(attribute_names(object));
    case Hdf5Request::references:
      return read_references(open_attribute(object, attribute.value()));
    case Hdf5Request::reference:
      return reference_to(object);
    case Hdf5Request::has_attribute:
      break;
  }
  const Hdf5Handle at = open(object);
  return Hdf5MessageWriter().number(at.is_valid() && H5Aexists(at.get(), attribute.value().c_str()) > 0 ? 1 : 0).take();
}

}  // namespace

void serve_hdf5(std::string_view bytes, Hdf5Channel& channel) {
  H5PLset_loading_state(0);
  try {
    const Hdf5Service service(bytes);
    channel.answer({});
    while (const std::optional<std::string> request = channel.next()) {
      try {
        channel.answer(service.answer(Hdf5MessageReader(*request)));
      } catch (const Hdf5Refusal& refusal) {
        channel.refuse(refusal.what());
      } catch (const std::bad_alloc&) {
        channel.refuse("more memory is needed than there is");
      }
    }
  } catch (const Hdf5Refusal& refusal) {
    channel.refuse(refusal.what());
  }
}

}  // namespace trismooth
