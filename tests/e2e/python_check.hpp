#pragma once

#include <filesystem>
#include <string>

namespace vantage::test {

/// Lets a Python script of this folder look at what vantage wrote; a failed check if it finds a
/// difference, and a message if Debian's Python or one of its modules is missing.
void check_in_python(const std::string& script, const std::filesystem::path& folder);

}  // namespace vantage::test
