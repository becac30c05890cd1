#include "metrics/reconstruction/camera_subsets.hpp"

#include <fmt/format.h>

#include <numeric>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMaxSubsets = 1'000'000;

/// The next subset of the same size in lexicographic order; false after the last one.
bool advance(CameraSubset& subset, std::size_t cameras) {
  for (std::size_t i = subset.size(); i-- > 0;) {
    if (subset[i] + (subset.size() - i) >= cameras) continue;  // as far right as it can be
    std::iota(subset.begin() + std::ptrdiff_t(i), subset.end(), subset[i] + 1);
    return true;
  }
  return false;
}

}  // namespace

std::vector<CameraSubset> camera_subsets(std::size_t cameras, std::size_t least, std::size_t most) {
  if (least < 1 || least > most || most > cameras) {
    throw bad_input("cameras", fmt::format("found subsets of {} to {} cameras; expected 1 to {}, "
                                           "as many as there are, the smaller one first",
                                           least, most, cameras));
  }
  std::vector<CameraSubset> subsets;
  for (std::size_t size = least; size <= most; ++size) {
    CameraSubset subset(size);
    std::iota(subset.begin(), subset.end(), std::size_t(0));
    do {
      if (subsets.size() == kMaxSubsets) {
        throw Error(ErrorCode::out_of_resources, "cameras",
                    fmt::format("{} cameras have more than {} subsets; ask for fewer cameras or "
                                "smaller subsets",
                                cameras, kMaxSubsets));
      }
      subsets.push_back(subset);
    } while (advance(subset, cameras));
  }
  return subsets;
}

}  // namespace vantage
