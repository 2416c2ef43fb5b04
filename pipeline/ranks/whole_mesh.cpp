// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/whole_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/description_words.h"
#include "trismooth/pipeline/ranks/row_exchange.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

namespace {

using Place = std::array<double, 3>;

/// The piece's array, or null: pieces that hold nothing may lack it.
const DataArray* find_array_of(const PieceArray& wanted, const MeshDocument& document) {
  const std::vector<DataArray>& arrays =
      wanted.of == PieceArray::Of::points ? document.point_arrays : document.cell_arrays;
  const auto found = std::ranges::find_if(arrays, [&](const DataArray& array) {
    return array.name == wanted.name && array.type == wanted.type && array.components == wanted.components;
  });
  return found == arrays.end() ? nullptr : &*found;
}

std::size_t row_bytes(const PieceArray& array) {
  return size_of(array.type) * static_cast<std::size_t>(array.components);
}

void append_row(std::vector<std::byte>& bytes, const DataArray* array, std::size_t row, std::size_t size) {
  if (array == nullptr) {
    bytes.resize(bytes.size() + size);  // of what no piece has said anything
  } else {
    const auto values = array->bytes.subspan(row * size, size);
    bytes.insert(bytes.end(), values.begin(), values.end());
  }
}

DataArray array_of(const PieceArray& told, std::vector<std::byte> bytes,
                   std::shared_ptr<const ArrayDescription> description) {
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {told.name, told.type, static_cast<std::size_t>(told.components), *owner, owner, std::move(description)};
}

/// What is said of the arrays, in their order, on rank 0: by the first piece that holds anything.
std::vector<std::shared_ptr<const ArrayDescription>> descriptions(const PieceFiles& files,
                                                                  const mpi::Communicator& ranks) {
  std::vector<char> bytes;
  const auto first = std::ranges::find_if(files.pieces, &holds_something);
  for (std::size_t i = 0; i < files.arrays.size() && first != files.pieces.end(); ++i) {
    const MeshDocument& document = first->document;
    const DataArray* const array =
        files.arrays[i].of == PieceArray::Of::coordinates ? nullptr : find_array_of(files.arrays[i], document);
    const ArrayDescription* const told =
        array == nullptr ? document.points_description.get() : array->description.get();
    for (const std::string& word : words_of(told)) {
      bytes.insert(bytes.end(), word.begin(), word.end());
      bytes.push_back('\0');
    }
  }
  const std::vector<char> told = first_bytes(bytes, ranks);
  std::vector<std::string> words;
  for (auto at = told.begin(); at != told.end();) {
    const auto end = std::find(at, told.end(), '\0');
    words.emplace_back(at, end);
    at = end + 1;
  }
  std::vector<std::shared_ptr<const ArrayDescription>> found;
  auto word = words.cbegin();
  while (word != words.cend()) {
    found.push_back(description_of(word));
  }
  return found;
}

/// Takes out the bit by which VTK marks copies, and the array where nothing else is in it.
void leave_out_copy_marks(std::vector<DataArray>& arrays) {
  constexpr auto other_marks = std::byte{0xFE};
  const auto marks = std::ranges::find_if(arrays, [](const DataArray& array) {
    return array.name == ghost_flags_name && array.type == ScalarType::uint8 && array.components == 1;
  });
  if (marks == arrays.end()) {
    return;
  }
  std::vector<std::byte> bytes(marks->bytes.begin(), marks->bytes.end());
  for (std::byte& byte : bytes) {
    byte &= other_marks;
  }
  if (std::ranges::all_of(bytes, [](std::byte byte) { return byte == std::byte{0}; })) {
    arrays.erase(marks);
    return;
  }
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  marks->bytes = *owner;
  marks->owner = owner;
}

/// A field as bytes: what it is called and holds.
std::vector<char> packed_field(const DataArray& field) {
  std::vector<char> bytes(field.name.begin(), field.name.end());
  bytes.push_back('\0');
  bytes.push_back(static_cast<char>(field.type));
  const std::array<std::uint64_t, 2> counts{field.components, field.bytes.size()};
  const auto* const numbers = reinterpret_cast<const char*>(counts.data());
  bytes.insert(bytes.end(), numbers, numbers + sizeof(counts));
  const auto* const values = reinterpret_cast<const char*>(field.bytes.data());
  bytes.insert(bytes.end(), values, values + field.bytes.size());
  return bytes;
}

std::vector<DataArray> unpacked_fields(const std::vector<char>& bytes) {
  std::vector<DataArray> fields;
  for (auto at = bytes.begin(); at != bytes.end();) {
    const auto name_end = std::find(at, bytes.end(), '\0');
    PieceArray told{PieceArray::Of::points, static_cast<ScalarType>(name_end[1]), 1, std::string(at, name_end)};
    std::array<std::uint64_t, 2> counts{};
    std::memcpy(counts.data(), &name_end[2], sizeof(counts));
    told.components = counts[0];
    const auto values = name_end + 2 + sizeof(counts);
    const auto end = values + static_cast<std::ptrdiff_t>(counts[1]);
    std::vector<std::byte> held(counts[1]);
    std::transform(values, end, held.begin(), [](char value) { return static_cast<std::byte>(value); });
    fields.push_back(array_of(told, std::move(held), nullptr));
    at = end;
  }
  return fields;
}

/// Whether the points of a piece are the mesh's as they stand, and its cells are.
bool is_whole(const Piece& piece) {
  for (std::size_t i = 0; i < piece.ids.size(); ++i) {
    if (piece.ids[i] != static_cast<std::int64_t>(i)) {
      return false;
    }
  }
  return std::ranges::count(piece.ghost_cells, 0) == std::ssize(piece.ghost_cells);
}

bool are_same(const DataArray* a, const DataArray* b) {
  return a != nullptr && b != nullptr && packed_field(*a) == packed_field(*b);
}

}  // namespace

