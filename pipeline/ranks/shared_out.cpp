// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/shared_out.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/machine/release.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/new_parallel_file.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/document_layout.h"
#include "trismooth/pipeline/ranks/partition/bisection.h"
#include "trismooth/pipeline/ranks/place_index.h"
#include "trismooth/pipeline/ranks/row_exchange.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

namespace {

constexpr std::string_view point_numbers_name = "GlobalPointIds";
constexpr std::string_view cell_numbers_name = "GlobalCellIds";

/// A piece that no file was read for.
class NewPiece final : public OriginalFile {
 public:
  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    if (added_point_arrays.empty() && added_cell_arrays.empty()) {
      codec_of(document.format).write_shared(path, document, FileWorkers(workers));
      return;
    }
    MeshDocument changed = document;
    changed.point_arrays.insert(changed.point_arrays.end(), added_point_arrays.begin(), added_point_arrays.end());
    changed.cell_arrays.insert(changed.cell_arrays.end(), added_cell_arrays.begin(), added_cell_arrays.end());
    codec_of(changed.format).write_shared(path, changed, FileWorkers(workers));
  }

  std::vector<std::filesystem::path> other_files(const std::filesystem::path& path) const override {
    const auto format = format_of(path);
    const auto others_of = format ? codec_of(*format).other_files_of : nullptr;
    return others_of == nullptr ? std::vector<std::filesystem::path>() : others_of(path);
  }

  bool keeps_values_of(std::string_view /*point_array*/) const override { return false; }
  bool takes_added_arrays() const override { return true; }
};

/// How many elements of a mesh a cell of that type counts as.
std::int64_t count_elements(std::uint8_t type, std::span<const std::int32_t> vertices, Quads quads) {
  return count_triangles(type, vertices) + (quads == Quads::smooth && quad_of_cell(type, vertices) ? 1 : 0);
}

/// Places of 0, 1, ... by the rank that each goes to.
mpi::ByRank<std::int32_t> places_by_rank(std::span<const std::int32_t> targets, const mpi::Communicator& ranks) {
  auto places = mpi::lists_by_rank<std::int32_t>(ranks);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    places[static_cast<std::size_t>(targets[i])].push_back(static_cast<std::int32_t>(i));
  }
  return places;
}

/// The rank of those whose equal ranges of `count` things have number `number` in them.
std::int32_t rank_of_range(std::int64_t number, std::int64_t count, const mpi::Communicator& ranks) {
  const std::int64_t length = (count + ranks.size() - 1) / ranks.size();
  return static_cast<std::int32_t>(number / std::max<std::int64_t>(length, 1));
}

std::span<const std::byte> bytes_of(const std::vector<double>& values) {
  return std::as_bytes(std::span(values));
}

/// Sends what was read to where it belongs.
class Sharing {
 public:
  Sharing(MeshShare share, Partition partition, Quads quads, const std::filesystem::path& input,
          const mpi::Communicator& ranks)
      : share_(std::move(share)), document_(share_.document), quads_(quads), input_(input), ranks_(ranks) {
    first_point_ = ranks_.sum_before(std::ssize(document_.points) / 3);
    first_cell_ = ranks_.sum_before(std::ssize(document_.cells.types));
    point_count_ = ranks_.sum(std::ssize(document_.points) / 3);
    cell_count_ = ranks_.sum(std::ssize(document_.cells.types));
    first_points_ = ranks_.of_all(std::vector{first_point_});
    choose_ranks(partition);
  }

  Piece piece() {
    send_cells();
    number_triangles();
    find_points();
    send_points();
    number_corners();
    return std::move(piece_);
  }

