#include "process/output_folder.hpp"

#include <system_error>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    const bool full = error == std::errc::no_space_on_device ||
                      error == std::errc::not_enough_memory || error.value() == EDQUOT;
    throw Error(full ? ErrorCode::out_of_resources : ErrorCode::bad_input, folder.string(),
                "cannot create this folder: " + error.message());
  }
  remove_abandoned_files(folder);
}

}  // namespace vantage
