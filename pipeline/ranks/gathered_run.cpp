// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/gathered_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/document_run.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/file_in_pieces.h"
#include "trismooth/pipeline/ranks/joined/rank_constraints.h"
#include "trismooth/pipeline/ranks/run_on_first.h"
#include "trismooth/pipeline/ranks/shared_texts.h"
#include "trismooth/pipeline/ranks/whole_mesh.h"

namespace trismooth {

namespace {

/// A file of vertices to hold has their ids: where these are not the numbers of the document's points, the options name
/// them otherwise.
class HeldByIds {
 public:
  /// Throws ReadError.
  HeldByIds(PipelineOptions& options, const std::vector<std::int64_t>& ids, const PieceFiles& files)
      : path_(options.fixed_ids) {
    const bool are_numbers = ids.empty() || ids.back() + 1 == std::ssize(ids);
    if (!path_ || (are_numbers && !options.fixed_ids_are_labels)) {
      return;
    }
    std::set<std::int32_t> points;
    for (const std::int64_t id : read_held_numbers(files, options, ids.empty() ? 0 : ids.back() + 1)) {
      const auto place = std::ranges::lower_bound(ids, id);
      if (place == ids.end() || *place != id) {
        throw unknown_vertex(options, id);
      }
      points.insert(static_cast<std::int32_t>(place - ids.begin()));
    }
    options.fixed_ids_are_labels = false;
    if (!points.empty()) {
      options.fixed_vertices.assign(points.begin(), points.end());
      options.fixed_ids.reset();
      count_ = std::ssize(points);
    }
  }

  void report(InputSummary& input) const {
    if (count_ > 0) {
      input.fixed_ids = *path_;
      input.fixed_ids_vertices = count_;
    }
  }

 private:
  std::optional<std::filesystem::path> path_;
  std::int64_t count_ = 0;
};

/// With an output that is a piece of that format: it is written later, and so is what belongs to it.
PipelineOptions of_piece(PipelineOptions options, FileFormat format) {
  if (options.output) {
    options.output = std::filesystem::path("piece").replace_extension(extensions_of(format).front());
  }
  options.beside = {};
  return options;
}

PipelineResult run_here(WholeMesh& whole, const PieceFiles& files, PipelineOptions options, AddedArrays& annotations) {
  const HeldByIds held(options, whole.ids, files);
  PipelineResult result =
      options.single ? run_pipeline_on(std::move(whole.document), options)
                     : run_on_document(whole.document, of_piece(options, files.file.piece_format), annotations);
  held.report(result.input);
  return result;
}

/// The last step. Collective.
void write_result(PieceFiles& files, const PipelineOptions& options, PipelineResult& result,
                  const mpi::Communicator& ranks, Workers& workers, const Stopwatch& watch) {
  const auto completed = [&]() -> const PipelineResult& {
    result.timings_ms.write += watch.milliseconds();
    return result;
  };
  result.other_outputs = output_pieces(files, *options.written());
  write_pieces(files, *options.written(), ranks, workers, completed, options.beside);
}

}  // namespace

PipelineResult run_gathered(PieceFiles& files, const PipelineOptions& options,
                            const std::shared_ptr<const mpi::Communicator>& communicator, Workers& workers) {
  const mpi::Communicator& ranks = *communicator;
  for (Piece& piece : files.pieces) {
    piece.mesh = {};
  }
  WholeMesh whole(files, ranks);
  AddedArrays annotations;
  PipelineResult result = run_on_first(
      options, communicator, [&](const PipelineOptions& own) { return run_here(whole, files, own, annotations); });
  if (options.single || !options.written()) {
    return result;
  }
  const Stopwatch watch;
  std::set<std::string> moved;
  for (const InterpolatedField& field : result.fields) {
    moved.insert(field.name);
  }
  whole.hand_back(files, texts_of_all(moved, ranks), annotations, ranks);
  drop_annotations(files);
  write_result(files, options, result, ranks, workers, watch);
  return result;
}

PipelineResult run_file_gathered(const PipelineOptions& options,
                                 const std::shared_ptr<const mpi::Communicator>& communicator, Workers& workers) {
  const mpi::Communicator& ranks = *communicator;
  if (!options.written()) {
    return run_on_first(options, communicator, &run_pipeline);
  }
  const FileFormat format = extension_of(*options.written()) == ".pvtp" ? FileFormat::vtp : FileFormat::vtu;
  MeshShare share;
  PipelineResult result = run_on_first(options, communicator, [&](const PipelineOptions& own) {
    const Stopwatch watch;
    MeshDocument& document = share.document;
    document = read_mesh(own.input, FileOptions{workers.count(), own.format});
    document.original.reset();
    require_carried(own, document);
    const double read_ms = watch.milliseconds();
    AddedArrays annotations;
    PipelineResult made = run_on_document(document, of_piece(own, format), annotations);
    made.timings_ms.read = read_ms;
    std::ranges::move(annotations.point_arrays, std::back_inserter(document.point_arrays));
    std::ranges::move(annotations.cell_arrays, std::back_inserter(document.cell_arrays));
    return made;
  });
  const Stopwatch watch;
  FileInPieces shared = put_in_pieces(std::move(share), options, ranks, workers);
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      require_own_pieces(shared.files, *options.written(), options.single);
    }
  });
  put_in_front(shared.losses, result.losses);
  put_in_front(shared.notes, result.notes);
  write_result(shared.files, options, result, ranks, workers, watch);
  return result;
}

}  // namespace trismooth
