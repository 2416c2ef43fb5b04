// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/file_in_pieces.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/input/line_groups.h"
#include "trismooth/pipeline/input/map_mesh.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/point_sets.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/mesh_share.h"
#include "trismooth/pipeline/ranks/share_reading.h"
#include "trismooth/pipeline/ranks/shared_out.h"
#include "trismooth/pipeline/ranks/shared_texts.h"

namespace trismooth {

namespace {

/// What the sets of a file hold, and what the report says of them.
void take_sets(const PipelineOptions& options, Workers& workers, MeshShare& share) {
  const MeshDocument& document = share.document;
  const PlanarMesh mesh = mesh_of_piece(document, options.input, options.quads, workers);
  const Regions regions = find_regions(document, mesh, options.region_arrays);
  HeldSets sets = find_held_sets(document, mesh.elements, options.fixed_sets, regions.of_triangle);
  share.held_by_sets = std::move(sets.flags);
  share.point_sets = std::move(sets.sets);
  share.notes = std::move(sets.notes);
  if (looks_geographic(mesh, document)) {
    share.notes.insert(share.notes.begin(), std::string(looks_geographic_note));
  }
  if (options.fixed_ids && options.fixed_ids_are_labels) {
    const std::vector<std::int32_t> vertices = read_vertex_labels(*options.fixed_ids, document);
    share.labelled.assign(vertices.begin(), vertices.end());
  }
  share.cell_sets = summarise_cell_sets(document);
  share.line_groups = find_line_groups(document);
}

/// Of rank 0; the others have nothing.
MeshShare read_whole(const PipelineOptions& options, const mpi::Communicator& ranks, Workers& workers) {
  MeshShare share;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      share.document = read_mesh(options.input, FileOptions{workers.count(), options.format});
      share.document.original.reset();
      require_carried(options, share.document);
      take_sets(options, workers, share);
    }
  });
  return share;
}

}  // namespace

void require_carried(const PipelineOptions& options, const MeshDocument& document) {
  if (!document.cell_labels.empty()) {
    throw ReadError(options.input, "holds texts at cells ('" + document.cell_labels.front().name +
                                       "'), which a mesh in pieces may not have yet");
  }
}

FileInPieces put_in_pieces(MeshShare share, const PipelineOptions& options, const mpi::Communicator& ranks,
                           Workers& workers) {
  FileInPieces made;
  MeshDocument& document = share.document;
  made.input.path = shown_input(options.input);
  made.input.format = document.format;
  made.input.point_sets = std::move(share.point_sets);
  made.input.cell_sets = std::move(share.cell_sets);
  made.input.line_groups = std::move(share.line_groups);
  std::vector<std::string> notes = std::move(share.notes);
  std::vector<std::int64_t> labelled = std::move(share.labelled);
  std::set<std::string> said(document.notes.begin(), document.notes.end());
  std::set<std::string> lost(document.losses.begin(), document.losses.end());
  if (options.written() && ranks.rank() == 0) {
    std::ranges::move(what_is_lost(document, FileFormat::vtu), std::inserter(lost, lost.end()));
    if (!document.periodic_pairs.empty()) {
      lost.insert("pieces hold no pairs of points that are the same place of what repeats itself: " +
                  std::to_string(document.periodic_pairs.size()) + " are not written");
    }
  }
  const std::set<std::string> of_places(document.arrays_of_places.begin(), document.arrays_of_places.end());
  made.files = shared_out(std::move(share), options.partition.value_or(Partition::bisect), options.quads, options.input,
                          options.written(), ranks, workers, notes);
  made.files.labelled = std::move(labelled);
  const std::vector<std::string> all_said = texts_of_all(said, ranks);
  made.losses = texts_of_all(lost, ranks);
  made.arrays_of_places = texts_of_all(of_places, ranks);
  // What the reader says of the file is said of what another format loses.
  std::ranges::copy(all_said, std::back_inserter(options.written() ? made.losses : made.notes));
  std::ranges::move(notes, std::back_inserter(made.notes));
  return made;
}

FileInPieces read_in_pieces(const PipelineOptions& options, FileReading reading, const mpi::Communicator& ranks,
                            Workers& workers) {
  // Files that are read by ranges have no sets to name, and who has which label is known of the whole file.
  const bool asks_for_whole = !options.fixed_sets.empty() || options.fixed_ids_are_labels;
  std::optional<MeshShare> share = asks_for_whole ? std::nullopt : read_share(options.input, ranks, workers);
  const bool by_ranges = share.has_value();
  if (!by_ranges) {
    if (reading == FileReading::by_ranges) {
      throw mpi::KnownToAll{std::make_exception_ptr(ReadError(options.input, "is not read by ranges, but as a whole"))};
    }
    share = read_whole(options, ranks, workers);
  }
  FileInPieces read = put_in_pieces(std::move(*share), options, ranks, workers);
  read.files.was_read_whole = !by_ranges;
  if (!by_ranges && ranks.size() > 1) {
    read.notes.emplace_back(
        "rank 0 has read the file whole and handed it out: what is read by ranges is OFF as text, VTU with raw "
        "appended arrays, and binary MSH, without --fixed-set and --fixed-labels");
  }
  return read;
}

}  // namespace trismooth
