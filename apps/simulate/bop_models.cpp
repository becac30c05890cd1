#include "simulate/bop_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/units.hpp"
#include "simulate/bop_ply.hpp"
#include "vantage/raycore/file.hpp"
#include "vantage/raycore/image_io.hpp"
#include "workcell/object_appearance.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// As exact as the model files are: whole nanometres. What is beyond is the corners' single
/// precision.
double millimetres(double metres) {
  return std::round(metres * 1e9) / 1e6;
}

/// Row by row, translation in mm.
Json matrix_json(const Pose& motion) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = motion.rotation();
  matrix.topRightCorner<3, 1>() = kMillimetres * motion.translation();
  Json numbers = Json::array();
  for (int i = 0; i < 16; ++i) numbers.push_back(matrix(i / 4, i % 4));
  return numbers;
}

Json vector_json(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

void add_symmetries(const Symmetries& symmetries, Json& info) {
  if (!symmetries.discrete.empty()) {
    Json& list = info["symmetries_discrete"] = Json::array();
    for (const Pose& motion : symmetries.discrete) list.push_back(matrix_json(motion));
  }
  if (!symmetries.continuous.empty()) {
    Json& list = info["symmetries_continuous"] = Json::array();
    for (const ContinuousSymmetry& symmetry : symmetries.continuous) {
      list.push_back({{"axis", vector_json(symmetry.axis)},
                      {"offset", vector_json(kMillimetres * symmetry.offset_m)}});
    }
  }
}

Json info_json(const BopModel& model) {
  const TriangleMesh& mesh = model.shape->mesh;
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (const Eigen::Vector3f& p : mesh.vertices()) {
    low = low.min(p.cast<double>().array()), high = high.max(p.cast<double>().array());
  }
  low = low.unaryExpr(&millimetres), high = high.unaryExpr(&millimetres);
  const Eigen::Array3d size = high - low;
  Json info{{"diameter", millimetres(diameter_m(mesh))},
            {"min_x", low.x()},
            {"min_y", low.y()},
            {"min_z", low.z()},
            {"size_x", size.x()},
            {"size_y", size.y()},
            {"size_z", size.z()}};
  add_symmetries(model.symmetries, info);
  return info;
}

/// 1, 2, …, without the ids that types have from elsewhere.
class ModelIds {
 public:
  explicit ModelIds(const std::vector<TypePtr>& types) {
    for (const TypePtr& type : types) {
      if (type->bop_id) taken_.insert(*type->bop_id);
    }
  }
  int next() {
    do ++last_;
    while (taken_.contains(last_));
    return last_;
  }

 private:
  std::set<int> taken_;
  int last_ = 0;
};

}  // namespace

std::vector<BopModel> bop_models(const Workcell& workcell) {
  std::vector<BopModel> models;
  ObjectLooks looks;
  ModelIds ids(workcell.knowledge->types());
  for (const TypePtr& type : workcell.knowledge->types()) {
    models.push_back({type->bop_id ? *type->bop_id : ids.next(), type->name, looks.of(type),
                      type->symmetries, type, type->mesh});
  }
  for (const PlacedObject& object : workcell.known_objects) {
    if (object.type != nullptr) continue;
    models.push_back({ids.next(), object.name, looks.of(object), {}, nullptr, object.mesh});
  }
  return models;
}

const BopModel& model_of(const std::vector<BopModel>& models, const PlacedObject& object) {
  return *std::find_if(models.begin(), models.end(), [&](const BopModel& model) {
    return model.type == object.type && model.mesh == object.mesh;
  });
}

double diameter_m(const TriangleMesh& mesh) {
  float squared = 0;
  const std::vector<Eigen::Vector3f>& p = mesh.vertices();
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      squared = std::max(squared, (p[i] - p[j]).squaredNorm());
    }
  }
  return std::sqrt(double(squared));
}

void write_bop_models(const std::filesystem::path& folder, const std::vector<BopModel>& models) {
  Json all = Json::object();
  for (const BopModel& model : models) {
    const std::string name = fmt::format("obj_{:06}", model.id);
    if (model.shape->textured()) write_png(folder / (name + ".png"), model.shape->texture);
    write_file(folder / (name + ".ply"), bop_ply(*model.shape, model.name, name + ".png"));
    all[std::to_string(model.id)] = info_json(model);
  }
  write_file(folder / "models_info.json", all.dump(1) + "\n");
}

}  // namespace vantage
