// SPDX-License-Identifier: BSD-3-Clause
// Every file of the collection, cut at every byte. Most cuts are refused. Those that leave a whole file cannot be told
// from one: formats without an end or a count (OBJ, and the arrays of legacy VTK files) end wherever they are cut, and
// a last number is whole wherever it is cut. The samples of the formats say which cuts these are; no other is accepted.
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"
#include "support/format_sample.h"

using accepted_files::AcceptedFile;
using accepted_files::Rest;
using trismooth::DataArray;
using trismooth::MeshDocument;

namespace {

template <class T>
bool starts_as(const std::vector<T>& part, const std::vector<T>& whole, std::size_t last_apart = 0) {
  const std::size_t length = part.size() - std::min(part.size(), last_apart);
  return part.size() <= whole.size() &&
         std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(length), whole.begin());
}

/// Every array is one of the whole file, up to its last number.
bool arrays_start_as(std::span<const DataArray> part, std::span<const DataArray> whole) {
  return std::ranges::all_of(part, [whole](const DataArray& array) {
    const DataArray* const same = find_array(whole, array.name);
    const std::size_t certain = array.bytes.size() - std::min(array.bytes.size(), size_of(array.type));
    return same != nullptr && same->type == array.type && array.bytes.size() <= same->bytes.size() &&
           std::ranges::equal(array.bytes.first(certain), same->bytes.first(certain));
  });
}

/// Nodes and elements are those of the lines that are there, but the coordinates of the last node, of which any may be
/// left out. What the sets say is known at the end of the file only.
std::string_view not_a_beginning_of_deck(const MeshDocument& part, const MeshDocument& whole) {
  return starts_as(part.points, whole.points, 3) && starts_as(part.cells.connectivity, whole.cells.connectivity) &&
                 starts_as(part.cells.types, whole.cells.types)
             ? ""
             : "is accepted, and not as the beginning of the mesh";
}

/// The last cell of a file without counts may have lost vertices.
std::string_view not_a_beginning(const MeshDocument& part, const MeshDocument& whole, bool all_cells) {
  if (all_cells && (part.points != whole.points || part.cells.connectivity != whole.cells.connectivity)) {
    return "is accepted as another mesh";
  }
  return starts_as(part.points, whole.points) && starts_as(part.cells.connectivity, whole.cells.connectivity) &&
                 starts_as(part.cells.types, whole.cells.types, all_cells ? 0 : 1) &&
                 arrays_start_as(part.point_arrays, whole.point_arrays) &&
                 arrays_start_as(part.cell_arrays, whole.cell_arrays) &&
                 arrays_start_as(part.field_arrays, whole.field_arrays)
             ? ""
             : "is accepted, and not as the beginning of the mesh";
}

}  // namespace

TEST_CASE("A file cut anywhere is refused unless what is left is a whole file") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    const MeshDocument whole = read(file).document.value();
    const accepted_files::FormatSample& sample = accepted_files::sample_of(format_of(file));
    const Rest rest = sample.rest_of == nullptr ? Rest::all_cells : sample.rest_of(file);
    for (std::size_t cut = 0; cut < file.bytes.size(); cut += stride_of(file)) {
      const std::string place = fmt::format("cut at byte {}", cut);
      const Outcome outcome = read(file, file.bytes.substr(0, cut));
      faults.add_any(file.name, place, outcome.fault);
      if (outcome.document.has_value() != sample.is_whole(file, cut)) {
        faults.add(file.name, place, outcome.document ? "is accepted" : outcome.message);
      } else if (outcome.document && rest != Rest::another_mesh) {
        faults.add_any(file.name, place,
                       rest == Rest::lines ? not_a_beginning_of_deck(*outcome.document, whole)
                                           : not_a_beginning(*outcome.document, whole, rest == Rest::all_cells));
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("A last index that is cut short is another index: no reader of text can tell") {
  std::string text = "OFF\n12 1 0\n";
  for (int i = 0; i < 12; ++i) {
    text += fmt::format("{} {} 0\n", i, i * i);
  }
  text += "3 0 1 11";
  const AcceptedFile file{"last_index", ".off", text};
  CHECK(read(file).document.value().cells.connectivity.back() == 11);
  CHECK(read(file, text.substr(0, text.size() - 1)).document.value().cells.connectivity.back() == 1);
  CHECK(!read(file, text.substr(0, text.size() - 2)).document);
}
