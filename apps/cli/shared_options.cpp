#include "cli/shared_options.hpp"

#include <fmt/format.h>

namespace vantage {

void add_threads_option(CLI::App& verb, int& threads) {
  verb.add_option("--threads", threads, "Number of threads; 0: one for each core")
      ->check(CLI::Range(0, 1024))
      ->group("Run");
}

CLI::Option* add_output_option(CLI::App& verb, std::filesystem::path& folder,
                               const std::string& content) {
  return verb.add_option("-o,--output", folder, "Folder for " + content + "; created if missing")
      ->option_text("FOLDER")
      ->group("Output");
}

void add_json_flag(CLI::App& verb, bool& json, const std::string& file) {
  verb.add_flag("--json", json, fmt::format("Print {} on stdout instead of a summary", file))
      ->group("Output");
}

void add_images_option(CLI::App& verb, std::vector<int>& images) {
  verb.add_option("--images", images, "Use only these images of the dataset, e.g. 0,20,40")
      ->delimiter(',')
      ->group("Input");
}

}  // namespace vantage
