// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/in_parts/mesh_cut.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/rings/colouring.h"
#include "trismooth/smoothing/rings/vertex_order.h"

namespace trismooth {

namespace {

constexpr std::int64_t cut_grain = 16384;

/// The part that owns each vertex.
BulkVector<std::int32_t> owners_along_curve(const MeshRings& mesh, std::span<const Point2<double>> local, int parts,
                                            Workers& workers) {
  const BulkVector<std::int32_t> order = hilbert_order(local, mesh.rings, workers);
  const std::int64_t free =
      std::partition_point(order.begin(), order.end(), [&](std::int32_t v) { return mesh.rings.is_free(v); }) -
      order.begin();
  BulkVector<std::int32_t> owners(order.size());
  workers.for_blocks(std::ssize(order), cut_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t place = i < free ? i : i - free;
      const std::int64_t count = i < free ? free : std::ssize(order) - free;
      owners[order[i]] = static_cast<std::int32_t>(place * parts / count);
    }
  });
  return owners;
}

/// What a part has of another one, which may be nothing yet.
MeshPart::Neighbour& neighbour_of(MeshPart& part, int other) {
  const auto place = std::ranges::lower_bound(part.neighbours, other, {}, &MeshPart::Neighbour::part);
  return place != part.neighbours.end() && place->part == other
             ? *place
             : *part.neighbours.insert(place, MeshPart::Neighbour{other, {}, {}});
}

/// Cuts parts out of one mesh. Keeps arrays of the mesh's size, so it is made once.
class Cutter {
 public:
  Cutter(const MeshRings& mesh, const ElementList& elements, std::span<const Point2<double>> local, int parts,
         Workers& workers)
      : mesh_(mesh),
        elements_(elements),
        local_(local),
        workers_(workers),
        owners_(owners_along_curve(mesh, local, parts, workers)),
        colouring_(colour_free_vertices(mesh.rings.view(), workers)),
        fixed_elements_(elements.visit([&](const auto& listed) {
          return numbers_of(
              std::ssize(listed), [&](std::int64_t e) { return all_are_fixed(listed[e], mesh.fixed); }, workers);
        })),
        is_known_(local.size()),
        number_(local.size()) {
    for (const std::uint8_t why : mesh.fixed) {
      free_vertices_ += why == 0 ? 1 : 0;
    }
  }

  /// Whatever others need of it is left out of `of_part`.
  CutPart part(int number, MeshPart& of_part) {
    mark_known(number);
    CutPart part;
    part.vertices = numbers_of(
        std::ssize(is_known_), [&](std::int64_t v) { return is_known_[v] != 0; }, workers_);
    for_vertices(part, [&](std::int32_t v, std::int32_t whole) { number_[whole] = v; });
    fill(part, of_part, number);
    take_rings(part, number);
    take_fixed_elements(part, number);
    find_owners_of_ghosts(part, of_part);
    return part;
  }

