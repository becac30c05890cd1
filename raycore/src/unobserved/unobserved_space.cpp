#include "vantage/raycore/advanced/unobserved_space.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scene/batch.hpp"
#include "scene/pixel_tile.hpp"
#include "scene/ray_packet.hpp"
#include "unobserved/lattice_probe.hpp"
#include "unobserved/lattice_scene.hpp"
#include "unobserved/seen_walk.hpp"
#include "unobserved/shell_scene.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// Layers thinner than this part of the coordinates on the way may be taken for seen.
constexpr double kThinnest = 1e-5;

/// A lattice's volume: where it ends, and whether a point is in it.
struct SeenVolume {
  raycore::detail::LatticeProbe probe;
  raycore::detail::LatticeScene scene;
  Eigen::Vector3d apex;
  double reach;  ///< the largest coordinate

  SeenVolume(const raycore::detail::EmbreeDevice& device, const VisibilityMesh& lattice,
             double its_reach)
      : probe(lattice),
        scene(device, lattice, probe),
        apex(lattice.camera.centre()),
        reach(its_reach) {}
};

double reach_of(const Box& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

/// The largest coordinate of the surface and of the camera; infinite if one is no number.
double reach_of(const VisibilityMesh& lattice) {
  const PinholeCamera& camera = lattice.camera;
  double reach = camera.centre().cwiseAbs().maxCoeff();
  if (camera.centre().hasNaN()) reach = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0, at = 0; j < lattice.height(); ++j) {
    for (std::size_t i = 0; i < lattice.width(); ++i, ++at) {
      const double depth = double(lattice.depth[at]);
      if (std::isnan(depth)) continue;
      const Eigen::Vector3d p =
          camera.unproject(double(lattice.columns[i]), double(lattice.rows[j]), depth);
      const double largest = p.cwiseAbs().maxCoeff();
      if (p.hasNaN()) reach = std::numeric_limits<double>::infinity();
      reach = std::max(reach, largest);
    }
  }
  return reach;
}

void check_reach(double reach, const std::string& where) {
  if (reach <= double(raycore::detail::kFarthestCoordinate)) return;
  throw bad_input(where, fmt::format("it reaches {:g} m from the origin; expected 1e9 m at most "
                                     "(is the unit right?)",
                                     reach));
}

/// Cameras that look where the viewer looks first: they see what its rays will meet, so that rays
/// go as far in their volumes as in any, and the others need only be probed.
void sort_for(const PinholeCamera& viewer, std::vector<raycore::detail::WalkVolume>& volumes) {
  const Eigen::Vector3f axis = viewer.T_world_cam().rotation().col(2).cast<float>();
  const auto likeness = [&](const raycore::detail::WalkVolume& volume) {
    const float* optical_axis = volume.probe.m + 6;
    return axis.dot(Eigen::Map<const Eigen::Vector3f>(optical_axis));
  };
  std::stable_sort(volumes.begin(), volumes.end(),
                   [&](const auto& a, const auto& b) { return likeness(a) > likeness(b); });
}

std::string name_of(std::size_t lattice) {
  return fmt::format("depth lattice {}", lattice);
}

}  // namespace

struct UnobservedSpace::Impl {
  Box box;
  raycore::detail::EmbreeDevice device;
  std::vector<std::unique_ptr<const SeenVolume>> volumes;  // in the lattices' order
  std::optional<raycore::detail::ShellScene> shell;

  explicit Impl(const Box& seen_box) : box(seen_box) {}

  raycore::detail::WalkJob job(const PinholeCamera& camera) const {
    const Eigen::Vector3f origin = camera.centre().cast<float>();
    const Eigen::Vector3d from = origin.cast<double>();
    const double reach = std::max(reach_of(box), from.cwiseAbs().maxCoeff());
    raycore::detail::WalkJob job;
    for (int axis = 0; axis < 3; ++axis) {
      job.box_min[axis] = float(box.min()[axis] - from[axis]);
      job.box_max[axis] = float(box.max()[axis] - from[axis]);
    }
    job.t_far = float(camera.range().far_m);
    job.step = float(kThinnest * reach);
    if (shell) job.shell = {shell->get(), {origin.x(), origin.y(), origin.z()}};
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      const SeenVolume& volume = *volumes[i];
      const Eigen::Vector3d apex = volume.apex - from;
      const double step = kThinnest * std::max(reach, volume.reach);
      // Rays from its apex lie in a border's plane or pass it by; in float they might cross it.
      const bool from_apex = apex.cwiseAbs().maxCoeff() <= 0.1 * step;
      job.volumes.push_back(
          {raycore::detail::ProbeView(volume.probe, -apex),
           volume.scene.get(),
           {float(apex.x()), float(apex.y()), float(apex.z())},
           float(step),
           from_apex,
           from_apex || !volume.scene.has_walls() ? 0.5f * volume.probe.nearest : 0,
           std::uint32_t(i)});
    }
    sort_for(camera, job.volumes);
    return job;
  }
};

UnobservedSpace::UnobservedSpace(std::span<const VisibilityMesh> lattices, const Box& box,
                                 const TriangleMesh* shell)
    : impl_(std::make_unique<Impl>(box)) {
  check_reach(reach_of(box), "box");
  if (shell != nullptr) impl_->shell.emplace(impl_->device, *shell);
  const std::size_t count = lattices.size();
  std::vector<double> reaches(count);
  for (std::size_t i = 0; i < count; ++i) lattices[i].check(name_of(i));
  tbb::parallel_for(std::size_t(0), count,
                    [&](std::size_t i) { reaches[i] = reach_of(lattices[i]); });
  for (std::size_t i = 0; i < count; ++i) check_reach(reaches[i], name_of(i));
  impl_->volumes.resize(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    impl_->volumes[i] = std::make_unique<const SeenVolume>(impl_->device, lattices[i], reaches[i]);
  });
}

UnobservedSpace::~UnobservedSpace() = default;

const Box& UnobservedSpace::box() const noexcept {
  return impl_->box;
}

std::size_t UnobservedSpace::lattice_count() const noexcept {
  return impl_->volumes.size();
}

void UnobservedSpace::first_unseen(const PinholeCamera& camera, std::span<const PixelTile> tiles,
                                   std::span<UnseenHits> hits) const {
  raycore::detail::check_batch_size("the array of hits", hits.size(), tiles.size());
  raycore::detail::check_tiles(camera);
  raycore::detail::walk_tiles(impl_->job(camera), camera, tiles, hits.data());
}

}  // namespace vantage
