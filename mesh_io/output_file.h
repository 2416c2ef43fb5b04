#pragma once

#include <filesystem>

namespace trismooth {

/// A file under construction: written beside its target under a temporary name, renamed over the target by commit().
/// Without a commit the destructor removes it and the target stays as it was. A target that exists and is not a
/// regular file (a device, a pipe) is written directly.
class OutputFile {
 public:
  /// Makes the temporary file beside `target`, following symbolic links. Throws WriteError where that is impossible.
  explicit OutputFile(const std::filesystem::path& target);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }

  /// Flushes the file to the disk and puts it in the target's place, with the target's permissions where there was
  /// one. Throws WriteError.
  void commit();

  /// Removes the temporary files of this process, if any: for signal handlers and other abrupt ends. Async-signal-safe.
  static void remove_unfinished() noexcept;

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  bool direct_ = false;
  bool done_ = false;
};

}  // namespace trismooth
