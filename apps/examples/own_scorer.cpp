// A scorer of your own: the more of some given points a view sees, the better. Here they are screws
// along the foot of a wall, on the side that the camera does not see.
#include <cstdio>
#include <vantage/planner/advanced/view_search.hpp>
#include <vantage/volume/advanced/classify.hpp>

using namespace vantage;

class PointScorer final : public ViewScorer {
 public:
  PointScorer(std::shared_ptr<const Scene> scene, std::vector<Eigen::Vector3f> points)
      : scene_(std::move(scene)), points_(std::move(points)) {}
  std::string_view name() const noexcept override { return "points"; }
  double unit() const noexcept override { return 1; }
  std::string_view unit_name() const noexcept override { return "points"; }
  /// Cheap, and never below the score: as if nothing hid anything.
  Score upper_bound(const PinholeCamera& view) const override { return count(view, false); }
  void score(std::span<const PinholeCamera> views, std::span<const Score>,
             std::span<ScoreBound> results, const StopToken&) const override {
    for (std::size_t i = 0; i < views.size(); ++i) {
      results[i] = {ScoreBound::Known::exact, count(views[i], true)};
    }
  }
  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override {
    return {{"points in the image", double(upper_bound(view))}};
  }

 private:
  Score count(const PinholeCamera& view, bool occlusion) const {
    const Eigen::Vector3f eye = view.centre().cast<float>();
    Score sum = 0;
    for (const Eigen::Vector3f& p : points_) {
      sum += view.in_view(p) && !(occlusion && scene_->occluded(p, eye));
    }
    return sum;
  }
  std::shared_ptr<const Scene> scene_;
  std::vector<Eigen::Vector3f> points_;
};

int main() {
  const Box area({-0.3, -0.3, 0}, {0.3, 0.3, 0.3});
  WorldModel world;
  const Box wall({-0.2, -0.02, 0}, {0.2, 0.02, 0.2});
  world.objects.push_back(
      {"wall", std::make_shared<TriangleMesh>(TriangleMesh::from_box(wall)), {}});
  std::vector<Eigen::Vector3f> screws;
  for (int i = -9; i <= 9; ++i) screws.push_back({0.02f * float(i), 0.03f, 0.01f});
  const PinholeCamera camera({320, 240, 300, 300, 159.5, 119.5}, {});
  const PlanningScene scene(world, classify(world, GridGeometry::covering(area, 0.01)), {});
  const auto scorer = std::make_shared<PointScorer>(known_scene(world), screws);
  const auto validity =
      std::make_shared<ViewValidityChecker>(ViewConstraints{}, scene, camera.range());
  const ViewSearch search(scorer, validity, nullptr, camera, {.ranked = 1});
  const auto found = search.run(view_candidates(production_views(), area));
  if (found.ranked.empty()) return 4;
  const Eigen::Vector3d eye = found.ranked[0].T_world_cam.translation();
  std::printf("from (%.2f, %.2f, %.2f) m: %d of %zu screws\n", eye.x(), eye.y(), eye.z(),
              int(found.ranked[0].score), screws.size());
}
