// SPDX-License-Identifier: BSD-3-Clause
// What comes back to the pieces of a mesh that rank 0 has.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <utility>

#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/document_layout.h"
#include "trismooth/pipeline/ranks/row_exchange.h"
#include "trismooth/pipeline/ranks/whole_mesh.h"

namespace trismooth {

namespace {

/// The arrays of rank 0; on the others without rows.
AddedArrays known_to_all(const AddedArrays& added, const mpi::Communicator& ranks) {
  MeshDocument told;
  told.point_arrays = added.point_arrays;
  told.cell_arrays = added.cell_arrays;
  std::vector<char> of_points = packed_point_layout(told);
  std::vector<char> of_cells = packed_cell_layout(told);
  ranks.broadcast(of_points);
  ranks.broadcast(of_cells);
  if (ranks.rank() > 0) {
    take_point_layout(of_points, told);
    take_cell_layout(of_cells, told);
  }
  return {std::move(told.point_arrays), std::move(told.cell_arrays)};
}

}  // namespace

std::vector<std::int32_t> WholeMesh::cells_of_copies(std::span<const std::int32_t> copies, std::size_t rank) const {
  const CellList& cells = document.cells;
  std::vector<std::pair<std::int32_t, std::int32_t>> by_lowest;  // of its corners
  for (std::size_t c = 0; c < cells.size() && !copies.empty(); ++c) {
    if (!cells[c].empty()) {
      by_lowest.emplace_back(*std::ranges::min_element(cells[c]), static_cast<std::int32_t>(c));
    }
  }
  std::ranges::sort(by_lowest);
  const auto in_order = [](std::span<const std::int32_t> corners) {
    std::vector<std::int32_t> ordered(corners.begin(), corners.end());
    std::ranges::sort(ordered);
    return ordered;
  };
  std::vector<std::int32_t> found;
  for (std::size_t at = 0; at < copies.size(); at += 1 + static_cast<std::size_t>(copies[at])) {
    std::vector<std::int32_t> corners;
    for (const std::int32_t v : copies.subspan(at + 1, static_cast<std::size_t>(copies[at]))) {
      corners.push_back(places_[rank][static_cast<std::size_t>(v)]);
    }
    std::ranges::sort(corners);
    found.push_back(static_cast<std::int32_t>(cells.size()));
    for (auto same = std::ranges::lower_bound(by_lowest, std::pair(corners.empty() ? -1 : corners.front(), 0));
         same != by_lowest.end() && !corners.empty() && same->first == corners.front(); ++same) {
      if (in_order(cells[static_cast<std::size_t>(same->second)]) == corners) {
        found.back() = same->second;
        break;
      }
    }
  }
  return found;
}

mpi::ByRank<std::int32_t> WholeMesh::cells_of_ranks(const PieceFiles& files, const mpi::Communicator& ranks) const {
  constexpr std::int64_t is_copy = -1;
  std::int64_t own = 0;
  for (const Piece& piece : files.pieces) {
    own += std::ranges::count(piece.ghost_cells, 0);
  }
  std::int64_t next = ranks.sum_before(own);
  std::vector<std::int64_t> numbers;
  std::vector<std::int32_t> copies;  // of each how many corners it has, and these
  for (std::size_t p = 0; p < files.pieces.size(); ++p) {
    const Piece& piece = files.pieces[p];
    for (std::size_t c = 0; c < piece.document.cells.size(); ++c) {
      if (piece.ghost_cells[c] == 0) {
        numbers.push_back(piece.cell_ids.empty() ? next++ : piece.cell_ids[c]);
        continue;
      }
      numbers.push_back(is_copy);
      copies.push_back(static_cast<std::int32_t>(piece.document.cells[c].size()));
      std::ranges::transform(piece.document.cells[c], std::back_inserter(copies),
                             [&](std::int32_t v) { return vertices_of_[p][static_cast<std::size_t>(v)]; });
    }
  }
  const mpi::ByRank<std::int64_t> numbers_of_ranks = on_first(std::move(numbers), ranks);
  const mpi::ByRank<std::int32_t> copies_of_ranks = on_first(std::move(copies), ranks);
  auto places = mpi::lists_by_rank<std::int32_t>(ranks);
  agree(ranks, [&] {
    for (std::size_t r = 0; r < places.size(); ++r) {
      const std::vector<std::int32_t> found = cells_of_copies(copies_of_ranks[r], r);
      auto copy = found.begin();
      for (const std::int64_t number : numbers_of_ranks[r]) {
        places[r].push_back(number == is_copy ? *copy++ : static_cast<std::int32_t>(number));
      }
    }
  });
  return places;
}

void WholeMesh::hand_back(PieceFiles& files, std::span<const std::string> point_arrays, const AddedArrays& added,
                          const mpi::Communicator& ranks) {
  if (is_of_piece_) {
    exchange_with(files.pieces.front().document);
    files.pieces.front().added = added;
    return;
  }
  const auto rows_of_rank = [&](std::span<const std::byte> rows, std::size_t size,
                                const mpi::ByRank<std::int32_t>& places, std::size_t count) {
    std::vector<std::int64_t> counts(places.size(), 0);
    counts[0] = static_cast<std::int64_t>(count);
    return exchanged_rows(rows, size, places, counts, ranks);
  };
  const std::vector<std::byte> places =
      rows_of_rank(std::as_bytes(std::span(document.points)), 3 * sizeof(double), places_, vertices_.size());
  for (std::size_t p = 0; p < files.pieces.size(); ++p) {
    const std::vector<std::byte> of_piece = rows_at(places, 3 * sizeof(double), vertices_of_[p]);
    std::memcpy(files.pieces[p].document.points.data(), of_piece.data(), of_piece.size());
  }
  for (const PieceArray& array : files.arrays) {
    if (array.of != PieceArray::Of::points || std::ranges::find(point_arrays, array.name) == point_arrays.end()) {
      continue;
    }
    const DataArray* const told = find_array(document.point_arrays, array.name);
    const std::size_t size = size_of(array.type) * static_cast<std::size_t>(array.components);
    const std::vector<std::byte> rows =
        rows_of_rank(told == nullptr ? std::span<const std::byte>{} : told->bytes, size, places_, vertices_.size());
    for (std::size_t p = 0; p < files.pieces.size(); ++p) {
      for (DataArray& values : files.pieces[p].document.point_arrays) {
        if (values.name == array.name) {
          values = with_rows(values, rows_at(rows, size, vertices_of_[p]));
        }
      }
    }
  }
  const AddedArrays told = known_to_all(added, ranks);
  for (const DataArray& array : told.point_arrays) {
    const std::vector<std::byte> rows = rows_of_rank(array.bytes, row_size_of(array), places_, vertices_.size());
    for (std::size_t p = 0; p < files.pieces.size(); ++p) {
      files.pieces[p].added.point_arrays.push_back(
          with_rows(array, rows_at(rows, row_size_of(array), vertices_of_[p])));
    }
  }
  if (told.cell_arrays.empty()) {
    return;
  }
  const mpi::ByRank<std::int32_t> cells = cells_of_ranks(files, ranks);
  std::size_t count = 0;
  for (const Piece& piece : files.pieces) {
    count += piece.document.cells.size();
  }
  for (const DataArray& array : told.cell_arrays) {
    std::vector<std::byte> of_document(array.bytes.size() + row_size_of(array));
    std::ranges::copy(array.bytes, of_document.begin());
    const std::vector<std::byte> rows = rows_of_rank(of_document, row_size_of(array), cells, count);
    auto row = rows.begin();
    for (Piece& piece : files.pieces) {
      const auto end = row + static_cast<std::ptrdiff_t>(piece.document.cells.size() * row_size_of(array));
      piece.added.cell_arrays.push_back(with_rows(array, {row, end}));
      row = end;
    }
  }
}

}  // namespace trismooth
