#include "pnp/minimal_samples.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "pose/principal_axes.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr std::size_t kMaxTriples = 200;  // for each view and type
constexpr double kMinExtent = 1e-3;       // collinear: second largest extent over the largest

using Readings = std::vector<const Correspondence*>;

bool enough_for_a_pose(const Correspondence& correspondence) {
  if (correspondence.measurement->pose()) return true;
  const auto& points = correspondence.points_m;
  if (points.size() < 4) return false;
  const Eigen::Vector3d extents = principal_axes(points).extents;
  return extents[1] > kMinExtent * extents[0];
}

double size_px(const Readings& correspondences) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Correspondence* correspondence : correspondences) {
    const SeenPoints* seen = correspondence->measurement->points();
    if (!seen) return std::numeric_limits<double>::infinity();  // as good as a pose can be
    for (const Eigen::Vector2d& pixel : seen->pixels) {
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  }
  return (high - low).norm();
}

/// Seeds by their measurements.
class Collector {
 public:
  void add(Readings correspondences) {
    std::vector<std::size_t> numbers;
    for (const Correspondence* correspondence : correspondences)
      numbers.push_back(correspondence->number);
    SampleGroup& group = groups_[numbers];
    group.size_px = size_px(correspondences);
    group.numbers = std::move(numbers);
    group.samples.emplace_back(std::move(correspondences));
  }

  std::vector<SampleGroup> sorted() {
    std::vector<SampleGroup> groups;
    for (auto& [numbers, group] : groups_) groups.push_back(std::move(group));
    std::stable_sort(groups.begin(), groups.end(), [](const SampleGroup& a, const SampleGroup& b) {
      return a.size_px > b.size_px;
    });
    return groups;
  }

 private:
  std::map<std::vector<std::size_t>, SampleGroup> groups_;
};

/// Measurements of few points in one view, read as one type: all of them, if they may be one
/// object, and three at a time.
void add_joined(const Readings& few, Collector& collector) {
  bool one_object = few.size() > 3;
  for (std::size_t i = 0; i < few.size(); ++i) {
    for (std::size_t j = i + 1; j < few.size(); ++j) {
      one_object = one_object && go_together(*few[i], *few[j]);
    }
  }
  if (one_object) collector.add(few);
  std::size_t triples = 0;
  for (std::size_t k = 2; k < few.size(); ++k) {
    for (std::size_t j = 1; j < k; ++j) {
      for (std::size_t i = 0; i < j && triples < kMaxTriples; ++i) {
        if (!go_together(*few[i], *few[j]) || !go_together(*few[i], *few[k]) ||
            !go_together(*few[j], *few[k])) {
          continue;
        }
        collector.add({few[i], few[j], few[k]});
        ++triples;
      }
    }
  }
}

}  // namespace

const std::vector<Pose>& MinimalSample::poses() {
  if (poses_) return *poses_;
  poses_.emplace();
  const Measurement& first = *correspondences_.front()->measurement;
  const Pose& T_world_cam = *first.view->T_world_cam;
  if (const SeenPose* seen = first.pose()) {
    poses_->push_back(T_world_cam * seen->T_cam_feature *
                      correspondences_.front()->T_object_feature.inverse());
    return *poses_;
  }
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  for (const Correspondence* correspondence : correspondences_) {
    const auto& seen = correspondence->measurement->points()->pixels;
    points.insert(points.end(), correspondence->points_m.begin(), correspondence->points_m.end());
    pixels.insert(pixels.end(), seen.begin(), seen.end());
  }
  for (const PoseGuess& guess : solve_pnp(first.view->lens, points, pixels)) {
    poses_->push_back(T_world_cam * guess.T_cam_body);
  }
  return *poses_;
}

std::vector<SampleGroup> find_minimal_samples(const std::vector<Correspondence>& correspondences) {
  Collector collector;
  std::map<std::pair<std::size_t, std::string>, Readings> few;
  for (const Correspondence& correspondence : correspondences) {
    if (enough_for_a_pose(correspondence)) {
      collector.add({&correspondence});
    } else {
      few[{correspondence.measurement->id.view, correspondence.type().name}].push_back(
          &correspondence);
    }
  }
  for (const auto& [place, of_one_view] : few) add_joined(of_one_view, collector);
  return collector.sorted();
}

}  // namespace vantage::reconstruction::detail
