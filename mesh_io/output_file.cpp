#include "trismooth/mesh_io/output_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <string>
#include <string_view>

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

// Commits begun, and whether the process is ending instead: one number, so that one of the two is first.
constexpr std::uint64_t ending = std::uint64_t{1} << 63;
std::atomic<std::uint64_t> progress{0};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// Waits for the end of the process where it is ending.
void begin_commit() {
  if ((progress.fetch_add(1) & ending) != 0) {
    for (;;) {
      ::pause();
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

/// The first bytes of a name in UTF-8, no character cut in two: some file systems take whole ones only.
std::string_view shortened(std::string_view name, std::size_t size) {
  constexpr auto continues = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; };
  if (size >= name.size()) {
    return name;
  }
  while (size > 0 && continues(name[size])) {
    --size;
  }
  return name.substr(0, size);
}

/// A name beside `target` that differs with every call. The extension stays last: some writers look at it.
std::string temporary_name(const std::filesystem::path& target) {
  constexpr std::size_t longest_stem = 100;  // file systems allow names of 255 bytes, those that encrypt them 143
  static std::atomic<unsigned> counter{0};
  const std::string suffix = "." + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  const std::string stem(shortened(target.stem().string(), longest_stem));
  return (target.parent_path() / ("." + stem + suffix + target.extension().string())).string();
}

/// Makes a new file beside `target`; sets `name` to its name. Negative where that is impossible.
int create_beside(const std::filesystem::path& target, mode_t mode, std::string& name) {
  int descriptor = -1;
  do {
    name = temporary_name(target);
    remember(name);  // before it is there, or a signal could come in between
    descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor < 0) {
      const int error = errno;
      forget(name);
      errno = error;
    }
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor;
}

/// Gives the file the owner, the group and the permissions of `old`, the first two where that is allowed.
bool adopt(int descriptor, const struct stat& old) {
  if (::fchown(descriptor, old.st_uid, old.st_gid) != 0) {
    [[maybe_unused]] const int refused = ::fchown(descriptor, static_cast<uid_t>(-1), old.st_gid);
  }
  return ::fchmod(descriptor, old.st_mode & 07777) == 0;
}

/// The new name of a file in the folder is on the disk after this. Not every file system can do it for folders, and the
/// file is in its place already: errors are no failure.
void flush_folder_of(const std::filesystem::path& file) {
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}

sigset_t broken_pipe() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGPIPE);
  return signals;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& target) : given_(target) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (std::filesystem::is_directory(status)) {
    throw WriteError(target, "is a folder");
  }
  direct_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (direct_) {
    target_ = target;
    path_ = target;
    const sigset_t signals = broken_pipe();
    ::pthread_sigmask(SIG_BLOCK, &signals, &signals_before_);
    return;
  }
  target_ = follow_links(target);
  constexpr mode_t of_any_file = 0666;  // less the process's mask
  constexpr mode_t of_nobody_else = 0600;
  struct stat old {};
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  const bool writable = !replaces || ::access(target_.c_str(), W_OK) == 0;
  std::string name;
  const int descriptor = writable ? create_beside(target_, replaces ? of_nobody_else : of_any_file, name) : -1;
  if (descriptor < 0) {
    fail(target, "cannot be written");
  }
  path_ = name;
  ::close(descriptor);
}

OutputFile::~OutputFile() {
  if (direct_) {
    if (sigismember(&signals_before_, SIGPIPE) == 0) {
      const sigset_t signals = broken_pipe();
      constexpr timespec no_time{};
      ::sigtimedwait(&signals, nullptr, &no_time);  // one that is pending is of our writes
      ::pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
    }
    return;
  }
  if (!done_) {
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
    fail(given_, "cannot be written");
  }
  struct stat old {};
  const bool adopted = ::stat(target_.c_str(), &old) != 0 || adopt(descriptor, old);
  const bool flushed = adopted && ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  if (!flushed) {
    errno = error;
    fail(given_, adopted ? "cannot be flushed to the disk" : "cannot be given the permissions of the old file");
  }
  begin_commit();
  if (::rename(path_.c_str(), target_.c_str()) != 0) {
    fail(given_, "cannot be replaced");
  }
  done_ = true;
  forget(path_.string());
  flush_folder_of(target_);
}

std::uint64_t OutputFile::commits_begun() noexcept {
  return progress & ~ending;
}

bool OutputFile::give_up(std::uint64_t commits) noexcept {
  if (!progress.compare_exchange_strong(commits, commits | ending)) {
    return false;
  }
  remove_unfinished();
  return true;
}

void OutputFile::remove_unfinished() noexcept {
  for (const UnfinishedFile& file : unfinished_files) {
    if (file.named) {
      ::unlink(file.name.data());
    }
  }
}

}  // namespace trismooth
