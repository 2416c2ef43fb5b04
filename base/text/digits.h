// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace trismooth {

/// Numbers in decimal digits, the same in every locale. Infinity is "inf", a value that is not a number "nan".

/// So many digits behind the point: "12.50".
std::string fixed_digits(double value, int decimals);

/// One digit before the point and so many behind it: "1.25e+01".
std::string scientific_digits(double value, int decimals);

/// At most so many digits in all, as %g of the C library has them: "12.5", "1.25e+09".
std::string general_digits(double value, int digits);

/// The fewest digits that stand for this value and no other, without an exponent: "12.5".
std::string shortest_digits(double value);

/// The fewest characters that stand for this value and no other: "12.5", "1e+300".
std::string shortest_text(double value);

/// The fewest digits that stand for this value of its type and no other, with an exponent below 1e-4 and from 1e16 on,
/// as Python and the library fmt have them: "0.1", "100000", "1e+16".
std::string plain_text(double value);
std::string plain_text(float value);

}  // namespace trismooth
