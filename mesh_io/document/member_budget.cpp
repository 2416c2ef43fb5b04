// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/member_budget.h"

#include <utility>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

constexpr std::size_t members_of_any_file = std::size_t{1} << 20;
constexpr std::size_t members_a_byte = 16;

}  // namespace

MemberBudget::MemberBudget(std::filesystem::path path, std::size_t bytes)
    : path_(std::move(path)), left_(members_of_any_file + members_a_byte * bytes) {}

void MemberBudget::spend(std::size_t members) {
  if (members > left_) {
    throw ReadError(path_, "its sets and groups have more members than a mesh of its size can have");
  }
  left_ -= members;
}

}  // namespace trismooth
