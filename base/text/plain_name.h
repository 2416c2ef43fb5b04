// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// Names as they are compared where programs write one in several ways: letters in lower case and digits, nothing else.
/// "Material_ID", "material id" and "MaterialId" are "materialid". Other alphabets' letters stay as they are.
std::string plain_name(std::string_view name);

}  // namespace trismooth
