// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/med/med_description.h"
#include "trismooth/mesh_io/med/med_reader.h"
#include "trismooth/mesh_io/med/med_writer.h"

namespace trismooth {

namespace {

bool is_med(std::string_view bytes) {
  return is_hdf5_with(bytes, "ENS_MAA");
}

}  // namespace

const Codec med_codec{med_description, &read_med, &write_med, &lost_in_med, &is_med};

}  // namespace trismooth
