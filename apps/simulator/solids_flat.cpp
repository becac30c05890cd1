#include "simulator/solid_checks.hpp"
#include "simulator/solids.hpp"
#include "vantage/raycore/box.hpp"

namespace vantage {

TriangleMesh box_solid(const Eigen::Vector3d& size_m) {
  detail::check_size(size_m);
  return TriangleMesh::from_box(Box(-0.5 * size_m, 0.5 * size_m, "size_m"));
}

}  // namespace vantage
