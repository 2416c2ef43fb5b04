// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/ranges/vtu_range.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/input_file.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/native_order.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_decoder.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_header.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_pieces.h"
#include "trismooth/mesh_io/vtk_xml/vtk_xml_text.h"
#include "trismooth/mesh_io/xml/xml_names.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

namespace {

void set_attribute(XmlElement& element, std::string_view name, std::string value) {
  for (auto& [known, old] : element.attributes) {
    if (known == name) {
      old = std::move(value);
      return;
    }
  }
  element.attributes.emplace_back(name, std::move(value));
}

/// Writes elements in the lines that they are in.
class XmlText {
 public:
  void write(const XmlElement& element, std::string_view before_end = {}) {
    for (; line_ < element.line; ++line_) {
      text_ += '\n';
    }
    text_.append("<").append(element.name);
    for (const auto& [name, value] : element.attributes) {
      text_.append(" ").append(name).append("=\"").append(escape_xml_attribute(value)).append("\"");
    }
    text_.append(">").append(escape_xml_attribute(element.text));
    for (const XmlElement& child : element.children) {
      write(child);
    }
    text_.append(before_end).append("</").append(element.name).append(">");
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t line_ = 1;
};

/// Where a file is unlike what is read by ranges.
[[noreturn]] void give_up(const std::filesystem::path& path, const char* what) {
  throw ReadError(path, std::string("is not read by ranges: ") + what);
}

class RangeReader {
 public:
  explicit RangeReader(const std::filesystem::path& path) : file_(path) {
    std::size_t begin = read_head();
    constexpr std::size_t tail_bytes = 4096;
    const std::size_t size = file_.size();
    const std::size_t tail_begin = std::max(begin, size - std::min(size, tail_bytes));
    const FileBytes tail = file_.read_range(tail_begin, size);
    const std::size_t end = tail.view().rfind("</AppendedData");
    if (end == std::string_view::npos) {
      give_up(path, "its appended section has no end");
    }
    begin_ = begin;
    end_ = tail_begin + end;
    const std::string joined = text_.substr(0, begin) + std::string(tail.view().substr(end));
    head_ = parse_xml_head(path, joined, "AppendedData", {"InformationKey", "Value"});
    encoding_ = read_vtk_xml_header(path, joined, head_, VtkXmlKind::unstructured_grid).encoding;
    if (encoding_.appended_base64) {
      give_up(path, "its appended section is base64");
    }
    find_piece();
  }

  VtuCounts counts() const { return {piece_.points, piece_.cells}; }

  MeshDocument read(NumberRange points, NumberRange cells, bool with_fields, const FileWorkers& workers) {
    if (points.last > piece_.points || cells.last > piece_.cells || piece_.points == 0 || piece_.cells == 0) {
      give_up(path(), "it has not these points and cells");
    }
    const std::vector<std::int32_t> corners = take_cells(cells, workers);
    take_section("Points", piece_.points, points, workers);
    take_section("PointData", piece_.points, points, workers);
    take_section("CellData", piece_.cells, cells, workers);
    XmlElement& grid = grid_element();
    if (XmlElement* const fields = child_of(grid, "FieldData"); fields != nullptr) {
      if (with_fields) {
        take_fields(*fields, workers);
      } else {
        std::erase_if(grid.children, [](const XmlElement& element) { return element.name == "FieldData"; });
      }
    }
    XmlElement& piece = piece_element();
    set_attribute(piece, "NumberOfPoints", std::to_string(points.last - points.first));
    set_attribute(piece, "NumberOfCells", std::to_string(cells.last - cells.first));
    MeshDocument document = vtu_codec.read_shared(path(), FileBytes(as_file()), workers);
    document.original.reset();
    document.cells.connectivity = corners;
    return document;
  }

 private:
  const std::filesystem::path& path() const { return file_.path(); }

