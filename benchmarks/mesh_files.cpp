// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_files.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

namespace mesh_files {

namespace {

constexpr int gmsh_triangle = 2;

class BytesFile {
 public:
  explicit BytesFile(const std::filesystem::path& path) : path_(path), stream_(path, std::ios::binary) {}

  void text(std::string_view text) { stream_ << text; }

  template <class T>
  void number(T value) {
    stream_.write(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  void close() {
    stream_.close();
    if (!stream_) {
      throw trismooth::WriteError(path_, "cannot be written");
    }
  }

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// Version 4.1, all in one block of nodes and one of elements.
void write_binary_msh(const std::filesystem::path& path, const trismooth::MeshDocument& triangles) {
  const std::size_t points = triangles.point_count();
  const std::size_t cells = triangles.cells.size();
  BytesFile file(path);
  const auto head = [&file](std::string_view section, std::size_t count, int kind) {
    file.text(section);
    for (const std::size_t number : {std::size_t{1}, count, std::size_t{1}, count}) {
      file.number(number);
    }
    for (const int number : {2, 1, kind}) {
      file.number(number);
    }
    file.number(count);
  };
  file.text("$MeshFormat\n4.1 1 8\n");
  file.number(1);
  file.text("\n$EndMeshFormat\n");
  head("$Nodes\n", points, 0);
  for (std::size_t point = 0; point < points; ++point) {
    file.number(point + 1);
  }
  for (const double x : triangles.points) {
    file.number(x);
  }
  file.text("\n$EndNodes\n");
  head("$Elements\n", cells, gmsh_triangle);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    file.number(cell + 1);
    for (const std::int32_t vertex : triangles.cells[cell]) {
      file.number(static_cast<std::size_t>(vertex) + 1);
    }
  }
  file.text("\n$EndElements\n");
  file.close();
}

void write_msh_2(const std::filesystem::path& path, const trismooth::MeshDocument& triangles) {
  BytesFile file(path);
  file.text(fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", triangles.point_count()));
  for (std::size_t point = 0; point < triangles.point_count(); ++point) {
    const double* const x = triangles.points.data() + 3 * point;
    file.text(fmt::format("{} {} {} {}\n", point + 1, x[0], x[1], x[2]));
  }
  file.text(fmt::format("$EndNodes\n$Elements\n{}\n", triangles.cells.size()));
  for (std::size_t cell = 0; cell < triangles.cells.size(); ++cell) {
    const auto vertices = triangles.cells[cell];
    file.text(fmt::format("{} {} 2 0 1 {} {} {}\n", cell + 1, gmsh_triangle, vertices[0] + 1, vertices[1] + 1,
                          vertices[2] + 1));
  }
  file.text("$EndElements\n");
  file.close();
}

}  // namespace

std::filesystem::path path_of(const std::filesystem::path& folder, const std::string& name, const std::string& kind) {
  const bool is_msh = kind == "msh-binary" || kind == "msh2";
  return folder / (name + "." + (is_msh ? "msh" : kind));
}

void write(const std::filesystem::path& path, const std::string& kind, const trismooth::MeshDocument& triangles) {
  if (kind == "msh-binary") {
    write_binary_msh(path, triangles);
  } else if (kind == "msh2") {
    write_msh_2(path, triangles);
  } else if (kind == "freefem") {
    trismooth::freefem_codec.write(path, triangles);
  } else {
    trismooth::write_mesh(path, triangles);
  }
}

}  // namespace mesh_files
