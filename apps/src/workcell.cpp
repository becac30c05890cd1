#include "workcell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "schema_check.hpp"
#include "schemas.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "volume_settings.hpp"
#include "yaml_document.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A value of a document that passed its schema: types and lengths need no second look.
class Value {
 public:
  Value(const Document& document, const json& json_value, std::string pointer)
      : document_(&document), json_(&json_value), pointer_(std::move(pointer)) {}

  bool has(const char* key) const { return json_->contains(key); }
  Value operator[](const char* key) const {
    return {*document_, json_->at(key), child(pointer_, key)};
  }
  std::vector<Value> elements() const {
    std::vector<Value> all;
    for (std::size_t i = 0; i < json_->size(); ++i) {
      all.emplace_back(*document_, (*json_)[i], child(pointer_, i));
    }
    return all;
  }

  template <class T>
  T as() const {
    return json_->get<T>();
  }
  Eigen::Vector3d vector() const { return {number(0), number(1), number(2)}; }
  double number(std::size_t index) const { return (*json_)[index].get<double>(); }

  std::string place() const { return document_->place(pointer_); }
  Error error(std::string message) const { return bad_input(place(), std::move(message)); }

 private:
  const Document* document_;
  const json* json_;
  std::string pointer_;
};

Box read_box(const Value& value) {
  return Box(value["min_m"].vector(), value["max_m"].vector(), value.place());
}

DepthRange read_range(const Value& value) {
  const DepthRange range{value.number(0), value.number(1)};
  range.check(value.place());
  return range;
}

Intrinsics read_intrinsics(const Value& value) {
  const Intrinsics intrinsics{value["width"].as<int>(), value["height"].as<int>(),
                              value["fx"].as<double>(), value["fy"].as<double>(),
                              value["cx"].as<double>(), value["cy"].as<double>()};
  intrinsics.check(value.place());
  return intrinsics;
}

Reach read_reach(const Value& value) {
  Reach reach{value["base_m"].vector(), 0, value["max_m"].as<double>()};
  if (value.has("min_m")) reach.min_m = value["min_m"].as<double>();
  if (reach.min_m >= reach.max_m) {
    throw value.error(fmt::format("found min_m: {} and max_m: {}; expected min_m < max_m",
                                  reach.min_m, reach.max_m));
  }
  return reach;
}

Pose read_pose(const Value& value) {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  if (value.has("translation_m")) translation = value["translation_m"].vector();
  if (!value.has("rotation")) return Pose::from_translation(translation);
  const Value q = value["rotation"];
  rotation = Eigen::Quaterniond(q["w"].as<double>(), q["x"].as<double>(), q["y"].as<double>(),
                                q["z"].as<double>());
  return Pose::from_quaternion(rotation, translation, q.place());
}

/// Reads objects; remembers their names and files.
class ObjectReader {
 public:
  ObjectReader(const fs::path& folder, std::vector<fs::path>& files)
      : folder_(folder), files_(files) {}

  KnownObject read(const Value& value) {
    KnownObject object{value["name"].as<std::string>(), read_shape(value), {}};
    const auto [first, is_new] = places_.try_emplace(object.name, value["name"].place());
    if (!is_new) {
      throw value["name"].error(fmt::format("the name \"{}\" is taken by {}; names have to differ",
                                            object.name, first->second));
    }
    if (value.has("pose")) object.T_world_object = read_pose(value["pose"]);
    return object;
  }

 private:
  std::shared_ptr<const TriangleMesh> read_shape(const Value& value) {
    if (value.has("box")) {
      if (value.has("unit_m")) {
        throw value["unit_m"].error("only a mesh has a unit; give the box in metres");
      }
      return std::make_shared<const TriangleMesh>(TriangleMesh::from_box(read_box(value["box"])));
    }
    const fs::path file = folder_ / value["mesh"].as<std::string>();
    if (!fs::is_regular_file(file)) {
      throw value["mesh"].error(
          fmt::format("there is no file {}; the path is relative to the "
                      "workcell file's folder",
                      file.string()));
    }
    const double unit_m = value.has("unit_m") ? value["unit_m"].as<double>() : 1.0;
    auto mesh = std::make_shared<const TriangleMesh>(read_mesh(file, unit_m));
    if (std::find(files_.begin(), files_.end(), file) == files_.end()) files_.push_back(file);
    return mesh;
  }

  fs::path folder_;
  std::vector<fs::path>& files_;
  std::map<std::string, std::string> places_;  // name → where it stands
};

void read_movable_camera(const Value& value, Workcell& workcell) {
  workcell.movable_intrinsics = read_intrinsics(value);
  if (value.has("depth_range_m")) workcell.movable_range = read_range(value["depth_range_m"]);
}

void read_candidates(const Value& value, Workcell& workcell) {
  if (value.has("radii_m")) {
    workcell.candidate_radii_m = value["radii_m"].as<std::vector<double>>();
  }
  if (value.has("count")) workcell.candidates_per_half_sphere = value["count"].as<int>();
}

StereoNoise read_noise(const Value& value) {
  StereoNoise noise;
  if (value.has("focal_px")) noise.focal_px = value["focal_px"].as<double>();
  if (value.has("baseline_m")) noise.baseline_m = value["baseline_m"].as<double>();
  if (value.has("subpixel_px")) noise.subpixel_px = value["subpixel_px"].as<double>();
  return noise;
}

VolumeOptions read_volume(const Value& value) {
  VolumeOptions volume;
  if (value.has("occluders")) {
    volume.occluders = occluder_mode_of(value["occluders"].as<std::string>());
  }
  if (value.has("anti_alias")) volume.anti_alias = value["anti_alias"].as<bool>();
  if (value.has("band_sigmas")) volume.band_sigmas = value["band_sigmas"].as<double>();
  if (value.has("noise")) volume.noise = read_noise(value["noise"]);
  return volume;
}

}  // namespace

Workcell load_workcell(const fs::path& path) {
  const Document document = read_yaml(path);
  check_schema(document, workcell_schema());
  const Value root(document, document.root, "");

  Workcell workcell{.work_area = read_box(root["work_area"])};
  workcell.files.push_back(path);
  if (root.has("sensor")) workcell.sensor_range = read_range(root["sensor"]["depth_range_m"]);
  if (root.has("movable_camera")) read_movable_camera(root["movable_camera"], workcell);
  if (root.has("candidates")) read_candidates(root["candidates"], workcell);
  if (root.has("reach")) workcell.reach = read_reach(root["reach"]);
  if (root.has("voxel_size_m")) workcell.voxel_size_m = root["voxel_size_m"].as<double>();
  if (root.has("volume")) workcell.volume = read_volume(root["volume"]);

  ObjectReader objects(path.parent_path(), workcell.files);
  const auto read_all = [&](const char* key, std::vector<KnownObject>& to) {
    if (!root.has(key)) return;
    for (const Value& value : root[key].elements()) to.push_back(objects.read(value));
  };
  read_all("static_structures", workcell.static_structures);
  read_all("known_objects", workcell.known_objects);
  return workcell;
}

}  // namespace vantage