  /// Reads the head into text_. The first byte of the appended data.
  std::size_t read_head() {
    constexpr std::size_t most_bytes = std::size_t{1} << 26;
    for (std::size_t bytes = std::size_t{1} << 16; bytes <= most_bytes; bytes *= 4) {
      const FileBytes read = file_.read_range(0, bytes);
      text_ = read.view();
      const std::size_t element = text_.find("<AppendedData");
      const std::size_t mark = element == text_.npos ? element : text_.find('_', text_.find('>', element));
      if (mark != text_.npos) {
        return mark + 1;
      }
      if (read.size() < bytes) {
        break;
      }
    }
    give_up(path(), "it has no appended section");
  }

  static XmlElement* child_of(XmlElement& parent, std::string_view name) {
    const auto found = std::ranges::find(parent.children, name, &XmlElement::name);
    return found == parent.children.end() ? nullptr : &*found;
  }

  XmlElement& grid_element() { return *child_of(head_.root, to_string(VtkXmlKind::unstructured_grid)); }
  XmlElement& piece_element() { return *child_of(grid_element(), "Piece"); }

  void find_piece() {
    XmlElement* const grid = child_of(head_.root, to_string(VtkXmlKind::unstructured_grid));
    if (grid == nullptr || child_of(*grid, "Piece") == nullptr) {
      give_up(path(), "it has not one piece");
    }
    std::vector<std::string> losses;
    const std::vector<VtkXmlPiece> pieces = find_vtk_xml_pieces(path(), *grid, VtkXmlKind::unstructured_grid, losses);
    if (pieces.size() != 1) {
      give_up(path(), "it has not one piece");
    }
    piece_ = pieces.front();
  }

  /// The rows [first, last) of an array of `rows`, in this machine's byte order.
  MemoryBlock rows_of(const XmlElement& array, const VtkXmlArrayType& type, std::uint64_t rows, NumberRange range,
                      const FileWorkers& workers) {
    if (type.values != VtkXmlArrayType::Values::numbers || vtk_xml_mode_of(path(), array) != VtkXmlMode::appended) {
      give_up(path(), "it has arrays of other values than numbers, or inside of elements");
    }
    const std::uint64_t row_bytes = type.components * size_of(type.type);
    const std::uint64_t total = saturating_product(rows, row_bytes);
    const NumberRange bytes{range.first * row_bytes, range.last * row_bytes};
    const std::uint64_t begin = begin_ + offset_of(array);
    MemoryBlock numbers;
    if (bytes.first == bytes.last) {
      return numbers;
    }
    const bool is_compressed = encoding_.compressor != VtkXmlCompressor::none;
    const Stream stream = is_compressed ? compressed_stream(begin, total, bytes) : plain_stream(begin, total, bytes);
    XmlElement alone = array;
    set_attribute(alone, "offset", "0");
    std::vector<std::string> losses;
    VtkXmlHeader header{encoding_, 1, 0};
    header.appended_end = stream.bytes.size();
    VtkXmlDecoder(path(), stream.bytes.view(), header, workers, losses)
        .read_numbers(alone, type.type, std::nullopt, numbers);
    const std::uint64_t surplus = bytes.first - stream.first;
    const std::uint64_t size = bytes.last - bytes.first;
    if (numbers.size() < surplus + size || surplus % size_of(type.type) != 0) {
      give_up(path(), "an array is cut off");
    }
    if (surplus > 0) {
      std::memmove(numbers.data(), numbers.data() + surplus, size);
    }
    numbers.truncate(size);
    return numbers;
  }

  /// An appended section that has the bytes of a part of one array alone, from byte `first` of it on.
  struct Stream {
    FileBytes bytes;
    std::uint64_t first;
  };

  std::size_t word_size() const { return encoding_.wide_block_headers ? 8 : 4; }