 private:
  /// Calls visit(number in the part, number in the whole).
  template <class Visit>
  void for_vertices(const CutPart& part, const Visit& visit) {
    workers_.for_blocks(std::ssize(part.vertices), cut_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        visit(v, part.vertices[v]);
      }
    });
  }

  bool is_counted(std::int32_t e, int number) const { return owners_[std::ranges::min(elements_[e])] == number; }

  /// What it owns, what is around that, and the corners of elements that it counts.
  void mark_known(int number) {
    std::ranges::fill(is_known_, std::uint8_t{0});
    const auto mark = [&](std::int32_t v) { std::atomic_ref(is_known_[v]).store(1, std::memory_order_relaxed); };
    workers_.for_blocks(std::ssize(owners_), cut_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        if (owners_[v] == number && (mesh_.fixed[v] & hold::isolated) == 0) {
          mark(v);
          mesh_.rings.view().for_vertices_around(v, mark);
        }
      }
    });
    for (const std::int32_t e : fixed_elements_) {
      if (is_counted(e, number)) {
        std::ranges::for_each(elements_[e], mark);
      }
    }
  }

  void fill(CutPart& part, MeshPart& of_part, int number) {
    const std::size_t count = part.vertices.size();
    part.mesh.fixed.resize(count);
    part.local.resize(count);
    of_part.ghosts.resize(count);
    of_part.colours.resize(count);
    for_vertices(part, [&](std::int32_t v, std::int32_t whole) {
      part.mesh.fixed[v] = mesh_.fixed[whole];
      part.local[v] = local_[whole];
      of_part.ghosts[v] = owners_[whole] == number ? 0 : 1;
      of_part.colours[v] = colouring_.colours[whole];
    });
    of_part.colour_count = colouring_.count;
    of_part.free_vertices = free_vertices_;
    of_part.number = number;
    of_part.place_on_machine = number;
  }

  void take_rings(CutPart& part, int number) {
    const auto size = [&](std::int32_t v) {
      const std::int32_t whole = part.vertices[v];
      return owners_[whole] == number ? std::ssize(mesh_.rings[whole]) : 0;
    };
    OneRings& rings = part.mesh.rings;
    rings = OneRings::with_sizes(static_cast<std::int32_t>(part.vertices.size()), size, workers_);
    rings.opposites.resize(mesh_.rings.opposites.empty() ? 0 : rings.neighbours.size());
    for_vertices(part, [&](std::int32_t v, std::int32_t whole) {
      if (size(v) > 0) {
        std::ranges::transform(mesh_.rings[whole], rings.neighbours.begin() + rings.offsets[v],
                               [&](std::int32_t neighbour) { return number_[neighbour]; });
      }
      if (size(v) > 0 && !rings.opposites.empty()) {
        std::ranges::transform(mesh_.rings.view().mixed(whole).opposites, rings.opposites.begin() + rings.offsets[v],
                               [&](std::int32_t opposite) { return in_part(opposite); });
      }
    });
  }

  void take_fixed_elements(CutPart& part, int number) {
    part.elements = elements_.visit([&]<class Corners>(std::span<const Corners> listed) {
      std::vector<Corners> taken;
      for (const std::int32_t e : fixed_elements_) {
        if (is_counted(e, number)) {
          std::ranges::transform(listed[e], taken.emplace_back().begin(), [&](std::int32_t v) { return in_part(v); });
          part.mesh.reversed.push_back(mesh_.reversed[e]);
        }
      }
      return OwnElements(std::move(taken));
    });
  }

  /// The number in the part of a vertex, or of no_corner.
  std::int32_t in_part(std::int32_t vertex) const { return vertex == no_corner ? no_corner : number_[vertex]; }

  void find_owners_of_ghosts(const CutPart& part, MeshPart& of_part) const {
    for (std::int32_t v = 0; v < std::ssize(part.vertices); ++v) {
      if (of_part.ghosts[v] != 0) {
        neighbour_of(of_part, owners_[part.vertices[v]]).receives.push_back(v);
      }
    }
  }

  const MeshRings& mesh_;
  ElementList elements_;
  std::span<const Point2<double>> local_;
  Workers& workers_;
  BulkVector<std::int32_t> owners_;
  Colouring colouring_;
  BulkVector<std::int32_t> fixed_elements_;  ///< the numbers of those without a free vertex
  std::int64_t free_vertices_ = 0;
  // Of the part that is made:
  BulkVector<std::uint8_t> is_known_;
  BulkVector<std::int32_t> number_;  ///< in the part, of what it knows
};

/// Has the owners of ghosts send them.
void find_sends(std::span<const CutPart> cut, std::span<const std::shared_ptr<MeshPart>> parts) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    // (A part is no neighbour of itself: what is added here is not what is gone through.)
    for (const MeshPart::Neighbour& owner : parts[p]->neighbours) {
      const BulkVector<std::int32_t>& numbers = cut[static_cast<std::size_t>(owner.part)].vertices;
      std::vector<std::int32_t> sends;
      for (const std::int32_t ghost : owner.receives) {
        const auto place = std::ranges::lower_bound(numbers, cut[p].vertices[ghost]);
        sends.push_back(static_cast<std::int32_t>(place - numbers.begin()));
      }
      neighbour_of(*parts[static_cast<std::size_t>(owner.part)], static_cast<int>(p)).sends = std::move(sends);
    }
  }
}

}  // namespace

std::vector<CutPart> cut_into_parts(const MeshRings& mesh, const ElementList& elements,
                                    std::span<const Point2<double>> local, const ThreadTeam& team, bool has_progress,
                                    Workers& workers) {
  Cutter cutter(mesh, elements, local, team.count(), workers);
  std::vector<CutPart> cut;
  std::vector<std::shared_ptr<MeshPart>> parts;
  for (int p = 0; p < team.count(); ++p) {
    const auto part = std::make_shared<MeshPart>();
    part->count = team.count();
    part->has_progress = has_progress;
    part->messenger = team.messenger(p);
    cut.push_back(cutter.part(p, *part));
    cut.back().mesh.part = part;
    parts.push_back(part);
  }
  find_sends(cut, parts);
  return cut;
}

}  // namespace trismooth
