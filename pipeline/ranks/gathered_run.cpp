#include "trismooth/pipeline/ranks/gathered_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "trismooth/base/stopwatch.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/parallel_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/pipeline/document_run.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/ranks/one_file_run.h"
#include "trismooth/pipeline/ranks/rank_constraints.h"
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

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

PipelineResult run_here(WholeMesh& whole, const PieceFiles& files, PipelineOptions options, AddedArrays& annotations) {
  const HeldByIds held(options, whole.ids, files);
  if (options.output && !options.single) {
    options.output = std::filesystem::path("piece").replace_extension(extensions_of(files.file.piece_format).front());
  }
  if (!options.single) {
    options.beside = {};  // the pieces are written later
  }
  PipelineResult result = options.single ? run_pipeline_on(std::move(whole.document), options)
                                         : run_on_document(whole.document, options, annotations);
  held.report(result.input);
  return result;
}

}  // namespace

PipelineResult run_gathered(PieceFiles& files, const PipelineOptions& options,
                            const std::shared_ptr<const mpi::Communicator>& communicator, Workers& workers) {
  const mpi::Communicator& ranks = *communicator;
  // (What is no file on a disk can be read once.)
  const bool is_of_pieces = names_parallel_file(options.input) || is_standard_stream(options.input) ||
                            ranks.any(ranks.rank() == 0 && !is_file(options.input));
  WholeMesh whole =
      is_of_pieces ? WholeMesh(files, ranks) : WholeMesh(files, FileOptions{workers.count(), options.format}, ranks);
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
  const auto completed = [&]() -> const PipelineResult& {
    result.timings_ms.write += watch.milliseconds();
    return result;
  };
  write_pieces(files, *options.written(), ranks, workers, completed, options.beside);
  return result;
}

}  // namespace trismooth
