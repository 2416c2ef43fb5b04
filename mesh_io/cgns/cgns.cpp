// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/cgns/cgns_description.h"
#include "trismooth/mesh_io/cgns/cgns_reader.h"
#include "trismooth/mesh_io/cgns/cgns_writer.h"
#include "trismooth/mesh_io/codec.h"

namespace trismooth {

namespace {

bool is_cgns(std::string_view bytes) {
  return is_adf(bytes) || is_hdf5_with(bytes, "CGNSLibraryVersion");
}

}  // namespace

const Codec cgns_codec{cgns_description, &read_cgns, &write_cgns, &lost_in_cgns, &is_cgns};

}  // namespace trismooth
