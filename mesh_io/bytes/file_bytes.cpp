#include "trismooth/mesh_io/bytes/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

std::string read_file_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw ReadError(path, "is a folder, not a mesh file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (file == nullptr) {
    throw ReadError(path, std::string("cannot be opened: ") + std::strerror(errno));
  }
  std::string bytes;
  try {
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    constexpr std::size_t least = std::size_t{1} << 16;
    bytes.resize(error ? least : static_cast<std::size_t>(size) + 1);
    std::size_t used = 0;
    while (const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get())) {
      used += got;
      if (used == bytes.size()) {
        bytes.resize(2 * used);
      }
    }
    if (std::ferror(file.get()) != 0) {
      throw ReadError(path, std::string("cannot be read: ") + std::strerror(errno));
    }
    bytes.resize(used);
  } catch (const std::bad_alloc&) {
    throw ReadError(path, "is too large for the memory of this machine");
  } catch (const std::length_error&) {
    throw ReadError(path, "is too large for the memory of this machine");
  }
  return bytes;
}

}  // namespace trismooth
