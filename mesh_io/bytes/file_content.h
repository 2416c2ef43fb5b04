#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

/// What a file holds, decompressed where gzip has compressed it.
struct FileContent {
  std::filesystem::path name;  ///< for messages: the file's, or "standard input"
  FileBytes bytes;
  std::string note;           ///< one sentence where the file is compressed and its name does not say so, else empty
  bool is_plain_file = true;  ///< neither compressed nor a stream
};

/// Reads a file, or standard input where `path` is `-`. Throws ReadError, also where it is compressed in another way,
/// and where the name says that gzip has compressed it and it has not.
FileContent read_content(const std::filesystem::path& path, const FileWorkers& workers);

/// Has `write` write a file at a path that it is given, and brings what it wrote to `path`: through an OutputFile, by
/// gzip where the name says so, or to standard output where `path` is `-`. Throws WriteError, which names `path`
/// whatever file `write` says that it could not write.
void write_content(const std::filesystem::path& path, const FileWorkers& workers,
                   const std::function<void(const std::filesystem::path&)>& write);

/// The same for a mesh of two files: `write` is given a path for each, with the extensions of `path` and of
/// `partner_of(path)`. Both are ready before the first of them is put in its place. Throws WriteError, also for
/// standard output, pipes and devices, and names that ask for compression.
void write_two_files(const std::filesystem::path& path,
                     std::filesystem::path (*partner_of)(const std::filesystem::path& path),
                     const std::function<void(const std::filesystem::path&)>& write);

}  // namespace trismooth