WholeMesh::WholeMesh(PieceFiles& files, const mpi::Communicator& ranks) {
  document.format = files.file.piece_format;
  if (ranks.size() == 1 && files.pieces.size() == 1 && is_whole(files.pieces.front())) {
    is_of_piece_ = true;
    exchange_with(files.pieces.front().document);
    const SharedNumbers& numbers = files.pieces.front().ids;
    ids.assign(numbers.begin(), numbers.end());
    leave_out_copy_marks(document.point_arrays);
    leave_out_copy_marks(document.cell_arrays);
    return;
  }
  find_vertices(files);
  number_points(files, ranks);
  gather_points(files, ranks);
  gather_cells(files, ranks);
  gather_arrays(files, ranks);
  gather_fields(files, ranks);
}

void WholeMesh::exchange_with(MeshDocument& of_piece) {
  std::swap(document.points, of_piece.points);
  std::swap(document.point_type, of_piece.point_type);
  std::swap(document.has_float32_axis, of_piece.has_float32_axis);
  std::swap(document.points_description, of_piece.points_description);
  std::swap(document.cells, of_piece.cells);
  std::swap(document.point_arrays, of_piece.point_arrays);
  std::swap(document.cell_arrays, of_piece.cell_arrays);
  std::swap(document.field_arrays, of_piece.field_arrays);
  std::swap(document.has_stale_annotations, of_piece.has_stale_annotations);
}

void WholeMesh::find_vertices(const PieceFiles& files) {
  for (std::size_t p = 0; p < files.pieces.size(); ++p) {
    const Piece& piece = files.pieces[p];
    std::vector<std::uint8_t> is_copy(piece.ids.size(), 1);
    for (std::size_t c = 0; c < piece.document.cells.size(); ++c) {
      if (piece.ghost_cells[c] == 0) {
        for (const std::int32_t v : piece.document.cells[c]) {
          is_copy[static_cast<std::size_t>(v)] = 0;
        }
      }
    }
    for (std::size_t i = 0; i < piece.ids.size(); ++i) {
      vertices_.push_back({piece.ids[i], is_copy[i], static_cast<std::int32_t>(p), static_cast<std::int32_t>(i)});
    }
  }
  std::ranges::sort(vertices_, {}, [](const RankVertex& v) { return std::tuple(v.id, v.is_copy, v.piece); });
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end(),
                              [](const RankVertex& a, const RankVertex& b) { return a.id == b.id; }),
                  vertices_.end());
  for (const Piece& piece : files.pieces) {
    std::vector<std::int32_t>& places = vertices_of_.emplace_back();
    for (const std::int64_t id : piece.ids) {
      places.push_back(
          static_cast<std::int32_t>(std::ranges::lower_bound(vertices_, id, {}, &RankVertex::id) - vertices_.begin()));
    }
  }
}

