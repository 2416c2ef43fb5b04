// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/overlap.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/release.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mpi/directory.h"
#include "trismooth/mpi/element_exchange.h"
#include "trismooth/mpi/local_mesh_checks.h"
#include "trismooth/mpi/messenger.h"
#include "trismooth/quality/element.h"

namespace trismooth::mpi {

namespace {

constexpr std::int64_t overlap_grain = 16384;

/// A vertex on its way to its owner.
struct SentVertex {
  std::int64_t id;
  std::uint8_t named;
};

template <class Corners>
class OverlapBuilder {
 public:
  OverlapBuilder(const LocalMesh& mesh, std::span<const Corners> elements, const Constraints& constraints,
                 bool is_gathered, std::shared_ptr<const Communicator> communicator, Workers& workers)
      : mesh_(mesh),
        elements_(elements),
        constraints_(constraints),
        is_gathered_(is_gathered),
        ranks_(*communicator),
        workers_(workers),
        messenger_(std::make_shared<Messenger>(std::move(communicator))) {}

  Overlap run() {
    require_agreement();
    owners_ = owners_of(mesh_.vertex_ids, mesh_.owners, ranks_);
    if (is_gathered_) {
      std::ranges::fill(owners_, 0);
    }
    send_vertices();
    around_ = exchange_elements(mesh_, elements_, has_triangle_ids_, constraints_.regions, owners_, ranks_);
    overlap_.triangle_ids = std::move(around_.ids);
    overlap_.part.messenger = messenger_;
    number_vertices();
    join_flags();
    list_elements();
    ranks_.on_all([&] { check_repeated(); });
    list_callers();
    meet_neighbours();
    if (is_gathered_) {
      gather_lines();
    }
    overlap_.listed = std::move(listed_elements_);
    return std::move(overlap_);
  }

 private:
  /// What some ranks have and others not is an oversight: a rank without elements or vertices does not count.
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
    has_triangle_ids_ = none_or_all(!mesh_.triangle_ids.empty(), !elements_.empty(), "triangle_ids");
    has_regions_ = none_or_all(!constraints_.regions.empty(), !elements_.empty(), "regions");
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
    to_owners_ = lists_by_rank<std::int32_t>(ranks_);
    auto sent = lists_by_rank<SentVertex>(ranks_);
    for (std::size_t v = 0; v < named_.size(); ++v) {
      if (owners_[v] != ranks_.rank()) {
        const auto owner = static_cast<std::size_t>(owners_[v]);
        to_owners_[owner].push_back(static_cast<std::int32_t>(v));
        sent[owner].push_back({mesh_.vertex_ids[v], named_[v]});
      }
    }
    listed_ = ranks_.exchanged(std::move(sent));
  }

