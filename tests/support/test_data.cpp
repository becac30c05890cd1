#include "support/test_data.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace vantage::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "vantage-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(std::string_view name, std::string_view bytes) const {
  const fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
  return file;
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

fs::path assets() {
  return VANTAGE_ASSETS;
}

std::optional<fs::path> recording(std::string_view name) {
  const char* data = std::getenv("VANTAGE_DATA");
  const fs::path folder =
      (data != nullptr ? fs::path(data) : fs::path(VANTAGE_DATA_DEFAULT)) / name;
  if (fs::is_directory(folder)) return folder;
  MESSAGE("SKIPPED: the recording " << folder.string() << " is not here");
  return std::nullopt;
}

}  // namespace vantage::test
