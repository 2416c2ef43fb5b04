// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/packed_picture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <new>
#include <utility>

#include <zlib.h>

#include "trismooth/base/box.h"
#include "trismooth/base/counting_sort.h"
#include "trismooth/base/hilbert_curve.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/picture/base64.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

using PackedNumbers = BulkVector<std::uint32_t>;

constexpr std::int64_t packing_grain = 16384;
constexpr int curve_order = 15;
constexpr int fewest_bits = 12;
constexpr int most_bits = 28;

/// Negative numbers among the others, small ones first.
std::uint32_t zigzag(std::int64_t number) {
  return static_cast<std::uint32_t>(number < 0 ? -2 * number - 1 : 2 * number);
}

/// The nearest whole number of one that is not negative. (The library's function is a call.)
double whole(double number) {
  const double half_up = number + 0.5;
  return static_cast<double>(static_cast<std::int64_t>(half_up));
}

class Packer {
 public:
  Packer(const MeshPicture& picture, std::span<const std::int32_t> shown, const MeshLines& lines, Workers& workers)
      : picture_(picture), lines_(lines), elements_(picture.elements.list()), shown_(shown), workers_(workers) {}

  PackedPicture pack() {
    order_vertices();
    order_elements();
    choose_grid();
    add_places();
    add_elements();
    add_meaning();
    add_exact();
    return finished();
  }

 private:
  struct Pending {
    std::string name;
    PackedNumbers numbers;
    std::size_t count = 0;
    int planes = 0;
    std::string deflated;
  };

  /// Of the vertices in their new order.
  struct Places {
    BulkVector<Point2<double>> exact;  ///< in the frame, as quality is evaluated, but for the scale
    BulkVector<Point2<double>> whole;  ///< rounded, from the base on
  };

  bool has_moved() const { return !picture_.after.empty(); }

  /// The corners of a shown element, counter-clockwise now.
  MixedElement corners(std::int32_t element) const {
    const std::span<const std::int32_t> listed = elements_[static_cast<std::size_t>(element)];
    MixedElement turned{0, 0, 0, no_corner};
    std::ranges::copy(listed, turned.begin());
    const auto& reversed = picture_.reversed_now();
    if (!reversed.empty() && reversed[element] != 0) {
      std::reverse(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(listed.size()));
    }
    return turned;
  }