 private:
  /// The rank that has read a point: the last of those whose ranges begin at it or before it.
  std::size_t reader_of(std::int64_t point) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(first_points_, point) - first_points_.begin() - 1);
  }

  void choose_ranks(Partition partition) {
    const std::size_t points = document_.point_count();
    const CellList& cells = document_.cells;
    cell_ranks_.resize(cells.size());
    if (partition == Partition::keep) {
      point_ranks_.resize(points);
      for (std::size_t p = 0; p < points; ++p) {
        point_ranks_[p] = rank_of_range(first_point_ + static_cast<std::int64_t>(p), point_count_, ranks_);
      }
      for (std::size_t c = 0; c < cells.size(); ++c) {
        cell_ranks_[c] = rank_of_range(first_cell_ + static_cast<std::int64_t>(c), cell_count_, ranks_);
      }
      return;
    }
    std::vector<Point2<double>> flat(points);
    for (std::size_t p = 0; p < points; ++p) {
      flat[p] = {document_.points[3 * p], document_.points[3 * p + 1]};
    }
    point_ranks_ = bisected(flat, ranks_.size(), ranks_);
    flat = {};
    // The rank of each cell's smallest corner, which whoever has read that point knows: cells of the same corners stay
    // together, as they have to in pieces.
    auto asked = mpi::lists_by_rank<std::int32_t>(ranks_);
    std::vector<std::int32_t> readers(cells.size(), -1);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (!cells[c].empty()) {
        const std::int64_t corner = std::ranges::min(cells[c]);
        const std::size_t reader = reader_of(corner);
        readers[c] = static_cast<std::int32_t>(reader);
        asked[reader].push_back(static_cast<std::int32_t>(corner - first_points_[reader]));
      }
    }
    const mpi::ByRank<std::int32_t> heard = ranks_.exchanged(std::move(asked));
    const mpi::ByRank<std::int32_t> told = ranks_.exchanged(values_at<std::int32_t>(point_ranks_, heard));
    std::vector<std::size_t> next(told.size(), 0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto reader = static_cast<std::size_t>(std::max(readers[c], 0));
      cell_ranks_[c] = readers[c] < 0 ? rank_of_range(first_cell_ + static_cast<std::int64_t>(c), cell_count_, ranks_)
                                      : told[reader][next[reader]++];
    }
  }

  void send_cells() {
    MeshDocument& made = piece_.document;
    CellList& cells = document_.cells;
    const mpi::ByRank<std::int32_t> places = places_by_rank(cell_ranks_, ranks_);
    const std::vector<std::int64_t> counts = ranks_.exchanged_counts(mpi::lengths_of(places));
    std::int64_t triangles = 0;
    {
      std::vector<std::int64_t> first_triangles(cells.size());
      for (std::size_t c = 0; c < cells.size(); ++c) {
        first_triangles[c] = triangles;
        triangles += count_elements(cells.types[c], cells[c], quads_);
      }
      const std::int64_t before = ranks_.sum_before(triangles);
      std::ranges::for_each(first_triangles, [before](std::int64_t& first) { first += before; });
      first_triangles_ = concatenated(ranks_.exchanged(values_at<std::int64_t>(first_triangles, places), counts));
    }
    auto numbers = mpi::lists_by_rank<std::int64_t>(ranks_);
    auto sizes = mpi::lists_by_rank<std::int32_t>(ranks_);
    auto corners = mpi::lists_by_rank<std::int32_t>(ranks_);
    for (std::size_t r = 0; r < places.size(); ++r) {
      for (const std::int32_t place : places[r]) {
        const auto c = static_cast<std::size_t>(place);
        numbers[r].push_back(first_cell_ + place);
        sizes[r].push_back(static_cast<std::int32_t>(cells[c].size()));
        corners[r].insert(corners[r].end(), cells[c].begin(), cells[c].end());
      }
    }
    piece_.cell_ids = concatenated(ranks_.exchanged(std::move(numbers), counts));
    made.cells.types = concatenated(ranks_.exchanged(values_at<std::uint8_t>(cells.types, places), counts));
    const std::vector<std::int32_t> all_sizes = concatenated(ranks_.exchanged(std::move(sizes), counts));
    made.cells.offsets.resize(all_sizes.size() + 1);
    std::inclusive_scan(all_sizes.begin(), all_sizes.end(), made.cells.offsets.begin() + 1, std::plus<>(),
                        std::int64_t{0});
    cells = {};
    made.cells.connectivity = concatenated(ranks_.exchanged(std::move(corners)));
    for (DataArray& array : document_.cell_arrays) {
      made.cell_arrays.push_back(
          with_rows(array, exchanged_rows(array.bytes, row_size_of(array), places, counts, ranks_)));
      array.bytes = {};
      array.owner.reset();
    }
  }

  /// Which points this rank needs, and whom it gets which of its own from.
  void find_points() {
    std::vector<std::int32_t> needed = piece_.document.cells.connectivity;
    std::ranges::sort(needed);
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    auto asked = mpi::lists_by_rank<std::int32_t>(ranks_);
    for (const std::int32_t point : needed) {
      const std::size_t reader = reader_of(point);
      asked[reader].push_back(static_cast<std::int32_t>(point - first_points_[reader]));
    }
    needed = {};
    mpi::ByRank<std::int32_t> own_asked = asked;
    sent_points_ = ranks_.exchanged(std::move(asked));
    // Points that nobody asks for are of no cell.
    std::vector<std::uint8_t> is_asked(document_.point_count(), 0);
    for (const auto& list : sent_points_) {
      for (const std::int32_t point : list) {
        is_asked[static_cast<std::size_t>(point)] = 1;
      }
    }
    auto others = mpi::lists_by_rank<std::int32_t>(ranks_);
    for (std::size_t p = 0; p < is_asked.size(); ++p) {
      if (is_asked[p] == 0) {
        const auto rank = static_cast<std::size_t>(point_ranks_[p]);
        others[rank].push_back(static_cast<std::int32_t>(p));
        sent_points_[rank].push_back(static_cast<std::int32_t>(p));
      }
    }
    const mpi::ByRank<std::int32_t> got = ranks_.exchanged(std::move(others));
    std::vector<std::int64_t> ids;
    for (std::size_t r = 0; r < got.size(); ++r) {
      for (const std::int32_t point : own_asked[r]) {
        ids.push_back(first_points_[r] + point);
      }
      for (const std::int32_t point : got[r]) {
        ids.push_back(first_points_[r] + point);
      }
      point_counts_.push_back(static_cast<std::int64_t>(own_asked[r].size() + got[r].size()));
    }
    agree(ranks_, [&] { check_document_size(ids.size(), piece_.cell_ids.size(), input_); });
    point_order_.resize(ids.size());
    std::iota(point_order_.begin(), point_order_.end(), 0);
    // What comes is in order, unless there are points of no cell.
    if (!std::ranges::is_sorted(ids)) {
      std::ranges::sort(point_order_, {}, [&](std::int32_t i) { return ids[static_cast<std::size_t>(i)]; });
    }
    std::vector<std::int64_t> ordered;
    ordered.reserve(ids.size());
    for (const std::int32_t i : point_order_) {
      ordered.push_back(ids[static_cast<std::size_t>(i)]);
    }
    piece_.ids = std::move(ordered);
  }

  std::vector<std::byte> rows_of_points(std::span<const std::byte> rows, std::size_t row_size) const {
    return rows_at(exchanged_rows(rows, row_size, sent_points_, point_counts_, ranks_), row_size, point_order_);
  }

  void send_points() {
    MeshDocument& made = piece_.document;
    made.point_type = document_.point_type;
    made.has_float32_axis = document_.has_float32_axis;
    made.points_description = document_.points_description;
    const std::vector<std::byte> places = rows_of_points(bytes_of(document_.points), 3 * sizeof(double));
    document_.points = {};
    made.points.resize(places.size() / sizeof(double));
    std::memcpy(made.points.data(), places.data(), places.size());
    for (DataArray& array : document_.point_arrays) {
      made.point_arrays.push_back(with_rows(array, rows_of_points(array.bytes, row_size_of(array))));
      array.bytes = {};
      array.owner.reset();
    }
    piece_.held_by_sets = flags_of_points(share_.held_by_sets);
    piece_.implied_by = flags_of_points(share_.implied_by);
  }

  /// None where no rank has any.
  std::vector<std::uint8_t> flags_of_points(std::vector<std::uint8_t>& flags) const {
    if (!ranks_.any(!flags.empty())) {
      return {};
    }
    flags.resize(point_ranks_.size(), 0);
    const std::vector<std::byte> rows = rows_of_points(std::as_bytes(std::span(flags)), 1);
    std::vector<std::uint8_t> sent(rows.size());
    std::ranges::transform(rows, sent.begin(), [](std::byte flag) { return std::to_integer<std::uint8_t>(flag); });
    return sent;
  }

  void number_corners() {
    const PlaceIndex index(piece_.ids);
    for (std::int32_t& corner : piece_.document.cells.connectivity) {
      corner = index.place_of(corner);
    }
  }

  void number_triangles() {
    const CellList& cells = piece_.document.cells;
    std::vector<std::int64_t> ids;
    ids.reserve(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::int64_t count = count_elements(cells.types[c], cells[c], quads_);
      for (std::int64_t t = 0; t < count; ++t) {
        ids.push_back(first_triangles_[c] + t);
      }
    }
    release(first_triangles_);
    // In a file of nothing but triangles these are its cells.
    piece_.triangle_ids = std::ranges::equal(ids, piece_.cell_ids) ? piece_.cell_ids : SharedNumbers(std::move(ids));
  }

  MeshShare share_;
  MeshDocument& document_;
  Quads quads_;
  const std::filesystem::path& input_;
  const mpi::Communicator& ranks_;
  std::int64_t first_point_ = 0;  ///< of the rank's range
  std::int64_t first_cell_ = 0;
  std::int64_t point_count_ = 0;  ///< in the whole file
  std::int64_t cell_count_ = 0;
  std::vector<std::int64_t> first_points_;     ///< of every rank's range
  std::vector<std::int32_t> point_ranks_;      ///< where each point of the range is at home
  std::vector<std::int32_t> cell_ranks_;       ///< where each cell of the range goes
  std::vector<std::int64_t> first_triangles_;  ///< of the piece's cells: the number of the first triangle of each
  mpi::ByRank<std::int32_t> sent_points_;      ///< places in the range, by the rank that gets them
  std::vector<std::int64_t> point_counts_;     ///< that come from every rank
  std::vector<std::int32_t> point_order_;      ///< how what comes is put in the order of the file
  Piece piece_;
};

