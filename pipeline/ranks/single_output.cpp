// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/single_output.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "trismooth/mesh_io/mesh_output.h"
#include "trismooth/pipeline/ranks/agreement.h"
#include "trismooth/pipeline/ranks/shared_texts.h"
#include "trismooth/pipeline/ranks/whole_mesh.h"

namespace trismooth {

void write_single(PieceFiles& files, const PipelineOptions& options, const mpi::Communicator& ranks, Workers& workers,
                  PipelineResult& result, const std::function<const PipelineResult&()>& completed) {
  WholeMesh whole(files, ranks);
  std::set<std::string> lost(whole.document.losses.begin(), whole.document.losses.end());
  std::optional<WrittenAside> file;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      const FileFormat target = output_format(*options.output, whole.document.format, options.format);
      std::ranges::move(what_is_lost(whole.document, target), std::inserter(lost, lost.end()));
      file.emplace(write_mesh_aside(*options.output, whole.document, AddedArrays{},
                                    FileOptions{workers.count(), options.format}));
      result.other_outputs = file->others(*options.output);
    }
  });
  std::ranges::move(texts_of_all(lost, ranks), std::back_inserter(result.losses));
  prepare_beside(options.beside, completed(), ranks);
  agree(ranks, [&] {
    if (file) {
      file->commit_before(options.beside.place);
    }
  });
}

}  // namespace trismooth
