#include "trismooth/mpi/overlap.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mpi/directory.h"
#include "trismooth/mpi/links.h"

namespace trismooth::mpi {

namespace {

/// A triangle on its way to those who own its vertices.
struct SentTriangle {
  std::int64_t id;
  std::array<std::int64_t, 3> vertices;
  std::array<std::int32_t, 3> owners;
  std::int32_t region;
};

/// A vertex on its way to its owner.
struct SentVertex {
  std::int64_t id;
  std::uint8_t named;
};

void require_length(std::size_t length, std::size_t expected, const char* what, const char* of) {
  if (length != expected) {
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(length) + " entries, expected one for each of " +
                                std::to_string(expected) + " " + of);
  }
}

void check_ids(std::span<const std::int64_t> ids) {
  std::vector<std::int32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::int32_t v) { return std::pair(ids[static_cast<std::size_t>(v)], v); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto v = static_cast<std::size_t>(order[i]);
    if (ids[v] < 0) {
      throw std::invalid_argument("vertex_ids: that of local vertex " + std::to_string(v) + " is " +
                                  std::to_string(ids[v]) + ", and must not be negative");
    }
    if (i > 0 && ids[static_cast<std::size_t>(order[i - 1])] == ids[v]) {
      throw std::invalid_argument("vertex_ids: local vertices " + std::to_string(order[i - 1]) + " and " +
                                  std::to_string(v) + " have the same id " + std::to_string(ids[v]));
    }
  }
}

class OverlapBuilder {
 public:
  OverlapBuilder(const LocalMesh& mesh, std::span<const Triangle> triangles, const Constraints& constraints,
                 bool is_gathered, std::shared_ptr<const Communicator> communicator)
      : mesh_(mesh),
        triangles_(triangles),
        constraints_(constraints),
        is_gathered_(is_gathered),
        ranks_(*communicator),
        links_(std::make_shared<Links>(std::move(communicator))) {}

  Overlap run() {
    ranks_.on_all([&] { check(); });
    require_agreement();
    owners_ = owners_of(mesh_.vertex_ids, mesh_.owners, ranks_);
    if (is_gathered_) {
      std::ranges::fill(owners_, 0);
    }
    send_vertices();
    receive_triangles();
    overlap_.part.links = links_;
    number();
    ranks_.on_all([&] { check_repeated(); });
    meet_neighbours();
    if (is_gathered_) {
      gather_lines();
    }
    return std::move(overlap_);
  }

 private:
  void check() const {
    check_mesh_size(std::ssize(mesh_.vertex_ids), std::ssize(triangles_));
    const auto vertices = static_cast<std::int32_t>(mesh_.vertex_ids.size());
    check_triangles(vertices, triangles_);
    check_constraints(constraints_, vertices, std::ssize(triangles_));
    check_ids(mesh_.vertex_ids);
    if (!mesh_.owners.empty()) {
      require_length(mesh_.owners.size(), mesh_.vertex_ids.size(), "owners", "local vertices");
      for (std::size_t v = 0; v < mesh_.owners.size(); ++v) {
        if (mesh_.owners[v] < 0 || mesh_.owners[v] >= ranks_.size()) {
          throw std::invalid_argument("owners: that of local vertex " + std::to_string(v) + " is " +
                                      std::to_string(mesh_.owners[v]) + ", and the ranks are 0 to " +
                                      std::to_string(ranks_.size() - 1));
        }
      }
    }
    if (!mesh_.ghost_triangles.empty()) {
      require_length(mesh_.ghost_triangles.size(), triangles_.size(), "ghost_triangles", "local triangles");
    }
    if (!mesh_.triangle_ids.empty()) {
      require_length(mesh_.triangle_ids.size(), triangles_.size(), "triangle_ids", "local triangles");
    }
  }

  /// What some ranks have and others not is an oversight: a rank without triangles or vertices does not count.
  void require_agreement() {
    const auto none_or_all = [&](bool has, bool could, const char* what) {
      const bool some = ranks_.any(has);
      ranks_.on_all([&] {
        if (some && could && !has) {
          throw std::invalid_argument(std::string(what) + " are there on other ranks, and not on this one");
        }
      });
      return some;
    };
    has_triangle_ids_ = none_or_all(!mesh_.triangle_ids.empty(), !triangles_.empty(), "triangle_ids");
    has_regions_ = none_or_all(!constraints_.regions.empty(), !triangles_.empty(), "regions");
    none_or_all(!mesh_.owners.empty(), !mesh_.vertex_ids.empty(), "owners");
  }

