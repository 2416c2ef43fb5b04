#pragma once

#include <filesystem>
#include <string>

namespace trismooth {

/// The bytes of the file. Throws ReadError, also for a folder and where memory does not suffice.
std::string read_file_bytes(const std::filesystem::path& path);

}  // namespace trismooth