  std::uint64_t offset_of(const XmlElement& array) const {
    const std::string* const text = array.attribute("offset");
    const auto offset = text == nullptr ? std::nullopt : parse_xml_count(*text);
    if (!offset || *offset > end_ - begin_) {
      give_up(path(), "an array has no offset");
    }
    return *offset;
  }

  std::vector<std::uint64_t> words_at(std::uint64_t begin, std::uint64_t count) const {
    if (begin > end_ || count > (end_ - begin) / word_size()) {
      give_up(path(), "an array ends within its header");
    }
    MemoryBlock bytes;
    std::byte* const target = bytes.extend(count * word_size());
    if (file_.read_at(target, bytes.size(), begin) != bytes.size()) {
      give_up(path(), "it is cut off");
    }
    swap_words(bytes);
    std::vector<std::uint64_t> words(count, 0);
    for (std::uint64_t i = 0; i < count; ++i) {
      if (word_size() == 8) {
        std::memcpy(&words[i], target + 8 * i, 8);
      } else {
        std::uint32_t word = 0;
        std::memcpy(&word, target + 4 * i, 4);
        words[i] = word;
      }
    }
    return words;
  }

  /// Between this machine's byte order and the file's.
  void swap_words(MemoryBlock& words) const {
    Workers alone(1);
    to_native_order(words.data(), words.size(), word_size(), encoding_.big_endian, FileWorkers(alone));
  }

  Stream stream_of(const std::vector<std::uint64_t>& words, NumberRange bytes, std::uint64_t first) const {
    MemoryBlock header;
    for (const std::uint64_t word : words) {
      if (word_size() == 8) {
        header.append(&word, 8);
      } else {
        const auto narrow = static_cast<std::uint32_t>(word);
        header.append(&narrow, 4);
      }
    }
    swap_words(header);
    MemoryBlock all;
    all.reserve_more(1 + header.size() + (bytes.last - bytes.first));
    all.append("_", 1);
    all.append(header.data(), header.size());
    const std::size_t count = bytes.last - bytes.first;
    if (bytes.last > end_ || file_.read_at(all.extend(count), count, bytes.first) != count) {
      give_up(path(), "it is cut off");
    }
    return {FileBytes(std::move(all)), first};
  }

  /// Arrays that share appended data could make a small file fill the memory.
  void count_used(std::uint64_t begin, std::uint64_t size) {
    used_ += counted_.insert(begin).second ? size : 0;
    if (used_ > end_ - begin_ || size > end_ - begin) {
      give_up(path(), "arrays overlap, or it is cut off");
    }
  }

  Stream plain_stream(std::uint64_t begin, std::uint64_t total, NumberRange bytes) {
    if (words_at(begin, 1).front() != total) {
      give_up(path(), "an array has another size than it should have");
    }
    count_used(begin, word_size() + total);
    const std::uint64_t data = begin + word_size();
    return stream_of({bytes.last - bytes.first}, {data + bytes.first, data + bytes.last}, bytes.first);
  }

  Stream compressed_stream(std::uint64_t begin, std::uint64_t total, NumberRange bytes) {
    const std::vector<std::uint64_t> facts = words_at(begin, 3);
    const std::uint64_t blocks = facts[0];
    const std::uint64_t block_size = facts[1];
    const std::uint64_t last_size = facts[2] == 0 ? block_size : facts[2];
    if (blocks == 0 || block_size == 0 || last_size > block_size ||
        saturating_product(blocks - 1, block_size) != total - std::min(total, last_size)) {
      give_up(path(), "an array has another size than it should have");
    }
    const std::vector<std::uint64_t> sizes = words_at(begin + 3 * word_size(), blocks);
    const std::uint64_t first_block = bytes.first / block_size;
    const std::uint64_t end_block = (bytes.last + block_size - 1) / block_size;
    const std::uint64_t data = begin + (3 + blocks) * word_size();
    NumberRange place{data, data};
    std::uint64_t end = data;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      if (end > end_ || sizes[b] > end_ - end) {
        give_up(path(), "it is cut off");
      }
      end += sizes[b];
      place.first = b < first_block ? end : place.first;
      place.last = b < end_block ? end : place.last;
    }
    count_used(begin, end - begin);
    std::vector<std::uint64_t> words{end_block - first_block, block_size, end_block == blocks ? facts[2] : 0};
    words.insert(words.end(), sizes.begin() + static_cast<std::ptrdiff_t>(first_block),
                 sizes.begin() + static_cast<std::ptrdiff_t>(end_block));
    return stream_of(words, place, first_block * block_size);
  }

