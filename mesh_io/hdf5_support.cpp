// SPDX-License-Identifier: BSD-3-Clause
// The one place that knows what a build without HDF5 says of the formats that are kept in it.
#ifndef TRISMOOTH_HAS_HDF5

#include "trismooth/mesh_io/cgns/cgns_description.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/med/med_description.h"

namespace trismooth {

const Codec med_codec{med_description};
const Codec cgns_codec{cgns_description};

}  // namespace trismooth

#endif
