#include "trismooth/mpi/overlap.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/mpi/directory.h"
#include "trismooth/mpi/links.h"

namespace trismooth::mpi {

namespace {

constexpr std::int64_t overlap_grain = 16384;

/// A triangle on its way to those who own its vertices.
struct SentTriangle {
  std::int64_t id;
  std::array<std::int64_t, 3> vertices;
  std::array<std::int32_t, 3> owners;
  std::int32_t region;
};

/// A triangle at own vertices: the caller's number `place`, or -1 - i for the i-th that was received.
struct KeptTriangle {
  std::int64_t id;
  std::int32_t place;
};

/// A vertex on its way to its owner.
struct SentVertex {
  std::int64_t id;
  std::uint8_t named;
};

void require_length(std::size_t length, std::size_t expected, const char* what, const char* of) {
  if (length != expected) {
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(length) +
                                " entries, expected one for each of " + std::to_string(expected) + " " + of);
  }
}

void check_ids(std::span<const std::int64_t> ids) {
  const auto require_not_negative = [&](std::size_t v) {
    if (ids[v] < 0) {
      throw std::invalid_argument("vertex_ids: that of local vertex " + std::to_string(v) + " is " +
                                  std::to_string(ids[v]) + ", and must not be negative");
    }
  };
  if (std::ranges::is_sorted(ids, std::less_equal<>())) {
    if (!ids.empty()) {
      require_not_negative(0);
    }
    return;
  }
  std::vector<std::pair<std::int64_t, std::size_t>> order;
  for (std::size_t v = 0; v < ids.size(); ++v) {
    require_not_negative(v);
    order.emplace_back(ids[v], v);
  }
  std::ranges::sort(order);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first == order[i - 1].first) {
      throw std::invalid_argument("vertex_ids: local vertices " + std::to_string(order[i - 1].second) + " and " +
                                  std::to_string(order[i].second) + " have the same id " +
                                  std::to_string(order[i].first));
    }
  }
}

void check_triangle_ids(std::span<const std::int64_t> ids) {
  // Votes for orientations have one bit more.
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max() / 4;
  for (std::size_t t = 0; t < ids.size(); ++t) {
    if (ids[t] < 0 || ids[t] > largest) {
      throw std::invalid_argument("triangle_ids: that of local triangle " + std::to_string(t) + " is " +
                                  std::to_string(ids[t]) + ", and must be from 0 to " + std::to_string(largest));
    }
  }
}

class OverlapBuilder {
 public:
  OverlapBuilder(const LocalMesh& mesh, std::span<const Triangle> triangles, const Constraints& constraints,
                 bool is_gathered, std::shared_ptr<const Communicator> communicator, Workers& workers)
      : mesh_(mesh),
        triangles_(triangles),
        constraints_(constraints),
        is_gathered_(is_gathered),
        ranks_(*communicator),
        workers_(workers),
        links_(std::make_shared<Links>(std::move(communicator))) {}

  Overlap run() {
    ranks_.on_all([&] { check(); });
    require_agreement();
    owners_ = owners_of(mesh_.vertex_ids, mesh_.owners, ranks_);
    if (is_gathered_) {
      std::ranges::fill(owners_, 0);
    }
    send_vertices();
    send_triangles();
    overlap_.part.links = links_;
    number_vertices();
    list_callers();
    list_triangles();
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
      check_triangle_ids(mesh_.triangle_ids);
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
    named_.assign(mesh_.vertex_ids.size(), 0);
    for (std::size_t v = 0; v < named_.size(); ++v) {
      named_[v] = static_cast<std::uint8_t>(
          (!constraints_.fixed.empty() && constraints_.fixed[v] != 0 ? hold::named : 0) |
          (!constraints_.other_cells.empty() && constraints_.other_cells[v] != 0 ? hold::other_cell : 0));
    }
    for (const std::int32_t v : constraints_.fixed_ids) {
      named_[static_cast<std::size_t>(v)] |= hold::named;
    }
    for (const auto& vertices : {constraints_.slide.lines, constraints_.slide.links}) {
      for (const std::int32_t v : vertices) {
        named_[static_cast<std::size_t>(v)] |= hold::line;
      }
    }
    overlap_.to_owners = lists_by_rank<std::int32_t>(ranks_);
    auto sent = lists_by_rank<SentVertex>(ranks_);
    overlap_.to_owners[static_cast<std::size_t>(ranks_.rank())].reserve(
        static_cast<std::size_t>(std::ranges::count(owners_, ranks_.rank())));
    for (std::size_t v = 0; v < named_.size(); ++v) {
      const auto owner = static_cast<std::size_t>(owners_[v]);
      overlap_.to_owners[owner].push_back(static_cast<std::int32_t>(v));
      if (owners_[v] != ranks_.rank()) {
        sent[owner].push_back({mesh_.vertex_ids[v], named_[v]});
      }
    }
    listed_ = ranks_.exchanged(std::move(sent));
  }

