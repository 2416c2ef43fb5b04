#include "trismooth/mesh_io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

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

mode_t default_permissions() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& target) {
  std::error_code error;
  target_ = std::filesystem::weakly_canonical(target, error);
  if (error) {
    target_ = target;
  }
  const std::filesystem::file_status status = std::filesystem::status(target_, error);
  if (std::filesystem::is_directory(status)) {
    throw WriteError(target, "is a folder");
  }
  direct_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (direct_) {
    path_ = target_;
    return;
  }
  if (std::filesystem::exists(status) && ::access(target_.c_str(), W_OK) != 0) {
    fail(target, "cannot be written");
  }
  // The extension stays last: some writers look at it.
  std::string name = (target_.parent_path() / ("." + target_.stem().string() + ".XXXXXX")).string();
  const std::string extension = target_.extension().string();
  name += extension;
  const int descriptor = ::mkstemps(name.data(), static_cast<int>(extension.size()));
  if (descriptor < 0) {
    fail(target, "cannot be written");
  }
  path_ = name;
  remember(name);
  struct stat old {};
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  ::fchmod(descriptor, replaces ? old.st_mode & 07777 : default_permissions());
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