  /// Own vertices, whoever has them, and the corners of all elements here.
  void number_vertices() {
    std::size_t most = mesh_.vertex_ids.size() + around_.foreign.size();
    for (const auto& of_rank : listed_) {
      most += of_rank.size();
    }
    std::vector<std::uint8_t> is_corner(mesh_.vertex_ids.size(), 0);  // of an element here
    for (const std::int32_t place : around_.places) {
      if (place >= 0) {
        for (const std::int32_t v : corners_of(elements_[static_cast<std::size_t>(place)])) {
          is_corner[static_cast<std::size_t>(v)] = 1;
        }
      }
    }
    BulkVector<OwnedId> vertices;
    vertices.reserve(most);
    for (std::size_t v = 0; v < mesh_.vertex_ids.size(); ++v) {
      if (owners_[v] == ranks_.rank() || is_corner[v] != 0) {
        vertices.push_back({mesh_.vertex_ids[v], owners_[v]});
      }
    }
    for (const auto& of_rank : listed_) {
      for (const SentVertex& vertex : of_rank) {
        vertices.push_back({vertex.id, ranks_.rank()});
      }
    }
    vertices.insert(vertices.end(), around_.foreign.begin(), around_.foreign.end());
    release(around_.foreign);
    sort_uniquely(vertices);
    overlap_.ids.reserve(vertices.size());
    overlap_.owners.reserve(vertices.size());
    overlap_.part.ghosts.reserve(vertices.size());
    for (const auto& [id, owner] : vertices) {
      overlap_.ids.push_back(id);
      overlap_.owners.push_back(owner);
      overlap_.part.ghosts.push_back(owner == ranks_.rank() ? 0 : 1);
    }
    release(vertices);
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

  /// What those who list own vertices say of them.
  void join_flags() {
    overlap_.named.assign(overlap_.ids.size(), 0);
    from_callers_ = lists_by_rank<std::int32_t>(ranks_);
    for (std::size_t r = 0; r < listed_.size(); ++r) {
      for (const SentVertex& vertex : listed_[r]) {
        const std::int32_t v = number_of(vertex.id);
        overlap_.named[static_cast<std::size_t>(v)] |= vertex.named;
        from_callers_[r].push_back(v);
      }
    }
    for (std::size_t v = 0; v < named_.size(); ++v) {
      if (owners_[v] == ranks_.rank()) {
        overlap_.named[static_cast<std::size_t>(number_of_local_[v])] |= named_[v];
      }
    }
    release(listed_);
    release(named_);
  }

  void list_elements() {
    listed_elements_.resize(around_.places.size());
    overlap_.regions.resize(has_regions_ ? around_.places.size() : 0);
    workers_.for_blocks(std::ssize(around_.places), overlap_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const std::int32_t place = around_.places[i];
        if (place >= 0) {
          std::ranges::transform(elements_[static_cast<std::size_t>(place)], listed_elements_[i].begin(),
                                 [this](std::int32_t v) {
                                   return v == no_corner ? no_corner : number_of_local_[static_cast<std::size_t>(v)];
                                 });
        } else {
          std::ranges::transform(around_.received[received_number(place)].vertices, listed_elements_[i].begin(),
                                 [this](std::int64_t id) { return id == no_corner ? no_corner : number_of(id); });
        }
        if (has_regions_) {
          overlap_.regions[i] = place >= 0 ? constraints_.regions[static_cast<std::size_t>(place)]
                                           : around_.received[received_number(place)].region;
        }
      }
    });
  }

  /// Who lists which own vertices.
  void list_callers() {
    for (std::size_t v = 0; v < number_of_local_.size(); ++v) {
      number_of_local_[v] = owners_[v] == ranks_.rank() ? number_of_local_[v] : Callers::not_own;
    }
    overlap_.callers = Callers(std::move(number_of_local_), std::move(to_owners_), std::move(from_callers_));
  }

  std::int32_t number_of(std::int64_t id) const {
    return static_cast<std::int32_t>(std::ranges::lower_bound(overlap_.ids, id) - overlap_.ids.begin());
  }

