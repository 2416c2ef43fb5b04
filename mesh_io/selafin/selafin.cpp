// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/selafin/selafin_reader.h"
#include "trismooth/mesh_io/selafin/selafin_writer.h"

namespace trismooth {

namespace {

bool is_selafin(std::string_view bytes) {
  return selafin_byte_order(bytes).has_value();
}

}  // namespace

const Codec selafin_codec{{FileFormat::selafin,
                           "selafin",
                           "SELAFIN",
                           {".slf", ".srf", ".sel"},
                           {.names = true, .quads = false, .collapsed_quads = false, .curved_cells = false},
                           1},
                          &read_selafin,
                          &write_selafin,
                          &lost_in_selafin,
                          &is_selafin};

}  // namespace trismooth