  /// Those that shown elements use, along a Hilbert curve.
  void order_vertices() {
    const std::size_t count = picture_.before.size();
    new_of_.assign(count, -1);
    for (const std::int32_t element : shown_) {
      for (const std::int32_t v : elements_[static_cast<std::size_t>(element)]) {
        new_of_[v] = 0;
      }
    }
    BulkVector<KeyedNumber> keyed;
    keyed.reserve(count);
    Box box;
    for (std::size_t v = 0; v < count; ++v) {
      if (new_of_[v] == 0) {
        keyed.push_back({0, static_cast<std::int32_t>(v)});
        box.add(picture_.before[v]);
        if (has_moved()) {
          box.add(picture_.after[v]);
        }
      }
    }
    if (keyed.empty()) {
      return;
    }
    frame_ = local_frame(box.low, box.high);
    low_ = frame_.enter(box.low);
    // (The extent is 1 at most there.)
    constexpr double last_cell = (1 << curve_order) - 1;
    workers_.for_blocks(std::ssize(keyed), packing_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        const Point2<double> from_low = frame_.enter(picture_.now()[keyed[i].number]) - low_;
        keyed[i].key =
            static_cast<std::uint32_t>(hilbert_index(static_cast<std::uint32_t>(from_low.x * last_cell),
                                                     static_cast<std::uint32_t>(from_low.y * last_cell), curve_order));
      }
    });
    radix_sort(keyed, 2 * curve_order, workers_);
    vertices_.resize(keyed.size());
    for (std::size_t place = 0; place < keyed.size(); ++place) {
      vertices_[place] = keyed[place].number;
      new_of_[keyed[place].number] = static_cast<std::int32_t>(place);
    }
  }

  /// Triangles first, each kind by its first corner in the new order.
  void order_elements() {
    int bits = 1;
    while ((std::size_t{1} << static_cast<unsigned>(bits)) < vertices_.size()) {
      ++bits;
    }
    BulkVector<KeyedNumber> keyed(shown_.size());
    workers_.for_blocks(std::ssize(keyed), packing_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        const std::span<const std::int32_t> listed = elements_[static_cast<std::size_t>(shown_[i])];
        std::int32_t first = new_of_[listed[0]];
        for (const std::int32_t v : listed) {
          first = std::min(first, new_of_[v]);
        }
        const std::uint32_t kind = listed.size() == 4 ? 1U << static_cast<unsigned>(bits) : 0;
        keyed[i] = {kind | static_cast<std::uint32_t>(first), shown_[i]};
      }
    });
    radix_sort(keyed, bits + 1, workers_);
    order_.resize(keyed.size());
    std::ranges::transform(keyed, order_.begin(), &KeyedNumber::number);
    quadrilaterals_ = std::ranges::count_if(
        order_, [this](std::int32_t e) { return elements_[static_cast<std::size_t>(e)].size() == 4; });
  }

  /// So fine that an element among the smallest is 256 steps wide.
  void choose_grid() {
    constexpr std::size_t most_asked = 65536;
    constexpr double steps_of_a_side = 256;
    const std::size_t stride = order_.size() / most_asked + 1;
    std::vector<double> shortest;
    for (std::size_t i = 0; i < order_.size(); i += stride) {
      const MixedElement element = corners(order_[i]);
      const std::span<const std::int32_t> listed = corners_of(element);
      double least = 16;
      for (std::size_t j = 0; j < listed.size(); ++j) {
        const Point2<double> side =
            frame_.enter(picture_.now()[next_corner(listed, j)]) - frame_.enter(picture_.now()[listed[j]]);
        least = std::min(least, squared_length(side));
      }
      shortest.push_back(std::sqrt(least));
    }
    bits_ = fewest_bits;
    if (!shortest.empty()) {
      const auto low = shortest.begin() + std::ssize(shortest) / 100;
      std::ranges::nth_element(shortest, low);
      const double wanted = *low > 0 ? std::log2(steps_of_a_side / *low) : most_bits;
      bits_ = static_cast<int>(std::clamp<double>(std::ceil(wanted), fewest_bits, most_bits));
    }
    const double steps = std::ldexp(1.0, bits_);
    base_ = {std::floor(low_.x * steps), std::floor(low_.y * steps)};
  }

  void add(std::string name, PackedNumbers numbers) {
    if (!numbers.empty()) {
      const std::size_t count = numbers.size();
      pending_.push_back({std::move(name), std::move(numbers), count, 0, {}});
    }
  }

  /// number(i) for each i of [0, count).
  template <class Number>
  void add(std::string name, std::size_t count, const Number& number) {
    PackedNumbers numbers(count);
    workers_.for_blocks(static_cast<std::int64_t>(count), packing_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        numbers[i] = number(static_cast<std::size_t>(i));
      }
    });
    add(std::move(name), std::move(numbers));
  }

  /// Where vertices are: each as seen from the one before; and where they are now as seen from where they were.
  void add_places() {
    const std::size_t count = vertices_.size();
    const double steps = std::ldexp(1.0, bits_);
    const auto keep = [&](Places& places, const BulkVector<Point2<double>>& points) {
      places.exact.resize(count);
      places.whole.resize(count);
      workers_.for_blocks(static_cast<std::int64_t>(count), packing_grain, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Point2<double> local = frame_.enter(points[vertices_[i]]);
          const Point2<double> exact{local.x * steps, local.y * steps};
          places.exact[i] = exact;
          places.whole[i] = {whole(exact.x - base_.x), whole(exact.y - base_.y)};
        }
      });
    };
    keep(before_, picture_.before);
    if (has_moved()) {
      keep(now_, picture_.after);
    }
    for (double Point2<double>::*axis : {&Point2<double>::x, &Point2<double>::y}) {
      const bool is_x = axis == &Point2<double>::x;
      add(is_x ? "x" : "y", count, [&](std::size_t i) {
        return zigzag(static_cast<std::int64_t>(before_.whole[i].*axis - (i > 0 ? before_.whole[i - 1].*axis : 0)));
      });
      if (has_moved()) {
        add(is_x ? "dx" : "dy", count, [&](std::size_t i) {
          return zigzag(static_cast<std::int64_t>(now_.whole[i].*axis - before_.whole[i].*axis));
        });
      }
    }
  }

  /// The corners of an element in the new order, from the first one on.
  MixedElement packed_corners(std::size_t place) const {
    const MixedElement element = corners(order_[place]);
    MixedElement packed{0, 0, 0, no_corner};
    const std::span<const std::int32_t> listed = corners_of(element);
    std::ranges::transform(listed, packed.begin(), [this](std::int32_t v) { return new_of_[v]; });
    const auto end = packed.begin() + static_cast<std::ptrdiff_t>(listed.size());
    std::rotate(packed.begin(), std::min_element(packed.begin(), end), end);
    return packed;
  }

  void add_elements() {
    const std::size_t count = order_.size();
    const std::size_t triangles = count - static_cast<std::size_t>(quadrilaterals_);
    packed_.resize(count);
    workers_.for_blocks(static_cast<std::int64_t>(count), packing_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        packed_[i] = packed_corners(static_cast<std::size_t>(i));
      }
    });
    add("a", count, [&](std::size_t i) { return zigzag(packed_[i][0] - (i > 0 ? packed_[i - 1][0] : 0)); });
    const auto behind_first = [&](std::size_t i, std::size_t corner) {
      return static_cast<std::uint32_t>(packed_[i][corner] - packed_[i][0]);
    };
    add("b", count, [&](std::size_t i) { return behind_first(i, 1); });
    add("c", count, [&](std::size_t i) { return behind_first(i, 2); });
    add("d", count - triangles, [&](std::size_t i) { return behind_first(triangles + i, 3); });
    add("number", count, [&](std::size_t i) { return zigzag(number(i) - (i > 0 ? number(i - 1) : 0)); });
  }

  std::int64_t number(std::size_t place) const {
    const std::int32_t element = order_[place];
    return picture_.numbers.empty() ? element : picture_.numbers[element];
  }

  /// Regions, what holds vertices, lines.
  void add_meaning() {
    if (!picture_.regions.empty()) {
      add("region", order_.size(),
          [&](std::size_t i) { return static_cast<std::uint32_t>(picture_.regions[order_[i]]); });
    }
    if (!picture_.held.empty()) {
      add("held", vertices_.size(), [&](std::size_t i) { return picture_.held[vertices_[i]]; });
    }
    const auto add_lines = [this](const char* name, const auto& edges) {
      PackedNumbers ends;
      for (const auto& edge : edges) {
        if (new_of_[edge[0]] >= 0 && new_of_[edge[1]] >= 0) {
          ends.push_back(static_cast<std::uint32_t>(new_of_[edge[0]]));
          ends.push_back(static_cast<std::uint32_t>(new_of_[edge[1]]));
        }
      }
      add(name, std::move(ends));
    };
    add_lines("boundary", lines_.boundary);
    add_lines("interface", lines_.interfaces);
    if (has_moved() && !picture_.reversed_before.empty()) {
      PackedNumbers turned;
      for (std::size_t i = 0; i < order_.size(); ++i) {
        if (picture_.reversed_before[order_[i]] != picture_.reversed_after[order_[i]]) {
          turned.push_back(static_cast<std::uint32_t>(i));
        }
      }
      add("turned", std::move(turned));
    }
  }

  /// One flag an element: it is among the worst of either state.
  std::vector<std::uint8_t> worst() const {
    std::vector<std::uint8_t> flags(elements_.size(), 0);
    for (const auto* const numbers : {&picture_.worst_before, &picture_.worst_after}) {
      for (const std::int64_t number : *numbers) {
        flags[picture_.place_of(number)] = 1;
      }
    }
    return flags;
  }

  /// The worst elements, and those that are seen otherwise in whole steps: their places in the new order, ascending,
  /// and the exact steps of their corners before and now (not from the base on, which would round them), as the two
  /// halves of doubles.
  void add_exact() {
    // Of shape: what is seen as a colour, and of flat elements as a number.
    constexpr double seen = 0.005;
    constexpr double part_seen = 0.05;
    const auto differs = [&](std::span<const std::int32_t> listed, const Places& places) {
      const auto shape_of = [listed](const BulkVector<Point2<double>>& p) {
        return listed.size() == 3 ? shape(p[listed[0]], p[listed[1]], p[listed[2]])
                                  : shape(p[listed[0]], p[listed[1]], p[listed[2]], p[listed[3]]);
      };
      const double is = shape_of(places.exact);
      const double shown = shape_of(places.whole);
      return !(std::abs(is - shown) <= std::min(seen, part_seen * std::abs(is))) || (is > 0) != (shown > 0) ||
             (is < 0) != (shown < 0);
    };
    const std::vector<std::uint8_t> is_worst = worst();
    std::vector<std::uint32_t> places = joined_lists<std::uint32_t>(
        std::ssize(order_), packing_grain, workers_, [&](std::int64_t i, std::vector<std::uint32_t>& found) {
          const std::span<const std::int32_t> listed = corners_of(packed_[i]);
          if (is_worst[order_[i]] != 0 || differs(listed, before_) || (has_moved() && differs(listed, now_))) {
            found.push_back(static_cast<std::uint32_t>(i));
          }
        });
    std::ranges::sort(places);
    PackedNumbers halves;
    for (const std::uint32_t place : places) {
      for (const Places* const state : {&before_, &now_}) {
        if (state == &now_ && !has_moved()) {
          continue;
        }
        for (const std::int32_t v : corners_of(packed_[place])) {
          for (const double number : {state->exact[v].x, state->exact[v].y}) {
            const auto bits = std::bit_cast<std::uint64_t>(number);
            halves.push_back(static_cast<std::uint32_t>(bits));
            halves.push_back(static_cast<std::uint32_t>(bits >> 32U));
          }
        }
      }
    }
    add("exact", PackedNumbers(places.begin(), places.end()));
    add("exactplaces", std::move(halves));
  }

  static void deflate_stream(Pending& stream) {
    std::uint32_t all = 0;
    for (const std::uint32_t number : stream.numbers) {
      all |= number;
    }
    stream.planes = all < 1U << 8U ? 1 : all < 1U << 16U ? 2 : all < 1U << 24U ? 3 : 4;
    const std::size_t count = stream.numbers.size();
    std::string planes(count * static_cast<std::size_t>(stream.planes), '\0');
    for (int plane = 0; plane < stream.planes; ++plane) {
      char* const to = planes.data() + count * static_cast<std::size_t>(plane);
      const auto shift = static_cast<unsigned>(8 * plane);
      for (std::size_t i = 0; i < count; ++i) {
        to[i] = static_cast<char>(stream.numbers[i] >> shift & 255U);
      }
    }
    z_stream z{};
    // Nothing repeats in such numbers but runs: their frequencies are what there is to win, and they cost little.
    constexpr int largest_window = 15;
    constexpr int most_memory = 9;
    if (deflateInit2(&z, 1, Z_DEFLATED, largest_window, most_memory, Z_RLE) != Z_OK) {
      throw std::bad_alloc();
    }
    constexpr std::size_t most_at_once = std::size_t{1} << 30U;
    stream.deflated.resize(deflateBound(&z, planes.size()));
    std::size_t given = 0;
    std::size_t made = 0;
    int state = Z_OK;
    while (state == Z_OK) {
      const std::size_t part = std::min(most_at_once, planes.size() - given);
      const std::size_t room = std::min(most_at_once, stream.deflated.size() - made);
      z.next_in = reinterpret_cast<Bytef*>(planes.data() + given);
      z.avail_in = static_cast<uInt>(part);
      z.next_out = reinterpret_cast<Bytef*>(stream.deflated.data() + made);
      z.avail_out = static_cast<uInt>(room);
      state = deflate(&z, given + part == planes.size() ? Z_FINISH : Z_NO_FLUSH);
      given += part - z.avail_in;
      made += room - z.avail_out;
    }
    deflateEnd(&z);
    stream.deflated.resize(made);
    stream.numbers = {};
  }

  PackedPicture finished() {
    workers_.for_blocks(std::ssize(pending_), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        deflate_stream(pending_[i]);
      }
    });
    PackedPicture packed;
    packed.vertices = std::ssize(vertices_);
    packed.quadrilaterals = quadrilaterals_;
    packed.triangles = std::ssize(order_) - quadrilaterals_;
    packed.base = base_;
    packed.origin = frame_.leave({std::ldexp(base_.x, -bits_), std::ldexp(base_.y, -bits_)});
    packed.step = std::ldexp(1.0, frame_.exponent - bits_);
    std::string bytes;
    for (Pending& stream : pending_) {
      packed.streams.push_back({std::move(stream.name), stream.count, stream.planes, stream.deflated.size()});
      bytes += stream.deflated;
      stream.deflated = {};
    }
    packed.data = base64(bytes);
    return packed;
  }

  const MeshPicture& picture_;
  const MeshLines& lines_;
  const ElementList elements_;
  const std::span<const std::int32_t> shown_;
  Workers& workers_;
  BulkVector<std::int32_t> vertices_;  ///< in the new order
  BulkVector<std::int32_t> new_of_;    ///< per vertex its place there, or -1
  BulkVector<std::int32_t> order_;     ///< of elements
  std::int64_t quadrilaterals_ = 0;
  LocalFrame frame_;
  Point2<double> low_{0, 0};   ///< of all vertices shown, in the frame
  int bits_ = 0;               ///< a step is 2^-bits in the frame
  Point2<double> base_{0, 0};  ///< where whole steps count from, in steps
  Places before_;
  Places now_;                       ///< none where nothing was smoothed
  BulkVector<MixedElement> packed_;  ///< the elements in their new order, corners in theirs
  std::vector<Pending> pending_;
};

}  // namespace

PackedPicture pack_picture(const MeshPicture& picture, std::span<const std::int32_t> shown, const MeshLines& lines,
                           Workers& workers) {
  return Packer(picture, shown, lines, workers).pack();
}

}  // namespace trismooth
