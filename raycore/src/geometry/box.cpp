#include "vantage/raycore/box.hpp"

#include <fmt/format.h>

#include <string>

#include "geometry/coordinates.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

Box::Box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, std::string_view where)
    : min_(min), max_(max) {
  // Written so that NaN fails.
  if (min_.allFinite() && max_.allFinite() && (min_.array() < max_.array()).all()) return;
  throw bad_input(
      std::string(where),
      fmt::format("min {} and max {} give the size {}; expected finite corners in metres with "
                  "min < max along x, y and z",
                  raycore::detail::to_text(min_), raycore::detail::to_text(max_),
                  raycore::detail::to_text(size())));
}

bool Box::contains(const Eigen::Vector3d& point) const {
  return (point.array() >= min_.array()).all() && (point.array() <= max_.array()).all();
}

}  // namespace vantage
