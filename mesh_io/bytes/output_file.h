// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <sys/types.h>

#include "trismooth/mesh_io/bytes/broken_pipe.h"

namespace trismooth {

/// A file under construction: written beside its target under a temporary name (".mesh.PID-N.off" for "mesh.off"),
/// renamed over the target by commit(). Without a commit the destructor removes it and the target stays as it was. A
/// target that exists and is not a regular file (a device, a pipe) is written directly; a pipe that nobody reads any
/// more is an error of the write then, not a SIGPIPE. To be destroyed by the thread that made it.
class OutputFile {
 public:
  /// Makes the temporary file beside `target`, following symbolic links. Throws WriteError where that is impossible.
  explicit OutputFile(const std::filesystem::path& target);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// The target, as it was given.
  const std::filesystem::path& given() const { return given_; }

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }

  /// Whether the target is no regular file, and is written directly.
  bool is_direct() const { return direct_; }

  /// Among the files that this thread makes: the name that was asked for of the one that is written at `path`, and
  /// where to write the one that is to have `name`. Others are what they are called. For what writes several files
  /// that name each other.
  static std::filesystem::path name_of(const std::filesystem::path& path);
  static std::filesystem::path place_of(const std::filesystem::path& name);

  /// Flushes the file to the disk and gives it the target's permissions, and its owner where that is allowed, where
  /// there was one: all of commit() but the last step. Where several files belong together, none is put in place before
  /// all are ready. Throws WriteError.
  void prepare();

  /// Puts the file in the target's place, ready as prepare() makes it. After a power cut there is the old file or all
  /// of the new one. Until this object goes, the old file lies under the temporary name. Throws WriteError.
  void commit();

  /// Where several files belong together and a later one has failed: undoes a commit(). Only file systems that cannot
  /// exchange names (NFS) have no old file any more; there the new one stays. What was written directly stays too.
  void take_back() noexcept;

  /// For files of several processes that belong together: from now on it is as if a commit was begun. When every
  /// process has called this, and not before, they commit: whoever is told to end until then puts nothing in its place,
  /// nor do those that wait for it.
  static void begin_commits() noexcept;

  /// How many files this process has begun to put in place.
  static std::uint64_t commits_begun() noexcept;

  /// For a signal handler that is to end the process: where no commit was begun beyond the first `commits`, removes the
  /// temporary files and answers true; no later commit comes through, it waits for the end. False, and nothing done,
  /// where one was begun, or where this has answered true before. What was written directly does not count: a pipe
  /// cannot be taken back. Async-signal-safe.
  static bool give_up(std::uint64_t commits) noexcept;

  /// Removes the temporary files of this process, if any: for abrupt ends at any time. Async-signal-safe.
  static void remove_unfinished() noexcept;

 private:
  /// What a file keeps when its content is replaced.
  struct Attributes {
    uid_t owner;
    gid_t group;
    mode_t permissions;
  };

  static std::optional<Attributes> attributes_of(const std::filesystem::path& file);
  static bool set_attributes(int descriptor, const Attributes& attributes);

  std::filesystem::path given_;
  std::filesystem::path target_;  ///< every link followed
  std::filesystem::path path_;
  std::optional<Attributes> old_;  ///< of the target
  bool direct_ = false;
  bool prepared_ = false;
  bool done_ = false;     ///< the new file is in its place; nothing is left under the temporary name, or the old file
  bool has_old_ = false;  ///< under the temporary name
  bool is_new_name_ = false;                               ///< there was no old file
  std::optional<BrokenPipeIsError> broken_pipe_is_error_;  ///< where it is written directly
};

}  // namespace trismooth
