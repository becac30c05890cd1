#include "scene/batch.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {
namespace {

std::string text(const Eigen::Vector3f& p) {
  return fmt::format("[{}, {}, {}]", p.x(), p.y(), p.z());
}

bool is_in_reach(const Eigen::Vector3f& p) {
  return in_reach(p.x(), p.y(), p.z());
}

}  // namespace

void refuse_segment(std::size_t index, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const bool zero = is_in_reach(from) && from == to;
  throw bad_input(
      fmt::format("segment {}", index),
      fmt::format("it goes from {} to {}; expected {}", text(from), text(to),
                  zero ? "two different points" : "finite coordinates within 1e9 m of the origin"));
}

void refuse_first_segment(PointsView from, const PointLanes& to) {
  for (std::size_t i = 0; i < from.size; ++i) {
    const Eigen::Vector3f o = from[i], t = to[i];
    if (!valid_segment(o.x(), o.y(), o.z(), t.x(), t.y(), t.z())) refuse_segment(i, o, t);
  }
  throw std::logic_error("no segment is invalid");
}

void refuse_first_ray(const PointLanes& origins, PointsView directions) {
  for (std::size_t i = 0; i < directions.size; ++i) {
    const Eigen::Vector3f o = origins[i], d = directions[i];
    if (valid_ray(o.x(), o.y(), o.z(), d.x(), d.y(), d.z())) continue;
    const bool zero = is_in_reach(o) && d.isZero(0);
    throw bad_input(fmt::format("ray {}", i),
                    fmt::format("its origin is {}, its direction {}; expected {}", text(o), text(d),
                                zero ? "a direction that is not zero"
                                     : "finite coordinates within 1e9 m of the origin"));
  }
  throw std::logic_error("no ray is invalid");
}

}  // namespace vantage::raycore::detail
