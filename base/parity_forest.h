// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"
#include "trismooth/base/machine/relaxed_atomics.h"

namespace trismooth {

/// Union-find over elements of two kinds, by any number of threads at once and without locks: which elements belong
/// together, and which of those are of the same kind. The higher root is hooked under the lower with one
/// compare-and-swap (as in ECL-CC: J. Jaiganesh and M. Burtscher 2018), and each word holds a parent together with the
/// parity to it, so that every word that is ever read is true.
///
/// Parents are lower than their children. So every search ends, and the root of a finished tree is its lowest element,
/// whatever the threads did in which order. Trivially copyable; the memory is someone else's.
struct ParityForest {
  std::uint32_t* words;  ///< per element: (parent << 1) | parity to the parent; a root is its own parent, with parity 0

  struct Root {
    std::uint32_t element;
    std::uint32_t parity;  ///< 1 where the element asked for is of the other kind than the root
  };
  enum class Join : std::uint8_t {
    joined,       ///< they were in different trees until this call
    known,        ///< they were in one tree, and it says the same
    contradicted  ///< they were in one tree, and it says the opposite
  };

  /// Makes the element a tree of its own. Elements are below 2^31.
  TRISMOOTH_HOST_DEVICE void plant(std::uint32_t element) const { words[element] = element << 1U; }

  TRISMOOTH_HOST_DEVICE Root find(std::uint32_t element) const {
    std::uint32_t parity = 0;
    for (;;) {
      const std::uint32_t up = load_relaxed(&words[element]);
      const std::uint32_t parent = up >> 1U;
      if (parent == element) {
        return {element, parity};
      }
      const std::uint32_t above = load_relaxed(&words[parent]);
      if (above >> 1U == parent) {
        return {parent, parity ^ (up & 1U)};
      }
      // Path halving. The element is no root and never will be again, so nobody hooks it meanwhile; another thread may
      // have shortened its path further, and then this makes it longer again, but not wrong.
      const std::uint32_t grandparent = above ^ (up & 1U);
      store_relaxed(&words[element], grandparent);
      element = grandparent >> 1U;
      parity ^= grandparent & 1U;
    }
  }

  /// The root of an element, without shortening the path: writes nothing.
  TRISMOOTH_HOST_DEVICE Root look_up(std::uint32_t element) const {
    std::uint32_t parity = 0;
    for (;;) {
      const std::uint32_t up = load_relaxed(&words[element]);
      if (up >> 1U == element) {
        return {element, parity};
      }
      parity ^= up & 1U;
      element = up >> 1U;
    }
  }

  /// Says that two elements belong together and are of the same kind (parity 0) or not (1).
  TRISMOOTH_HOST_DEVICE Join join(std::uint32_t a, std::uint32_t b, std::uint32_t parity) const {
    const std::uint32_t up_a = load_relaxed(&words[a]);
    const std::uint32_t up_b = load_relaxed(&words[b]);
    if ((up_a ^ up_b) >> 1U == 0) {
      // They have one parent, as most have that are in one tree already.
      return (up_a ^ up_b) == parity ? Join::known : Join::contradicted;
    }
    Root high = find(a);
    Root low = find(b);
    for (;;) {
      const std::uint32_t between = high.parity ^ low.parity ^ parity;
      if (high.element == low.element) {
        return between == 0 ? Join::known : Join::contradicted;
      }
      if (high.element < low.element) {
        const Root lower = high;
        high = low;
        low = lower;
      }
      const std::uint32_t root = high.element << 1U;
      const std::uint32_t found = exchange_if_equal(&words[high.element], root, (low.element << 1U) | between);
      if (found == root) {
        return Join::joined;
      }
      // Somebody has hooked it. That happens once to every element, so this loop ends.
      const Root next = find(found >> 1U);
      high = {next.element, high.parity ^ (found & 1U) ^ next.parity};
    }
  }
};

}  // namespace trismooth
