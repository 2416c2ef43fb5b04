// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/nastran/nastran_card.h"

namespace trismooth {

/// Names of properties, which preprocessors write in comments: HyperMesh ($HMNAME PROP 1"steel", or COMP where none is
/// of PROP), Femap ("$ Femap ... Property 1 : steel") and Patran ("$ Elements and Element Properties for region :
/// steel" before the card of the property).
class NastranNames {
 public:
  /// A whole line that is a comment.
  void read_comment(std::string_view line);
  /// A card that follows.
  void read_card(const NastranCard& card);

  /// The names by number.
  std::map<std::int64_t, std::string> take();

 private:
  std::map<std::int64_t, std::string> properties_;
  std::map<std::int64_t, std::string> components_;
  std::string next_;  ///< of the property that is stated next
};

/// The comment that names a property, without a line end.
std::string nastran_name_comment(std::int64_t property, std::string_view name);

/// Whether such a comment can hold the name.
bool is_nastran_name(std::string_view name);

}  // namespace trismooth
