#include "pnp/minimal_samples.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "pose/principal_axes.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage::detail {
namespace {

constexpr std::size_t kMostTriples = 200;  // for each view and type
constexpr double kLeastExtent = 1e-3;      // collinear: second largest extent over the largest

using Readings = std::vector<const Reading*>;

bool enough_for_a_pose(const Reading& reading) {
  if (reading.sighting->pose()) return true;
  const auto& points = reading.points_m;
  if (points.size() < 4) return false;
  const Eigen::Vector3d extents = principal_axes(points).extents;
  return extents[1] > kLeastExtent * extents[0];
}

double size_px(const Readings& readings) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Reading* reading : readings) {
    const SeenPoints* seen = reading->sighting->points();
    if (!seen) return std::numeric_limits<double>::infinity();  // as good as a pose can be
    for (const Eigen::Vector2d& pixel : seen->pixels) {
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  }
  return (high - low).norm();
}

/// Seeds by their sightings.
class Collector {
 public:
  void add(Readings readings) {
    std::vector<std::size_t> numbers;
    for (const Reading* reading : readings) numbers.push_back(reading->number);
    SeedGroup& group = groups_[numbers];
    group.size_px = size_px(readings);
    group.numbers = std::move(numbers);
    group.seeds.emplace_back(std::move(readings));
  }

  std::vector<SeedGroup> sorted() {
    std::vector<SeedGroup> groups;
    for (auto& [numbers, group] : groups_) groups.push_back(std::move(group));
    std::stable_sort(groups.begin(), groups.end(),
                     [](const SeedGroup& a, const SeedGroup& b) { return a.size_px > b.size_px; });
    return groups;
  }

 private:
  std::map<std::vector<std::size_t>, SeedGroup> groups_;
};

/// Sightings of few points in one view, read as one type: all of them, if they may be one object,
/// and three at a time.
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
      for (std::size_t i = 0; i < j && triples < kMostTriples; ++i) {
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

const std::vector<Pose>& Seed::poses() {
  if (poses_) return *poses_;
  poses_.emplace();
  const Sighting& first = *readings_.front()->sighting;
  const Pose& T_world_cam = *first.view->T_world_cam;
  if (const SeenPose* seen = first.pose()) {
    poses_->push_back(T_world_cam * seen->T_cam_feature *
                      readings_.front()->T_object_feature.inverse());
    return *poses_;
  }
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  for (const Reading* reading : readings_) {
    const auto& seen = reading->sighting->points()->pixels;
    points.insert(points.end(), reading->points_m.begin(), reading->points_m.end());
    pixels.insert(pixels.end(), seen.begin(), seen.end());
  }
  for (const PoseGuess& guess : guess_poses(first.view->lens, points, pixels)) {
    poses_->push_back(T_world_cam * guess.T_cam_body);
  }
  return *poses_;
}

std::vector<SeedGroup> find_seeds(const std::vector<Reading>& readings) {
  Collector collector;
  std::map<std::pair<std::size_t, std::string>, Readings> few;
  for (const Reading& reading : readings) {
    if (enough_for_a_pose(reading)) {
      collector.add({&reading});
    } else {
      few[{reading.sighting->id.view, reading.type().name}].push_back(&reading);
    }
  }
  for (const auto& [place, of_one_view] : few) add_joined(of_one_view, collector);
  return collector.sorted();
}

}  // namespace vantage::detail
