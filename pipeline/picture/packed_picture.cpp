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

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/picture/base64.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

using PackedNumbers = BulkVector<std::uint32_t>;

constexpr std::int64_t packing_grain = 16384;
constexpr int fewest_bits = 12;
constexpr int most_bits = 28;

/// Negative numbers among the others, small ones first.
std::uint32_t zigzag(std::int64_t number) {
  return static_cast<std::uint32_t>(number < 0 ? -2 * number - 1 : 2 * number);
}

/// The nearest whole number of one that is not negative. (The library's function is a call.)
std::int32_t nearest(double number) {
  const double half_up = number + 0.5;
  return static_cast<std::int32_t>(half_up);
}

/// Deflates planes of bytes one behind the other. Nothing repeats in them but runs, where they are nearly empty; else
/// how often each byte is there is what there is to win. Where that is too little for the time it takes they are
/// stored: less than an eighth, and of many bytes less than half.
class PlaneDeflater {
 public:
  /// Of so many bytes in all.
  explicit PlaneDeflater(std::size_t bytes) {
    constexpr int largest_window = 15;
    constexpr int most_memory = 9;
    if (deflateInit2(&z_, level, Z_DEFLATED, largest_window, most_memory, Z_RLE) != Z_OK) {
      throw std::bad_alloc();
    }
    deflated_.resize(deflateBound(&z_, bytes));
  }
  PlaneDeflater(const PlaneDeflater&) = delete;
  PlaneDeflater& operator=(const PlaneDeflater&) = delete;
  ~PlaneDeflater() { deflateEnd(&z_); }

  /// The next plane. `is_last`: and nothing else.
  void add(std::string_view plane, bool is_last) {
    const double bits = bits_of_a_byte(plane);
    constexpr std::size_t many = std::size_t{1} << 19U;
    const bool is_stored = bits > (plane.size() > many ? 4 : 7);
    run([&] { return deflateParams(&z_, is_stored ? 0 : level, bits > 1 ? Z_HUFFMAN_ONLY : Z_RLE); });
    constexpr std::size_t most_at_once = std::size_t{1} << 30U;
    for (std::size_t given = 0; given < plane.size(); given += most_at_once) {
      const std::string_view part = plane.substr(given, most_at_once);
      z_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
      z_.avail_in = static_cast<uInt>(part.size());
      const bool is_end = is_last && given + part.size() == plane.size();
      run([&] { return deflate(&z_, is_end ? Z_FINISH : Z_NO_FLUSH); });
    }
  }

  std::string take() {
    deflated_.resize(made_);
    return std::move(deflated_);
  }

 private:
  static constexpr int level = 1;

  /// Has step() read all that there is to be read.
  template <class Step>
  void run(const Step& step) {
    constexpr std::size_t least_room = 4096;
    do {
      if (deflated_.size() - made_ < least_room) {
        deflated_.resize(deflated_.size() + deflated_.size() / 8 + least_room);
      }
      const std::size_t room = std::min(deflated_.size() - made_, std::size_t{1} << 30U);
      z_.next_out = reinterpret_cast<Bytef*>(deflated_.data() + made_);
      z_.avail_out = static_cast<uInt>(room);
      step();
      made_ += room - z_.avail_out;
    } while (z_.avail_out == 0);
  }

  /// What coding each by how often it is there would leave of eight; of many, by some of them.
  static double bits_of_a_byte(std::string_view bytes) {
    constexpr std::size_t enough = 65536;
    const std::size_t stride = bytes.size() / enough + 1;
    std::array<std::size_t, 256> counts{};
    std::size_t all = 0;
    for (std::size_t i = 0; i < bytes.size(); i += stride) {
      ++counts[static_cast<unsigned char>(bytes[i])];
      ++all;
    }
    double bits = 0;
    for (const std::size_t count : counts) {
      if (count > 0) {
        const double part = static_cast<double>(count) / static_cast<double>(all);
        bits -= part * std::log2(part);
      }
    }
    return bits;
  }

  z_stream z_{};
  std::string deflated_;
  std::size_t made_ = 0;
};

class Packer {
 public:
  Packer(const OrderedPicture& ordered, const MeshLines& lines, Workers& workers)
      : mesh_(ordered.mesh),
        elements_(ordered.mesh.elements.list()),
        triangles_(elements_.size() - static_cast<std::size_t>(elements_.count_quadrilaterals())),
        lines_(lines),
        workers_(workers),
        frame_(ordered.frame),
        low_(ordered.low) {}

  PackedPicture pack() {
    choose_grid();
    add_places();
    add_elements();
    add_meaning();
    add_exact();
    return finished();
  }

 private:
  struct Pending {
    PackedNumbers numbers;
    PackedStream packed;
  };