  /// Has an array element mean these numbers, in the file that is made of the range.
  void put(XmlElement& array, const MemoryBlock& numbers) {
    set_attribute(array, "offset", std::to_string(appended_.size()));
    const std::uint64_t size = numbers.size();
    appended_.append(&size, sizeof(size));
    appended_.append(numbers.data(), size);
  }

  static bool is_array(const XmlElement& element) { return element.name == "DataArray" || element.name == "Array"; }

  void take_section(const char* name, std::uint64_t rows, NumberRange range, const FileWorkers& workers) {
    XmlElement* const section = child_of(piece_element(), name);
    for (std::size_t i = 0; section != nullptr && i < section->children.size(); ++i) {
      if (XmlElement& array = section->children[i]; is_array(array)) {
        put(array, rows_of(array, vtk_xml_array_type_of(path(), array), rows, range, workers));
      }
    }
  }

  void take_fields(XmlElement& section, const FileWorkers& workers) {
    for (XmlElement& array : section.children) {
      if (!is_array(array)) {
        continue;
      }
      const std::optional<std::uint64_t> rows = whole_number_attribute(path(), array, "NumberOfTuples");
      if (!rows) {
        give_up(path(), "an array of the whole mesh does not say how long it is");
      }
      put(array, rows_of(array, vtk_xml_array_type_of(path(), array), *rows, {0, *rows}, workers));
    }
  }

  /// Whole numbers as what 64 bits with a sign hold.
  std::vector<std::int64_t> integers_of(const XmlElement& array, std::uint64_t rows, NumberRange range,
                                        const FileWorkers& workers) {
    const VtkXmlArrayType type = vtk_xml_array_type_of(path(), array);
    if (type.components != 1) {
      give_up(path(), "cells are of arrays of several components");
    }
    const MemoryBlock numbers = rows_of(array, type, rows, range, workers);
    std::vector<std::int64_t> integers;
    visit_scalar_type(type.type, [&](auto zero) {
      using T = decltype(zero);
      if constexpr (std::is_floating_point_v<T>) {
        give_up(path(), "cells are of numbers that are not whole");
      } else {
        const std::span values(reinterpret_cast<const T*>(numbers.data()), numbers.size() / sizeof(T));
        integers.reserve(values.size());
        for (const T value : values) {
          if (!std::in_range<std::int64_t>(value) || std::cmp_less(value, 0)) {
            give_up(path(), "a number of a cell is out of range");
          }
          integers.push_back(static_cast<std::int64_t>(value));
        }
      }
    });
    return integers;
  }

