#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reconstruction/synthetic_views.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::test {

inline const Eigen::Vector3d kCubeSize(0.05, 0.05, 0.05);

inline std::vector<CameraView> aimed(const std::vector<Eigen::Vector3d>& eyes,
                                     const Eigen::Vector3d& target = {0, 0, 0}) {
  std::vector<CameraView> views;
  for (const Eigen::Vector3d& eye : eyes) {
    views.push_back({"camera " + std::to_string(views.size()),
                     Lens({640, 480, 615, 612, 320.5, 238.5}, {}), Pose::looking_at(eye, target)});
  }
  return views;
}

/// The pixels of a feature's points.
inline SeenPoints pixels_of(const CameraView& view, const ObjectFeature& feature,
                            const Pose& T_world_object, double sigma_px = 0.1) {
  SeenPoints seen{{}, sigma_px};
  for (const Eigen::Vector3d& point : feature.points()) {
    seen.pixels.push_back(
        view.lens.project(view.T_world_cam->inverse() * (T_world_object * point)));
  }
  return seen;
}

inline void see_points(CameraView& view, const ObjectType& type, std::size_t feature,
                       const Pose& T_world_object) {
  const ObjectFeature& what = type.features[feature];
  view.observations.push_back({what.key, pixels_of(view, what, T_world_object)});
}

inline void see_label(CameraView& view, const FeatureKey& key, const Eigen::Vector3d& p_world) {
  view.observations.push_back({key, SeenLabel{view.T_world_cam->inverse() * p_world, 0.002}});
}

inline ObjectFeature key_point(const std::string& name, const Eigen::Vector3d& p) {
  return {{"keypoint", name}, FeaturePoints{{p}}};
}

inline ObjectFeature label(const std::string& kind, const std::string& name) {
  return {{kind, name}, FeatureLabel{}};
}

inline TypePtr shared(ObjectType type) {
  return std::make_shared<const ObjectType>(std::move(type));
}

inline const ReconstructedObject* object_at(const Reconstruction& result, const PlacedObject& truth,
                                            double within_m) {
  for (const ReconstructedObject& object : result.objects) {
    const double off =
        (object.T_world_object.translation() - truth.T_world_object.translation()).norm();
    if (object.type->name == truth.type->name && off < within_m) return &object;
  }
  return nullptr;
}

inline void check_pose(const ReconstructedObject& object, const Pose& truth, double m, double rad) {
  const PoseError error = pose_error(*object.type, object.T_world_object, truth);
  CHECK(error.m < m);
  CHECK(error.rad < rad);
}

/// Every observation is at one place in the result.
inline void check_accounts(const std::vector<CameraView>& views, const Reconstruction& result) {
  std::vector<ObservationId> ids;
  for (const ReconstructedObject& object : result.objects) {
    for (const Support& support : object.support) ids.push_back(support.id);
  }
  for (const Unexplained& unexplained : result.unexplained) {
    ids.push_back(unexplained.id);
    CHECK_FALSE(unexplained.reason.empty());
  }
  std::sort(ids.begin(), ids.end());
  std::size_t next = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (std::size_t o = 0; o < views[v].observations.size(); ++o, ++next) {
      REQUIRE(next < ids.size());
      CHECK(ids[next] == ObservationId{v, o});
    }
  }
  CHECK(next == ids.size());
}

}  // namespace vantage::test
