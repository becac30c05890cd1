#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage {

/// Every motion that leaves the object as it is, the identity first: BOP's
/// `get_symmetry_transformations`. Turns around a continuous symmetry are taken in steps in which
/// no vertex moves farther than `max_step` of the object's diameter; each discrete motion is
/// followed by each of these turns. Two continuous symmetries stand side by side; they are not
/// multiplied.
std::vector<Pose> symmetry_motions(const Symmetries& symmetries, double max_step = 0.01);

/// The largest distance between two vertices, metres; 0 for fewer than two.
double diameter_m(const std::vector<Eigen::Vector3d>& vertices);

/// What pose errors look at of an object. Object's frame, metres.
struct ErrorModel {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Pose> symmetries;  ///< the identity first
  double diameter_m = 0;
};

/// @throws Error bad_input for a mesh without vertices.
ErrorModel error_model(const TriangleMesh& mesh, const Symmetries& symmetries);

}  // namespace vantage