  using WholePlaces = BulkVector<std::array<std::int32_t, 2>>;

  bool has_moved() const { return !mesh_.after.empty(); }

  /// So fine that an element among the smallest is 256 steps wide.
  void choose_grid() {
    constexpr std::size_t most_asked = 16384;
    constexpr double steps_of_a_side = 256;
    const std::size_t stride = elements_.size() / most_asked + 1;
    std::vector<double> shortest;
    for (std::size_t i = 0; i < elements_.size(); i += stride) {
      const std::span<const std::int32_t> listed = elements_[i];
      double least = 16;
      for (std::size_t j = 0; j < listed.size(); ++j) {
        const Point2<double> side = mesh_.now()[next_corner(listed, j)] - mesh_.now()[listed[j]];
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
    steps_ = std::ldexp(1.0, bits_);
    base_ = {std::floor(low_.x * steps_), std::floor(low_.y * steps_)};
  }

  void add(std::string name, PackedNumbers numbers) {
    if (!numbers.empty()) {
      const std::size_t count = numbers.size();
      pending_.push_back({std::move(numbers), {std::move(name), count, 0, 0, {}}});
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
    const std::size_t count = mesh_.before.size();
    before_ = whole_places(mesh_.before);
    now_ = whole_places(mesh_.after);
    for (const std::size_t axis : {0U, 1U}) {
      add(axis == 0 ? "x" : "y", count,
          [&](std::size_t i) { return zigzag(before_[i][axis] - (i > 0 ? before_[i - 1][axis] : 0)); });
      if (has_moved()) {
        add(axis == 0 ? "dx" : "dy", count, [&](std::size_t i) { return zigzag(now_[i][axis] - before_[i][axis]); });
      }
    }
  }

  /// In steps, as quality is evaluated, but for the scale.
  Point2<double> exact(Point2<double> place) const { return {place.x * steps_, place.y * steps_}; }

  /// In whole steps from the base on.
  WholePlaces whole_places(const BulkVector<Point2<double>>& points) {
    WholePlaces whole(points.size());
    workers_.for_blocks(std::ssize(points), packing_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        const Point2<double> steps = exact(points[i]);
        whole[i] = {nearest(steps.x - base_.x), nearest(steps.y - base_.y)};
      }
    });
    return whole;
  }

  void add_elements() {
    elements_.visit([this](const auto& elements) {
      const std::size_t count = elements.size();
      add("a", count, [&](std::size_t i) { return zigzag(elements[i][0] - (i > 0 ? elements[i - 1][0] : 0)); });
      const auto behind_first = [&elements](std::size_t i, std::size_t corner) {
        return static_cast<std::uint32_t>(elements[i][corner] - elements[i][0]);
      };
      add("b", count, [&](std::size_t i) { return behind_first(i, 1); });
      add("c", count, [&](std::size_t i) { return behind_first(i, 2); });
      add("d", count - triangles_, [&](std::size_t i) { return behind_first(triangles_ + i, 3); });
    });
    add("number", elements_.size(), [this](std::size_t i) { return zigzag(number(i) - (i > 0 ? number(i - 1) : 0)); });
  }

  std::int64_t number(std::size_t element) const { return mesh_.numbers[element]; }

  /// Regions, what holds vertices, lines.
  void add_meaning() {
    if (!mesh_.regions.empty()) {
      add("region", elements_.size(), [this](std::size_t i) { return static_cast<std::uint32_t>(mesh_.regions[i]); });
    }
    if (!mesh_.held.empty()) {
      add("held", mesh_.held.size(), [this](std::size_t i) { return mesh_.held[i]; });
    }
    const auto add_lines = [this](const char* name, const std::vector<EdgeEnds>& edges) {
      PackedNumbers ends;
      for (const EdgeEnds& edge : edges) {
        ends.insert(ends.end(), edge.begin(), edge.end());
      }
      add(name, std::move(ends));
    };
    add_lines("boundary", lines_.boundary);
    add_lines("interface", lines_.interfaces);
    PackedNumbers turned;
    for (std::size_t i = 0; i < mesh_.reversed_before.size(); ++i) {
      if (mesh_.reversed_before[i] != 0) {
        turned.push_back(static_cast<std::uint32_t>(i));
      }
    }
    add("turned", std::move(turned));
  }

  /// The numbers of the worst elements of either state, ascending.
  std::vector<std::int64_t> worst() const {
    std::vector<std::int64_t> numbers = mesh_.worst_before;
    numbers.insert(numbers.end(), mesh_.worst_after.begin(), mesh_.worst_after.end());
    std::ranges::sort(numbers);
    return numbers;
  }

  /// The worst elements, and those that are seen otherwise in whole steps: their places in the new order, ascending,
  /// and the exact steps of their corners before and now (not from the base on, which would round them), as the two
  /// halves of doubles.
  void add_exact() {
    // Of shape: what is seen as a colour, and of flat elements as a number.
    constexpr double seen = 0.005;
    constexpr double part_seen = 0.05;
    const auto differs = [&](std::span<const std::int32_t> listed, const BulkVector<Point2<double>>& points,
                             const WholePlaces& places) {
      const auto shape_of = [listed](const auto& p) {
        return listed.size() == 3 ? shape(p(0), p(1), p(2)) : shape(p(0), p(1), p(2), p(3));
      };
      const double is = shape_of([&](std::size_t i) { return exact(points[listed[i]]); });
      const double shown = shape_of([&](std::size_t i) {
        const auto& [x, y] = places[listed[i]];
        return Point2<double>{static_cast<double>(x), static_cast<double>(y)};
      });
      return !(std::abs(is - shown) <= std::min(seen, part_seen * std::abs(is))) || (is > 0) != (shown > 0) ||
             (is < 0) != (shown < 0);
    };
    const std::vector<std::int64_t> worst_numbers = worst();
    std::vector<std::uint32_t> places = joined_lists<std::uint32_t>(
        static_cast<std::int64_t>(elements_.size()), packing_grain, workers_,
        [&](std::int64_t i, std::vector<std::uint32_t>& found) {
          const std::span<const std::int32_t> listed = elements_[i];
          if (std::ranges::binary_search(worst_numbers, number(i)) || differs(listed, mesh_.before, before_) ||
              (has_moved() && differs(listed, mesh_.after, now_))) {
            found.push_back(static_cast<std::uint32_t>(i));
          }
        });
    std::ranges::sort(places);
    PackedNumbers halves;
    for (const std::uint32_t place : places) {
      for (const auto* const points : {&mesh_.before, &mesh_.after}) {
        if (points->empty()) {
          continue;
        }
        for (const std::int32_t v : elements_[place]) {
          const Point2<double> steps = exact((*points)[v]);
          for (const double number : {steps.x, steps.y}) {
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

  /// The stream's planes, deflated, as text.
  static void deflate_stream(Pending& pending) {
    std::uint32_t all = 0;
    for (const std::uint32_t number : pending.numbers) {
      all |= number;
    }
    PackedStream& packed = pending.packed;
    packed.planes = all < 1U << 8U ? 1 : all < 1U << 16U ? 2 : all < 1U << 24U ? 3 : 4;
    const std::size_t count = pending.numbers.size();
    PlaneDeflater deflater(count * static_cast<std::size_t>(packed.planes));
    std::string plane(count, '\0');
    for (int k = 0; k < packed.planes; ++k) {
      std::ranges::transform(pending.numbers, plane.begin(), [shift = static_cast<unsigned>(8 * k)](std::uint32_t n) {
        return static_cast<char>(n >> shift & 255U);
      });
      deflater.add(plane, k + 1 == packed.planes);
    }
    std::string deflated = deflater.take();
    packed.bytes = deflated.size();
    deflated.resize((deflated.size() + 2) / 3 * 3);
    packed.text = base64(deflated);
    pending.numbers = {};
  }

  PackedPicture finished() {
    workers_.for_blocks(std::ssize(pending_), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        deflate_stream(pending_[i]);
      }
    });
    PackedPicture packed;
    packed.vertices = std::ssize(mesh_.before);
    packed.triangles = static_cast<std::int64_t>(triangles_);
    packed.quadrilaterals = elements_.count_quadrilaterals();
    packed.base = base_;
    packed.origin = frame_.leave({std::ldexp(base_.x, -bits_), std::ldexp(base_.y, -bits_)});
    packed.step = std::ldexp(1.0, frame_.exponent - bits_);
    for (Pending& pending : pending_) {
      packed.streams.push_back(std::move(pending.packed));
    }
    return packed;
  }

  const MeshPicture& mesh_;
  const ElementList elements_;
  const std::size_t triangles_;
  const MeshLines& lines_;
  Workers& workers_;
  const LocalFrame frame_;
  const Point2<double> low_;   ///< of all vertices, in the frame
  int bits_ = 0;               ///< a step is 2^-bits in the frame
  double steps_ = 1;           ///< 2^bits
  Point2<double> base_{0, 0};  ///< where whole steps count from, in steps
  WholePlaces before_;
  WholePlaces now_;  ///< none where nothing was smoothed
  std::vector<Pending> pending_;
};

}  // namespace

PackedPicture pack_picture(const OrderedPicture& ordered, const MeshLines& lines, Workers& workers) {
  return Packer(ordered, lines, workers).pack();
}

}  // namespace trismooth
