#include "bench_volume_probe.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "bench_volume_scenes.hpp"
#include "timing.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::bench {
namespace {

/// A line of Linux' account of this process, e.g. VmHWM: the most memory that was ever resident.
double status_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return std::atof(line.c_str() + key.size() + 1) / 1024;
  }
  throw std::runtime_error("the system does not tell " + key);
}

WorldModel world_of(const std::string& scene) {
  if (scene == "wall") return wall().model();
  return scene == "cell" ? cell() : many_objects();
}

}  // namespace

Figures run_probe(const std::string& scene, const std::string& mode, double voxel_size_m) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "'" + program + "' " + kProbe + " " + scene + " " + mode + " " +
                              std::to_string(voxel_size_m * 1e6);
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error("cannot start " + command);
  Figures figures;
  char name[64];
  double value = 0;
  while (std::fscanf(output, "%63s %lf", name, &value) == 2) figures[name] = value;
  if (pclose(output) != 0 || figures.empty()) throw std::runtime_error("failed: " + command);
  return figures;
}

int answer_probe(char** arguments) {
  const std::string scene = arguments[0], mode = arguments[1];
  const double voxel_size_m = std::atof(arguments[2]) * 1e-6;
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  const Box area = scene == "wall" ? wall_area() : cell_area();
  const GridGeometry geometry = GridGeometry::covering(area, voxel_size_m);
  VolumeOptions options;
  options.occluders = mode == "mesh" ? OccluderMode::mesh : OccluderMode::voxels;
  const WorldModel world = world_of(scene);

  const double base_mb = status_mb("VmRSS");
  std::shared_ptr<const StateGrid> grid;
  const Work work = [&] { grid = classify(world, geometry, options); };
  std::vector<double> seconds = {wall_seconds(work)};
  const double peak_mb = status_mb("VmHWM");
  while (seconds.size() < 3) {
    grid.reset();
    seconds.push_back(wall_seconds(work));
  }
  std::printf("base_mb %f\npeak_mb %f\nms %f\nvoxels %f\nshadow %f\noccupied %f\n", base_mb,
              peak_mb, 1e3 * median(seconds), double(geometry.voxel_count()),
              double(grid->count(VoxelState::shadow)), double(grid->count(VoxelState::occupied)));
  return 0;
}

}  // namespace vantage::bench
