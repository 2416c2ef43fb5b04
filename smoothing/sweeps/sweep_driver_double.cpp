// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/sweep_driver.h"

namespace trismooth {

template class SweepDriver<double>;

}  // namespace trismooth
