// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/off/off_binary_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_list_rows.h"
#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::size_t word_bytes = 4;

/// How a program writes binary OFF, beyond what the keyword says.
struct Dialect {
  NumberEncoding byte_order = NumberEncoding::big_endian;
  std::size_t vertex_colour = 0;           ///< components
  std::optional<std::size_t> face_colour;  ///< components of every face; nothing where each face counts its own
};

/// Colours, words as the file has them, row by row.
struct Colours {
  std::vector<std::uint32_t> words;
  std::size_t components = 0;
  bool uniform = true;  ///< all rows are of one length

  void begin_row(std::size_t row, std::size_t length) {
    components = row == 0 ? length : components;
    uniform = uniform && length == components;
  }

  void move_to(std::vector<DataArray>& arrays) {
    if (!uniform || components == 0) {
      return;
    }
    constexpr std::uint32_t largest = 255;
    if (std::ranges::all_of(words, [](std::uint32_t word) { return word <= largest; })) {
      arrays.push_back(make_data_array("colours", components, std::vector<std::int32_t>(words.begin(), words.end())));
      return;
    }
    std::vector<float> numbers(words.size());
    std::ranges::transform(words, numbers.begin(), [](std::uint32_t word) { return std::bit_cast<float>(word); });
    arrays.push_back(make_data_array("colours", components, std::move(numbers)));
  }
};

struct VertexFields {
  std::vector<float> normals;
  std::vector<float> texture_coordinates;
  Colours colours;
};

class BinaryOffReader {
 public:
  BinaryOffReader(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                  const OffKeyword& keyword, const Dialect& dialect, const FileWorkers& workers)
      : path_(path),
        bytes_(bytes),
        workers_(workers),
        offset_(begin),
        word_offset_(begin),
        keyword_(keyword),
        dialect_(dialect),
        swapped_((dialect.byte_order == NumberEncoding::big_endian) == (std::endian::native == std::endian::little)) {
    document_.point_type = sites_.type = ScalarType::float32;
    sites_.encoding = dialect.byte_order;
  }

  std::pair<MeshDocument, NumberSites> read() {
    read_counts();
    read_vertices();
    read_faces();
    if (offset_ != bytes_.size()) {
      word_offset_ = offset_;
      fail("expected the end of the file after " + std::to_string(vertex_count_) + " vertices and " +
           std::to_string(face_count_) + " faces, got " + std::to_string(bytes_.size() - offset_) + " bytes more");
    }
    return {std::move(document_), std::move(sites_)};
  }

  /// True where the file has room for the vertices and faces that its first words declare in this byte order.
  bool has_likely_counts() {
    try {
      read_counts();
      return true;
    } catch (const ReadError&) {
      return false;
    }
  }

 private:
  std::uint32_t word(std::string_view what) {
    word_offset_ = offset_;
    if (bytes_.size() - offset_ < word_bytes) {
      fail("expected " + std::string(what) + ", got the end of the file");
    }
    std::uint32_t stored = 0;
    BinaryNumbers(bytes_, offset_, swapped_).next(stored);
    offset_ += word_bytes;
    return stored;
  }

  float real(std::string_view what) { return std::bit_cast<float>(word(what)); }

