// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/plain_name.h"

#include "trismooth/base/text/letter_case.h"

namespace trismooth {

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const char lower = lower_letter(c);
    if ((lower >= 'a' && lower <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80) {
      plain += lower;
    }
  }
  return plain;
}

}  // namespace trismooth
