#include "evaluate/shadow_filters/shadow_filter_benchmark.hpp"

#include "simulator/scene/ground_truth.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"
#include "vantage/volume/advanced/visibility.hpp"

namespace vantage {
namespace {

std::vector<VisibilityMesh> lattices_of(const PlanningCell& cell,
                                        const VisibilityOptions& options) {
  std::vector<VisibilityMesh> lattices;
  for (const DepthCamera& observer : cell.world.cameras) {
    if (observer.depth == nullptr) {
      throw bad_input(cell.name, "camera \"" + observer.name +
                                     "\" has no depth image, which visibility meshes are made "
                                     "from; expected +ideal or +noisy");
    }
    auto lattice = visibility_lattice({observer.camera, observer.depth}, cell.request.work_area,
                                      cell.request.volume.noise, options);
    if (lattice) lattices.push_back(std::move(*lattice));
  }
  return lattices;
}

WorldModel known_of(const PlanningCell& cell) {
  return {cell.world.objects, cell.world.static_structures, {}};
}

std::shared_ptr<const StateGrid> filtered(const StateGrid& grid, const ShadowFilter& filter) {
  return remove_small_components(*morphological_open(grid, filter.opening_voxels), filter.min_m3);
}

}  // namespace

std::vector<ShadowFilter> filters_of(const ShadowFilterOptions& settings) {
  std::vector<ShadowFilter> filters;
  std::vector<double> offsets = settings.offsets_sigmas;
  if (settings.classified) offsets = {0};
  for (const double offset : offsets)
    for (const int opening : settings.openings_voxels)
      for (const double min_cm3 : settings.min_cm3)
        filters.push_back({offset, opening, 1e-6 * min_cm3});
  return filters;
}

FilteredScene evaluate_shadow_filters(const PlanningCell& cell, const ShadowFilterOptions& settings,
                                      const StopToken& stop) {
  const auto geometry = GridGeometry::covering(cell.request.work_area, settings.voxel_size_m);
  const GroundTruth truth(cell.scene, cell.cameras(), geometry);
  const TrueShadow shadow(truth.grid());
  FilteredScene scene{.name = cell.name};
  std::optional<double> offset;
  std::shared_ptr<const StateGrid> grid;
  for (const ShadowFilter& filter : filters_of(settings)) {
    if (offset != filter.offset_sigmas) {
      offset = filter.offset_sigmas;
      grid = settings.classified ? classify(cell.world, geometry, cell.request.volume, stop)
                                 : carve(lattices_of(cell, {.step_px = settings.step_px,
                                                            .holes = settings.holes,
                                                            .offset_sigmas = *offset}),
                                         geometry, known_of(cell), stop);
      if (grid == nullptr) return scene;
    }
    scene.scores.push_back(shadow.score(*filtered(*grid, filter)));
  }
  scene.hidden_m3 = scene.scores.front().true_m3 + scene.scores.front().missed_m3;
  return scene;
}

}  // namespace vantage