  /// Puts the cells into the file that is made, with corners that all are its first point; the corners they have.
  std::vector<std::int32_t> take_cells(NumberRange range, const FileWorkers& workers) {
    XmlElement* const section = child_of(piece_element(), "Cells");
    XmlElement* connectivity = nullptr;
    XmlElement* offsets = nullptr;
    XmlElement* types = nullptr;
    for (std::size_t i = 0; section != nullptr && i < section->children.size(); ++i) {
      XmlElement& array = section->children[i];
      const std::string* const name = array.attribute("Name");
      XmlElement** const known = name == nullptr           ? nullptr
                                 : *name == "connectivity" ? &connectivity
                                 : *name == "offsets"      ? &offsets
                                 : *name == "types"        ? &types
                                                           : nullptr;
      if (known == nullptr || *known != nullptr) {
        give_up(path(), "it has other arrays of cells");
      }
      *known = &array;
    }
    if (connectivity == nullptr || offsets == nullptr || types == nullptr) {
      give_up(path(), "it lacks arrays of cells");
    }
    put(*types, rows_of(*types, vtk_xml_array_type_of(path(), *types), piece_.cells, range, workers));
    std::vector<std::int64_t> ends{0};
    if (range.first < range.last) {
      ends = integers_of(*offsets, piece_.cells, {range.first - (range.first > 0 ? 1 : 0), range.last}, workers);
      if (range.first == 0) {
        ends.insert(ends.begin(), 0);
      }
    }
    const std::int64_t all = integers_of(*offsets, piece_.cells, {piece_.cells - 1, piece_.cells}, workers).front();
    if (!std::ranges::is_sorted(ends) || ends.back() > all) {
      give_up(path(), "offsets of cells do not rise");
    }
    const std::vector<std::int64_t> corners =
        integers_of(*connectivity, static_cast<std::uint64_t>(all),
                    {static_cast<std::uint64_t>(ends.front()), static_cast<std::uint64_t>(ends.back())}, workers);
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const std::int64_t limit = std::min(static_cast<std::int64_t>(piece_.points), most);
    std::vector<std::int32_t> numbers(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] >= limit) {
        give_up(path(), "a cell has a corner that is no point");
      }
      numbers[i] = static_cast<std::int32_t>(corners[i]);
    }
    put_integers(*connectivity, std::vector<std::int64_t>(corners.size(), 0));
    const std::int64_t first = ends.front();
    std::ranges::for_each(ends, [first](std::int64_t& end) { end -= first; });
    ends.erase(ends.begin());
    put_integers(*offsets, ends);
    return numbers;
  }

  void put_integers(XmlElement& array, const std::vector<std::int64_t>& numbers) {
    MemoryBlock bytes;
    bytes.append(numbers.data(), numbers.size() * sizeof(std::int64_t));
    set_attribute(array, "type", "Int64");
    put(array, bytes);
  }

  /// The range as a file of its own.
  MemoryBlock as_file() {
    XmlElement& root = head_.root;
    std::erase_if(root.attributes, [](const auto& attribute) { return attribute.first == "compressor"; });
    set_attribute(root, "byte_order", std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    set_attribute(root, "header_type", "UInt64");
    root.children.pop_back();  // the appended section
    XmlText text;
    text.write(root, "<AppendedData encoding=\"raw\">_");
    std::string head = text.take();
    const std::size_t split = head.rfind("</");
    MemoryBlock file;
    const auto add = [&file](std::string_view bytes) { file.append(bytes.data(), bytes.size()); };
    file.reserve_more(head.size() + appended_.size() + 32);
    add(std::string_view(head).substr(0, split));
    file.append(appended_.data(), appended_.size());
    add("</AppendedData>");
    add(std::string_view(head).substr(split));
    appended_ = MemoryBlock();
    return file;
  }

  InputFile file_;
  std::string text_;
  XmlHead head_;
  VtkXmlEncoding encoding_;
  std::uint64_t begin_ = 0;  ///< of the appended data
  std::uint64_t end_ = 0;
  std::set<std::uint64_t> counted_;  ///< where arrays begin whose bytes are in used_
  std::uint64_t used_ = 0;
  VtkXmlPiece piece_;
  MemoryBlock appended_;  ///< of the file that is made of the range
};

}  // namespace

VtuCounts count_vtu(const std::filesystem::path& path) {
  return RangeReader(path).counts();
}

MeshDocument read_vtu_range(const std::filesystem::path& path, NumberRange points, NumberRange cells, bool with_fields,
                            const FileWorkers& workers) {
  return RangeReader(path).read(points, cells, with_fields, workers);
}

}  // namespace trismooth
