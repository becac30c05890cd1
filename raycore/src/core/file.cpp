#include "vantage/raycore/detail/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// An open file's number, closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  /// False if a write that was put off has failed.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// The Error for the system's error number `code`.
Error system_error(const fs::path& path, const char* what, int code) {
  const bool full = code == ENOSPC || code == EDQUOT || code == EFBIG || code == ENOMEM;
  return {full ? ErrorCode::out_of_resources : ErrorCode::bad_input, path.string(),
          fmt::format("{}: {}", what, std::generic_category().message(code))};
}

std::size_t checked_size(const fs::path& path, int file, std::size_t max_bytes) {
  struct stat status = {};
  if (::fstat(file, &status) != 0) throw system_error(path, "cannot be read", errno);
  if (!S_ISREG(status.st_mode)) {
    throw bad_input(path.string(), S_ISDIR(status.st_mode)
                                       ? "is a folder; expected a file"
                                       : "is no regular file; expected one that can be read whole");
  }
  if (std::uintmax_t(status.st_size) > max_bytes) {
    throw bad_input(path.string(), fmt::format("has {} bytes; at most {} are read here",
                                               status.st_size, max_bytes));
  }
  return std::size_t(status.st_size);
}

/// Reads until `bytes` is full or the file ends. @returns the number of bytes read.
std::size_t read_all(const fs::path& path, int file, std::vector<std::uint8_t>& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(path, "cannot be read", errno);
    if (count == 0) break;
    done += std::size_t(count);
  }
  return done;
}

/// In a clone without Git LFS a large file is a few lines that say where it is.
void check_no_pointer(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kStart = "version https://git-lfs.github.com/spec/";
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (bytes.size() > 1024 || !text.starts_with(kStart)) return;
  throw bad_input(path.string(),
                  "is a pointer of Git LFS, not the file itself; install git-lfs and run "
                  "\"git lfs pull\" in the repository that it comes from");
}

void write_all(const fs::path& path, int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(path, "cannot be written", errno);
    bytes.remove_prefix(std::size_t(count));
  }
}

/// A new, empty file beside the target, which takes the target's place or goes away.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) : target_(target) {
    check_target();
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    int file = -1;
    do {
      // The ending is kept: there are writers that choose the format by it.
      static std::atomic<unsigned> counter = 0;
      path_ = folder /
              fmt::format(".vantage-{}-{}{}", ::getpid(), ++counter, target.extension().string());
      file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file < 0 && errno == EEXIST);
    if (file < 0) fail_to_create(folder, errno);
    ::close(file);
  }
  ~Temporary() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const fs::path& path() const { return path_; }

  void replace_target() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) {
      throw system_error(target_, "cannot be replaced", errno);
    }
    path_.clear();
  }

 private:
  /// Renaming onto a device such as /dev/null would replace it for everyone.
  void check_target() const {
    std::error_code ignored;
    const fs::file_status status = fs::status(target_, ignored);
    if (!target_.has_filename() || fs::is_directory(status)) {
      throw bad_input(target_.string(), "is a folder; expected the name of a file to write");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      throw bad_input(target_.string(), "is there already and is no regular file; name another");
    }
  }

  [[noreturn]] void fail_to_create(const fs::path& folder, int code) const {
    if (code == ENOENT) {
      throw bad_input(target_.string(),
                      fmt::format("the folder {} does not exist; make it first", folder.string()));
    }
    throw system_error(target_, "cannot be written", code);
  }

  fs::path target_;
  fs::path path_;
};

}  // namespace

std::vector<std::uint8_t> read_file(const fs::path& path, std::size_t max_bytes) {
  // Without O_NONBLOCK, opening a pipe would wait for its writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open()) throw system_error(path, "cannot be opened", errno);
  const std::size_t size = checked_size(path, file.get(), max_bytes);
  try {
    std::vector<std::uint8_t> bytes(size);
    bytes.resize(read_all(path, file.get(), bytes));
    check_no_pointer(path, bytes);
    return bytes;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_resources, path.string(),
                fmt::format("has {} bytes; there is not that much memory", size));
  }
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file_with(path, [&](const fs::path& temporary) {
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    if (!file.is_open()) throw system_error(path, "cannot be written", errno);
    write_all(path, file.get(), bytes);
    if (!file.close()) throw system_error(path, "cannot be written", errno);
  });
}

void write_file_with(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  Temporary temporary(path);
  write(temporary.path());
  temporary.replace_target();
}

}  // namespace vantage
