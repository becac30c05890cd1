#pragma once

#include <filesystem>
#include <string>

namespace vantage {

/// SHA-256 of a file's bytes, 64 hexadecimal digits.
/// @throws Error as `read_file` does.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace vantage
