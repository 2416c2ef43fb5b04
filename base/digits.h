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

}  // namespace trismooth
