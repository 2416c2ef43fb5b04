#include "trismooth/mesh_io/output_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

// The names of the unfinished files, where a signal handler can read them: it may not allocate, lock or wait.
struct UnfinishedFile {
  std::atomic<bool> used{false};
  std::atomic<bool> named{false};
  std::array<char, 4096> name{};
};
std::array<UnfinishedFile, 8> unfinished_files;

void remember(const std::string& name) {
  for (UnfinishedFile& file : unfinished_files) {
    if (name.size() < file.name.size() && !file.used.exchange(true)) {
      std::memcpy(file.name.data(), name.c_str(), name.size() + 1);
      file.named = true;
      return;
    }
  }
}

void forget(const std::string& name) {
  for (UnfinishedFile& file : unfinished_files) {
    if (file.named && name == file.name.data()) {
      file.named = false;
      file.used = false;
    }
  }
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw WriteError(path, what + ": " + std::strerror(errno));
}

/// The file that a name stands for, every symbolic link followed, also where that file does not exist yet.
std::filesystem::path follow_links(const std::filesystem::path& target) {
  constexpr int most_links = 40;
  std::filesystem::path path = target;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(path, error)); ++links) {
    if (links == most_links) {
      throw WriteError(target, "leads through too many symbolic links");
    }
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  }
  return path;
}

/// A name beside `target` that differs with every call. The extension stays last: some writers look at it.
std::string temporary_name(const std::filesystem::path& target) {
  constexpr std::size_t longest_stem = 200;  // most file systems allow names of 255 bytes
  static std::atomic<unsigned> counter{0};
  const std::string suffix = "." + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  const std::string stem = target.stem().string().substr(0, longest_stem);
  return (target.parent_path() / ("." + stem + suffix + target.extension().string())).string();
}

/// Makes a new file beside `target`; sets `name` to its name. Negative where that is impossible.
int create_beside(const std::filesystem::path& target, std::string& name) {
  constexpr mode_t read_and_write = 0666;  // less the process's mask
  int descriptor = -1;
  do {
    name = temporary_name(target);
    descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, read_and_write);
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& target) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (std::filesystem::is_directory(status)) {
    throw WriteError(target, "is a folder");
  }
  direct_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (direct_) {
    target_ = target;
    path_ = target;
    return;
  }
  target_ = follow_links(target);
  struct stat old {};
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  std::string name;
  const bool writable = !replaces || ::access(target_.c_str(), W_OK) == 0;
  const int descriptor = writable ? create_beside(target_, name) : -1;
  if (descriptor < 0) {
    fail(target, "cannot be written");
  }
  path_ = name;
  remember(name);
  if (replaces) {
    ::fchmod(descriptor, old.st_mode & 07777);
  }
  ::close(descriptor);
}

OutputFile::~OutputFile() {
  if (!direct_ && !done_) {
    ::unlink(path_.c_str());
    forget(path_.string());
  }
}

void OutputFile::commit() {
  if (direct_) {
    return;
  }
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    fail(target_, "cannot be written");
  }
  const bool flushed = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!flushed) {
    fail(target_, "cannot be flushed to the disk");
  }
  if (::rename(path_.c_str(), target_.c_str()) != 0) {
    fail(target_, "cannot be replaced");
  }
  done_ = true;
  forget(path_.string());
}

void OutputFile::remove_unfinished() noexcept {
  for (const UnfinishedFile& file : unfinished_files) {
    if (file.named) {
      ::unlink(file.name.data());
    }
  }
}

}  // namespace trismooth
