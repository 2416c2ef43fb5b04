// SPDX-License-Identifier: BSD-3-Clause
#include "support/one_file_codec.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/triangle/triangle_reader.h"
#include "trismooth/mesh_io/triangle/triangle_writer.h"

#include "support/scratch_folder.h"

namespace test_support {

using trismooth::Codec;
using trismooth::DataArray;
using trismooth::FileBytes;
using trismooth::FileFormat;
using trismooth::FileWorkers;
using trismooth::MeshDocument;
using trismooth::OriginalFile;

namespace {

constexpr char file_separator = '\x1C';

/// Has both files written, by the names that tell them apart, and joins them at `path`.
void write_joined(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  static const ScratchFolder folder;
  std::vector<std::string> files;
  for (const char* const name : {"mesh.node", "mesh.ele"}) {
    write(folder / name);
    files.push_back(bytes_of(folder / name));
  }
  trismooth::BufferedWriter writer(path);
  writer.write(joined_files(files[0], files[1]));
  writer.close();
}

class JoinedOriginal : public OriginalFile {
 public:
  explicit JoinedOriginal(std::shared_ptr<const OriginalFile> both) : both_(std::move(both)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             trismooth::Workers& workers) const override {
    write_joined(path, [&](const std::filesystem::path& file) {
      both_->write(file, document, added_point_arrays, added_cell_arrays, workers);
    });
  }

  bool keeps_values_of(std::string_view point_array) const override { return both_->keeps_values_of(point_array); }

 private:
  std::shared_ptr<const OriginalFile> both_;
};

MeshDocument read_joined(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  const std::string_view all = bytes;
  const std::size_t nodes_end = std::min(all.find(file_separator), all.size());
  const std::size_t elements_begin = std::min(nodes_end + 1, all.size());
  MeshDocument document = trismooth::read_triangle_files({path, std::string(all.substr(0, nodes_end))},
                                                         {path, std::string(all.substr(elements_begin))}, workers);
  document.original = std::make_shared<JoinedOriginal>(std::move(document.original));
  return document;
}

void write_triangle_joined(const std::filesystem::path& path, const MeshDocument& document,
                           const FileWorkers& workers) {
  write_joined(path, [&](const std::filesystem::path& file) { trismooth::write_triangle(file, document, workers); });
}

const Codec joined_triangle_codec{trismooth::triangle_codec.description, &read_joined, &write_triangle_joined,
                                  &trismooth::lost_in_triangle};

}  // namespace

const Codec& one_file_codec(FileFormat format) {
  return format == FileFormat::triangle ? joined_triangle_codec : trismooth::codec_of(format);
}

std::string joined_files(std::string_view nodes, std::string_view elements) {
  return std::string(nodes) + file_separator + std::string(elements);
}

}  // namespace test_support