void WholeMesh::number_points(const PieceFiles& files, const mpi::Communicator& ranks) {
  std::vector<std::int64_t> own_ids;
  std::vector<std::uint8_t> own_copies;
  for (const RankVertex& vertex : vertices_) {
    own_ids.push_back(vertex.id);
    own_copies.push_back(vertex.is_copy);
  }
  const mpi::ByRank<std::int64_t> ids_of_ranks = on_first(std::move(own_ids), ranks);
  const mpi::ByRank<std::uint8_t> copies = on_first(std::move(own_copies), ranks);
  agree(ranks, [&] {
    for (const auto& list : ids_of_ranks) {
      ids.insert(ids.end(), list.begin(), list.end());
    }
    std::ranges::sort(ids);
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    check_document_size(ids.size(), 0, files.path);
    constexpr std::int32_t nobody = -1;
    std::vector<std::int32_t> teller(ids.size(), nobody);
    std::vector<std::uint8_t> is_copied(ids.size(), 1);
    for (std::size_t r = 0; r < ids_of_ranks.size(); ++r) {
      std::vector<std::int32_t>& places = places_.emplace_back();
      for (std::size_t i = 0; i < ids_of_ranks[r].size(); ++i) {
        const auto v = static_cast<std::size_t>(std::ranges::lower_bound(ids, ids_of_ranks[r][i]) - ids.begin());
        places.push_back(static_cast<std::int32_t>(v));
        if (teller[v] == nobody || copies[r][i] < is_copied[v]) {
          teller[v] = static_cast<std::int32_t>(r);
          is_copied[v] = copies[r][i];
        }
      }
    }
    for (std::size_t r = 0; r < places_.size(); ++r) {
      std::vector<std::uint8_t>& is_taken = is_taken_.emplace_back();
      for (const std::int32_t v : places_[r]) {
        is_taken.push_back(teller[static_cast<std::size_t>(v)] == static_cast<std::int32_t>(r) ? 1 : 0);
      }
    }
  });
}

void WholeMesh::gather_points(const PieceFiles& files, const mpi::Communicator& ranks) {
  std::vector<Place> own;
  for (const RankVertex& vertex : vertices_) {
    const double* const xyz = files.pieces[static_cast<std::size_t>(vertex.piece)].document.points.data() +
                              3 * static_cast<std::size_t>(vertex.point);
    own.push_back({xyz[0], xyz[1], xyz[2]});
  }
  const mpi::ByRank<Place> told = on_first(std::move(own), ranks);
  bool has_float32_axis = false;
  for (const Piece& piece : files.pieces) {
    has_float32_axis = has_float32_axis || piece.document.has_float32_axis;
  }
  document.has_float32_axis = ranks.any(has_float32_axis);
  document.points.resize(3 * ids.size());
  for (std::size_t r = 0; r < told.size(); ++r) {
    for (std::size_t i = 0; i < told[r].size(); ++i) {
      std::ranges::copy(told[r][i], document.points.begin() + 3 * static_cast<std::ptrdiff_t>(places_[r][i]));
    }
  }
}

void WholeMesh::gather_cells(const PieceFiles& files, const mpi::Communicator& ranks) {
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> sizes;
  std::vector<std::int32_t> corners;
  std::vector<std::int64_t> numbers;
  for (std::size_t p = 0; p < files.pieces.size(); ++p) {
    const Piece& piece = files.pieces[p];
    for (std::size_t c = 0; c < piece.document.cells.size(); ++c) {
      if (piece.ghost_cells[c] == 0) {
        types.push_back(piece.document.cells.types[c]);
        numbers.push_back(piece.cell_ids.empty() ? 0 : piece.cell_ids[c]);
        sizes.push_back(static_cast<std::int32_t>(piece.document.cells[c].size()));
        std::ranges::transform(piece.document.cells[c], std::back_inserter(corners),
                               [&](std::int32_t v) { return vertices_of_[p][static_cast<std::size_t>(v)]; });
      }
    }
  }
  const mpi::ByRank<std::uint8_t> types_of_ranks = on_first(std::move(types), ranks);
  const mpi::ByRank<std::int32_t> sizes_of_ranks = on_first(std::move(sizes), ranks);
  const mpi::ByRank<std::int32_t> corners_of_ranks = on_first(std::move(corners), ranks);
  const mpi::ByRank<std::int64_t> numbers_of_ranks = on_first(std::move(numbers), ranks);
  agree(ranks, [&] {
    CellList cells;
    std::vector<std::int32_t> cell;
    std::vector<std::int64_t> number_of;
    for (std::size_t r = 0; r < types_of_ranks.size(); ++r) {
      auto corner = corners_of_ranks[r].begin();
      for (std::size_t c = 0; c < types_of_ranks[r].size(); ++c) {
        cell.clear();
        for (std::int32_t i = 0; i < sizes_of_ranks[r][c]; ++i) {
          cell.push_back(places_[r][static_cast<std::size_t>(*corner++)]);
        }
        cells.append(types_of_ranks[r][c], cell);
      }
      number_of.insert(number_of.end(), numbers_of_ranks[r].begin(), numbers_of_ranks[r].end());
    }
    if (!std::ranges::is_sorted(number_of)) {
      cell_order_.resize(number_of.size());
      std::iota(cell_order_.begin(), cell_order_.end(), std::size_t{0});
      std::ranges::sort(cell_order_, {}, [&](std::size_t c) { return number_of[c]; });
      CellList sorted;
      for (const std::size_t c : cell_order_) {
        sorted.append(cells.types[c], cells[c]);
      }
      cells = std::move(sorted);
    }
    document.cells = std::move(cells);
    check_document_size(0, document.cells.size(), files.path);
  });
}

