// Two cameras see the markers of a cube: where does it stand, and how certain is that?
#include <cmath>
#include <cstdio>
#include <vantage/reconstruction/reconstruct.hpp>

namespace {

/// A cube of 5 cm with a marker of 3.2 cm on top (id 14) and on its front (id 13).
vantage::ObjectType red_cube() {
  vantage::ObjectType cube{"red_cube", {"cube"}};
  cube.mesh = std::make_shared<const vantage::TriangleMesh>(
      vantage::TriangleMesh::from_box({{-0.025, -0.025, -0.025}, {0.025, 0.025, 0.025}}));
  const Eigen::Matrix3d front = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).matrix();
  cube.features.push_back(vantage::marker_feature(
      {"4X4_250", 14, 0.032, vantage::Pose::from_translation({0, 0, 0.025})}));
  cube.features.push_back(vantage::marker_feature(
      {"4X4_250", 13, 0.032, vantage::Pose::from_rotation(front, {0, -0.025, 0})}));
  return cube;
}

/// Stands in for a detector: the corners of all markers where the camera sees them.
vantage::CameraView look(const char* name, const Eigen::Vector3d& eye,
                         const vantage::ObjectType& type, const vantage::Pose& T_world_object) {
  vantage::CameraView view{name, vantage::Lens({640, 480, 600, 600, 319.5, 239.5}, {})};
  view.T_world_cam = vantage::Pose::looking_at(eye, {0, 0, 0});
  for (const vantage::ObjectFeature& feature : type.features) {
    vantage::SeenPoints seen;
    for (const Eigen::Vector3d& p_object : feature.points()) {
      seen.pixels.push_back(
          view.lens.project(view.T_world_cam->inverse() * (T_world_object * p_object)));
    }
    view.observations.push_back({feature.key, seen});
  }
  return view;
}

}  // namespace

int main() {
  const vantage::ObjectType cube = red_cube();
  const auto truth = vantage::Pose::from_translation({0.10, 0.05, 0.025});
  const std::vector<vantage::CameraView> views{look("left", {-0.4, -0.6, 0.5}, cube, truth),
                                               look("right", {0.5, -0.5, 0.4}, cube, truth)};

  const vantage::MemoryKnowledgeBase knowledge({cube});
  const vantage::Reconstruction found = vantage::reconstruct_pnp(views, knowledge);
  for (const vantage::ReconstructedObject& object : found.objects) {
    const Eigen::Vector3d at = object.T_world_object.translation();
    const Eigen::Vector3d sigma_m = object.covariance->diagonal().head<3>().cwiseSqrt();
    std::printf("%s at (%.3f, %.3f, %.3f) m, ± %.2f mm, by %zu markers\n",
                object.type->name.c_str(), at.x(), at.y(), at.z(), 1e3 * sigma_m.maxCoeff(),
                object.support.size());
  }
  return found.objects.size() == 1 ? 0 : 1;
}
