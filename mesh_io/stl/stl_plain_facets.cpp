#include "trismooth/mesh_io/stl/stl_plain_facets.h"

#include <array>
#include <cmath>
#include <limits>

#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/stl/stl_layout.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

namespace {

constexpr std::size_t most_facets = std::numeric_limits<std::int32_t>::max() / 3;

constexpr std::size_t offset_of_corner(std::size_t corner) {
  return stl_layout::header_bytes + corner / 3 * stl_layout::facet_bytes + (1 + corner % 3) * stl_layout::vector_bytes;
}

/// Words and numbers of the facets of a text.
class FacetText {
 public:
  FacetText(std::string_view text, std::size_t offset) : text_(text), at_(offset) {}

  void skip_space() {
    while (at_ < text_.size() && is_white_space(text_[at_])) {
      ++at_;
    }
  }

  bool at_end() const { return at_ == text_.size(); }
  std::size_t offset() const { return at_; }
  /// Of the word or number that was read last.
  std::size_t token_offset() const { return token_; }

  /// Reads the next token, if it is that word.
  bool next(std::string_view word) {
    skip_space();
    token_ = at_;
    const bool is_word = text_.substr(at_).starts_with(word);
    at_ += is_word ? word.size() : 0;
    return is_word && (at_end() || is_white_space(text_[at_]));
  }

  bool skip(std::size_t tokens) {
    PlainNumbers numbers(text_, at_);
    const bool skipped = numbers.skip(tokens);
    at_ = numbers.offset();
    return skipped;
  }

  bool next(double& coordinate) {
    PlainNumbers numbers(text_, at_);
    const bool plain = numbers.next(coordinate) && std::isfinite(coordinate);
    token_ = numbers.token_offset();
    at_ = numbers.offset();
    return plain;
  }

 private:
  std::string_view text_;
  std::size_t at_;
  std::size_t token_ = 0;
};

/// The facets that begin in a part of a text.
struct FacetPart {
  std::size_t facets = 0;
  std::size_t first = 0;      ///< the number of the first one, among those of all parts
  std::size_t begin = 0;      ///< byte offset of the first one
  std::size_t last_word = 0;  ///< of the last word of the last one
  std::size_t end = 0;        ///< behind it
};

class PlainTextReader {
 public:
  PlainTextReader(std::string_view text, std::size_t offset, const FileWorkers& workers)
      : text_(text), offset_(offset), workers_(workers), lines_(text, offset, workers), parts_(lines_.size()) {}

  std::optional<PlainTextFacets> read() {
    lines_.all_of([this](std::size_t part) { return find_facets(part); });
    std::size_t facets = 0;
    for (FacetPart& part : parts_) {
      part.first = facets;
      facets += part.facets;
    }
    constexpr std::size_t least_facet_bytes = 86;  // 9 words, 12 numbers, and a separator behind each
    if (facets == 0 || facets > (text_.size() + 1) / least_facet_bytes || facets > most_facets) {
      return std::nullopt;
    }
    PlainTextFacets result{};
    shared_resize(points_, 9 * facets, result.facets.offsets, 9 * facets, workers_.workers);
    if (!lines_.all_of([&](std::size_t part) { return read_facets(parts_[part], result.facets.offsets); }) ||
        !are_all()) {
      return std::nullopt;
    }
    for (const FacetPart& part : parts_) {
      if (part.facets > 0) {
        result.last_word = part.last_word;
        result.end = part.end;
      }
    }
    if (!is_end_of_text(result.end)) {
      return std::nullopt;
    }
    const auto point_of = [this](std::size_t corner) {
      return std::array{points_[3 * corner], points_[3 * corner + 1], points_[3 * corner + 2]};
    };
    result.facets.corners = weld_corners<double>(3 * facets, point_of, workers_);
    return result;
  }

