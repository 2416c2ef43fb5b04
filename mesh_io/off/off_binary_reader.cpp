#include "trismooth/mesh_io/off/off_binary_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::size_t word_bytes = 4;

/// How a program writes binary OFF, beyond what the keyword says.
struct Dialect {
  CoordinateEncoding byte_order = CoordinateEncoding::big_endian;
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

class BinaryOffReader {
 public:
  BinaryOffReader(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                  const OffKeyword& keyword, const Dialect& dialect)
      : path_(path), bytes_(bytes), offset_(begin), word_offset_(begin), keyword_(keyword), dialect_(dialect) {
    document_.point_type = sites_.type = ScalarType::float32;
    sites_.encoding = dialect.byte_order;
  }

  std::pair<MeshDocument, CoordinateSites> read() {
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
    std::array<char, word_bytes> stored{};
    std::memcpy(stored.data(), bytes_.data() + offset_, word_bytes);
    if ((dialect_.byte_order == CoordinateEncoding::big_endian) == (std::endian::native == std::endian::little)) {
      std::ranges::reverse(stored);
    }
    offset_ += word_bytes;
    return std::bit_cast<std::uint32_t>(stored);
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
    document_.points.resize(3 * vertex_count_);
    sites_.offsets.resize(3 * vertex_count_);
    std::vector<float> normals;
    std::vector<float> texture_coordinates;
    Colours colours;
    const auto read_normal = [&] {
      for (int i = 0; keyword_.normals && i < 3; ++i) {
        normals.push_back(real("a normal"));
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
      read_colour(colours, vertex, dialect_.vertex_colour);
      if (keyword_.colours_first) {
        read_normal();
      }
      for (int i = 0; keyword_.texture_coordinates && i < 2; ++i) {
        texture_coordinates.push_back(real("texture coordinates"));
      }
    }
    if (keyword_.normals) {
      document_.point_arrays.push_back(make_data_array("normals", 3, std::move(normals)));
    }
    colours.move_to(document_.point_arrays);
    if (keyword_.texture_coordinates) {
      document_.point_arrays.push_back(make_data_array("texture_coordinates", 2, std::move(texture_coordinates)));
    }
  }

  void read_faces() {
    CellList& cells = document_.cells;
    Colours colours;
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
    colours.move_to(document_.cell_arrays);
    if (!colours.uniform) {
      document_.notes.emplace_back(
          "The face colours have different numbers of components; they are kept in OFF output only.");
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
  std::size_t offset_;
  std::size_t word_offset_;  ///< of the word that was read last
  const OffKeyword& keyword_;
  Dialect dialect_;
  MeshDocument document_;
  CoordinateSites sites_;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
};

/// The dialects that the keyword leaves open, the more frequent ones first.
std::vector<Dialect> dialects_of(const OffKeyword& keyword) {
  using enum CoordinateEncoding;
  constexpr std::array<std::size_t, 3> with_colours{4, 3, 0};
  const auto colours = std::span(with_colours).last(keyword.colours ? 3 : 1);
  std::vector<Dialect> dialects;
  for (const bool as_geomview : {true, false}) {
    for (const CoordinateEncoding byte_order :
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

std::pair<MeshDocument, CoordinateSites> read_binary_off(const std::filesystem::path& path, std::string_view bytes,
                                                         std::size_t begin, const OffKeyword& keyword) {
  std::vector<Dialect> dialects = dialects_of(keyword);
  // The error that is told is that of a dialect whose counts fit, if there is one: the first of them.
  std::stable_partition(dialects.begin(), dialects.end(), [&](const Dialect& dialect) {
    return BinaryOffReader(path, bytes, begin, keyword, dialect).has_likely_counts();
  });
  std::optional<ReadError> first;
  for (const Dialect& dialect : dialects) {
    try {
      return BinaryOffReader(path, bytes, begin, keyword, dialect).read();
    } catch (const ReadError& error) {
      if (!first) {
        first = error;
      }
    }
  }
  throw ReadError(*first);
}

}  // namespace trismooth
