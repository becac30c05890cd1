#include "cli/inputs_json.hpp"

#include <set>

#include "cli/sha256.hpp"

namespace vantage {

nlohmann::ordered_json inputs_json(const std::vector<std::filesystem::path>& files) {
  nlohmann::ordered_json inputs = nlohmann::ordered_json::array();
  std::set<std::filesystem::path> known;
  for (const std::filesystem::path& file : files) {
    if (!known.insert(file).second) continue;
    inputs.push_back({{"path", file.string()}, {"sha256", sha256_of_file(file)}});
  }
  return inputs;
}

}  // namespace vantage
