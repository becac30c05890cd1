#pragma once

#include <map>
#include <string>
#include <vector>

#include "reconstruct/observed_scene.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Cameras that are mounted: located by the board once, and not anew in every picture, whose noise
/// would make all objects shake together. A camera that is really elsewhere is noticed.
class TrackedCameras {
 public:
  /// Gives the views of one instant the poses that their cameras have. Views without a pose get
  /// that of before.
  /// @returns warnings, one for each camera that was moved.
  std::vector<std::string> apply(const BopScene& scene, ObservedScene& observed);

 private:
  struct Mounted {
    Pose T_world_cam;
    Matrix6d covariance;
    bool by_board = false;
  };
  std::map<int, Mounted> cameras_;  // by image
};

}  // namespace vantage
