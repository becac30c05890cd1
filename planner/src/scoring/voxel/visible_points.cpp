#include "vantage/planner/advanced/visible_points.hpp"

#include <fmt/format.h>

#include <bit>

#include "scoring/voxel/point_hierarchy.hpp"
#include "scoring/voxel/view_frustum.hpp"
#include "scoring/voxel/visibility_counter.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

const Points& checked(const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = points[i];
    if (p.allFinite()) continue;
    throw bad_input(fmt::format("point {}", i), fmt::format("it is at [{}, {}, {}]; expected "
                                                            "finite coordinates",
                                                            p.x(), p.y(), p.z()));
  }
  return points;
}

void check_views(std::span<const PinholeCamera> views, std::size_t needed, std::size_t results) {
  if (views.size() != needed || views.size() != results) {
    throw bad_input("views", fmt::format("{} views, {} needed scores, {} results; expected as many "
                                         "of each",
                                         views.size(), needed, results));
  }
  for (std::size_t i = 1; i < views.size(); ++i) {
    if (views[i].centre() == views[0].centre()) continue;
    throw bad_input("views", fmt::format("the centre of view {} differs from that of view 0; "
                                         "expected views that share one centre",
                                         i));
  }
}

}  // namespace

struct VisiblePoints::Impl {
  std::vector<Obstacles> obstacles;
  planner::detail::PointPackets set;
};

VisiblePoints::VisiblePoints(Points points, std::shared_ptr<const Scene> occluders)
    : VisiblePoints(std::move(points), std::vector<Obstacles>{{std::move(occluders)}}) {}
VisiblePoints::VisiblePoints(Points points, std::vector<Obstacles> obstacles)
    : impl_(std::make_unique<const Impl>(
          Impl{std::move(obstacles), planner::detail::PointPackets(checked(points))})) {}
VisiblePoints::~VisiblePoints() = default;
VisiblePoints::VisiblePoints(VisiblePoints&&) noexcept = default;
VisiblePoints& VisiblePoints::operator=(VisiblePoints&&) noexcept = default;

std::size_t VisiblePoints::size() const noexcept {
  return impl_->set.size;
}

Score VisiblePoints::upper_bound(const PinholeCamera& view) const {
  const planner::detail::PointPackets& set = impl_->set;
  const planner::detail::ViewFrustum frustum(view, set.largest_coordinate);
  Score bound = 0;
  planner::detail::for_each_box(
      set, frustum, [&](std::size_t level, std::size_t box, planner::detail::InView in) {
        if (in != planner::detail::InView::none) bound += set.points_below(level, box);
        return true;
      });
  return bound;
}

void VisiblePoints::count(std::span<const PinholeCamera> views, std::span<const Score> needed,
                          std::span<ScoreBound> results, const StopToken& stop) const {
  check_views(views, needed.size(), results.size());
  if (views.empty()) return;
  planner::detail::ViewCounter(impl_->set, impl_->obstacles, views, needed).run(stop, results);
}

void VisiblePoints::count(std::span<const PinholeCamera> views, std::span<const Score> needed,
                          std::span<ScoreBound> results, std::span<VisibleMasks> seen,
                          const StopToken& stop) const {
  check_views(views, needed.size(), results.size());
  if (seen.size() != views.size())
    throw bad_input("views", "expected one element of `seen` for each view");
  if (views.empty()) return;
  planner::detail::ViewCounter counter(impl_->set, impl_->obstacles, views, needed);
  counter.keep(seen);
  counter.run(stop, results);
}

PointsView VisiblePoints::ordered_points() const noexcept {
  return impl_->set.points;
}

std::vector<std::uint8_t> VisiblePoints::visible(const PinholeCamera& view) const {
  const planner::detail::PointPackets& set = impl_->set;
  std::vector<std::uint8_t> result(set.size);
  const std::vector<std::uint16_t> in_view = in_view_masks(set, view);
  std::vector<std::uint16_t> hidden(set.packets());
  planner::detail::SegmentTracer(set.points, impl_->obstacles)
      .occluded(view.centre(), set.spread, in_view, hidden);
  for (std::size_t i = 0; i < set.packets(); ++i) {
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
      if (((in_view[i] & ~hidden[i]) >> lane & 1) == 0) continue;
      result[set.original[set.spread[i] * kPacketWidth + lane]] = 1;
    }
  }
  return result;
}

std::uint64_t VisiblePoints::count_in_view(const PinholeCamera& view) const {
  std::uint64_t count = 0;
  for (const std::uint16_t mask : in_view_masks(impl_->set, view)) {
    count += std::uint64_t(std::popcount(mask));
  }
  return count;
}

}  // namespace vantage
