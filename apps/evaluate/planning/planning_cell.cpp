#include "evaluate/planning/planning_cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "plan/plan_input.hpp"
#include "simulator/depth/depth_sensor.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/error.hpp"
#include "workcell/detectable_objects.hpp"
#include "workcell/simulated_cell.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

/// The part after the file name's last separator, the separator included; nothing if there is no
/// separator, or if the whole name is a file.
std::optional<std::string> cut_off(std::string& name, char separator) {
  const std::size_t at = name.rfind(separator);
  if (at == std::string::npos || name.find('/', at) != std::string::npos || fs::exists(name)) {
    return std::nullopt;
  }
  const std::string rest = name.substr(at + 1);
  name.erase(at);
  return rest;
}

/// The indices of the cameras that a name asks for.
std::vector<std::size_t> chosen_cameras(const PlanningCellName& name, const Workcell& workcell) {
  std::vector<std::string> known;
  for (const CellCamera& camera : workcell.cameras) known.push_back(camera.name);
  if (known.empty()) {
    throw bad_input(name.workcell.string() + ": cameras",
                    "there are no cameras, so all of the work area is shadow; expected at least "
                    "one, e.g. \"- {name: front, eye_m: [0, -0.7, 0.4], target_m: [0, 0, 0]}\"");
  }
  std::vector<std::size_t> chosen;
  for (const std::string& camera : name.cameras.empty() ? known : name.cameras) {
    const auto found = std::ranges::find(known, camera);
    if (found == known.end()) {
      throw bad_input(name.workcell.string(),
                      fmt::format("it has no camera \"{}\"; expected one or more of: {}", camera,
                                  fmt::join(known, ", ")));
    }
    const auto index = std::size_t(found - known.begin());
    if (std::ranges::find(chosen, index) != chosen.end()) {
      throw bad_input(name.workcell.string(),
                      fmt::format("camera \"{}\" is named twice; name it once", camera));
    }
    chosen.push_back(index);
  }
  return chosen;
}

StereoSensor sensor_of(DepthKind kind, const Workcell& workcell) {
  if (kind == DepthKind::ideal) return StereoSensor::ideal();
  return {.noise = workcell.volume.noise};
}

/// What is recognised, and the cameras without depth images.
WorldModel world_of(const Workcell& workcell, const SimulatedScene& scene,
                    const std::vector<std::size_t>& cameras) {
  std::vector<PinholeCamera> views;
  for (const std::size_t i : cameras) views.push_back(workcell.cameras[i].camera);
  const auto found = recognisable_objects(workcell.known_objects, views, scene.rays());
  WorldModel world{known(found), known(workcell.static_structures), {}};
  for (const std::size_t i : cameras) {
    world.cameras.push_back({workcell.cameras[i].name, workcell.cameras[i].camera, nullptr});
  }
  return world;
}

WorldModel with_depth(WorldModel world, const SimulatedScene& scene,
                      const std::vector<std::size_t>& cameras, const StereoSensor& sensor,
                      std::uint64_t seed) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    world.cameras[i].depth = std::make_shared<const DepthImage>(simulate_depth(
        scene.rays(), world.cameras[i].camera, sensor, sample_hash(seed, cameras[i])));
  }
  return world;
}

std::string title_of(const PlanningCellName& name, const WorldModel& world, DepthKind kind) {
  std::vector<std::string> cameras;
  for (const DepthCamera& camera : world.cameras) cameras.push_back(camera.name);
  std::string title = fmt::format("{}:{}", name.workcell.stem().string(), fmt::join(cameras, ","));
  if (kind != DepthKind::none) title += "+" + kDepthKinds[std::size_t(kind)];
  return title;
}

}  // namespace

const std::vector<std::string> kDepthKinds{"none", "ideal", "noisy"};

DepthKind depth_kind_of(const std::string& name) {
  const auto kind = std::ranges::find(kDepthKinds, name);
  if (kind != kDepthKinds.end()) return DepthKind(kind - kDepthKinds.begin());
  throw bad_input("depth images", fmt::format("found \"{}\"; expected one of: {}", name,
                                              fmt::join(kDepthKinds, ", ")));
}

PlanningCellName planning_cell_name(const std::string& argument) {
  PlanningCellName name;
  std::string rest = argument;
  if (const auto depth = cut_off(rest, '+')) name.depth = depth_kind_of(*depth);
  if (const auto cameras = cut_off(rest, ':')) name.cameras = parts_of(*cameras, ',');
  if (rest.empty()) {
    throw bad_input("'" + argument + "'", "expected FILE[:CAMERA,...][+none, +ideal or +noisy]");
  }
  name.workcell = rest;
  return name;
}

std::vector<PinholeCamera> PlanningCell::cameras() const {
  std::vector<PinholeCamera> cameras;
  for (const DepthCamera& observer : world.cameras) cameras.push_back(observer.camera);
  return cameras;
}

PlanningCell load_planning_cell(const PlanningCellName& name, DepthKind usual, std::uint64_t seed) {
  // The thesis, whose tables this reproduces, has no camera body.
  Workcell workcell = load_workcell(name.workcell, ViewConstraints::bare());
  const std::vector<std::size_t> cameras = chosen_cameras(name, workcell);
  place_random_objects(workcell);
  const DepthKind kind = name.depth.value_or(usual);
  SimulatedScene scene = simulated_cell(workcell).scene;
  const WorldModel world = world_of(workcell, scene, cameras);
  const StereoSensor sensor =
      sensor_of(kind == DepthKind::none ? DepthKind::noisy : kind, workcell);
  WorldModel measured = with_depth(world, scene, cameras, sensor, seed);
  return {title_of(name, world, kind),
          kDepthKinds[std::size_t(kind)],
          kind == DepthKind::none ? world : measured,
          std::move(measured),
          plan_request(workcell, workcell.sensor_intrinsics),
          std::move(scene),
          workcell.files};
}

}  // namespace vantage
