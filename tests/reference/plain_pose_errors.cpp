#include "reference/plain_pose_errors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/moller_trumbore.hpp"

namespace vantage::test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

Vector3d moved(const Matrix4d& motion, const Vector3d& point) {
  return (motion * point.homogeneous()).head<3>();
}

Eigen::Vector2d pixel(const Eigen::Matrix3d& k, const Vector3d& p_cam) {
  return (k * p_cam).hnormalized();
}

template <class Distance>
double least_of_largest(const Points& points, const Motions& symmetries, Distance&& distance) {
  double least = std::numeric_limits<double>::infinity();
  for (const Matrix4d& symmetry : symmetries) {
    double largest = 0;
    for (const Vector3d& point : points) {
      largest = std::max(largest, distance(point, moved(symmetry, point)));
    }
    least = std::min(least, largest);
  }
  return least;
}

/// Distance from the camera to the mesh along each pixel's ray; 0: nothing there.
std::vector<double> ranges(const TriangleMesh& mesh, const Pose& T_cam_object,
                           const Intrinsics& camera) {
  ReferenceScene scene;
  scene.add(mesh, T_cam_object, 0);
  std::vector<double> result;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      double nearest = 0;
      for (const WorldTriangle& triangle : scene.triangles()) {
        const Crossing crossing = triangle.cross(Vector3d::Zero(), ray.normalized());
        if (crossing.margin_m < 0 || crossing.t <= 0) continue;
        if (nearest == 0 || crossing.t < nearest) nearest = crossing.t;
      }
      result.push_back(nearest);
    }
  }
  return result;
}

}  // namespace

Matrix4d matrix_of(const Pose& pose) {
  Matrix4d matrix = Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation();
  matrix.topRightCorner<3, 1>() = pose.translation();
  return matrix;
}

double plain_rotation_error_rad(const Matrix4d& estimate, const Matrix4d& truth) {
  const Eigen::Matrix3d turn =
      estimate.topLeftCorner<3, 3>() * truth.topLeftCorner<3, 3>().inverse();
  return std::acos(std::clamp((turn.trace() - 1) / 2, -1.0, 1.0));
}

double plain_add(const Points& points, const Matrix4d& estimate, const Matrix4d& truth) {
  double sum = 0;
  for (const Vector3d& point : points) sum += (moved(estimate, point) - moved(truth, point)).norm();
  return sum / double(points.size());
}

double plain_add_s(const Points& points, const Matrix4d& estimate, const Matrix4d& truth) {
  double sum = 0;
  for (const Vector3d& from : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& to : points) {
      least = std::min(least, (moved(truth, from) - moved(estimate, to)).norm());
    }
    sum += least;
  }
  return sum / double(points.size());
}

double plain_mssd(const Points& points, const Motions& symmetries, const Matrix4d& estimate,
                  const Matrix4d& truth) {
  return least_of_largest(points, symmetries, [&](const Vector3d& point, const Vector3d& turned) {
    return (moved(estimate, point) - moved(truth, turned)).norm();
  });
}

double plain_mspd(const Points& points, const Motions& symmetries, const Matrix4d& estimate,
                  const Matrix4d& truth, const Eigen::Matrix3d& k) {
  return least_of_largest(points, symmetries, [&](const Vector3d& point, const Vector3d& turned) {
    return (pixel(k, moved(estimate, point)) - pixel(k, moved(truth, turned))).norm();
  });
}

double plain_diameter(const Points& points) {
  double widest = 0;
  for (const Vector3d& a : points) {
    for (const Vector3d& b : points) widest = std::max(widest, (a - b).norm());
  }
  return widest;
}

double plain_vsd(const TriangleMesh& mesh, const Pose& estimate, const Pose& truth,
                 const std::vector<float>& scene_depth, const Intrinsics& camera, double diameter,
                 double delta, double tau) {
  const std::vector<double> estimated = ranges(mesh, estimate, camera);
  const std::vector<double> real = ranges(mesh, truth, camera);
  double cost = 0, count = 0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    const int u = int(i) % camera.width, v = int(i) / camera.width;
    const double scale =
        Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1).norm();
    const double scene = double(scene_depth[i]) * scale;
    const auto not_hidden = [&](double range) { return scene == 0 || range - scene <= delta; };
    const bool in_real = real[i] > 0 && not_hidden(real[i]);
    const bool in_estimated = estimated[i] > 0 && (not_hidden(estimated[i]) || in_real);
    if (!in_real && !in_estimated) continue;
    ++count;
    const bool both = in_real && in_estimated;
    cost += !both || std::abs(real[i] - estimated[i]) / diameter >= tau ? 1 : 0;
  }
  return count == 0 ? 1 : cost / count;
}

}  // namespace vantage::test
