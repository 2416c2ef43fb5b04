#pragma once

#include "trismooth/base/parity_forest.h"

namespace trismooth::cuda {

using trismooth::ParityForest;

}  // namespace trismooth::cuda
