// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/free_names.h"

namespace trismooth {

/// Names of sets as Abaqus and CalculiX allow them: a letter, then letters, digits, '_' and '-', no two alike whatever
/// the case of their letters.
class InpSetNames {
 public:
  /// A name like `wanted`. Remembers which were changed.
  std::string claim(std::string_view wanted);

  /// "copper part (as copper_part)": names that have what is not allowed.
  const std::vector<std::string>& rewritten() const { return rewritten_; }

  /// "all (as all_1)": names that are allowed and that another set had.
  const std::vector<std::string>& repeated() const { return repeated_; }

 private:
  FreeNames taken_;
  std::vector<std::string> rewritten_;
  std::vector<std::string> repeated_;
};

}  // namespace trismooth