  void send_vertices() {
    std::vector<std::uint8_t> named(mesh_.vertex_ids.size(), 0);
    for (std::size_t v = 0; v < named.size(); ++v) {
      named[v] = static_cast<std::uint8_t>(
          (!constraints_.fixed.empty() && constraints_.fixed[v] != 0 ? hold::named : 0) |
          (!constraints_.other_cells.empty() && constraints_.other_cells[v] != 0 ? hold::other_cell : 0));
    }
    for (const std::int32_t v : constraints_.fixed_ids) {
      named[static_cast<std::size_t>(v)] |= hold::named;
    }
    for (const auto& vertices : {constraints_.slide.lines, constraints_.slide.links}) {
      for (const std::int32_t v : vertices) {
        named[static_cast<std::size_t>(v)] |= hold::line;
      }
    }
    overlap_.to_owners = lists_by_rank<std::int32_t>(ranks_);
    auto sent = lists_by_rank<SentVertex>(ranks_);
    for (std::size_t v = 0; v < named.size(); ++v) {
      const auto owner = static_cast<std::size_t>(owners_[v]);
      overlap_.to_owners[owner].push_back(static_cast<std::int32_t>(v));
      sent[owner].push_back({mesh_.vertex_ids[v], named[v]});
    }
    listed_ = ranks_.exchanged(sent);
  }

