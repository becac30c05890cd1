#include "core/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <atomic>
#include <cerrno>
#include <initializer_list>
#include <string>
#include <system_error>

#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace raycore::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTemporaryPrefix = ".vantage-";

/// Whether the file that a descriptor is of still has this path.
bool has_path(int file, const fs::path& path) {
  struct stat open = {}, named = {};
  return ::fstat(file, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// ".vantage-123-4.png", as `TemporaryFile` names them.
bool is_temporary_name(const std::string& name) {
  if (!name.starts_with(kTemporaryPrefix)) return false;
  const std::size_t begin = std::string(kTemporaryPrefix).size();
  const std::size_t dash = name.find_first_not_of("0123456789", begin);
  if (dash == begin || dash == std::string::npos || name[dash] != '-') return false;
  if (dash + 1 == name.size()) return false;
  const std::size_t end = name.find_first_not_of("0123456789", dash + 1);
  return end != dash + 1 && (end == std::string::npos || name[end] == '.');
}

/// Removes a file if no process has it locked.
void remove_if_abandoned(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open()) return;
  struct stat status = {};
  if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) return;  // somebody's, or no locks here
  if (has_path(file.get(), path)) ::unlink(path.c_str());
}

}  // namespace

Error system_error(const fs::path& path, const char* what, int code) {
  bool used_up = false;
  for (const int one : {ENOSPC, EDQUOT, EFBIG, ENOMEM, EMFILE, ENFILE, ENOBUFS, EIO, EAGAIN}) {
    used_up |= code == one;
  }
  return {used_up ? ErrorCode::out_of_resources : ErrorCode::bad_input, path.string(),
          fmt::format("{}: {}", what, std::generic_category().message(code))};
}

TemporaryFile::TemporaryFile(const fs::path& target)
    : target_(target), folder_(target.has_parent_path() ? target.parent_path() : fs::path(".")) {
  check_target();
  while (!create()) {
  }
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

/// @returns false if the name was taken, or another process cleared the file away before it was
/// locked.
bool TemporaryFile::create() {
  static std::atomic<unsigned> counter = 0;
  // The ending is kept: there are writers that choose the format by it.
  const fs::path path = folder_ / fmt::format("{}{}-{}{}", kTemporaryPrefix, ::getpid(), ++counter,
                                              target_.extension().string());
  file_ = Descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file_.is_open()) {
    if (errno == EEXIST) return false;
    fail_to_create(errno);
  }
  // Where there are no locks, nobody clears away either.
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat status = {};
  if (::fstat(file_.get(), &status) == 0 && status.st_nlink == 0) return false;
  path_ = path;
  return true;
}

void TemporaryFile::replace_target() {
  flush_to_disk();
  if (::rename(path_.c_str(), target_.c_str()) != 0) {
    throw system_error(target_, "cannot be replaced", errno);
  }
  path_.clear();
  // So that the name survives, too. The file is there by now: it is no failure if this is one.
  const Descriptor folder(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.is_open()) ::fsync(folder.get());
}

void TemporaryFile::flush_to_disk() const {
  if (::fsync(file_.get()) == 0 || errno == EINVAL || errno == ENOTSUP) return;
  throw system_error(target_, "cannot be written to the disk", errno);
}

/// Renaming onto a device such as /dev/null would replace it for everyone.
void TemporaryFile::check_target() const {
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  if (!target_.has_filename() || fs::is_directory(status)) {
    throw bad_input(target_.string(), "is a folder; expected the name of a file to write");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw bad_input(target_.string(), "exists and is not a regular file; name another one");
  }
}

void TemporaryFile::fail_to_create(int code) const {
  if (code == ENOENT) {
    throw bad_input(target_.string(),
                    fmt::format("the folder {} does not exist; make it first", folder_.string()));
  }
  throw system_error(target_, "cannot be written", code);
}

}  // namespace raycore::detail

void remove_abandoned_files(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator at(folder, error);
  for (; !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    if (raycore::detail::is_temporary_name(at->path().filename().string())) {
      raycore::detail::remove_if_abandoned(at->path());
    }
  }
}

}  // namespace vantage