  std::size_t count(std::string_view what) {
    const std::uint32_t number = word(what);
    if (number > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max())) {
      fail("expected " + std::string(what) + ", got " + std::to_string(number) + ", more than is supported");
    }
    return number;
  }

  void read_counts() {
    vertex_count_ = count("the number of vertices");
    face_count_ = count("the number of faces");
    word("the number of edges");  // which says nothing
    const std::size_t vertex_bytes = word_bytes * (3 + keyword_.least_extras() + dialect_.vertex_colour);
    const std::size_t face_bytes = word_bytes * (4 + dialect_.face_colour.value_or(1));
    const std::size_t left = bytes_.size() - offset_;
    require_room(path_, "vertices", vertex_count_, vertex_bytes, left);
    require_room(path_, "faces", face_count_, face_bytes, left - vertex_count_ * vertex_bytes);
  }

  void read_vertices() {
    shared_resize(document_.points, 3 * vertex_count_, sites_.offsets, 3 * vertex_count_, workers_.workers);
    VertexFields fields;
    if (!read_plain_vertices(fields)) {
      fields = {};
      read_vertices_one_by_one(fields);
    }
    if (keyword_.normals) {
      document_.point_arrays.push_back(make_data_array("normals", 3, std::move(fields.normals)));
    }
    fields.colours.move_to(document_.point_arrays);
    if (keyword_.texture_coordinates) {
      document_.point_arrays.push_back(
          make_data_array("texture_coordinates", 2, std::move(fields.texture_coordinates)));
    }
  }

  /// In parts, by all workers; false where anything is wrong.
  bool read_plain_vertices(VertexFields& fields) {
    if (workers_.part_bytes == FileWorkers::serial || vertex_count_ == 0) {
      return false;
    }
    const std::size_t normal = keyword_.normals ? 3 : 0;
    const std::size_t texture = keyword_.texture_coordinates ? 2 : 0;
    const std::size_t colour = dialect_.vertex_colour;
    fields.normals.resize(normal * vertex_count_);
    fields.texture_coordinates.resize(texture * vertex_count_);
    fields.colours.words.resize(colour * vertex_count_);
    fields.colours.components = colour;
    const std::size_t vertex_bytes = word_bytes * (3 + normal + texture + colour);
    const bool plain = all_file_blocks(workers_, vertex_count_, vertex_bytes, [&](std::size_t first, std::size_t last) {
      BinaryNumbers numbers(bytes_, offset_ + first * vertex_bytes, swapped_);
      bool finite = true;
      for (std::size_t vertex = first; vertex < last && finite; ++vertex) {
        for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
          float coordinate = 0;
          finite = numbers.next(coordinate) && std::isfinite(coordinate) && finite;
          document_.points[i] = static_cast<double>(coordinate);
          sites_.offsets[i] = numbers.token_offset();
        }
        if (!keyword_.colours_first) {
          read_row(numbers, fields.normals, normal, vertex);
        }
        read_row(numbers, fields.colours.words, colour, vertex);
        if (keyword_.colours_first) {
          read_row(numbers, fields.normals, normal, vertex);
        }
        read_row(numbers, fields.texture_coordinates, texture, vertex);
      }
      return finite;
    });
    offset_ += plain ? vertex_count_ * vertex_bytes : 0;
    return plain;
  }

  template <class T>
  static void read_row(BinaryNumbers& numbers, std::vector<T>& rows, std::size_t components, std::size_t row) {
    for (T& value : std::span(rows).subspan(components * row, components)) {
      numbers.next(value);
    }
  }

  void read_vertices_one_by_one(VertexFields& fields) {
    const auto read_normal = [&] {
      for (int i = 0; keyword_.normals && i < 3; ++i) {
        fields.normals.push_back(real("a normal"));
      }
    };
    for (std::size_t vertex = 0; vertex < vertex_count_; ++vertex) {
      for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
        document_.points[i] = static_cast<double>(real("a coordinate"));
        sites_.offsets[i] = word_offset_;
        if (!std::isfinite(document_.points[i])) {
          fail("vertex " + std::to_string(vertex) + " has a coordinate that is not a finite number");
        }
      }
      if (!keyword_.colours_first) {
        read_normal();
      }
      read_colour(fields.colours, vertex, dialect_.vertex_colour);
      if (keyword_.colours_first) {
        read_normal();
      }
      for (int i = 0; keyword_.texture_coordinates && i < 2; ++i) {
        fields.texture_coordinates.push_back(real("texture coordinates"));
      }
    }
  }

  void read_faces() {
    Colours colours;
    if (!read_plain_faces(colours)) {
      document_.cells = {};
      colours = {};
      read_faces_one_by_one(colours);
    }
    colours.move_to(document_.cell_arrays);
    if (!colours.uniform) {
      document_.notes.emplace_back(
          "The face colours have different numbers of components; they are kept in OFF output only.");
    }
  }

  /// Faces whose colours all have as many components as that of the first one, in parts, by all workers; false where
  /// anything is wrong or otherwise.
  bool read_plain_faces(Colours& colours) {
    const std::size_t left = bytes_.size() - offset_;
    if (workers_.part_bytes == FileWorkers::serial || face_count_ == 0) {
      return false;
    }
    std::uint32_t components = static_cast<std::uint32_t>(dialect_.face_colour.value_or(0));
    if (!dialect_.face_colour) {
      std::uint32_t degree = 0;
      BinaryNumbers(bytes_, offset_, swapped_).next(degree);
      if (degree > left / word_bytes ||
          !BinaryNumbers(bytes_, std::min(offset_ + (1 + std::size_t{degree}) * word_bytes, bytes_.size()), swapped_)
               .next(components) ||
          components > 4) {
        return false;
      }
    }
    const std::size_t counted = dialect_.face_colour ? 0 : 1;
    const BinaryListRows rows(bytes_, offset_,
                              {.rows = face_count_,
                               .item_bytes = word_bytes,
                               .bytes_behind = word_bytes * (counted + components),
                               .swapped = swapped_},
                              workers_);
    if (!rows.items()) {
      return false;
    }
    CellList& cells = document_.cells;
    shared_resize(cells.connectivity, *rows.items(), cells.offsets, face_count_ + 1, workers_.workers);
    shared_resize(cells.types, face_count_, colours.words, components * face_count_, workers_.workers);
    colours.components = components;
    const auto end = rows.read([&](BinaryNumbers& numbers, const PlainListRows::Part& part) {
      std::size_t item = part.first_item;
      for (std::size_t face = part.first; face < part.last; ++face) {
        std::uint32_t degree = 0;
        if (!numbers.next(degree) || degree < 3) {
          return false;
        }
        for (const std::size_t face_end = item + degree; item < face_end; ++item) {
          std::uint32_t index = 0;
          if (!numbers.next(index) || index >= vertex_count_) {
            return false;
          }
          cells.connectivity[item] = static_cast<std::int32_t>(index);
        }
        std::uint32_t declared = components;
        if (counted == 1 && (!numbers.next(declared) || declared != components)) {
          return false;
        }
        read_row(numbers, colours.words, components, face);
        cells.offsets[face + 1] = static_cast<std::int64_t>(item);
        cells.types[face] = cell_type::of_face(degree);
      }
      return true;
    });
    offset_ = end ? end->offset : offset_;
    return end.has_value();
  }

  void read_faces_one_by_one(Colours& colours) {
    CellList& cells = document_.cells;
    for (std::size_t face = 0; face < face_count_; ++face) {
      const std::uint32_t degree = word("the number of vertices of a face");
      if (degree < 3 || degree > (bytes_.size() - offset_) / word_bytes) {
        fail_face(face, "has " + std::to_string(degree) + " vertices; expected 3 or more, and the file has room for " +
                            std::to_string((bytes_.size() - offset_) / word_bytes) + " at most");
      }
      for (std::uint32_t corner = 0; corner < degree; ++corner) {
        const std::uint32_t index = word("a vertex index");
        if (index >= vertex_count_) {
          fail_face(face, "vertex index " + std::to_string(static_cast<std::int32_t>(index)) +
                              " is out of range, the file has " + std::to_string(vertex_count_) + " vertices");
        }
        cells.connectivity.push_back(static_cast<std::int32_t>(index));
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
      cells.types.push_back(cell_type::of_face(degree));
      const std::size_t components = dialect_.face_colour ? *dialect_.face_colour : word("a number of components");
      if (components > 4) {
        fail_face(face, "has a colour of " + std::to_string(components) + " components; expected 0 to 4");
      }
      read_colour(colours, face, components);
    }
  }

  void read_colour(Colours& colours, std::size_t row, std::size_t components) {
    colours.begin_row(row, components);
    for (std::size_t i = 0; i < components; ++i) {
      colours.words.push_back(word("a colour"));
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(path_, "byte " + std::to_string(word_offset_) + ": " + message);
  }
  [[noreturn]] void fail_face(std::size_t face, const std::string& message) const {
    fail("face " + std::to_string(face) + " " + message);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  FileWorkers workers_;
  std::size_t offset_;
  std::size_t word_offset_;  ///< of the word that was read last
  const OffKeyword& keyword_;
  Dialect dialect_;
  bool swapped_;  ///< words are not in this machine's byte order
  MeshDocument document_;
  NumberSites sites_;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
};

/// The dialects that the keyword leaves open, the more frequent ones first.
std::vector<Dialect> dialects_of(const OffKeyword& keyword) {
  using enum NumberEncoding;
  constexpr std::array<std::size_t, 3> with_colours{4, 3, 0};
  const auto colours = std::span(with_colours).last(keyword.colours ? 3 : 1);
  std::vector<Dialect> dialects;
  for (const bool as_geomview : {true, false}) {
    for (const NumberEncoding byte_order :
         {as_geomview ? big_endian : little_endian, as_geomview ? little_endian : big_endian}) {
      for (const std::size_t of_vertex : colours) {
        if (as_geomview) {
          dialects.push_back({byte_order, of_vertex, std::nullopt});
          continue;
        }
        for (const std::size_t of_face : colours) {
          dialects.push_back({byte_order, of_vertex, of_face});
        }
      }
    }
  }
  return dialects;
}

}  // namespace

std::pair<MeshDocument, NumberSites> read_binary_off(const std::filesystem::path& path, std::string_view bytes,
                                                     std::size_t begin, const OffKeyword& keyword,
                                                     const FileWorkers& workers) {
  // The error that is told is that of a dialect whose counts fit, if there is one: the first of them.
  std::vector<Dialect> dialects;
  std::vector<Dialect> others;
  for (const Dialect& dialect : dialects_of(keyword)) {
    const bool is_likely = BinaryOffReader(path, bytes, begin, keyword, dialect, workers).has_likely_counts();
    (is_likely ? dialects : others).push_back(dialect);
  }
  dialects.insert(dialects.end(), others.begin(), others.end());
  std::optional<ReadError> first;
  for (const Dialect& dialect : dialects) {
    try {
      return BinaryOffReader(path, bytes, begin, keyword, dialect, workers).read();
    } catch (const ReadError& error) {
      if (!first) {
        first = error;
      }
    }
  }
  throw ReadError(*first);
}

}  // namespace trismooth
