// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace fuzz {

/// A promise that was not kept. Nothing but the test program catches it: under libFuzzer it ends the process.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

inline void require(bool kept, const std::string& promise) {
  if (!kept) {
    throw Broken(promise);
  }
}

}  // namespace fuzz