void WholeMesh::gather_arrays(const PieceFiles& files, const mpi::Communicator& ranks) {
  const auto told = descriptions(files, ranks);
  for (std::size_t i = 0; i < files.arrays.size(); ++i) {
    const PieceArray& array = files.arrays[i];
    const std::size_t size = row_bytes(array);
    std::vector<std::byte> own;
    if (array.of == PieceArray::Of::coordinates) {
      document.point_type = array.type;
      document.points_description = ranks.rank() == 0 ? told[i] : nullptr;
      continue;
    }
    if (array.of == PieceArray::Of::points) {
      for (const RankVertex& vertex : vertices_) {
        append_row(own, find_array_of(array, files.pieces[static_cast<std::size_t>(vertex.piece)].document),
                   static_cast<std::size_t>(vertex.point), size);
      }
    } else {
      for (const Piece& piece : files.pieces) {
        const DataArray* const values = find_array_of(array, piece.document);
        for (std::size_t c = 0; c < piece.document.cells.size(); ++c) {
          if (piece.ghost_cells[c] == 0) {
            append_row(own, values, c, size);
          }
        }
      }
    }
    mpi::ByRank<std::byte> rows = on_first(std::move(own), ranks);
    if (ranks.rank() > 0) {
      continue;
    }
    std::vector<std::byte> all;
    if (array.of == PieceArray::Of::points) {
      all.resize(size * ids.size());
      for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t v = 0; v < places_[r].size(); ++v) {
          if (is_taken_[r][v] != 0) {
            std::copy_n(rows[r].begin() + static_cast<std::ptrdiff_t>(v * size), size,
                        all.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(places_[r][v]) * size));
          }
        }
      }
      document.point_arrays.push_back(array_of(array, std::move(all), told[i]));
    } else {
      for (std::vector<std::byte>& of_rank : rows) {
        all.insert(all.end(), of_rank.begin(), of_rank.end());
        of_rank = {};
      }
      if (!cell_order_.empty()) {
        std::vector<std::byte> sorted;
        sorted.reserve(all.size());
        for (const std::size_t c : cell_order_) {
          const auto row = std::span(all).subspan(c * size, size);
          sorted.insert(sorted.end(), row.begin(), row.end());
        }
        all = std::move(sorted);
      }
      document.cell_arrays.push_back(array_of(array, std::move(all), told[i]));
    }
  }
  leave_out_copy_marks(document.point_arrays);
  leave_out_copy_marks(document.cell_arrays);
}

void WholeMesh::gather_fields(const PieceFiles& files, const mpi::Communicator& ranks) {
  std::vector<char> own;
  const auto first = std::ranges::find_if(files.pieces, &holds_something);
  if (first != files.pieces.end()) {
    for (const DataArray& field : first->document.field_arrays) {
      const std::vector<char> bytes = packed_field(field);
      own.insert(own.end(), bytes.begin(), bytes.end());
    }
  }
  const std::vector<DataArray> fields = unpacked_fields(first_bytes(own, ranks));
  std::set<std::string> differing;
  for (const Piece& piece : files.pieces) {
    if (!holds_something(piece)) {
      continue;
    }
    const std::vector<DataArray>& others = piece.document.field_arrays;
    for (const auto& listed : {std::span(fields), std::span(others)}) {
      for (const DataArray& field : listed) {
        if (!are_same(find_array(fields, field.name), find_array(others, field.name))) {
          differing.insert(field.name);
        }
      }
    }
  }
  const std::vector<std::string> left_out = texts_of_all(differing, ranks);
  if (ranks.rank() > 0) {
    return;
  }
  for (const DataArray& field : fields) {
    if (std::ranges::find(left_out, field.name) == left_out.end()) {
      document.field_arrays.push_back(field);
    }
  }
  for (const std::string& name : left_out) {
    document.losses.push_back("the field array '" + name + "' is not the same in all pieces: it is not written");
  }
}

}  // namespace trismooth
