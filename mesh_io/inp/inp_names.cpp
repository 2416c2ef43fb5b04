// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_names.h"

#include "trismooth/mesh_io/inp/inp_text.h"

namespace trismooth {

namespace {

constexpr std::size_t longest_set_name = 60;

bool is_letter_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string allowed_name(std::string_view wanted) {
  std::string name;
  for (const char c : wanted.substr(0, longest_set_name)) {
    name += is_letter_of_name(c) || (c >= '0' && c <= '9') || c == '-' ? c : '_';
  }
  return name.empty() || !is_letter_of_name(name.front()) ? "SET_" + name : name;
}

}  // namespace

std::string InpSetNames::claim(std::string_view wanted) {
  const std::string allowed = allowed_name(wanted);
  const std::string key = inp_key(allowed);
  // What was added to the key to make it another one is added to the name.
  std::string name = allowed + taken_.claim(key).substr(key.size());
  if (name != wanted) {
    (allowed == wanted ? repeated_ : rewritten_).push_back(std::string(wanted) + " (as " + name + ")");
  }
  return name;
}

}  // namespace trismooth
