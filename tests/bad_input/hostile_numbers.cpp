// SPDX-License-Identifier: BSD-3-Clause
// Every number of every file of the collection replaced by hostile ones. What a number is for is found out by what
// changes with it: coordinates, vertex indices, counts, values of arrays, or nothing (comments, names).
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"

using accepted_files::AcceptedFile;
using trismooth::MeshDocument;

namespace {

constexpr std::string_view of_words = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.+-%";
constexpr std::string_view of_line = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.+-% ";

struct Place {
  std::size_t begin;
  std::size_t size;
};

/// Adds the words that are decimal numbers, in text that begins at `offset` of its file.
void add_numbers(std::string_view text, std::size_t offset, std::vector<Place>& places) {
  for (std::size_t begin = text.find_first_of(of_words); begin != text.npos;) {
    const std::size_t end = std::min(text.find_first_not_of(of_words, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const bool starts = word.find_first_of("0123456789") < 2;
    if (starts && word.find_first_not_of("0123456789.eE+-") == word.npos) {
      places.push_back({offset + begin, end - begin});
    }
    begin = text.find_first_of(of_words, end);
  }
}

/// The lines of a binary legacy file that are text: those that begin with a keyword.
void add_keyword_numbers(std::string_view bytes, std::vector<Place>& places) {
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = bytes.substr(begin, end - begin);
    if (line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") > 3 && line.find_first_not_of(of_line) == line.npos) {
      add_numbers(line, begin, places);
    }
    begin = end + 1;
  }
}

/// The numbers of what is text in the file; most of those that are not text throughout have a header that is.
std::vector<Place> text_numbers(const AcceptedFile& file) {
  const std::string_view bytes = file.bytes;
  std::vector<Place> places;
  if (file.extension == ".vtk" && bytes.find("\nBINARY") != bytes.npos) {
    add_keyword_numbers(bytes, places);
  } else if (file.extension == ".ply" && bytes.find("format ascii") == bytes.npos) {
    add_numbers(bytes.substr(0, bytes.find("end_header")), 0, places);
  } else if (!file.name.starts_with("stl_binary") && !contains(file.name, "off_big") &&
             !contains(file.name, "off_little") && !is_kept_by_hdf5(file) && file.extension != ".meshb") {
    add_numbers(bytes.substr(0, bytes.find("<AppendedData")), 0, places);
  }
  return places;
}

enum class Role : std::uint8_t {
  nothing,     ///< the document is the same whatever it says
  coordinate,  ///< of a point
  index,       ///< of a vertex, or something else that makes other cells of the same number
  value,       ///< of an array
  structure    ///< anything else: another number is refused
};

bool same_shape(const MeshDocument& a, const MeshDocument& b) {
  return a.points.size() == b.points.size() && a.cells.size() == b.cells.size();
}

Role role_of(const MeshDocument& whole, const std::vector<Outcome>& trials) {
  bool any = false;
  for (const Outcome& trial : trials) {
    if (!trial.document) {
      continue;
    }
    any = true;
    if (trial.document->points != whole.points) {
      return Role::coordinate;
    }
    if (trial.document->cells.connectivity != whole.cells.connectivity) {
      return Role::index;
    }
    if (!difference(whole, *trial.document).empty()) {
      return Role::value;
    }
  }
  return any ? Role::nothing : Role::structure;
}

/// The field of 8 or 16 columns in which the place is, in a deck of Nastran; the place itself between commas and tabs,
/// in comments, and in all other files.
Place field_of(const AcceptedFile& file, const Place& place) {
  const std::string_view bytes = file.bytes;
  const std::size_t begin = bytes.find_last_of("\r\n\xBF", place.begin) + 1;
  const std::string_view line = bytes.substr(begin, bytes.find_first_of("\r\n", begin) - begin);
  const std::size_t column = place.begin - begin;
  if (file.extension != ".bdf" || line.find_first_of(",\t$") != line.npos || column < 8) {
    return place;
  }
  const std::size_t width = contains(line.substr(0, 8), "*") ? 16 : 8;
  const std::size_t first = 8 + (column - 8) / width * width;
  return {begin + first, std::min(width, line.size() - first)};
}

/// In columns, numbers behind the one that is replaced stay where they are.
std::string replaced(const AcceptedFile& file, const Place& place, std::string_view by) {
  const Place field = field_of(file, place);
  std::string text(by);
  text.resize(field.size > place.size ? std::max(text.size(), field.size) : text.size(), ' ');
  return std::string(file.bytes).replace(field.begin, field.size, text);
}

std::optional<std::int64_t> whole_number(std::string_view word) {
  if (word.find_first_not_of("0123456789-") != word.npos || word.size() > 18) {
    return std::nullopt;
  }
  return std::stoll(std::string(word));
}

/// From 0 on, of those that 64 bits hold.
bool is_natural_number(std::string_view word) {
  return word.size() <= std::string_view("9223372036854775807").size() &&
         word.find_first_not_of("0123456789") == word.npos;
}

const std::vector<std::string> not_numbers{"nan",   "inf", "-inf", "NaN(0x1)", "1e999", "-1e400", "1,5",
                                           "1.5.2", "--1", "1e",   "0x1p3",    "0x10",  "x"};

std::vector<std::string> hostile_whole_numbers(std::int64_t right) {
  return {"-1",
          "-2147483648",
          "2147483647",
          "2147483648",
          "4294967296",
          std::to_string((std::int64_t{1} << 32) + right),
          "9223372036854775807",
          "18446744073709551616",
          "1000000000000000000000000000000",
          "1000000000",
          "0",
          std::to_string(right - 1),
          std::to_string(right + 1),
          "1.5"};
}

/// What is wrong with reading the file with `word` in place of the number.
std::string fault_of(const AcceptedFile& file, const MeshDocument& whole, const Place& place, Role role,
                     std::string_view word, bool is_number) {
  if (file.bytes.compare(place.begin, place.size, word) == 0) {
    return {};
  }
  const Outcome outcome = read(file, replaced(file, place, word));
  if (!outcome.fault.empty() || !outcome.document || role == Role::nothing) {
    return outcome.fault;
  }
  // The version of a legacy file, of which the part before the first point counts.
  if (file.extension == ".vtk" && place.begin < file.bytes.find('\n')) {
    return {};
  }
  // Tags of elements are any numbers, no two alike; by their groups they may be the same cell as another.
  const bool is_msh = file.extension == ".msh";
  const bool same_mesh =
      outcome.document->points == whole.points && outcome.document->cells.connectivity == whole.cells.connectivity;
  // How many partitions a mesh has says nothing.
  if (is_msh && contains(file.name, "partitioned") && same_mesh) {
    return {};
  }
  // Polygons have any number of nodes: what is no tag any more is one of these.
  if (is_msh && contains(file.name, "polygons") && role == Role::structure && word == "0") {
    return {};
  }
  if (is_msh && (role == Role::index ? contains(file.name, "groups") : role == Role::structure && same_mesh)) {
    return {};
  }
  // Where an array may hold more than is asked for, it may also be said to lie where a longer one does: that is told.
  const bool told = std::ranges::any_of(outcome.document->losses,
                                        [](const std::string& loss) { return contains(loss, "the rest is not kept"); });
  if (role == Role::structure && told && word == "0") {
    return {};
  }
  // Two numbers, where a file separates numbers by commas.
  const bool is_inp = file.extension == ".inp";
  const bool is_nastran = file.extension == ".bdf";
  if (word == "1,5" && (is_inp || is_nastran || contains(file.name, "_commas"))) {
    return {};
  }
  // The system 0 is the one in which all are.
  if (is_nastran && word == "0" && same_mesh && contains(file.name, "systems")) {
    return {};
  }
  // Longer than its field, it is more than one number.
  if (is_nastran && word.size() > std::max(field_of(file, place).size, place.size) && outcome.document) {
    return {};
  }
  // A data set of another number is somebody else's, and that is told.
  const bool is_elsewhere = std::ranges::any_of(outcome.document->notes, [](const std::string& note) {
    return contains(note, "What the data sets") && contains(note, "UNV");
  });
  if (file.extension == ".unv" && is_elsewhere && outcome.document->cells.size() != whole.cells.size()) {
    return {};
  }
  // Labels of elements are any numbers, no two alike, and members of groups may be missing.
  if (file.extension == ".unv" && role == Role::structure && same_mesh && is_natural_number(word)) {
    return {};
  }
  // Where a range of Abaqus ends is any number: ranges have gaps.
  if (is_inp && role == Role::value && same_mesh && is_natural_number(word)) {
    return {};
  }
  // Elements of Abaqus have any numbers from 0 on, no two alike.
  if (is_inp && role == Role::structure && same_mesh && is_natural_number(word)) {
    return {};
  }
  if (role == Role::structure || (!is_number && role != Role::value)) {
    return "is accepted";
  }
  // No narrower number that it may be the same as in some of its bits.
  const bool is_far_off = word.size() > 8 || (word.starts_with('-') && file.extension != ".obj");
  if (role == Role::index && is_far_off) {
    return "is accepted as the index of a vertex";
  }
  // Where strips end is said by numbers among their vertices.
  if (!same_shape(whole, *outcome.document) && file.extension != ".obj" && !contains(file.name, "_strips")) {
    return "is accepted with other numbers of points and cells";
  }
  const bool is_colour = file.extension == ".vtk" &&
                         file.bytes.rfind("COLOR_SCALARS", place.begin) != std::string::npos &&
                         file.bytes.find("FIELD", place.begin) != std::string::npos;
  // OBJ counts from the last vertex too; colours of legacy files are cut to the range of colours.
  // A group with a minus is the same in MSH.
  // Elements of a universal file are of the family that their descriptor names, with as many nodes as they have.
  const bool is_family = file.extension == ".unv" && word == "92";
  const bool may_be_same = ((file.extension == ".obj" || is_msh) && word == "-1") || is_colour || is_family;
  return !may_be_same && difference(whole, *outcome.document).empty() ? "is accepted, and is what stood there before"
                                                                      : "";
}

}  // namespace

TEST_CASE("A hostile number in text is refused, or is a value that an array may hold") {
  Faults faults;
  std::array<std::size_t, 5> roles{};
  for (const AcceptedFile& file : accepted_files::all()) {
    const MeshDocument whole = read(file).document.value();
    const std::vector<Place> places = text_numbers(file);
    for (std::size_t i = 0; i < places.size(); i += stride_of(file)) {
      const Place& place = places[i];
      const std::string_view word = std::string_view(file.bytes).substr(place.begin, place.size);
      const std::optional<std::int64_t> right = whole_number(word);
      std::vector<Outcome> trials;
      for (const std::string& other :
           {right ? std::to_string(*right + 1) : "0.5", right ? std::to_string(*right - 1) : "0.625"}) {
        trials.push_back(read(file, replaced(file, place, other)));
      }
      const Role role = role_of(whole, trials);
      ++roles[static_cast<std::size_t>(role)];
      const auto check = [&](std::string_view hostile, bool is_number) {
        faults.add_any(
            file.name,
            fmt::format("'{}' at byte {} is '{}' (role {})", word, place.begin, hostile, static_cast<int>(role)),
            fault_of(file, whole, place, role, hostile, is_number));
      };
      for (const std::string& hostile : not_numbers) {
        check(hostile, false);
      }
      if (right && role != Role::coordinate) {
        for (const std::string& hostile : hostile_whole_numbers(*right)) {
          check(hostile, hostile != "1.5");
        }
      }
    }
  }
  // None of the roles went unnoticed.
  CHECK(std::ranges::all_of(roles, [](std::size_t count) { return count > 50; }));
  REQUIRE_NONE(faults);
}