  /// An element that two ranks have was not called a copy by either. (Where elements have ids, one that is there twice
  /// is meant to be.)
  void check_repeated() const {
    if (has_triangle_ids_ || around_.received.empty()) {
      return;
    }
    std::vector<std::uint8_t> is_at_received(overlap_.ids.size(), 0);
    for (std::size_t i = 0; i < around_.places.size(); ++i) {
      if (around_.places[i] < 0) {
        for (const std::int32_t v : corners_of(listed_elements_[i])) {
          is_at_received[static_cast<std::size_t>(v)] = 1;
        }
      }
    }
    std::vector<std::pair<Corners, std::int32_t>> sorted;  // and the rank that has it
    for (std::size_t i = 0; i < around_.places.size(); ++i) {
      Corners corners = listed_elements_[i];
      if (std::ranges::all_of(corners_of(corners),
                              [&](std::int32_t v) { return is_at_received[static_cast<std::size_t>(v)] != 0; })) {
        std::ranges::sort(corners);
        sorted.emplace_back(corners, around_.places[i] >= 0
                                         ? ranks_.rank()
                                         : around_.received[received_number(around_.places[i])].source);
      }
    }
    std::ranges::sort(sorted);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first == sorted[i - 1].first && sorted[i].second != sorted[i - 1].second) {
        throw std::invalid_argument(name_of(sorted[i].first) + " is on rank " + std::to_string(sorted[i - 1].second) +
                                    " and on rank " + std::to_string(sorted[i].second) +
                                    "; copies are to be in ghost_triangles");
      }
    }
  }

  /// "the triangle of vertex ids 1, 2 and 3", of corners in ascending order.
  std::string name_of(Corners corners) const {
    if (corners.front() == no_corner) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    const std::span<const std::int32_t> all = corners_of(corners);
    const auto id = [&](std::int32_t v) { return std::to_string(overlap_.ids[static_cast<std::size_t>(v)]); };
    return (all.size() == 3 ? "the triangle of vertex ids " : "the quadrilateral of vertex ids ") +
           list_text(all.first(all.size() - 1), id) + " and " + id(all.back());
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
  std::span<const Corners> elements_;
  const Constraints& constraints_;
  bool is_gathered_;
  const Communicator& ranks_;
  Workers& workers_;
  std::shared_ptr<Messenger> messenger_;
  bool has_triangle_ids_ = false;
  bool has_regions_ = false;
  std::vector<std::int32_t> owners_;          ///< of local vertices
  std::vector<std::uint8_t> named_;           ///< of local vertices, as Overlap::named
  BulkVector<std::int32_t> number_of_local_;  ///< in the overlap; of local vertices that are there
  ByRank<std::int32_t> to_owners_;            ///< as Callers has them
  ByRank<std::int32_t> from_callers_;         ///< likewise
  ByRank<SentVertex> listed_;                 ///< own vertices that other ranks have
  ElementsAround<Corners> around_;
  std::vector<Corners> listed_elements_;  ///< as Overlap::listed
  Overlap overlap_;
};

}  // namespace

bool has_quadrilaterals(const ElementList& elements, const Communicator& ranks) {
  const auto is_quadrilateral = [](const auto& corners) { return corner_count(corners) == 4; };
  return ranks.any(elements.visit([&](const auto& listed) { return std::ranges::any_of(listed, is_quadrilateral); }));
}

std::string_view why_one_sided(const Overlap& overlap) {
  return overlap.elements().are_triangles()
             ? "a one-sided surface"
             : "a one-sided surface, or a quadrilateral whose corners are not listed in turn";
}

Overlap build_overlap(const LocalMesh& mesh, const ElementList& elements, const Constraints& constraints,
                      bool is_gathered, std::shared_ptr<const Communicator> communicator, Workers& workers) {
  const Communicator& ranks = *communicator;
  ranks.on_all([&] { check_local_mesh(mesh, elements, constraints, ranks.size()); });
  OwnElements converted;
  const auto built = [&]<class Corners>(std::span<const Corners> listed) {
    ranks.on_all([&] { listed = listed_as<Corners>(elements, converted); });
    return OverlapBuilder(mesh, listed, constraints, is_gathered, std::move(communicator), workers).run();
  };
  return has_quadrilaterals(elements, ranks) ? built(std::span<const MixedElement>())
                                             : built(std::span<const Triangle>());
}

Overlap build_overlap(const LocalMesh& mesh, const Constraints& constraints, bool is_gathered,
                      const std::shared_ptr<const Communicator>& communicator, int threads) {
  OwnElements converted;
  ElementList elements;
  std::optional<Workers> workers;
  communicator->on_all([&] {
    workers.emplace(threads);
    elements = mesh.triangles.list(std::ssize(mesh.vertex_ids), converted);
  });
  return build_overlap(mesh, elements, constraints, is_gathered, communicator, *workers);
}

}  // namespace trismooth::mpi
