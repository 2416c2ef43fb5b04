#include "trismooth/mesh_io/patched_original.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

std::size_t count_points(const CoordinateSites& sites) {
  if (sites.vertices.empty()) {
    return sites.offsets.size() / 3;
  }
  return static_cast<std::size_t>(*std::ranges::max_element(sites.vertices)) + 1;
}

class PatchedOriginal final : public OriginalFile {
 public:
  PatchedOriginal(std::string bytes, CoordinateSites sites)
      : bytes_(std::move(bytes)), sites_(std::move(sites)), point_count_(count_points(sites_)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays,
             std::span<const DataArray> added_cell_arrays) const override {
    if (!added_point_arrays.empty() || !added_cell_arrays.empty()) {
      throw WriteError(path, "this format has no place for added arrays");
    }
    if (document.point_count() != point_count_) {
      throw WriteError(path, "the file that was read has " + std::to_string(point_count_) +
                                 " points, but the mesh to be written has " + std::to_string(document.point_count()));
    }
    write_patched(path, bytes_, sites_, document.points);
  }

 private:
  std::string bytes_;
  CoordinateSites sites_;
  std::size_t point_count_;
};

}  // namespace

std::shared_ptr<const OriginalFile> make_patched_original(std::string bytes, CoordinateSites sites) {
  return std::make_shared<PatchedOriginal>(std::move(bytes), std::move(sites));
}

}  // namespace trismooth
