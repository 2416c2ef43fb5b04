// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "trismooth/base/parity_forest.h"
#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/primitives/reduce.cuh"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/component_votes.cuh"
#include "trismooth/cuda/topology/components.h"

namespace trismooth::cuda {

namespace {

/// Shortens the paths, so that the walks of FlattenForest are short.
struct ShortenPaths {
  ParityForest forest;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t t) const { forest.find(t); }
};

/// Hangs every triangle directly under its root, and notes which ones are roots. Without halving paths on the way: a
/// thread that halves one may write to a word what was true some time ago, after the word's own thread has been there.
struct FlattenForest {
  ParityForest forest;
  std::uint32_t* is_root;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t t) const {
    const ParityForest::Root root = forest.look_up(t);
    // Others may be on their way through this word; it says the same of them as before.
    store_relaxed(&forest.words[t], (root.element << 1U) | root.parity);
    is_root[t] = root.element == t ? 1 : 0;
  }
};

/// Replaces the root by its number.
struct NumberRoots {
  std::uint32_t* words;
  const std::uint32_t* numbers;  ///< numbers[root] - 1 is the root's number

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t t) const {
    const std::uint32_t word = words[t];
    words[t] = ((numbers[word >> 1U] - 1) << 1U) | (word & 1U);
  }
};

struct ParityVotes {
  const std::uint32_t* words;

  TRISMOOTH_HOST_DEVICE Vote operator()(std::uint32_t t) const {
    const bool against = (words[t] & 1U) != 0;
    return {words[t] >> 1U, against, !against, false, false};
  }
};

struct Magnitude {
  const std::int32_t* margins;

  TRISMOOTH_HOST_DEVICE std::int64_t operator()(std::uint32_t component) const {
    const std::int32_t margin = margins[component];
    return margin < 0 ? -margin : margin;
  }
};

struct Plus {
  TRISMOOTH_HOST_DEVICE std::int64_t operator()(std::int64_t a, std::int64_t b) const { return a + b; }
};

}  // namespace

Components number_components(Context& context, DeviceBuffer<std::uint32_t> forest_words) {
  Components components;
  components.words = std::move(forest_words);
  const auto triangle_count = static_cast<std::uint32_t>(components.words.size());
  if (triangle_count == 0) {
    return components;
  }
  std::uint32_t* const words = components.words.data();
  {
    DeviceBuffer<std::uint32_t> numbers(context, triangle_count);
    for_each(context, triangle_count, ShortenPaths{{words}});
    for_each(context, triangle_count, FlattenForest{{words}, numbers.data()});
    sum_up(context, numbers.data(), triangle_count);
    for_each(context, triangle_count, NumberRoots{words, numbers.data()});
    components.count = static_cast<std::int32_t>(download(context, numbers.data() + (triangle_count - 1)));
  }
  // Of a component's n triangles, p are listed against its lowest one and n - p are not; the smaller of both numbers is
  // half of n - |p - (n - p)|.
  DeviceBuffer<std::int32_t> margins(context, static_cast<std::size_t>(components.count));
  margins.fill_bytes(0);
  count_votes(context, triangle_count, ParityVotes{words}, {margins.data(), nullptr});
  const std::int64_t majority =
      reduce(context, static_cast<std::uint32_t>(components.count), std::int64_t{0}, Magnitude{margins.data()}, Plus{});
  components.reoriented_triangles = (std::int64_t{triangle_count} - majority) / 2;
  return components;
}

}  // namespace trismooth::cuda
