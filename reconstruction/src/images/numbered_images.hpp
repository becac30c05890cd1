#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vantage::reconstruction::detail {

/// Whether the file's ending, in upper or lower case, is that of a colour image that we read.
bool is_color_image(const std::filesystem::path& file);

/// Whether it is that of a depth image that we read.
bool is_depth_image(const std::filesystem::path& file);

/// The files of a folder whose names are numbers, such as 000012.png. A folder that is not there
/// has none.
class NumberedImages {
 public:
  /// @param is_image which files count, e.g. `is_depth_image`.
  NumberedImages(const std::filesystem::path& folder,
                 bool (*is_image)(const std::filesystem::path&));

  const std::filesystem::path& folder() const { return folder_; }
  bool exists() const { return exists_; }

  /// Nothing if there is none. Of several with one number: PNG, then by the alphabet.
  std::optional<std::filesystem::path> find(int number) const;

  /// What is in the folder, for a message about one that is missing: "000000.gif and 12 more".
  std::string contents() const;

 private:
  std::filesystem::path folder_;
  bool exists_;
  std::map<int, std::filesystem::path> by_number_;
  std::vector<std::string> names_;  ///< of everything, sorted
};

}  // namespace vantage::reconstruction::detail
