#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "vantage/raycore/error.hpp"

namespace vantage::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder of this process's own, in memory where there is one; it stays for the next input.
inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    auto made = parent / ("vantage-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(made);
    std::atexit([] { std::filesystem::remove_all(folder()); });
    return made;
  }();
  return path;
}

inline std::filesystem::path file_with(const char* name, std::string_view bytes) {
  const std::filesystem::path path = folder() / name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), std::streamsize(bytes.size()));
  return path;
}

/// Whatever the input is, a reader returns or throws an Error that says where and what.
template <class Read>
int only_errors(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.where().empty() || error.message().empty()) std::abort();
  }
  return 0;
}

}  // namespace vantage::fuzz
