// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "trismooth/mesh_io/hdf5/hdf5_child.h"

namespace trismooth {

/// What HDF5's library says of the file of these bytes: answers the requests of an Hdf5Reader, in its child, whose
/// first answer says that the file is open. What is to be read is checked against the bytes before memory is asked for.
void serve_hdf5(std::string_view bytes, Hdf5Channel& channel);

}  // namespace trismooth
