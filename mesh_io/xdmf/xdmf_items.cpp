// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_items.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#ifdef TRISMOOTH_HAS_HDF5
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#endif

namespace trismooth {

#ifndef TRISMOOTH_HAS_HDF5
class Hdf5Reader {};
#endif

namespace {

constexpr std::string_view white_space = " \t\r\n";

std::optional<ScalarType> type_named(const std::string& name, std::uint64_t precision) {
  const auto sized = [precision](ScalarType one, ScalarType two, ScalarType four,
                                 ScalarType eight) -> std::optional<ScalarType> {
    switch (precision) {
      case 1:
        return one;
      case 2:
        return two;
      case 4:
        return four;
      case 8:
        return eight;
      default:
        return std::nullopt;
    }
  };
  if (name == "FLOAT" && (precision == 4 || precision == 8)) {
    return precision == 4 ? ScalarType::float32 : ScalarType::float64;
  }
  if (name == "INT") {
    return sized(ScalarType::int8, ScalarType::int16, ScalarType::int32, ScalarType::int64);
  }
  if (name == "UINT") {
    return sized(ScalarType::uint8, ScalarType::uint16, ScalarType::uint32, ScalarType::uint64);
  }
  if (name == "CHAR" || name == "UCHAR") {
    return name == "CHAR" ? ScalarType::int8 : ScalarType::uint8;
  }
  if (name == "SHORT" || name == "USHORT") {
    return name == "SHORT" ? ScalarType::int16 : ScalarType::uint16;
  }
  return std::nullopt;
}

/// The path with one slash in front of each name.
std::string plain_path(std::string_view path) {
  std::string plain;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    if (end > 0) {
      plain.append("/").append(path.substr(0, end));
    }
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return plain;
}

template <class T>
std::optional<T> parse(std::string_view token) {
  if constexpr (std::is_floating_point_v<T>) {
    return parse_number<T>(token);
  } else {
    return parse_integer_as<T>(token);
  }
}

}  // namespace

std::uint64_t XdmfItem::count() const {
  std::uint64_t product = 1;
  for (const std::uint64_t extent : extents) {
    product = saturating_product(product, extent);
  }
  return product;
}

XdmfItems::XdmfItems(std::filesystem::path file, std::string_view bytes, const FileWorkers& workers, XdmfPaths& paths)
    : file_(std::move(file)), bytes_(bytes), workers_(workers), paths_(paths) {}

XdmfItems::~XdmfItems() = default;

void XdmfItems::fail(std::size_t line, const std::string& message) const {
  throw ReadError(file_, line, message);
}

std::string_view XdmfItems::content_of(const XmlElement& item) const {
  return trimmed(bytes_.substr(item.content_begin, item.content_end - item.content_begin), white_space);
}

std::size_t XdmfItems::file_of(std::string_view name, std::size_t line) {
  const std::string plain = xml_unescaped(name);
  if (plain.empty() || plain == "." || plain == ".." || plain.find_first_of("/\\") != plain.npos) {
    fail(line, "names the file " + quoted(std::string_view(plain)) +
                   ": only files beside this one are read, by their names without a folder");
  }
  const auto found = std::ranges::find(files_, plain, &XdmfHeavyFile::name);
  if (found != files_.end()) {
    return static_cast<std::size_t>(found - files_.begin());
  }
  files_.push_back({plain, file_.parent_path() / plain});
  readers_.emplace_back();
  left_.push_back(0);
  return files_.size() - 1;
}

std::string_view XdmfItems::bytes_of(std::size_t file, std::size_t line) {
  XdmfHeavyFile& heavy = files_[file];
  if (!heavy.bytes) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(heavy.path, error)) {
      fail(line, "its numbers are in " + heavy.name +
                     (file_ == shown_input("-") ? ", which is not in the current folder" : ", which is not beside it"));
    }
    heavy.bytes = read_file_bytes(heavy.path, workers_);
    // As much as compression makes of its bytes: one dataset may have many names.
    left_[file] = saturating_product(1040, heavy.bytes->size());
  }
  return heavy.bytes->view();
}

