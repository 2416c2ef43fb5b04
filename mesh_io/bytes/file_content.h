// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

class MemoryFile;
class OutputFile;

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

/// Files that are complete under other names, on the disk, or in memory where they are for standard output. Without a
/// commit() nothing is left of them, and what has their names stays as it was. What a pipe or a device was given is
/// there already: it cannot be taken back. To be destroyed by the thread that made it.
class WrittenAside {
 public:
  /// Files that are prepared.
  explicit WrittenAside(std::vector<std::unique_ptr<OutputFile>> files);
  /// What is for standard output.
  explicit WrittenAside(std::unique_ptr<MemoryFile> stream);
  WrittenAside(WrittenAside&& other) noexcept;
  WrittenAside& operator=(WrittenAside&& other) noexcept;
  ~WrittenAside();

  /// Writes what is for standard output, if anything is, and the files take their places, in their order, all of them
  /// or none. Throws WriteError.
  void commit();
  /// commit(), then `next`, if it is any, which puts in place what belongs behind these: where that throws they go
  /// back.
  void commit_before(const std::function<void()>& next);

  /// Undoes a commit(), as OutputFile::take_back() does.
  void take_back() noexcept;

  /// The files that are to be there besides `path`, as write_mesh_aside() was told that one: none but of a mesh of
  /// several files.
  std::vector<std::filesystem::path> others(const std::filesystem::path& path) const;

 private:
  std::vector<std::unique_ptr<OutputFile>> files_;
  std::unique_ptr<MemoryFile> stream_;
};

/// Has `write` write a file at a path that it is given, as what is to come to `path`: through an OutputFile, by gzip
/// where the name says so, or to standard output where `path` is `-`. Throws WriteError, which names `path` whatever
/// file `write` says that it could not write.
WrittenAside write_content_aside(const std::filesystem::path& path, const FileWorkers& workers,
                                 const std::function<void(const std::filesystem::path&)>& write);

/// write_content_aside() of a mesh of several files: `write` writes all of them, `path` where it is told and `others`
/// at their OutputFile::place_of(). Throws WriteError, also for standard output, pipes and devices, and names that ask
/// for compression.
WrittenAside write_files_aside(const std::filesystem::path& path, const std::vector<std::filesystem::path>& others,
                               const std::function<void(const std::filesystem::path&)>& write);

/// write_content_aside() of a mesh of two files: `write` is given a path for each, with the extensions of `path` and of
/// `partner_of(path)`. Throws WriteError, also for standard output, pipes and devices, and names that ask for
/// compression.
WrittenAside write_two_files_aside(const std::filesystem::path& path,
                                   std::filesystem::path (*partner_of)(const std::filesystem::path& path),
                                   const std::function<void(const std::filesystem::path&)>& write);

}  // namespace trismooth
