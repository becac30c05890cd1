#include "reconstruct/missing_markers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "vantage/reconstruction/detector.hpp"
#include "workcell/marker_dictionaries.hpp"

namespace vantage {
namespace {

constexpr std::size_t kConvincing = 3;  ///< different markers: a small dictionary misreads some

ColorImage mirrored(const ColorImage& picture) {
  ColorImage result = picture;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      std::copy_n(picture.pixel(picture.width - 1 - u, v), 3, result.pixel(u, v));
    }
  }
  return result;
}

/// The values of the markers that are seen, e.g. "5X5/7".
std::set<std::string> markers_in(const ColorImage& picture,
                                 const std::vector<std::string>& dictionaries) {
  std::set<std::string> values;
  for (const Observation& seen : ArucoDetector({dictionaries}).detect(picture)) {
    values.insert(seen.key.value);
  }
  return values;
}

}  // namespace

std::string missing_markers_hint(const ColorImage& picture,
                                 const std::vector<std::string>& dictionaries) {
  if (markers_in(mirrored(picture), dictionaries).size() >= kConvincing) {
    return "the picture is mirrored: flipped left to right, it shows markers of the dictionary";
  }
  std::map<std::string, std::vector<std::string>> by_family;
  for (const std::string& value : markers_in(picture, largest_dictionaries())) {
    by_family[value.substr(0, value.find('/'))].push_back(value);
  }
  const auto most = std::ranges::max_element(
      by_family, {}, [](const auto& family) { return family.second.size(); });
  if (most == by_family.end() || most->second.size() < kConvincing) return {};
  return fmt::format("the picture shows the markers {}: is the board from another dictionary?",
                     fmt::join(most->second, ", "));
}

}  // namespace vantage