const Hdf5Reader& XdmfItems::reader_of(std::size_t file, [[maybe_unused]] std::size_t line) {
#ifdef TRISMOOTH_HAS_HDF5
  const std::string_view bytes = bytes_of(file, line);
  if (readers_[file] == nullptr) {
    readers_[file] = std::make_unique<Hdf5Reader>(files_[file].path, bytes);
  }
  return *readers_[file];
#else
  fail(line, "its numbers are in " + files_[file].name +
                 ", a file of HDF5, which this build does not read: build it with TRISMOOTH_HDF5");
#endif
}

void XdmfItems::describe_heavy(const XmlElement& element, XdmfItem& item) {
  const std::string_view content = content_of(element);
  if (item.place == XdmfItem::Place::binary) {
    item.file = file_of(content, element.line);
    const std::string seek = xdmf_attribute(element, "Seek");
    const auto begin = parse_unsigned(seek.empty() ? "0" : seek);
    if (!begin) {
      fail(element.line, "Seek=" + quoted(std::string_view(seek)) + " is no place in a file");
    }
    item.begin = *begin;
    const std::string order = xdmf_word(xdmf_attribute(element, "Endian"));
    item.is_big_endian = order == "BIG" || (order != "LITTLE" && std::endian::native == std::endian::big);
    const std::string compression = xdmf_word(xdmf_attribute(element, "Compression"));
    if (!compression.empty() && compression != "RAW") {
      fail(element.line, "its numbers are compressed as " + compression + ", which is not read");
    }
    item.key =
        "b" + std::to_string(item.file) + ":" + std::to_string(item.begin) + ":" + std::to_string(item.is_big_endian);
    return;
  }
  const std::size_t colon = content.find(':');
  if (colon == content.npos || content.find('|') != content.npos) {
    fail(element.line, "expected the name of an HDF5 file, a colon and a path in it, got " + quoted(content));
  }
  item.file = file_of(trimmed(content.substr(0, colon), white_space), element.line);
  item.dataset = plain_path(xml_unescaped(trimmed(content.substr(colon + 1), white_space)));
  item.key = "h" + std::to_string(item.file) + ":" + item.dataset;
#ifdef TRISMOOTH_HAS_HDF5
  Hdf5Shape shape = reader_of(item.file, element.line).shape_of(item.dataset);
  if (!item.extents.empty() && item.count() != shape.count()) {
    fail(element.line, "declares " + std::to_string(item.count()) + " values of " + quoted(content) + ", which has " +
                           std::to_string(shape.count()));
  }
  item.type = shape.type;
  item.extents = std::move(shape.extents);
#else
  reader_of(item.file, element.line);
#endif
}

XdmfItem XdmfItems::find(const XmlElement& element) {
  // What refers to something that refers to something: as deep as elements may be.
  const XmlElement* at = &element;
  for (int steps = 0; at->attribute("Reference") != nullptr; ++steps) {
    const std::string reference = xdmf_attribute(*at, "Reference");
    const std::string path = xdmf_word(reference) == "XML" ? xml_unescaped(content_of(*at)) : reference;
    const XmlElements& found = paths_.find(path, at->line);
    if (steps == 64 || found.size() != 1 || found[0]->name != "DataItem") {
      fail(at->line, "the reference " + quoted(std::string_view(path)) + " leads to no single <DataItem>");
    }
    at = found[0];
  }
  XdmfItem item{.line = at->line};
  const std::string kind = xdmf_word(xdmf_attribute(*at, "ItemType", "Type"));
  if (!kind.empty() && kind != "UNIFORM") {
    fail(at->line, "a <DataItem> of the type " + quoted(std::string_view(kind)) +
                       " is not read: ParaView and meshio write its numbers as they are");
  }
  if (!at->children.empty()) {
    fail(at->line, "a <DataItem> has <" + at->children[0].name + "> where its numbers are expected");
  }
  const std::string extents = xdmf_attribute(*at, "Dimensions");
  for (std::string_view rest = trimmed(extents, white_space); !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of(white_space), rest.size());
    const auto extent = parse_unsigned(rest.substr(0, end));
    if (!extent) {
      fail(at->line, "Dimensions=" + quoted(std::string_view(extents)) + " are not whole numbers");
    }
    item.extents.push_back(*extent);
    rest = trimmed(rest.substr(end), white_space);
  }
  const std::string type = xdmf_word(xdmf_attribute(*at, "NumberType", "DataType"));
  const std::string precision = xdmf_attribute(*at, "Precision");
  const auto bytes = parse_unsigned(precision.empty() ? "4" : precision);
  if (!bytes) {
    fail(at->line, "Precision=" + quoted(std::string_view(precision)) + " is no number of bytes");
  }
  item.type = type_named(type.empty() ? "FLOAT" : type, *bytes);
  const std::string format = xdmf_word(xdmf_attribute(*at, "Format"));
  if (format == "HDF" || format == "HDF5") {
    item.place = XdmfItem::Place::hdf5;
    describe_heavy(*at, item);
  } else if (item.extents.empty()) {
    fail(at->line, "a <DataItem> without Dimensions");
  } else if (format == "BINARY") {
    item.place = XdmfItem::Place::binary;
    describe_heavy(*at, item);
  } else if (format.empty() || format == "XML") {
    item.begin = at->content_begin;
    item.end = at->content_end;
    item.key = "x" + std::to_string(item.begin);
    item.is_untyped = type.empty();
    // Text has the digits that it has: DOLFINx writes 16 of them, and no Precision.
    if (precision.empty() && item.type == ScalarType::float32) {
      item.type = ScalarType::float64;
    }
  } else {
    fail(at->line, "Format=" + quoted(std::string_view(format)) + " is not read: XML, HDF and Binary are");
  }
  return item;
}

