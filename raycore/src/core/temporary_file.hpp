#pragma once

#include <unistd.h>

#include <filesystem>
#include <utility>

#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {

/// An open file's number, closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  /// False if a write that was put off has failed.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// The Error for the system's error number `code`: out_of_resources where something is used up or
/// broken, bad_input where the user can fix it.
Error system_error(const std::filesystem::path& path, const char* what, int code);

/// A new, empty file beside the target, which takes the target's place or goes away. It is locked
/// while it lives: what has no lock was left by a process that is gone.
class TemporaryFile {
 public:
  /// @throws Error bad_input for a target that is a folder or no regular file, or whose folder is
  /// missing or may not be written; out_of_resources if the disk is full.
  explicit TemporaryFile(const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Has the disk keep what was written, and renames. @throws Error as the constructor does.
  void replace_target();

 private:
  void check_target() const;
  bool create();
  void flush_to_disk() const;
  [[noreturn]] void fail_to_create(int code) const;

  std::filesystem::path target_, folder_, path_;
  Descriptor file_{-1};
};

}  // namespace vantage::raycore::detail
