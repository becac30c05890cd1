#include "images/numbered_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <initializer_list>
#include <string_view>

namespace vantage::reconstruction::detail {
namespace {

namespace fs = std::filesystem;

bool ends_in(const fs::path& file, std::initializer_list<std::string_view> endings) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(endings, ending) != endings.end();
}

/// Nothing for a name that is more than digits.
std::optional<int> number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  int number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc() || end != stem.data() + stem.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

bool is_color_image(const fs::path& file) {
  return ends_in(file, {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp"});
}

bool is_depth_image(const fs::path& file) {
  return ends_in(file, {".png", ".tif", ".tiff", ".exr", ".npy"});
}

NumberedImages::NumberedImages(const fs::path& folder, bool (*is_image)(const fs::path&))
    : folder_(folder), exists_(fs::is_directory(folder)) {
  if (!exists_) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    names_.push_back(file.filename().string());
    const auto number = number_of(file);
    if (!number || !is_image(file)) continue;
    // PNG before the others, as BOP has it; else by the alphabet.
    const auto rank = [](const fs::path& f) { return std::pair(!ends_in(f, {".png"}), f); };
    const auto [place, is_new] = by_number_.try_emplace(*number, file);
    if (!is_new && rank(file) < rank(place->second)) place->second = file;
  }
  std::ranges::sort(names_);
}

std::optional<fs::path> NumberedImages::find(int number) const {
  const auto found = by_number_.find(number);
  return found == by_number_.end() ? std::nullopt : std::optional(found->second);
}

std::string NumberedImages::contents() const {
  if (!exists_) return "no such folder";
  if (names_.empty()) return "the folder is empty";
  const std::string more =
      names_.size() > 1 ? fmt::format(" and {} more", names_.size() - 1) : std::string();
  return "the folder has " + names_.front() + more;
}

}  // namespace vantage::reconstruction::detail