/// Whether an array has these numbers.
bool holds_numbers(const DataArray& array, std::span<const std::int64_t> numbers) {
  return array.type == ScalarType::int64 && array.components == 1 &&
         std::ranges::equal(array.as<std::int64_t>(), numbers);
}

bool is_numbers_array(const DataArray& array, std::string_view name) {
  const bool is_of_points = name == point_numbers_name;
  return array.name == name || (is_of_points && array.name == "GlobalNodeIds") ||
         (array.description != nullptr &&
          std::ranges::find(array.description->roles, "GlobalIds") != array.description->roles.end());
}

/// Adds the array of numbers in the file, unless it is there already. What readers of pieces would take for it is given
/// another name. Whether it was added.
bool add_numbers(std::vector<DataArray>& arrays, std::string_view name, const SharedNumbers& numbers,
                 const mpi::Communicator& ranks, std::vector<std::string>& notes) {
  FreeNames names;
  bool is_there = false;
  for (const DataArray& array : arrays) {
    names.take(array.name);
  }
  names.take(name);
  for (DataArray& array : arrays) {
    if (!is_numbers_array(array, name)) {
      continue;
    }
    if (!is_there && !ranks.any(!holds_numbers(array, numbers))) {
      is_there = true;
      continue;
    }
    const std::string old = std::exchange(array.name, names.claim(array.name + "_of_file"));
    if (array.description != nullptr) {
      ArrayDescription description = *array.description;
      std::erase(description.roles, "GlobalIds");
      array.description = std::make_shared<const ArrayDescription>(std::move(description));
    }
    notes.push_back("the array '" + old + "' is written as '" + array.name +
                    "': in pieces its name stands for the numbers of the file's " +
                    (name == point_numbers_name ? "points" : "cells"));
  }
  if (!is_there) {
    arrays.push_back({std::string(name), ScalarType::int64, 1, std::as_bytes(std::span(numbers)), numbers.owner()});
  }
  return !is_there;
}

