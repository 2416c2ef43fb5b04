#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

MeshDocument read(const std::filesystem::path& path, std::string) { throw ReadError(path, "format not there yet"); }
void write(const std::filesystem::path& path, const MeshDocument&) { throw WriteError(path, "format not there yet"); }
std::vector<std::string> lost(const MeshDocument&) { return {}; }

}  // namespace

const Codec vtk_legacy_codec{&read, &write, &lost};

}  // namespace trismooth