XdmfItem XdmfItems::only_item_of(const XmlElement& element) {
  const auto items = std::ranges::count(element.children, std::string_view("DataItem"), &XmlElement::name);
  if (items != 1) {
    fail(element.line, "<" + element.name + "> has " + std::to_string(items) + " <DataItem>s where one is expected");
  }
  return find(*element.child("DataItem"));
}

template <class T>
std::vector<T> XdmfItems::read_text(const XdmfItem& item, std::vector<std::uint64_t>* offsets) {
  const std::string_view text = bytes_.substr(0, item.end);
  TextScanner scanner(text, file_, TextScanner::Comments::none, item.begin);
  const std::uint64_t declared = item.count();
  require_room(file_, "numbers in a <DataItem>", declared, 2, item.end - item.begin + 1);
  const auto count = static_cast<std::size_t>(declared);
  std::vector<T> values(count);
  if (offsets != nullptr) {
    offsets->resize(count);
  }
  PlainRows plain(text, workers_);
  const auto end =
      count == 0 ? std::nullopt
                 : plain.read(item.begin, count, 1, [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       if (!numbers.next(values[i])) {
                         return false;
                       }
                       if (offsets != nullptr) {
                         (*offsets)[i] = numbers.token_offset();
                       }
                     }
                     return true;
                   });
  if (end) {
    scanner.resume(end->last_number, end->offset);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      if (scanner.at_end()) {
        fail(item.line, "expected " + std::to_string(count) + " numbers in a <DataItem>, got " + std::to_string(i));
      }
      const std::string_view token = scanner.next_token("a number");
      const auto value = parse<T>(token);
      if (!value) {
        scanner.fail((std::is_floating_point_v<T> ? "expected a number, got " : "expected a whole number, got ") +
                     quoted(token));
      }
      values[i] = *value;
      if (offsets != nullptr) {
        (*offsets)[i] = scanner.token_offset();
      }
    }
  }
  if (!scanner.at_end()) {
    const std::string_view token = scanner.next_token("the end");
    scanner.fail("expected the end of a <DataItem> behind the " + std::to_string(count) +
                 " numbers that it declares, got " + quoted(token));
  }
  return values;
}

template <class T>
std::vector<T> XdmfItems::read_binary(const XdmfItem& item) {
  const std::string_view bytes = bytes_of(item.file, item.line);
  const std::size_t size = size_of(item.type.value());
  if (item.begin > bytes.size()) {
    fail(item.line, "its numbers begin behind the end of " + files_[item.file].name);
  }
  require_room(files_[item.file].path, "numbers", item.count(), size, bytes.size() - item.begin);
  const auto count = static_cast<std::size_t>(item.count());
  const bool is_swapped = item.is_big_endian == (std::endian::native == std::endian::little);
  std::vector<T> values(count);
  visit_scalar_type(*item.type, [&](auto number) {
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(&number, bytes.data() + item.begin + i * size, size);
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): it is a number
      values[i] = static_cast<T>(is_swapped ? with_bytes_reversed(number) : number);
    }
  });
  return values;
}

