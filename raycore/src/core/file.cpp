#include "vantage/raycore/detail/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>

#include "core/temporary_file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using raycore::detail::Descriptor;
using raycore::detail::system_error;
using raycore::detail::TemporaryFile;

std::size_t checked_size(const fs::path& path, int file, std::size_t max_bytes) {
  struct stat status = {};
  if (::fstat(file, &status) != 0) throw system_error(path, "cannot be read", errno);
  if (!S_ISREG(status.st_mode)) {
    throw bad_input(path.string(),
                    S_ISDIR(status.st_mode)
                        ? "is a folder; expected a file"
                        : "is not a regular file; expected one that can be read as a whole");
  }
  if (std::uintmax_t(status.st_size) > max_bytes) {
    throw bad_input(path.string(),
                    fmt::format("has {} bytes; the limit is {}", status.st_size, max_bytes));
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
                  "is a Git LFS pointer, not the file itself; install git-lfs and run \"git lfs "
                  "pull\" in the repository that it comes from");
}

void write_all(const fs::path& path, int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(path, "cannot be written", errno);
    bytes.remove_prefix(std::size_t(count));
  }
}

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
  TemporaryFile temporary(path);
  write(temporary.path());
  temporary.replace_target();
}

}  // namespace vantage
