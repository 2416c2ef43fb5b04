// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_mesh.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "trismooth/base/machine/release.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/smoothing/backend_choice.h"

namespace trismooth {

namespace {

bool has_middle_nodes(const Piece& piece) {
  return !piece.mesh.quadratics.empty();
}

/// Whether vertices that cells use have more than one z. Collective.
bool heights_differ(const PieceFiles& files, const mpi::Communicator& ranks) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PartSums range;
  range.largest = {-infinity, -infinity};
  for (const Piece& piece : files.pieces) {
    for (std::size_t v = 0; v < piece.mesh.in_cell.size(); ++v) {
      if (piece.mesh.in_cell[v] != 0) {
        const double z = piece.document.points[3 * v + 2];
        range.largest = {std::max(range.largest[0], z), std::max(range.largest[1], -z)};
      }
    }
  }
  range = ranks.joined(range);
  return -range.largest[1] < range.largest[0];
}

Storage storage_of_pieces(const PieceFiles& files, const mpi::Communicator& ranks) {
  const bool has_float32 = std::ranges::any_of(files.pieces, [](const Piece& piece) {
    return piece.document.point_count() > 0 && storage_of(piece.document) == Storage::float32;
  });
  return ranks.any(has_float32) ? Storage::float32 : Storage::float64;
}

bool has_ghosts(const PieceFiles& files) {
  return std::ranges::any_of(
      files.pieces, [](const Piece& piece) { return std::ranges::any_of(piece.ghost_cells, std::identity()); });
}

/// Whether that piece's points and elements are the mesh's as they stand.
bool is_mesh_of_its_own(const Piece& piece) {
  return std::ranges::adjacent_find(piece.ids, std::greater_equal<>()) == piece.ids.end();
}

void take_piece(Piece& piece, RankMesh& mesh) {
  mesh.ids = piece.ids;
  mesh.elements = piece.mesh.elements;
  mesh.in_other_cell = std::move(piece.mesh.in_other_cell);
  mesh.triangle_ids = piece.triangle_ids;
  piece.vertices.resize(piece.ids.size());
  std::iota(piece.vertices.begin(), piece.vertices.end(), 0);
}

SharedNumbers joined_ids(const PieceFiles& files) {
  std::vector<std::int64_t> ids;
  for (const Piece& piece : files.pieces) {
    ids.insert(ids.end(), piece.ids.begin(), piece.ids.end());
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// The elements of all pieces, by the rank's numbers of vertices.
template <class Corners>
std::vector<Corners> joined_elements(const PieceFiles& files) {
  std::vector<Corners> joined;
  for (const Piece& piece : files.pieces) {
    for (const std::span<const std::int32_t> corners : piece.mesh.elements) {
      Corners& element = joined.emplace_back();
      element.fill(no_corner);
      std::ranges::transform(corners, element.begin(),
                             [&](std::int32_t v) { return piece.vertices[static_cast<std::size_t>(v)]; });
    }
  }
  return joined;
}

void join(PieceFiles& files, RankMesh& mesh) {
  mesh.ids = joined_ids(files);
  mesh.in_other_cell.assign(mesh.ids.size(), 0);
  std::vector<std::int64_t> triangle_ids;
  for (Piece& piece : files.pieces) {
    piece.vertices.resize(piece.ids.size());
    for (std::size_t i = 0; i < piece.ids.size(); ++i) {
      const auto v = static_cast<std::size_t>(std::ranges::lower_bound(mesh.ids, piece.ids[i]) - mesh.ids.begin());
      piece.vertices[i] = static_cast<std::int32_t>(v);
      mesh.in_other_cell[v] |= piece.mesh.in_other_cell[i];
    }
    triangle_ids.insert(triangle_ids.end(), piece.triangle_ids.begin(), piece.triangle_ids.end());
  }
  const bool are_triangles =
      std::ranges::all_of(files.pieces, [](const Piece& piece) { return piece.mesh.elements.are_triangles(); });
  mesh.joined_elements =
      are_triangles ? OwnElements(joined_elements<Triangle>(files)) : OwnElements(joined_elements<MixedElement>(files));
  mesh.elements = mesh.joined_elements.list();
  mesh.triangle_ids = std::move(triangle_ids);
}

void mark_ghosts(const PieceFiles& files, RankMesh& mesh) {
  mesh.ghost_triangles.reserve(mesh.elements.size());
  for (const Piece& piece : files.pieces) {
    for (std::size_t t = 0; t < piece.mesh.elements.size(); ++t) {
      mesh.ghost_triangles.push_back(piece.is_ghost(t) ? 1 : 0);
    }
  }
}

}  // namespace

std::string_view what_is_not_joined(const PieceFiles& files, const SmoothingOptions& options,
                                    const mpi::Communicator& ranks) {
  const bool has_quads =
      std::ranges::any_of(files.pieces, [](const Piece& piece) { return piece.mesh.count_quadrilaterals() > 0; });
  const bool takes_quads =
      backend_of(options).takes_quadrilaterals_in_parts() && options.topology != Topology::halfedge;
  if (!takes_quads && ranks.any(has_quads)) {
    return "quadrilaterals";
  }
  if (ranks.any(std::ranges::any_of(files.pieces, &has_middle_nodes))) {
    return "elements with nodes in the middle of their sides";
  }
  return heights_differ(files, ranks) ? "a mesh that lies in no plane z = constant" : "";
}

bool are_numbered_without_gaps(const PieceFiles& files) {
  std::size_t points = 0;
  for (const Piece& piece : files.pieces) {
    points += piece.ids.size();
  }
  std::vector<std::uint8_t> is_there(points, 0);
  std::size_t end = 0;
  for (const Piece& piece : files.pieces) {
    for (const std::int64_t id : piece.ids) {
      const auto place = static_cast<std::size_t>(id);
      if (place >= points) {
        return false;
      }
      is_there[place] = 1;
      end = std::max(end, place + 1);
    }
  }
  return std::ranges::count(is_there, 1) == static_cast<std::ptrdiff_t>(end);
}

RankMesh join_pieces(PieceFiles& files, const mpi::Communicator& ranks) {
  RankMesh mesh;
  mesh.storage = storage_of_pieces(files, ranks);
  agree(ranks, [&] {
    if (files.pieces.size() == 1 && is_mesh_of_its_own(files.pieces.front())) {
      take_piece(files.pieces.front(), mesh);
    } else {
      join(files, mesh);
    }
    if (has_ghosts(files)) {
      mark_ghosts(files, mesh);
    }
    check_document_size(mesh.ids.size(), mesh.elements.size(), files.path);
    for (Piece& piece : files.pieces) {
      release(piece.mesh.points);
    }
  });
  return mesh;
}

std::vector<std::array<double, 3>> places_of(const PieceFiles& files, const RankMesh& mesh) {
  std::vector<std::array<double, 3>> places(mesh.ids.size());
  for (const Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      std::copy_n(piece.document.points.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                  places[static_cast<std::size_t>(piece.vertices[i])].begin());
    }
  }
  return places;
}

std::vector<Point2<double>> points_of(const PieceFiles& files, const RankMesh& mesh) {
  std::vector<Point2<double>> points(mesh.ids.size());
  for (const Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      points[static_cast<std::size_t>(piece.vertices[i])] = {piece.document.points[3 * i],
                                                             piece.document.points[3 * i + 1]};
    }
  }
  return points;
}

void move_point(double& x, double& y, Point2<double> to) {
  if (!(to == Point2<double>{x, y})) {
    x = to.x;
    y = to.y;
  }
}

void move_points(PieceFiles& files, std::span<const Point2<double>> points) {
  for (Piece& piece : files.pieces) {
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      move_point(piece.document.points[3 * i], piece.document.points[3 * i + 1],
                 points[static_cast<std::size_t>(piece.vertices[i])]);
    }
  }
}

}  // namespace trismooth
