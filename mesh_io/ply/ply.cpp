#include "trismooth/mesh_io/ply/ply.h"

#include "trismooth/mesh_io/codec.h"

namespace trismooth {

const Codec ply_codec{&read_ply, &write_ply, &what_ply_loses};

}  // namespace trismooth
