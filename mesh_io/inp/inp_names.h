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

  /// "copper part (as copper_part)": names that are not as they were wanted.
  const std::vector<std::string>& changed() const { return changed_; }

 private:
  FreeNames taken_;
  std::vector<std::string> changed_;
};

}  // namespace trismooth
