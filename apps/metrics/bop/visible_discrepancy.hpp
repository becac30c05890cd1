#pragma once

#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// BOP's thresholds: 0.05, 0.1, …, 0.5; of VSD's misalignment and of what counts as correct.
std::vector<double> bop_thresholds();

/// How the visible surface discrepancy is measured.
struct VsdOptions {
  double delta_m = 0.015;  ///< so far behind the scene's depth a surface still counts as visible
  std::vector<double> taus = bop_thresholds();  ///< misalignments, shares of the diameter
};

/// What is seen of an object in one camera's image: range (not depth) for every pixel, row-major,
/// 0 where the object is not.
struct ObjectView {
  std::vector<double> range_m;
};

/// The object alone, at T_cam_object, as an ideal camera sees it.
ObjectView view_of(const TriangleMesh& mesh, const Pose& T_cam_object, const Intrinsics& camera);

/// Where an object at its true pose is visible in a scene (BOP's mode "bop19"): a pixel without
/// depth hides nothing.
std::vector<bool> visible_mask(const ObjectView& object, const DepthImage& scene,
                               const Intrinsics& camera, double delta_m);

/// BOP's visible fraction: how much of the object's silhouette in the image is visible; 0 if it is
/// not in the image.
double visible_fraction(const ObjectView& object, const DepthImage& scene, const Intrinsics& camera,
                        double delta_m);

/// VSD: the share of the surface seen at either pose that is not seen at both, or is misaligned by
/// tau or more (cost "step"); one error, 0 to 1, for each tau. 1 if nothing is visible.
/// @param scene what the camera measured of the whole scene; unknown depth hides nothing.
/// @throws Error bad_input if `scene` and `camera` differ in size.
std::vector<double> vsd(const ObjectView& estimate, const ObjectView& truth,
                        const DepthImage& scene, const Intrinsics& camera, double diameter_m,
                        const VsdOptions& options = {});

}  // namespace vantage
