#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scoring/voxel/box_soa.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::planner::detail {

/// A triangle or a rectangle. Metres, world frame.
struct FaceCorners {
  std::array<Eigen::Vector3d, 4>
      corners;             ///< around the face; a triangle's last one is there twice
  Eigen::Vector3d normal;  ///< outwards, of length 1
};

/// Triangles and rectangles, ready to be projected into many views, in groups of neighbours: most
/// of what a view does not need is left out group by group. Metres, world frame.
struct FlatFaces {
  struct Face {
    std::array<std::uint32_t, 4> corners;
    Eigen::Vector3d normal;
    double offset_m;  ///< of its plane: normal · p
  };

  /// Of a group.
  static constexpr std::size_t kMaxFaces = 8, kMaxCorners = 4 * kMaxFaces;

  /// Some faces [first, last) and their corners, which no other group has.
  struct Group {
    std::uint32_t first_face, last_face, first_corner, last_corner;
    bool parallel;               ///< all of its faces have the first one's normal ...
    double lowest_m, highest_m;  ///< ... and their planes' offsets are among these
  };

  std::vector<double> x, y, z;  ///< of the corners
  std::vector<Face> list;
  std::vector<Group> groups;
  BoxLanes boxes{0};  ///< around each group
  double largest_coordinate_m = 0;

  FlatFaces() = default;
  explicit FlatFaces(const std::vector<FaceCorners>& faces);

 private:
  void add_group(const std::vector<FaceCorners>& faces, std::span<const std::uint32_t> members);
};

/// @param faces as `voxel_faces` gives them: two triangles for each rectangle.
FlatFaces rectangles_of(const TriangleMesh& faces);

/// The largest faces of a scene, as many as are worth their cost where they hide something. What is
/// made of very many triangles is left out.
FlatFaces largest_faces_of(const Scene& scene);

}  // namespace vantage::planner::detail
