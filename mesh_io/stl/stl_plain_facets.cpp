// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/stl/stl_plain_facets.h"

#include <cmath>
#include <utility>

#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/stl/stl_layout.h"
#include "trismooth/mesh_io/text/line_parts.h"
#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

namespace {

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
  bool expect(std::string_view word) {
    skip_space();
    token_ = at_;
    const bool is_word = text_.substr(at_).starts_with(word);
    at_ += is_word ? word.size() : 0;
    return is_word && (at_end() || is_white_space(text_[at_]));
  }

  bool expect_statement(std::string_view word) { return expect(word); }

  bool pass(std::size_t tokens, std::string_view /*what*/) {
    PlainNumbers numbers(text_, at_);
    const bool skipped = numbers.skip(tokens);
    at_ = numbers.offset();
    return skipped;
  }

  bool next(double& coordinate, std::string_view /*what*/) {
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
      : text_(text), offset_(offset), workers_(workers.workers), lines_(text, offset, workers), parts_(lines_.size()) {}

  std::optional<PlainTextFacets> read() {
    lines_.all_of([this](std::size_t part) { return find_facets(part); });
    std::size_t facets = 0;
    for (FacetPart& part : parts_) {
      part.first = facets;
      facets += part.facets;
    }
    constexpr std::size_t least_facet_bytes = 86;  // 9 words, 12 numbers, and a separator behind each
    if (facets == 0 || facets > (text_.size() + 1) / least_facet_bytes || facets > stl_layout::most_facets) {
      return std::nullopt;
    }
    PlainTextFacets result;
    shared_resize(result.facets.points, 9 * facets, result.facets.offsets, 9 * facets, workers_);
    if (!lines_.all_of([&](std::size_t part) { return read_facets(parts_[part], result.facets); }) || !are_all()) {
      return std::nullopt;
    }
    for (const FacetPart& part : parts_) {
      if (part.facets > 0) {
        result.last_word = part.last_word;
        result.end = part.end;
      }
    }
    return is_end_of_text(result.end) ? std::optional(std::move(result)) : std::nullopt;
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
      if (words.expect("facet")) {
        part.begin = facets == 0 ? line : part.begin;
        ++facets;
      }
    }
    part.facets = facets;
    return true;
  }

  bool read_facets(FacetPart& part, StlTextFacets& facets) {
    FacetText words(text_, part.begin);
    for (std::size_t facet = part.first; facet < part.first + part.facets; ++facet) {
      if (!words.expect("facet") || !read_stl_facet(words, facet, facets)) {
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
    if (words.expect("endsolid")) {
      words = FacetText(text_, find_line_end(text_, words.offset()));
    }
    words.skip_space();
    return words.at_end();
  }

  std::string_view text_;
  std::size_t offset_;
  Workers& workers_;
  LineParts lines_;
  std::vector<FacetPart> parts_;
};

}  // namespace

std::optional<PlainTextFacets> read_plain_text_facets(std::string_view text, std::size_t offset,
                                                      const FileWorkers& workers) {
  if (workers.part_bytes == FileWorkers::serial) {
    return std::nullopt;
  }
  return PlainTextReader(text, offset, workers).read();
}

}  // namespace trismooth
