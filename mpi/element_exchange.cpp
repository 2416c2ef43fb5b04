// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/element_exchange.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "trismooth/mpi/directory.h"
#include "trismooth/quality/element.h"

namespace trismooth::mpi {

namespace {

/// An element on its way to those who own its vertices.
template <class Corners>
struct SentElement {
  std::int64_t id;
  CornerIds<Corners> vertices;
  Corners owners;  ///< of the corners, in their order
  std::int32_t region;
};

template <class Corners>
class ElementExchange {
 public:
  ElementExchange(const LocalMesh& mesh, std::span<const Corners> elements, bool has_ids,
                  std::span<const std::int32_t> regions, std::span<const std::int32_t> owners,
                  const Communicator& ranks)
      : mesh_(mesh), elements_(elements), has_ids_(has_ids), regions_(regions), owners_(owners), ranks_(ranks) {}

  ElementsAround<Corners> run() {
    send();
    sort();
    return std::move(found_);
  }

 private:
  bool is_copy(std::size_t t) const { return !mesh_.ghost_triangles.empty() && mesh_.ghost_triangles[t] != 0; }

  /// What answers the ids of the caller's elements that are no copies: of ascending ones.
  auto own_ids() const {
    return [this, next = std::int32_t{0}, id = first_id_](std::int32_t t) mutable {
      if (has_ids_) {
        return mesh_.triangle_ids[static_cast<std::size_t>(t)];
      }
      for (; next < t; ++next) {
        id += is_copy(static_cast<std::size_t>(next)) ? 0 : 1;
      }
      return id;
    };
  }

  /// Keeps the elements at own vertices, and sends those at the others' to them.
  void send() {
    std::int64_t count = 0;
    for (std::size_t t = 0; t < elements_.size(); ++t) {
      count += is_copy(t) ? 0 : 1;
    }
    first_id_ = ranks_.sum_before(count);
    if (has_ids_) {
      std::vector<std::int64_t> ids;
      for (std::size_t t = 0; t < elements_.size(); ++t) {
        if (!is_copy(t)) {
          ids.push_back(mesh_.triangle_ids[t]);
        }
      }
      require_unique(ids, "triangle_ids", ranks_);
    }
    kept_.reserve(static_cast<std::size_t>(count));
    std::vector<std::int64_t> counts(static_cast<std::size_t>(ranks_.size()), 0);  // of those that go to each rank
    std::vector<std::int32_t> leaving;
    for (std::size_t t = 0; t < elements_.size(); ++t) {
      if (is_copy(t)) {
        continue;
      }
      bool leaves = false;
      const CornerOwners owners = owners_of_corners(t);
      for (const std::int32_t owner : owners.ranks()) {
        if (owner == ranks_.rank()) {
          kept_.push_back(static_cast<std::int32_t>(t));
        } else {
          ++counts[static_cast<std::size_t>(owner)];
          leaves = true;
        }
      }
      if (leaves) {
        leaving.push_back(static_cast<std::int32_t>(t));
      }
    }
    exchange(leaving, ranks_.exchanged_counts(counts));
  }

  /// Sends the elements `leaving` in portions, so that what is on its way takes little memory where nearly all belong
  /// to other ranks.
  void exchange(std::span<const std::int32_t> leaving, const std::vector<std::int64_t>& from_counts) {
    constexpr std::size_t least_portion = 8192;
    constexpr std::size_t most_portions = 8;
    const std::size_t portion = std::max(least_portion, (leaving.size() + most_portions - 1) / most_portions);
    PartSums most;
    const std::size_t own_portions = (leaving.size() + portion - 1) / portion;
    most.largest[0] = static_cast<double>(own_portions);
    const auto portions = static_cast<std::size_t>(ranks_.joined(most).largest[0]);
    found_.received.reserve(
        static_cast<std::size_t>(std::accumulate(from_counts.begin(), from_counts.end(), std::int64_t{0})));
    auto id_of = own_ids();
    for (std::size_t i = 0; i < portions; ++i) {
      auto sent = lists_by_rank<SentElement<Corners>>(ranks_);
      const std::size_t first = std::min(i * portion, leaving.size());
      for (const std::int32_t t : leaving.subspan(first, std::min(portion, leaving.size() - first))) {
        const CornerOwners owners = owners_of_corners(static_cast<std::size_t>(t));
        const SentElement<Corners> element = sent_element(t, id_of(t), owners.of_corners);
        for (const std::int32_t owner : owners.ranks()) {
          if (owner != ranks_.rank()) {
            sent[static_cast<std::size_t>(owner)].push_back(element);
          }
        }
      }
      const std::vector<std::int64_t> counts = portions == 1 ? from_counts : ranks_.exchanged_counts(lengths_of(sent));
      receive(ranks_.exchanged(std::move(sent), counts));
    }
  }