 private:
  bool find_facets(std::size_t number) {
    FacetPart& part = parts_[number];
    const std::string_view text = text_.substr(0, lines_.end(number));
    std::size_t facets = 0;
    for (std::size_t line = lines_.begin(number); line < text.size(); line = find_line_end(text, line)) {
      FacetText words(text, line);
      words.skip_space();
      line = words.offset();
      if (words.next("facet")) {
        part.begin = facets == 0 ? line : part.begin;
        ++facets;
      }
    }
    part.facets = facets;
    return true;
  }

  bool read_facets(FacetPart& part, std::vector<std::uint64_t>& offsets) {
    FacetText words(text_, part.begin);
    for (std::size_t facet = part.first; facet < part.first + part.facets; ++facet) {
      if (!words.next("facet") || !words.next("normal") || !words.skip(3) || !words.next("outer") ||
          !words.next("loop")) {
        return false;
      }
      for (std::size_t i = 9 * facet; i < 9 * facet + 9; ++i) {
        if ((i % 3 == 0 && !words.next("vertex")) || !words.next(points_[i])) {
          return false;
        }
        offsets[i] = words.token_offset();
      }
      if (!words.next("endloop") || !words.next("endfacet")) {
        return false;
      }
    }
    part.last_word = words.token_offset();
    part.end = words.offset();
    return true;
  }

  /// True where each part's facets begin behind those of the part before.
  bool are_all() const {
    std::size_t end = offset_;
    for (const FacetPart& part : parts_) {
      if (part.facets > 0) {
        FacetText words(text_, end);
        words.skip_space();
        if (words.offset() != part.begin) {
          return false;
        }
        end = part.end;
      }
    }
    return true;
  }

  bool is_end_of_text(std::size_t offset) const {
    FacetText words(text_, offset);
    if (words.next("endsolid")) {
      words = FacetText(text_, find_line_end(text_, words.offset()));
    }
    words.skip_space();
    return words.at_end();
  }

  std::string_view text_;
  std::size_t offset_;
  FileWorkers workers_;
  LineParts lines_;
  std::vector<FacetPart> parts_;
  std::vector<double> points_;
};

}  // namespace

std::optional<PlainBinaryFacets> read_plain_binary_facets(std::string_view bytes, std::size_t count,
                                                          const FileWorkers& workers) {
  if (workers.part_bytes == FileWorkers::serial || count > most_facets) {
    return std::nullopt;
  }
  PlainBinaryFacets result;
  std::vector<std::uint64_t>& offsets = result.facets.offsets;
  shared_resize(offsets, 9 * count, result.attributes, count, workers.workers);
  const bool plain = all_file_blocks(workers, count, stl_layout::facet_bytes, [&](std::size_t first, std::size_t last) {
    for (std::size_t facet = first; facet < last; ++facet) {
      std::size_t offset = offset_of_corner(3 * facet);
      for (std::size_t i = 9 * facet; i < 9 * facet + 9; ++i, offset += sizeof(float)) {
        offsets[i] = offset;
        if (!std::isfinite(stl_layout::number_at<float>(bytes, offset))) {
          return false;
        }
      }
      result.attributes[facet] = stl_layout::number_at<std::uint16_t>(bytes, offset);
    }
    return true;
  });
  if (!plain) {
    return std::nullopt;
  }
  const auto point_of = [bytes](std::size_t corner) {
    const std::size_t offset = offset_of_corner(corner);
    return std::array{stl_layout::number_at<float>(bytes, offset),
                      stl_layout::number_at<float>(bytes, offset + sizeof(float)),
                      stl_layout::number_at<float>(bytes, offset + 2 * sizeof(float))};
  };
  result.facets.corners = weld_corners<float>(3 * count, point_of, workers);
  return result;
}

std::optional<PlainTextFacets> read_plain_text_facets(std::string_view text, std::size_t offset,
                                                      const FileWorkers& workers) {
  if (workers.part_bytes == FileWorkers::serial) {
    return std::nullopt;
  }
  return PlainTextReader(text, offset, workers).read();
}

}  // namespace trismooth
