// SPDX-License-Identifier: BSD-3-Clause
#include "properties/for_random_meshes.h"

#include <algorithm>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "support/share_of_cases.h"

namespace properties {

namespace {

std::int64_t only_seed() {
  return from_environment("TRISMOOTH_SEED", -1);
}

std::string verdict(const Property& property, const RandomMesh& mesh) {
  try {
    return property(mesh);
  } catch (const std::exception& error) {
    return fmt::format("an exception: {}", error.what());
  }
}

template <class T>
std::vector<T> chosen(const std::vector<T>& values, const std::vector<bool>& keep) {
  std::vector<T> kept;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (keep[i]) {
      kept.push_back(values[i]);
    }
  }
  return kept;
}

/// The mesh without some of its triangles: `keep` has one flag for each.
RandomMesh with_triangles(const RandomMesh& mesh, const std::vector<bool>& keep) {
  RandomMesh smaller = mesh;
  smaller.mesh.triangles = chosen(mesh.mesh.triangles, keep);
  smaller.regions = chosen(mesh.regions, keep);
  return smaller;
}

/// The mesh without its isolated vertices, the others renumbered in their order.
RandomMesh without_isolated_vertices(const RandomMesh& mesh) {
  std::vector<bool> keep(mesh.mesh.points.size(), false);
  for (const trismooth::Triangle& t : mesh.mesh.triangles) {
    for (const std::int32_t v : t) {
      keep[v] = true;
    }
  }
  std::vector<std::int32_t> number(keep.size(), -1);
  std::int32_t next = 0;
  for (std::size_t v = 0; v < keep.size(); ++v) {
    number[v] = keep[v] ? next++ : -1;
  }
  RandomMesh smaller = mesh;
  smaller.mesh.points = chosen(mesh.mesh.points, keep);
  smaller.fixed = chosen(mesh.fixed, keep);
  smaller.other_cells = chosen(mesh.other_cells, keep);
  for (trismooth::Triangle& t : smaller.mesh.triangles) {
    t = {number[t[0]], number[t[1]], number[t[2]]};
  }
  for (std::int32_t& v : smaller.fixed_ids) {
    v = number[v];
  }
  std::erase(smaller.fixed_ids, -1);
  return smaller;
}

/// As the text of an OFF file, with the constraints as comments.
std::string off_text(const RandomMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.mesh.points.size(), mesh.mesh.triangles.size());
  for (const auto& p : mesh.mesh.points) {
    text += fmt::format("{} {} 0\n", p.x, p.y);
  }
  for (const auto& [a, b, c] : mesh.mesh.triangles) {
    text += fmt::format("3 {} {} {}\n", a, b, c);
  }
  const auto comment = [&text](const std::string& what, const auto& numbers) {
    if (!numbers.empty()) {
      text += fmt::format("# {}:", what);
      for (const auto number : numbers) {
        text += fmt::format(" {}", int{number});
      }
      text += '\n';
    }
  };
  comment("fixed", mesh.fixed);
  comment("fixed_ids", mesh.fixed_ids);
  comment("other_cells", mesh.other_cells);
  comment("regions", mesh.regions);
  return text;
}

/// The smallest mesh found, by leaving out triangles and holding vertices, of which the property does not hold.
class Shrinker {
 public:
  Shrinker(const Property& property, RandomMesh mesh) : property_(property), mesh_(std::move(mesh)) {}

  RandomMesh shrink() {
    keep_if_it_fails(without_isolated_vertices(mesh_));
    for (bool smaller = true; smaller;) {
      smaller = drop_triangles();
      smaller = drop_constraints() || smaller;
    }
    hold_vertices();
    return mesh_;
  }

 private:
  bool keep_if_it_fails(RandomMesh candidate) {
    constexpr int most_attempts = 5000;
    if (++attempts_ > most_attempts || !random_meshes::is_orientable(candidate.mesh.triangles) ||
        verdict(property_, candidate).empty()) {
      return false;
    }
    mesh_ = std::move(candidate);
    return true;
  }

  bool drop_triangles() {
    bool dropped = false;
    for (std::size_t size = std::max<std::size_t>(mesh_.mesh.triangles.size() / 2, 1); size > 0; size /= 2) {
      for (std::size_t first = 0; first < mesh_.mesh.triangles.size();) {
        std::vector<bool> keep(mesh_.mesh.triangles.size(), true);
        std::fill(keep.begin() + static_cast<std::ptrdiff_t>(first),
                  keep.begin() + static_cast<std::ptrdiff_t>(std::min(first + size, keep.size())), false);
        const RandomMesh candidate = with_triangles(mesh_, keep);
        if (keep_if_it_fails(without_isolated_vertices(candidate)) || keep_if_it_fails(candidate)) {
          dropped = true;
        } else {
          first += size;
        }
      }
    }
    return dropped;
  }

  bool drop_constraints() {
    bool dropped = false;
    const auto drop = [&](auto RandomMesh::*list) {
      RandomMesh candidate = mesh_;
      (candidate.*list).clear();
      dropped = (!(mesh_.*list).empty() && keep_if_it_fails(std::move(candidate))) || dropped;
    };
    drop(&RandomMesh::fixed);
    drop(&RandomMesh::fixed_ids);
    drop(&RandomMesh::other_cells);
    drop(&RandomMesh::regions);
    return dropped;
  }

  /// The fewer are free, the easier it is to see what happens.
  void hold_vertices() {
    for (std::int32_t v = 0; v < mesh_.mesh.vertex_count(); ++v) {
      RandomMesh candidate = mesh_;
      candidate.fixed_ids.push_back(v);
      keep_if_it_fails(std::move(candidate));
    }
  }

  const Property& property_;
  RandomMesh mesh_;
  int attempts_ = 0;
};

}  // namespace

std::int64_t meshes_of(std::int64_t count) {
  return only_seed() >= 0 ? 0 : count * per_cent_of_cases() / 100;
}

void for_random_meshes(std::int64_t count, const Property& property) {
  const std::int64_t only = only_seed();
  const std::int64_t first = only >= 0 ? only : 0;
  const std::int64_t last = only >= 0 ? only : meshes_of(count) - 1;
  for (std::int64_t seed = first; seed <= last; ++seed) {
    const RandomMesh mesh = random_meshes::random_mesh(static_cast<std::uint64_t>(seed));
    const std::string wrong = verdict(property, mesh);
    if (!wrong.empty()) {
      const RandomMesh small = Shrinker(property, mesh).shrink();
      FAIL(fmt::format(
          "mesh {} ({}; {} vertices, {} triangles): {}\nTo repeat: TRISMOOTH_SEED={} and this test's name."
          "\nThe same of {} vertices and {} triangles: {}\n{}",
          seed, mesh.kind, mesh.mesh.points.size(), mesh.mesh.triangles.size(), wrong, seed, small.mesh.points.size(),
          small.mesh.triangles.size(), verdict(property, small), off_text(small)));
    }
  }
  SUCCEED();
}

}  // namespace properties
