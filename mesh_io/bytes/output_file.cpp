// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/output_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

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
// (A rank writes many pieces of a mesh at a time.)
std::array<UnfinishedFile, 256> unfinished_files;

void remember(std::string_view name) {
  for (UnfinishedFile& file : unfinished_files) {
    if (name.size() < file.name.size() && !file.used.exchange(true)) {
      std::memcpy(file.name.data(), name.data(), name.size());
      file.name[name.size()] = '\0';
      file.named = true;
      return;
    }
  }
}

void forget(std::string_view name) {
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

/// Makes a new file beside `target`; sets `path` to its name. Negative where that is impossible.
int create_beside(const std::filesystem::path& target, mode_t mode, std::filesystem::path& path) {
  int descriptor = -1;
  do {
    path = temporary_name(target);
    remember(path.native());  // before it is there, or a signal could come in between
    descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor < 0) {
      const int error = errno;
      forget(path.native());
      errno = error;
    }
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor;
}

/// The folder of a file, kept open: telling the disk of a new name in it takes no memory, so it cannot fail for lack
/// of any.
class Folder {
 public:
  explicit Folder(const std::filesystem::path& file)
      : descriptor_(
            ::open(file.has_parent_path() ? file.parent_path().c_str() : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
  }

  /// New names in it are on the disk after this. Not every file system can do it, and the file is in its place already:
  /// errors are no failure.
  void flush() const {
    if (descriptor_ >= 0) {
      ::fsync(descriptor_);
    }
  }

 private:
  int descriptor_;
};

thread_local std::vector<const OutputFile*> files_of_thread;

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& target) : given_(target) {
  files_of_thread.reserve(files_of_thread.size() + 1);  // what follows cannot fail then
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (std::filesystem::is_directory(status)) {
    throw WriteError(target, "is a folder");
  }
  direct_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (direct_) {
    target_ = target;
    path_ = target;
    broken_pipe_is_error_.emplace();
    files_of_thread.push_back(this);
    return;
  }
  target_ = follow_links(target);
  constexpr mode_t of_any_file = 0666;  // less the process's mask
  constexpr mode_t of_nobody_else = 0600;
  old_ = attributes_of(target_);
  const bool writable = !old_ || ::access(target_.c_str(), W_OK) == 0;
  const int descriptor = writable ? create_beside(target_, old_ ? of_nobody_else : of_any_file, path_) : -1;
  if (descriptor < 0) {
    fail(target, "cannot be written");
  }
  ::close(descriptor);
  files_of_thread.push_back(this);
}

OutputFile::~OutputFile() {
  std::erase(files_of_thread, this);
  if (!direct_ && (!done_ || has_old_)) {
    ::unlink(path_.c_str());
    forget(path_.native());
  }
}

std::optional<OutputFile::Attributes> OutputFile::attributes_of(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    return std::nullopt;
  }
  constexpr mode_t all_permissions = 07777;
  return Attributes{status.st_uid, status.st_gid, status.st_mode & all_permissions};
}

/// The owner and the group where that is allowed. File systems without permissions of their own allow no change, and
/// need none.
bool OutputFile::set_attributes(int descriptor, const Attributes& attributes) {
  if (::fchown(descriptor, attributes.owner, attributes.group) != 0) {
    [[maybe_unused]] const int refused = ::fchown(descriptor, static_cast<uid_t>(-1), attributes.group);
  }
  if (::fchmod(descriptor, attributes.permissions) == 0) {
    return true;
  }
  const int error = errno;
  struct stat status {};
  const bool is_so = ::fstat(descriptor, &status) == 0 && (status.st_mode & ~S_IFMT) == attributes.permissions;
  errno = error;
  return is_so;
}

std::filesystem::path OutputFile::name_of(const std::filesystem::path& path) {
  const auto found = std::ranges::find(files_of_thread, path, [](const OutputFile* file) { return file->path_; });
  return found == files_of_thread.end() ? path : (*found)->given_;
}

std::filesystem::path OutputFile::place_of(const std::filesystem::path& name) {
  const auto found = std::ranges::find(files_of_thread, name, [](const OutputFile* file) { return file->given_; });
  return found == files_of_thread.end() ? name : (*found)->path_;
}

void OutputFile::prepare() {
  if (direct_ || prepared_) {
    return;
  }
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    fail(given_, "cannot be written");
  }
  // Somebody may have removed the old file, or changed its permissions.
  const std::optional<Attributes> now = attributes_of(target_);
  const std::optional<Attributes>& kept = now ? now : old_;
  const bool adopted = !kept || set_attributes(descriptor, *kept);
  const bool flushed = adopted && ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  if (!flushed) {
    errno = error;
    fail(given_, adopted ? "cannot be flushed to the disk" : "cannot be given the permissions of the old file");
  }
  prepared_ = true;
}

void OutputFile::commit() {
  if (direct_) {
    return;
  }
  prepare();
  const Folder folder(target_);
  begin_commit();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(target_, error);
  is_new_name_ = !std::filesystem::exists(status);
  const bool is_replaced =
      std::filesystem::is_regular_file(status) &&
      ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;  // it keeps the old file
  if (!is_replaced && ::rename(path_.c_str(), target_.c_str()) != 0) {
    fail(given_, "cannot be replaced");
  }
  done_ = true;
  has_old_ = is_replaced;
  if (!has_old_) {
    forget(path_.native());
  }
  folder.flush();
}

void OutputFile::take_back() noexcept {
  if (!done_) {
    return;
  }
  if (has_old_) {
    ::rename(path_.c_str(), target_.c_str());
    forget(path_.native());
  } else if (is_new_name_) {
    ::unlink(target_.c_str());
  }
  has_old_ = false;
  is_new_name_ = false;
}

void OutputFile::begin_commits() noexcept {
  begin_commit();
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
