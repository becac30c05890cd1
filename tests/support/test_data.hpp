#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vantage::test {

/// A folder of its own for one test, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  /// Writes a file into the folder and returns its path.
  std::filesystem::path write(std::string_view name, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);

/// The checkout's folder of shipped files.
std::filesystem::path assets();

/// The folder with the recording `name`, beside the checkout or in $VANTAGE_DATA; nothing, and a
/// message that says that the test is skipped, where it is missing.
std::optional<std::filesystem::path> recording(std::string_view name);

}  // namespace vantage::test
