#include "calibration/calibration_document.hpp"

#include <cstdint>
#include <vector>

#include "documents/json_document.hpp"
#include "documents/yaml_document.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {

Document read_calibration_document(const std::filesystem::path& file) {
  // Calibration tools write all the corners that they saw beside the result.
  constexpr DocumentLimits kLimits = {.max_values = 4'000'000};
  const std::vector<std::uint8_t> bytes = read_file(file, kLimits.max_bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) {
    throw bad_input(file.string(),
                    "the file is empty; expected a calibration as YAML, JSON or XML");
  }
  if (text[start] == '<') {
    return parse_opencv_xml(text, file.string());
  }
  if (file.extension() == ".json") return parse_json(text, file.string(), kLimits);
  return parse_yaml(text, file.string(), {.limits = kLimits, .ignore_tags = true});
}

}  // namespace vantage::reconstruction::detail
