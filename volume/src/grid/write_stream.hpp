#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace vantage::volume::detail {

/// As `write_file_with`, for a writer that wants a stream and does not look after its errors.
void write_stream(const std::filesystem::path& path,
                  const std::function<void(std::ostream&)>& write);

}  // namespace vantage::volume::detail