template <class T>
std::vector<T> XdmfItems::read(const XdmfItem& item) {
  if (!item.type) {
    fail(item.line, "holds no numbers of a type that is read");
  }
  const bool is_real = *item.type == ScalarType::float32 || *item.type == ScalarType::float64;
  if (std::is_integral_v<T> && is_real && item.place != XdmfItem::Place::text) {
    fail(item.line, "holds " + std::string(to_string(*item.type)) + ", where whole numbers are expected");
  }
  switch (item.place) {
    case XdmfItem::Place::text:
      return read_text<T>(item, nullptr);
    case XdmfItem::Place::binary:
      return read_binary<T>(item);
    case XdmfItem::Place::hdf5:
      break;
  }
#ifdef TRISMOOTH_HAS_HDF5
  const std::uint64_t bytes = saturating_product(item.count(), size_of(*item.type));
  if (bytes > left_[item.file]) {
    fail(item.line, "more is to be read of " + files_[item.file].name + " than it can hold");
  }
  left_[item.file] -= bytes;
  return reader_of(item.file, item.line).template read<T>(item.dataset);
#else
  return {};
#endif
}

std::vector<double> XdmfItems::read_coordinates(const XdmfItem& item, std::vector<std::uint64_t>& offsets) {
  if (item.type == ScalarType::float64) {
    return read_text<double>(item, &offsets);
  }
  const std::vector<float> values = read_text<float>(item, &offsets);
  return {values.begin(), values.end()};
}

void XdmfItems::keep_coordinates(const XdmfItem& item, std::vector<std::uint64_t> offsets,
                                 std::vector<SiteColumn> columns, std::size_t first_point) {
  const std::size_t count = static_cast<std::size_t>(item.count()) / columns.size();
  if (item.place == XdmfItem::Place::text) {
    NumberSites& sites = coordinates_.emplace_back();
    sites.type = item.type.value();
    sites.columns = std::move(columns);
    sites.offsets = std::move(offsets);
    sites.first_vertex = first_point;
  } else if (item.place == XdmfItem::Place::binary) {
    files_[item.file].coordinates.push_back(
        binary_sites(binary_encoding(item.is_big_endian), item.type.value(), item.begin, count, std::move(columns)));
    files_[item.file].coordinates.back().first_vertex = first_point;
  } else {
#ifdef TRISMOOTH_HAS_HDF5
    Hdf5Column column =
        hdf5_column(reader_of(item.file, item.line), item.dataset, 0, count, std::move(columns), first_point);
    column.is_packed ? files_[item.file].packed.push_back(std::move(column))
                     : files_[item.file].coordinates.push_back(std::move(column.numbers));
#endif
  }
}

DataArray XdmfItems::read_array(const XdmfItem& item, const std::string& name, std::size_t components) {
  auto found = arrays_.find(item.key);
  if (found == arrays_.end()) {
    DataArray array = visit_scalar_type(item.type.value_or(ScalarType::float64), [&](auto number) {
      return make_data_array(name, components, read<decltype(number)>(item));
    });
    found = arrays_.emplace(item.key, std::move(array)).first;
  }
  DataArray array = found->second;
  array.name = name;
  array.components = components;
  return array;
}

void XdmfItems::find_file_names(const XmlElement& element) {
  for (const XmlElement& child : element.children) {
    find_file_names(child);
  }
  const std::string format = xdmf_word(xdmf_attribute(element, "Format"));
  const bool is_hdf = format == "HDF" || format == "HDF5";
  if (element.name != "DataItem" || element.attribute("Reference") != nullptr || (!is_hdf && format != "BINARY")) {
    return;
  }
  const std::string_view content = content_of(element);
  const std::string_view name =
      is_hdf ? trimmed(content.substr(0, std::min(content.find(':'), content.size())), white_space) : content;
  const auto begin = static_cast<std::size_t>(name.data() - bytes_.data());
  names_.push_back({begin, begin + name.size(), file_of(name, element.line)});
}

std::vector<XdmfHeavyFile> XdmfItems::take_files() {
  readers_.clear();
  return std::move(files_);
}

template std::vector<double> XdmfItems::read(const XdmfItem& item);
template std::vector<std::int64_t> XdmfItems::read(const XdmfItem& item);
template std::vector<std::int32_t> XdmfItems::read(const XdmfItem& item);

}  // namespace trismooth