  void receive_triangles() {
    const auto is_ghost = [&](std::size_t t) {
      return !mesh_.ghost_triangles.empty() && mesh_.ghost_triangles[t] != 0;
    };
    std::int64_t own = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      own += is_ghost(t) ? 0 : 1;
    }
    std::int64_t next_id = ranks_.sum_before(own);
    auto sent = lists_by_rank<SentTriangle>(ranks_);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (is_ghost(t)) {
        continue;
      }
      SentTriangle triangle{has_triangle_ids_ ? mesh_.triangle_ids[t] : next_id++,
                            {},
                            {},
                            has_regions_ ? constraints_.regions[t] : 0};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto v = static_cast<std::size_t>(triangles_[t][i]);
        triangle.vertices[i] = mesh_.vertex_ids[v];
        triangle.owners[i] = owners_[v];
      }
      const auto& [a, b, c] = triangle.owners;
      sent[static_cast<std::size_t>(a)].push_back(triangle);
      if (b != a) {
        sent[static_cast<std::size_t>(b)].push_back(triangle);
      }
      if (c != a && c != b) {
        sent[static_cast<std::size_t>(c)].push_back(triangle);
      }
    }
    const ByRank<SentTriangle> from = ranks_.exchanged(sent);
    sent = {};
    for (std::size_t r = 0; r < from.size(); ++r) {
      received_.insert(received_.end(), from[r].begin(), from[r].end());
      sources_.insert(sources_.end(), from[r].size(), static_cast<std::int32_t>(r));
    }
  }

  /// Numbers vertices and triangles.
  void number() {
    std::vector<std::pair<std::int64_t, std::int32_t>> vertices;  // and their owners
    for (const auto& of_rank : listed_) {
      for (const SentVertex& vertex : of_rank) {
        vertices.emplace_back(vertex.id, ranks_.rank());
      }
    }
    for (const SentTriangle& triangle : received_) {
      for (std::size_t i = 0; i < 3; ++i) {
        vertices.emplace_back(triangle.vertices[i], triangle.owners[i]);
      }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const auto& [id, owner] : vertices) {
      overlap_.ids.push_back(id);
      overlap_.owners.push_back(owner);
      overlap_.part.ghosts.push_back(owner == ranks_.rank() ? 0 : 1);
    }
    overlap_.named.assign(vertices.size(), 0);
    overlap_.from_callers = lists_by_rank<std::int32_t>(ranks_);
    for (std::size_t r = 0; r < listed_.size(); ++r) {
      for (const SentVertex& vertex : listed_[r]) {
        const std::int32_t v = number_of(vertex.id);
        overlap_.named[static_cast<std::size_t>(v)] |= vertex.named;
        overlap_.from_callers[r].push_back(v);
      }
    }
    std::vector<std::size_t> order(received_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t t) { return received_[t].id; });
    for (const std::size_t t : order) {
      const SentTriangle& triangle = received_[t];
      overlap_.triangles.push_back(
          {number_of(triangle.vertices[0]), number_of(triangle.vertices[1]), number_of(triangle.vertices[2])});
      overlap_.triangle_ids.push_back(triangle.id);
      if (has_regions_) {
        overlap_.regions.push_back(triangle.region);
      }
      sorted_sources_.push_back(sources_[t]);
    }
    received_ = {};
    sources_ = {};
    listed_ = {};
  }

  std::int32_t number_of(std::int64_t id) const {
    return static_cast<std::int32_t>(std::ranges::lower_bound(overlap_.ids, id) - overlap_.ids.begin());
  }

  void check_repeated() const {
    for (std::size_t t = 1; t < overlap_.triangle_ids.size(); ++t) {
      if (overlap_.triangle_ids[t] == overlap_.triangle_ids[t - 1]) {
        throw std::invalid_argument("triangle_ids: " + std::to_string(overlap_.triangle_ids[t]) + " is on rank " +
                                    std::to_string(sorted_sources_[t - 1]) + " and on rank " +
                                    std::to_string(sorted_sources_[t]) + "; copies are to be in ghost_triangles");
      }
    }
    if (has_triangle_ids_) {
      return;  // then a triangle that is there twice is meant to be
    }
    using Corners = std::array<std::int32_t, 3>;
    std::vector<std::pair<Corners, std::int32_t>> sorted;
    for (std::size_t t = 0; t < overlap_.triangles.size(); ++t) {
      Corners corners = overlap_.triangles[t];
      std::ranges::sort(corners);
      sorted.emplace_back(corners, sorted_sources_[t]);
    }
    std::ranges::sort(sorted);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first == sorted[i - 1].first && sorted[i].second != sorted[i - 1].second) {
        const auto id = [&](std::size_t k) {
          return std::to_string(overlap_.ids[static_cast<std::size_t>(sorted[i].first[k])]);
        };
        throw std::invalid_argument("the triangle of vertex ids " + id(0) + ", " + id(1) + " and " + id(2) +
                                    " is on rank " + std::to_string(sorted[i - 1].second) + " and on rank " +
                                    std::to_string(sorted[i].second) + "; copies are to be in ghost_triangles");
      }
    }
  }

  /// Tells the owners of ghosts that this rank has them.
  void meet_neighbours() {
    auto wanted = lists_by_rank<std::int64_t>(ranks_);
    std::vector<std::vector<std::int32_t>> receives(wanted.size());
    for (std::int32_t v = 0; v < overlap_.vertex_count(); ++v) {
      if (!overlap_.is_own(v)) {
        const auto owner = static_cast<std::size_t>(overlap_.owners[static_cast<std::size_t>(v)]);
        wanted[owner].push_back(overlap_.ids[static_cast<std::size_t>(v)]);
        receives[owner].push_back(v);
      }
    }
    const ByRank<std::int64_t> asked = ranks_.exchanged(wanted);
    for (std::size_t r = 0; r < asked.size(); ++r) {
      if (asked[r].empty() && receives[r].empty()) {
        continue;
      }
      MeshPart::Neighbour neighbour{static_cast<int>(r), {}, std::move(receives[r])};
      for (const std::int64_t id : asked[r]) {
        neighbour.sends.push_back(number_of(id));
      }
      overlap_.part.neighbours.push_back(std::move(neighbour));
    }
  }

  /// Brings the lines and links of all ranks to the one that owns all vertices.
  void gather_lines() {
    struct Line {
      std::int64_t a;
      std::int64_t b;
      std::int32_t tag;
    };
    const Sliding& slide = constraints_.slide;
    const bool has_tags = ranks_.any(!slide.line_tags.empty());
    const auto gathered = [&](std::span<const std::int32_t> pairs, bool are_lines) {
      auto sent = lists_by_rank<Line>(ranks_);
      for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
        sent[0].push_back({mesh_.vertex_ids[static_cast<std::size_t>(pairs[i])],
                           mesh_.vertex_ids[static_cast<std::size_t>(pairs[i + 1])],
                           are_lines && !slide.line_tags.empty() ? slide.line_tags[i / 2] : 0});
      }
      return ranks_.exchanged(sent);
    };
    // Ranks that have the same edge may both have the line on it.
    std::set<std::tuple<std::int64_t, std::int64_t, std::int32_t>> known;
    for (const auto& of_rank : gathered(slide.lines, true)) {
      for (const Line& line : of_rank) {
        if (!known.emplace(std::min(line.a, line.b), std::max(line.a, line.b), line.tag).second) {
          continue;
        }
        overlap_.lines.insert(overlap_.lines.end(), {number_of(line.a), number_of(line.b)});
        if (has_tags) {
          overlap_.line_tags.push_back(line.tag);
        }
      }
    }
    for (const auto& of_rank : gathered(slide.links, false)) {
      for (const Line& link : of_rank) {
        overlap_.links.insert(overlap_.links.end(), {number_of(link.a), number_of(link.b)});
      }
    }
  }

  const LocalMesh& mesh_;
  std::span<const Triangle> triangles_;
  const Constraints& constraints_;
  bool is_gathered_;
  const Communicator& ranks_;
  std::shared_ptr<Links> links_;
  bool has_triangle_ids_ = false;
  bool has_regions_ = false;
  std::vector<std::int32_t> owners_;  ///< of local vertices
  ByRank<SentVertex> listed_;
  std::vector<SentTriangle> received_;
  std::vector<std::int32_t> sources_;
  std::vector<std::int32_t> sorted_sources_;
  Overlap overlap_;
};

}  // namespace

Overlap build_overlap(const LocalMesh& mesh, std::span<const Triangle> triangles, const Constraints& constraints,
                      bool is_gathered, std::shared_ptr<const Communicator> communicator) {
  return OverlapBuilder(mesh, triangles, constraints, is_gathered, std::move(communicator)).run();
}

}  // namespace trismooth::mpi
