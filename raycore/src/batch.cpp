#include "batch.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "vantage/raycore/error.hpp"

namespace vantage::detail {
namespace {

std::string text(const Eigen::Vector3f& p) {
  return fmt::format("[{}, {}, {}]", p.x(), p.y(), p.z());
}

bool in_reach(const Eigen::Vector3f& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthestCoordinate;
}

bool valid(const Eigen::Vector3f& o, const Eigen::Vector3f& d) {
  return valid_ray(o.x(), o.y(), o.z(), d.x(), d.y(), d.z());
}

}  // namespace

void check_batch_size(const char* what, std::size_t size, std::size_t expected) {
  if (size == expected) return;
  throw bad_input("batch", fmt::format("{} has {} elements; expected {}", what, size, expected));
}

void refuse_first_segment(PointsView from, const PointLanes& to) {
  for (std::size_t i = 0; i < from.size; ++i) {
    if (valid(from[i], to[i] - from[i])) continue;
    const bool zero = in_reach(from[i]) && from[i] == to[i];
    throw bad_input(fmt::format("segment {}", i),
                    fmt::format("it goes from {} to {}; expected {}", text(from[i]), text(to[i]),
                                zero ? "two different points"
                                     : "finite coordinates within 1e9 m of the origin"));
  }
  throw std::logic_error("no segment is invalid");
}

void refuse_first_ray(const PointLanes& origins, PointsView directions) {
  for (std::size_t i = 0; i < directions.size; ++i) {
    if (valid(origins[i], directions[i])) continue;
    const bool zero = in_reach(origins[i]) && directions[i].isZero(0);
    throw bad_input(fmt::format("ray {}", i),
                    fmt::format("its origin is {}, its direction {}; expected {}", text(origins[i]),
                                text(directions[i]),
                                zero ? "a direction that is not zero"
                                     : "finite coordinates within 1e9 m of the origin"));
  }
  throw std::logic_error("no ray is invalid");
}

}  // namespace vantage::detail
