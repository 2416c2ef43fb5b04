#include "trismooth/mesh_io/document/patched_original.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

class PatchedOriginal : public OriginalFile {
 public:
  PatchedOriginal(FileBytes bytes, CoordinateSites sites)
      : bytes_(std::move(bytes)), sites_(std::move(sites)), vertex_count_(count_vertices(sites_)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    if (!added_point_arrays.empty() || !added_cell_arrays.empty()) {
      throw WriteError(path, "the format holds no named arrays, none can be added");
    }
    if (document.point_count() != vertex_count_) {
      throw WriteError(path, "the file that was read has " + std::to_string(vertex_count_) +
                                 " vertices, the mesh to write has " + std::to_string(document.point_count()));
    }
    write_patched(path, bytes_, sites_, document.points, {}, FileWorkers(workers));
  }

 private:
  static std::size_t count_vertices(const CoordinateSites& sites) {
    return sites.vertices.empty() ? sites.offsets.size() / 3
                                  : static_cast<std::size_t>(*std::ranges::max_element(sites.vertices)) + 1;
  }

  FileBytes bytes_;
  CoordinateSites sites_;
  std::size_t vertex_count_;
};

}  // namespace

std::shared_ptr<const OriginalFile> make_patched_original(FileBytes bytes, CoordinateSites sites) {
  return std::make_shared<PatchedOriginal>(std::move(bytes), std::move(sites));
}

}  // namespace trismooth