  /// Keeps what came, and its corners that others own.
  void receive(const ByRank<SentElement<Corners>>& from) {
    for (std::size_t r = 0; r < from.size(); ++r) {
      for (const auto& [id, vertices, owners, region] : from[r]) {
        found_.received.push_back({id, vertices, region, static_cast<std::int32_t>(r)});
        for (std::size_t i = 0; i < vertices.size(); ++i) {
          if (owners[i] != ranks_.rank() && vertices[i] != no_corner) {
            found_.foreign.push_back({vertices[i], owners[i]});
          }
        }
      }
    }
    // Neighbours have them in common.
    sort_uniquely(found_.foreign);
  }

  /// Those of an element's corners, and each of them once.
  struct CornerOwners {
    Corners of_corners;
    Corners different;
    std::size_t count = 0;

    std::span<const std::int32_t> ranks() const { return std::span(different).first(count); }
  };
  CornerOwners owners_of_corners(std::size_t t) const {
    CornerOwners owners{};
    owners.of_corners.fill(no_corner);
    const std::span<const std::int32_t> corners = corners_of(elements_[t]);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t owner = owners_[static_cast<std::size_t>(corners[i])];
      owners.of_corners[i] = owner;
      if (std::ranges::find(owners.ranks(), owner) == owners.ranks().end()) {
        owners.different[owners.count++] = owner;
      }
    }
    return owners;
  }

  SentElement<Corners> sent_element(std::int32_t t, std::int64_t id, const Corners& owners) const {
    const auto place = static_cast<std::size_t>(t);
    SentElement<Corners> element{id, {}, owners, regions_.empty() ? 0 : regions_[place]};
    std::ranges::transform(elements_[place], element.vertices.begin(), [&](std::int32_t v) {
      return v == no_corner ? no_corner : mesh_.vertex_ids[static_cast<std::size_t>(v)];
    });
    return element;
  }

  /// Those that were kept and those that came, in the order of their ids.
  void sort() {
    std::vector<std::int32_t> came(found_.received.size());
    for (std::size_t i = 0; i < came.size(); ++i) {
      came[i] = received_place(i);
    }
    const auto id_of_received = [&](std::int32_t place) { return found_.received[received_number(place)].id; };
    std::ranges::sort(came, {}, id_of_received);
    if (has_ids_) {
      const auto id_of_kept = [&](std::int32_t t) { return mesh_.triangle_ids[static_cast<std::size_t>(t)]; };
      if (!std::ranges::is_sorted(kept_, {}, id_of_kept)) {
        std::ranges::sort(kept_, {}, id_of_kept);
      }
    }
    found_.places.reserve(kept_.size() + came.size());
    auto id_of = own_ids();
    auto next = came.begin();
    const auto take_received = [&](std::int64_t before) {
      for (; next != came.end() && id_of_received(*next) < before; ++next) {
        found_.places.push_back(*next);
        found_.ids.push_back(id_of_received(*next));
      }
    };
    for (const std::int32_t t : kept_) {
      const std::int64_t id = id_of(t);
      take_received(id);
      found_.places.push_back(t);
      found_.ids.push_back(id);
    }
    take_received(std::numeric_limits<std::int64_t>::max());
  }

  const LocalMesh& mesh_;
  std::span<const Corners> elements_;
  bool has_ids_;
  std::span<const std::int32_t> regions_;
  std::span<const std::int32_t> owners_;
  const Communicator& ranks_;
  std::int64_t first_id_ = 0;      ///< of the caller's elements, where they have none
  BulkVector<std::int32_t> kept_;  ///< the caller's elements at own vertices
  ElementsAround<Corners> found_;
};

}  // namespace

void sort_uniquely(BulkVector<OwnedId>& vertices) {
  if (!std::ranges::is_sorted(vertices)) {
    std::ranges::sort(vertices);
  }
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

template <class Corners>
ElementsAround<Corners> exchange_elements(const LocalMesh& mesh, std::span<const Corners> elements, bool has_ids,
                                          std::span<const std::int32_t> regions, std::span<const std::int32_t> owners,
                                          const Communicator& ranks) {
  return ElementExchange<Corners>(mesh, elements, has_ids, regions, owners, ranks).run();
}

template ElementsAround<Triangle> exchange_elements(const LocalMesh&, std::span<const Triangle>, bool,
                                                    std::span<const std::int32_t>, std::span<const std::int32_t>,
                                                    const Communicator&);
template ElementsAround<MixedElement> exchange_elements(const LocalMesh&, std::span<const MixedElement>, bool,
                                                        std::span<const std::int32_t>, std::span<const std::int32_t>,
                                                        const Communicator&);

}  // namespace trismooth::mpi
