#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

/// BOP's pose errors with matrices and loops, as the papers print them. Motions are 4 × 4.
using Points = std::vector<Eigen::Vector3d>;
using Motions = std::vector<Eigen::Matrix4d>;

Eigen::Matrix4d matrix_of(const Pose& pose);

double plain_rotation_error_rad(const Eigen::Matrix4d& estimate, const Eigen::Matrix4d& truth);
double plain_add(const Points& points, const Eigen::Matrix4d& estimate,
                 const Eigen::Matrix4d& truth);
double plain_add_s(const Points& points, const Eigen::Matrix4d& estimate,
                   const Eigen::Matrix4d& truth);
double plain_mssd(const Points& points, const Motions& symmetries, const Eigen::Matrix4d& estimate,
                  const Eigen::Matrix4d& truth);
double plain_mspd(const Points& points, const Motions& symmetries, const Eigen::Matrix4d& estimate,
                  const Eigen::Matrix4d& truth, const Eigen::Matrix3d& k);
double plain_diameter(const Points& points);

/// VSD with a ray for each pixel and each triangle; scene depths of 0 are unknown.
double plain_vsd(const TriangleMesh& mesh, const Pose& estimate, const Pose& truth,
                 const std::vector<float>& scene_depth, const Intrinsics& camera, double diameter,
                 double delta, double tau);

}  // namespace vantage::test
