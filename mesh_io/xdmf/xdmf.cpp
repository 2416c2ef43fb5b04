// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "trismooth/mesh_io/codec.h"
#ifdef TRISMOOTH_HAS_XML
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/xdmf/xdmf_reader.h"
#include "trismooth/mesh_io/xdmf/xdmf_writer.h"
#endif

namespace trismooth {

namespace {

constexpr FormatDescription description{
    FileFormat::xdmf, "xdmf", "XDMF", {".xdmf", ".xmf"}, {.arrays = true, .names = true}};

#ifdef TRISMOOTH_HAS_XML
bool is_xdmf(std::string_view bytes) {
  const std::string_view head = text_head(bytes);
  return head.substr(0, 4096).find("<Xdmf") != head.npos;
}
#endif

}  // namespace

#ifdef TRISMOOTH_HAS_XML
const Codec xdmf_codec{description, &read_xdmf, &write_xdmf, &lost_in_xdmf, &is_xdmf, nullptr, &xdmf_other_files};
#else
const Codec xdmf_codec{description};
#endif

}  // namespace trismooth
