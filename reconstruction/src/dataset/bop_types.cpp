#include "dataset/bop_types.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "dataset/bop_entry.hpp"
#include "dataset/json_file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/mesh_io.hpp"

namespace vantage::reconstruction::detail {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMetresPerMm = 0.001;

/// The elements of a list that may be missing.
std::vector<json> list_of(const json& info, const char* key, const std::string& where) {
  if (!info.contains(key)) return {};
  if (!info[key].is_array()) {
    throw bad_input(where, fmt::format("found {}; expected a list", excerpt(info[key])));
  }
  return info[key];
}

/// Row by row, translation in mm.
Pose read_motion(const json& value, const std::string& where) {
  const auto m = numbers_of<16>(value, where);
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    throw bad_input(where, fmt::format("found the last row {}, {}, {}, {}; expected 0, 0, 0, 1: a "
                                       "matrix is written row by row",
                                       m[12], m[13], m[14], m[15]));
  }
  Eigen::Matrix3d rotation;
  rotation << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  return Pose::from_rotation(rotation, kMetresPerMm * Eigen::Vector3d(m[3], m[7], m[11]), where);
}

ContinuousSymmetry read_line(const json& value, const std::string& where) {
  if (!value.is_object() || !value.contains("axis")) {
    throw bad_input(
        where, fmt::format("found {}; expected an object with the key \"axis\"", excerpt(value)));
  }
  const auto axis = numbers_of<3>(value["axis"], where + ".axis");
  const Eigen::Vector3d direction(axis[0], axis[1], axis[2]);
  if (!(direction.norm() > 1e-6)) {
    throw bad_input(where + ".axis", "found no direction; expected an axis");
  }
  ContinuousSymmetry line{direction.normalized()};
  if (value.contains("offset")) {
    const auto offset = numbers_of<3>(value["offset"], where + ".offset");
    line.offset_m = kMetresPerMm * Eigen::Vector3d(offset[0], offset[1], offset[2]);
  }
  return line;
}

Symmetries read_symmetries(const json& info, const std::string& place) {
  Symmetries symmetries;
  const auto read_all = [&](const char* key, auto& to, auto&& read) {
    const std::string where = place + ": " + key;
    const std::vector<json> list = list_of(info, key, where);
    for (std::size_t i = 0; i < list.size(); ++i) {
      to.push_back(read(list[i], fmt::format("{}[{}]", where, i)));
    }
  };
  read_all("symmetries_discrete", symmetries.discrete, read_motion);
  read_all("symmetries_continuous", symmetries.continuous, read_line);
  return symmetries;
}

/// Reads the models of one folder.
class ModelFolder {
 public:
  ModelFolder(const fs::path& folder, std::vector<fs::path>& files)
      : folder_(folder), info_(folder / "models_info.json"), files_(files) {}

  std::vector<ObjectType> read() const {
    if (!fs::is_regular_file(info_)) {
      throw bad_input(info_.string(),
                      "missing; a folder used as a knowledge base contains BOP's models: "
                      "models_info.json and obj_000001.ply, …");
    }
    const json root = parse_json_file(info_);
    files_.push_back(info_);
    if (!root.is_object()) {
      throw bad_input(info_.string(), fmt::format("found {}; expected an object with one entry per "
                                                  "model, such as \"1\": {{\"diameter\": …}}",
                                                  excerpt(root)));
    }
    std::map<int, std::string> keys;  // in the order of the ids, not of their digits
    for (const auto& [key, unused] : root.items()) take(keys, key);
    std::vector<ObjectType> types;
    for (const auto& [id, key] : keys) types.push_back(read_type(id, key, root[key]));
    return types;
  }

 private:
  std::string place(const std::string& key) const {
    return fmt::format("{}: {}", info_.string(), json(key).dump());
  }

  void take(std::map<int, std::string>& keys, const std::string& key) const {
    const int id = id_of(key, "model", place(key));
    if (keys.try_emplace(id, key).second) return;
    throw bad_input(place(key), fmt::format("model {} is given twice; remove one of them", id));
  }

  ObjectType read_type(int id, const std::string& key, const json& info) const {
    const std::string where = place(key);
    if (!info.is_object()) {
      throw bad_input(where, fmt::format("found {}; expected an object with the model's properties",
                                         excerpt(info)));
    }
    ObjectType type{.name = fmt::format("obj_{:06}", id)};
    const fs::path file = folder_ / (type.name + ".ply");
    if (!fs::is_regular_file(file)) {
      throw bad_input(where, fmt::format("there is no {} beside it; add the model or remove the "
                                         "entry",
                                         file.filename().string()));
    }
    type.mesh = std::make_shared<const TriangleMesh>(read_mesh(file, kMetresPerMm));
    files_.push_back(file);
    type.symmetries = read_symmetries(info, where);
    type.features = {{{"pose", type.name}, FeaturePose{}}};
    type.bop_id = id;
    type.place = where;
    return type;
  }

  const fs::path& folder_;
  fs::path info_;
  std::vector<fs::path>& files_;
};

}  // namespace

std::vector<ObjectType> read_bop_types(const fs::path& folder, std::vector<fs::path>& files) {
  return ModelFolder(folder, files).read();
}

}  // namespace vantage::reconstruction::detail
