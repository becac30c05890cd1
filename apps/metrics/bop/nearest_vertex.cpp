#include "metrics/bop/nearest_vertex.hpp"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>

namespace vantage {
namespace {

/// The points as nanoflann asks for them.
struct Cloud {
  std::vector<Eigen::Vector3d> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][Eigen::Index(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // let nanoflann find it
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;

}  // namespace

struct NearestVertex::Impl {
  explicit Impl(std::vector<Eigen::Vector3d> points) : cloud{std::move(points)}, tree(3, cloud) {}
  Cloud cloud;
  Tree tree;
};

NearestVertex::NearestVertex(std::vector<Eigen::Vector3d> points)
    : impl_(std::make_unique<const Impl>(std::move(points))) {
  assert(!impl_->cloud.points.empty());
}

NearestVertex::~NearestVertex() = default;

double NearestVertex::distance_m(const Eigen::Vector3d& point) const {
  std::uint32_t index = 0;
  double squared = 0;
  impl_->tree.knnSearch(point.data(), 1, &index, &squared);
  return std::sqrt(squared);
}

}  // namespace vantage
