#include "trismooth/mesh_io/document/coordinate_sites.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// Ends of coordinate tokens: white space, a comment, the line continuation of OBJ.
constexpr std::string_view token_ends = " \t\v\f\r\n#\\";

/// The new bytes of a coordinate.
class SitePatcher {
 public:
  SitePatcher(std::string_view bytes, const CoordinateSites& sites) : bytes_(bytes), sites_(sites) {}

  /// The bytes that the coordinate at `offset` takes; fills `text` with new ones where `value` differs from it.
  std::size_t patch(std::size_t offset, std::size_t axis, double value, std::string& text) const {
    const ScalarType type = sites_.axis_types.empty() ? sites_.type : sites_.axis_types[axis];
    return visit_scalar_type(type,
                             [&](auto zero) { return patch_as(offset, static_cast<decltype(zero)>(value), text); });
  }

 private:
  template <class T>
  std::size_t patch_as(std::size_t offset, T value, std::string& text) const {
    text.clear();
    if (sites_.encoding == CoordinateEncoding::text) {
      const std::size_t end = std::min(bytes_.find_first_of(token_ends, offset), bytes_.size());
      const std::string_view token = bytes_.substr(offset, end - offset);
      if constexpr (std::is_floating_point_v<T>) {
        const std::optional<T> stored = parse_number<T>(token);
        if (!stored || differs(*stored, value)) {
          append_number(text, value);
        }
      } else if (parse_integer_as<T>(token) != value) {
        text = std::to_string(value);
      }
      return token.size();
    }
    std::array<char, sizeof(T)> stored{};
    std::memcpy(stored.data(), bytes_.data() + offset, sizeof(T));
    const bool swapped =
        (sites_.encoding == CoordinateEncoding::big_endian) == (std::endian::native == std::endian::little);
    if (swapped) {
      std::ranges::reverse(stored);
    }
    if (differs(std::bit_cast<T>(stored), value)) {
      auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
      if (swapped) {
        std::ranges::reverse(bytes);
      }
      text.assign(bytes.data(), bytes.size());
    }
    return sizeof(T);
  }

  /// A zero's sign counts: what is written is read back bit for bit. Where a vertex stands at several sites, they were
  /// found equal with whatever sign each has.
  template <class T>
  bool differs(T stored, T value) const {
    if constexpr (std::is_floating_point_v<T>) {
      return stored != value || (sites_.vertices.empty() && std::signbit(stored) != std::signbit(value));
    } else {
      return stored != value;
    }
  }

  std::string_view bytes_;
  const CoordinateSites& sites_;
};

}  // namespace

void write_patched(const std::filesystem::path& path, std::string_view bytes, const CoordinateSites& sites,
                   std::span<const double> points, std::string_view suffix) {
  BufferedWriter writer(path);
  const SitePatcher patcher(bytes, sites);
  std::size_t written = 0;
  std::string text;
  for (std::size_t site = 0; site < sites.offsets.size() / 3; ++site) {
    const std::size_t vertex = sites.vertices.empty() ? site : static_cast<std::size_t>(sites.vertices[site]);
    // A file may list y before x: the bytes are written in their own order.
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::ranges::sort(axes, {}, [&](std::size_t axis) { return sites.offsets[3 * site + axis]; });
    for (const std::size_t axis : axes) {
      const std::size_t offset = sites.offsets[3 * site + axis];
      const std::size_t length = patcher.patch(offset, axis, points[3 * vertex + axis], text);
      if (!text.empty()) {
        writer.write(bytes.substr(written, offset - written));
        writer.write(text);
        written = offset + length;
      }
    }
  }
  writer.write(bytes.substr(written));
  writer.write(suffix);
  writer.close();
}

}  // namespace trismooth
