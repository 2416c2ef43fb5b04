// SPDX-License-Identifier: BSD-3-Clause
// The component quality alone, by the header for all.
#include <cstdio>

#include "trismooth/trismooth.h"

int main() {
  const double equilateral = trismooth::shape<double>({0, 0}, {2, 0}, {1, 1.7320508075688772});
  const bool acceptable = trismooth::is_acceptable(trismooth::Metric::shape, equilateral);
  std::printf("an equilateral triangle has shape %g\n", equilateral);
  return acceptable && equilateral > 0.999 ? 0 : 1;
}