  bool is_copy(std::size_t t) const { return !mesh_.ghost_triangles.empty() && mesh_.ghost_triangles[t] != 0; }

  /// Keeps the triangles at own vertices, and sends those at the others' to them.
  void send_triangles() {
    std::int64_t count = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      count += is_copy(t) ? 0 : 1;
    }
    std::int64_t next_id = ranks_.sum_before(count);
    if (has_triangle_ids_) {
      std::vector<std::int64_t> ids;
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (!is_copy(t)) {
          ids.push_back(mesh_.triangle_ids[t]);
        }
      }
      require_unique(ids, "triangle_ids", ranks_);
    }
    is_at_kept_.assign(mesh_.vertex_ids.size(), 0);
    kept_.reserve(static_cast<std::size_t>(count));
    auto sent = lists_by_rank<SentTriangle>(ranks_);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (is_copy(t)) {
        continue;
      }
      const std::int64_t id = has_triangle_ids_ ? mesh_.triangle_ids[t] : next_id++;
      std::array<std::int32_t, 3> owners{};
      for (std::size_t i = 0; i < 3; ++i) {
        owners[i] = owners_[static_cast<std::size_t>(triangles_[t][i])];
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const bool is_told = (i > 0 && owners[i] == owners[0]) || (i > 1 && owners[i] == owners[1]);
        if (is_told) {
          continue;
        }
        if (owners[i] == ranks_.rank()) {
          keep(t, id);
        } else {
          sent[static_cast<std::size_t>(owners[i])].push_back(sent_triangle(t, id, owners));
        }
      }
    }
    const ByRank<SentTriangle> from = ranks_.exchanged(std::move(sent));
    for (std::size_t r = 0; r < from.size(); ++r) {
      received_.insert(received_.end(), from[r].begin(), from[r].end());
      sources_.insert(sources_.end(), from[r].size(), static_cast<std::int32_t>(r));
    }
  }

  void keep(std::size_t t, std::int64_t id) {
    kept_.push_back({id, static_cast<std::int32_t>(t)});
    for (const std::int32_t v : triangles_[t]) {
      is_at_kept_[static_cast<std::size_t>(v)] = 1;
    }
  }

  SentTriangle sent_triangle(std::size_t t, std::int64_t id, const std::array<std::int32_t, 3>& owners) const {
    SentTriangle triangle{id, {}, owners, has_regions_ ? constraints_.regions[t] : 0};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.vertices[i] = mesh_.vertex_ids[static_cast<std::size_t>(triangles_[t][i])];
    }
    return triangle;
  }

  /// Own vertices, whoever has them, and the corners of all triangles here.
  void number_vertices() {
    std::vector<std::pair<std::int64_t, std::int32_t>> vertices;  // and their owners
    vertices.reserve(mesh_.vertex_ids.size());
    for (std::size_t v = 0; v < mesh_.vertex_ids.size(); ++v) {
      if (owners_[v] == ranks_.rank() || is_at_kept_[v] != 0) {
        vertices.emplace_back(mesh_.vertex_ids[v], owners_[v]);
      }
    }
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
    if (!std::ranges::is_sorted(vertices)) {
      std::ranges::sort(vertices);
    }
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    overlap_.ids.reserve(vertices.size());
    overlap_.owners.reserve(vertices.size());
    overlap_.part.ghosts.reserve(vertices.size());
    for (const auto& [id, owner] : vertices) {
      overlap_.ids.push_back(id);
      overlap_.owners.push_back(owner);
      overlap_.part.ghosts.push_back(owner == ranks_.rank() ? 0 : 1);
    }
    vertices = {};
    number_of_local_.resize(mesh_.vertex_ids.size());
    workers_.for_blocks(std::ssize(number_of_local_), overlap_grain, [&](std::int64_t begin, std::int64_t end) {
      std::size_t next = 0;  // behind the last one
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        // Vertices are numbered as their ids are, more often than not.
        const bool follows = next < overlap_.ids.size() && overlap_.ids[next] == mesh_.vertex_ids[v];
        next = follows ? next : static_cast<std::size_t>(number_of(mesh_.vertex_ids[v]));
        number_of_local_[v] = static_cast<std::int32_t>(next++);
      }
    });
  }

  /// Who has which own vertices, and what they say of them.
  void list_callers() {
    overlap_.named.assign(overlap_.ids.size(), 0);
    overlap_.from_callers = lists_by_rank<std::int32_t>(ranks_);
    for (std::size_t r = 0; r < listed_.size(); ++r) {
      for (const SentVertex& vertex : listed_[r]) {
        const std::int32_t v = number_of(vertex.id);
        overlap_.named[static_cast<std::size_t>(v)] |= vertex.named;
        overlap_.from_callers[r].push_back(v);
      }
    }
    const auto own = static_cast<std::size_t>(ranks_.rank());
    overlap_.from_callers[own].reserve(overlap_.to_owners[own].size());
    for (const std::int32_t local : overlap_.to_owners[own]) {
      const std::int32_t v = number_of_local_[static_cast<std::size_t>(local)];
      overlap_.named[static_cast<std::size_t>(v)] |= named_[static_cast<std::size_t>(local)];
      overlap_.from_callers[own].push_back(v);
    }
    listed_ = {};
    named_ = {};
  }

  /// Those that were kept and those that came, in the order of their ids.
  void list_triangles() {
    for (std::size_t i = 0; i < received_.size(); ++i) {
      kept_.push_back({received_[i].id, -1 - static_cast<std::int32_t>(i)});
    }
    const auto id_of = [](const KeptTriangle& triangle) { return triangle.id; };
    if (!std::ranges::is_sorted(kept_, {}, id_of)) {
      std::ranges::sort(kept_, {}, id_of);
    }
    overlap_.triangles.resize(kept_.size());
    overlap_.triangle_ids.resize(kept_.size());
    overlap_.regions.resize(has_regions_ ? kept_.size() : 0);
    workers_.for_blocks(std::ssize(kept_), overlap_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const auto [id, place] = kept_[i];
        overlap_.triangle_ids[i] = id;
        for (std::size_t k = 0; k < 3; ++k) {
          overlap_.triangles[i][k] =
              place >= 0 ? number_of_local_[static_cast<std::size_t>(triangles_[static_cast<std::size_t>(place)][k])]
                         : number_of(received_[static_cast<std::size_t>(-1 - place)].vertices[k]);
        }
        if (has_regions_) {
          overlap_.regions[i] = place >= 0 ? constraints_.regions[static_cast<std::size_t>(place)]
                                           : received_[static_cast<std::size_t>(-1 - place)].region;
        }
      }
    });
  }

  std::int32_t number_of(std::int64_t id) const {
    return static_cast<std::int32_t>(std::ranges::lower_bound(overlap_.ids, id) - overlap_.ids.begin());
  }

  /// A triangle that two ranks have was not called a copy by either. (Where triangles have ids, one that is there twice
  /// is meant to be.)
  void check_repeated() const {
    if (has_triangle_ids_ || received_.empty()) {
      return;
    }
    std::vector<std::uint8_t> is_at_received(overlap_.ids.size(), 0);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      for (std::size_t k = 0; k < 3 && kept_[i].place < 0; ++k) {
        is_at_received[static_cast<std::size_t>(overlap_.triangles[i][k])] = 1;
      }
    }
    using Corners = std::array<std::int32_t, 3>;
    std::vector<std::pair<Corners, std::int32_t>> sorted;  // and the rank that has it
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      Corners corners = overlap_.triangles[i];
      if (std::ranges::all_of(corners,
                              [&](std::int32_t v) { return is_at_received[static_cast<std::size_t>(v)] != 0; })) {
        std::ranges::sort(corners);
        sorted.emplace_back(
            corners, kept_[i].place >= 0 ? ranks_.rank() : sources_[static_cast<std::size_t>(-1 - kept_[i].place)]);
      }
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
    const ByRank<std::int64_t> asked = ranks_.exchanged(std::move(wanted));
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
      return ranks_.exchanged(std::move(sent));
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
  Workers& workers_;
  std::shared_ptr<Links> links_;
  bool has_triangle_ids_ = false;
  bool has_regions_ = false;
  std::vector<std::int32_t> owners_;           ///< of local vertices
  std::vector<std::uint8_t> named_;            ///< of local vertices, as Overlap::named
  std::vector<std::uint8_t> is_at_kept_;       ///< of local vertices: corners of kept triangles
  std::vector<std::int32_t> number_of_local_;  ///< in the overlap; of local vertices that are there
  ByRank<SentVertex> listed_;                  ///< own vertices that other ranks have
  std::vector<KeptTriangle> kept_;
  std::vector<SentTriangle> received_;
  std::vector<std::int32_t> sources_;  ///< of received triangles: ranks
  Overlap overlap_;
};

}  // namespace

Overlap build_overlap(const LocalMesh& mesh, std::span<const Triangle> triangles, const Constraints& constraints,
                      bool is_gathered, std::shared_ptr<const Communicator> communicator, Workers& workers) {
  return OverlapBuilder(mesh, triangles, constraints, is_gathered, std::move(communicator), workers).run();
}

}  // namespace trismooth::mpi
