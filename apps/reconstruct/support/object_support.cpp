#include "reconstruct/support/object_support.hpp"

#include <cmath>
#include <utility>

#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/check_support.hpp"

namespace vantage {
namespace {

/// The height at which the floor carries objects: of the work area's lower face, or of a board on
/// it. Elsewhere it is what the camera has to stay above, and maybe nothing else.
std::optional<double> carrying_floor(const Workcell& workcell) {
  constexpr double kSameHeight_m = 0.01;
  const std::optional<double>& floor = workcell.constraints.floor_z_m;
  if (!floor || workcell.board) return floor;
  const double above = workcell.work_area.min().z() - *floor;
  return std::abs(above) <= kSameHeight_m ? floor : std::nullopt;
}

/// What carries objects. The board is left out where the floor is its top.
std::vector<KnownObject> carriers_of(const Workcell& workcell) {
  constexpr double kSameHeight_m = 0.001;
  std::vector<KnownObject> carriers = known(workcell.static_structures);
  const std::optional<double>& floor = workcell.constraints.floor_z_m;
  if (!workcell.board || (floor && std::abs(*floor) < kSameHeight_m)) return carriers;
  const Board& board = *workcell.board;
  const Eigen::Vector3d size(board.size_m.x(), board.size_m.y(), board.thickness_m);
  carriers.push_back({"the board", std::make_shared<TriangleMesh>(box_solid(size)),
                      Pose::from_translation({0, 0, -0.5 * board.thickness_m})});
  return carriers;
}

}  // namespace

SceneSupport check_support(const Workcell& workcell, std::vector<DepthCamera> depth,
                           std::span<ReconstructedObject> objects) {
  SupportOptions options;
  options.floor_z_m = carrying_floor(workcell);
  SceneSupport support{{}, carriers_of(workcell)};
  if (!options.floor_z_m && support.structures.empty()) return support;
  support.objects =
      check_support(support.structures, measured_space(std::move(depth)), options, objects);
  return support;
}

}  // namespace vantage