/// In pieces a cell array of this name says which cells are copies; in one file it is as good as any other.
void rename_ghost_flags(std::vector<DataArray>& cell_arrays, std::vector<std::string>& notes) {
  FreeNames names;
  for (const DataArray& array : cell_arrays) {
    names.take(array.name);
  }
  for (DataArray& array : cell_arrays) {
    if (array.name == ghost_flags_name) {
      array.name = names.claim(array.name + "_of_file");
      notes.push_back("the array '" + std::string(ghost_flags_name) + "' is written as '" + array.name +
                      "': in pieces its name stands for copies of cells");
    }
  }
}

void require_poly_data(const MeshDocument& document, const std::filesystem::path& output) {
  constexpr std::array held{cell_type::vertex,   cell_type::poly_vertex,    cell_type::line,    cell_type::poly_line,
                            cell_type::triangle, cell_type::triangle_strip, cell_type::polygon, cell_type::quad};
  for (const std::uint8_t type : document.cells.types) {
    if (std::ranges::find(held, type) == held.end()) {
      throw std::invalid_argument(output.string() + ": VTP holds no cells of type " + std::to_string(type) +
                                  ", which the file has; choose .pvtu");
    }
  }
}

}  // namespace

PieceFiles shared_out(MeshShare share, Partition partition, Quads quads, const std::filesystem::path& input,
                      const std::optional<std::filesystem::path>& output, const mpi::Communicator& ranks,
                      Workers& workers, std::vector<std::string>& notes) {
  MeshDocument& document = share.document;
  const std::vector<char> point_layout =
      first_bytes(document.points.empty() ? std::vector<char>{} : packed_point_layout(document), ranks);
  const std::vector<char> cell_layout =
      first_bytes(document.cells.types.empty() ? std::vector<char>{} : packed_cell_layout(document), ranks);
  agree(ranks, [&] {
    if (document.points.empty() && !point_layout.empty()) {
      take_point_layout(point_layout, document);
    }
    if (document.cells.types.empty() && !cell_layout.empty()) {
      take_cell_layout(cell_layout, document);
    }
  });
  std::vector<DataArray> fields = std::move(document.field_arrays);
  const FileFormat format = output && extension_of(*output) == ".pvtp" ? FileFormat::vtp : FileFormat::vtu;
  PieceFiles files;
  files.path = input;
  Piece piece = Sharing(std::move(share), partition, quads, input, ranks).piece();
  piece.number = static_cast<std::size_t>(ranks.rank());
  piece.path = input;
  MeshDocument& made = piece.document;
  made.format = format;
  made.original = std::make_shared<NewPiece>();
  made.field_arrays = std::move(fields);
  rename_ghost_flags(made.cell_arrays, notes);
  const bool adds_points = add_numbers(made.point_arrays, point_numbers_name, piece.ids, ranks, notes);
  const bool adds_cells = add_numbers(made.cell_arrays, cell_numbers_name, piece.cell_ids, ranks, notes);
  agree(ranks, [&] {
    if (format == FileFormat::vtp) {
      require_poly_data(made, *output);
    }
    piece.mesh = mesh_of_piece(made, input, quads, workers);
    piece.ghost_cells.assign(made.cells.size(), 0);
    const std::vector<std::string> sources(static_cast<std::size_t>(ranks.size()), input.filename().string());
    NewParallelFile parallel = make_parallel_file(format, made, sources);
    files.bytes = std::move(parallel.bytes);
    files.file = std::move(parallel.file);
  });
  files.arrays = arrays_of_piece(made);
  for (PieceArray& array : files.arrays) {
    array.is_added = (adds_points && array.of == PieceArray::Of::points && array.name == point_numbers_name) ||
                     (adds_cells && array.of == PieceArray::Of::cells && array.name == cell_numbers_name);
  }
  files.pieces.push_back(std::move(piece));
  return files;
}

}  // namespace trismooth
