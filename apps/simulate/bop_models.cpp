#include "simulate/bop_models.hpp"
#include "process/result_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "cli/units.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/image_io.hpp"
#include "workcell/object_appearance.hpp"

namespace vantage {
namespace {

/// A vertex of the file: one of the mesh's, with one of the places on the texture that it has.
struct FileVertices {
  std::vector<std::uint32_t> of_mesh;  ///< file vertex → mesh vertex
  std::vector<Eigen::Vector2f> uv;     ///< texels; empty without texture
  std::vector<Triangle> triangles;
};

FileVertices split_by_texture(const TexturedMesh& shape) {
  FileVertices file;
  if (!shape.textured()) {
    for (std::uint32_t i = 0; i < shape.mesh.vertices().size(); ++i) file.of_mesh.push_back(i);
    file.triangles = shape.mesh.triangles();
    return file;
  }
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
  for (std::size_t t = 0; t < shape.uv.size(); ++t) {
    Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = shape.mesh.triangles()[t][corner];
      const Eigen::Vector2f& uv = shape.uv[t][corner];
      const auto [entry, is_new] =
          known.try_emplace({vertex, uv.x(), uv.y()}, std::uint32_t(file.of_mesh.size()));
      if (is_new) file.of_mesh.push_back(vertex), file.uv.push_back(uv);
      triangle[corner] = entry->second;
    }
    file.triangles.push_back(triangle);
  }
  return file;
}

/// Normals of the mesh's vertices; vertices at one place count as one only if they are one.
std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices().size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto at = [&](int corner) -> Eigen::Vector3d {
      return mesh.corner(t, corner % 3).cast<double>();
    };
    const Eigen::Vector3d face = (at(1) - at(0)).cross(at(2) - at(0)).stableNormalized();
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d a = (at(corner + 1) - at(corner)).stableNormalized();
      const Eigen::Vector3d b = (at(corner + 2) - at(corner)).stableNormalized();
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      normals[mesh.triangles()[t][std::size_t(corner)]] += angle * face;
    }
  }
  for (Eigen::Vector3d& normal : normals) normal = normal.stableNormalized();
  return normals;
}

std::string header(const TexturedMesh& shape, const FileVertices& file, const std::string& name,
                   const std::string& texture_file) {
  std::string text = fmt::format("ply\nformat ascii 1.0\ncomment {}, millimetres\n", name);
  if (shape.textured()) text += "comment TextureFile " + texture_file + "\n";
  text += fmt::format("element vertex {}\n", file.of_mesh.size());
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz"}) {
    text += fmt::format("property float {}\n", property);
  }
  text += shape.textured() ? "property float texture_u\nproperty float texture_v\n"
                           : "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                      file.triangles.size());
  return text;
}

}  // namespace

std::string bop_ply(const TexturedMesh& shape, const std::string& name,
                    const std::string& texture_file) {
  const FileVertices file = split_by_texture(shape);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(shape.mesh);
  const Eigen::Vector3i color =
      (shape.color * 255).array().round().max(0).min(255).cast<int>().matrix();
  std::string text = header(shape, file, name, texture_file);
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < file.of_mesh.size(); ++i) {
    const Eigen::Vector3d p = 1000 * shape.mesh.vertices()[file.of_mesh[i]].cast<double>();
    const Eigen::Vector3d& n = normals[file.of_mesh[i]];
    fmt::format_to(out, "{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}", p.x(), p.y(), p.z(), n.x(),
                   n.y(), n.z());
    if (shape.textured()) {
      fmt::format_to(out, " {:.7f} {:.7f}\n", file.uv[i].x() / float(shape.texture.width),
                     1 - file.uv[i].y() / float(shape.texture.height));
    } else {
      fmt::format_to(out, " {} {} {}\n", color.x(), color.y(), color.z());
    }
  }
  for (const Triangle& t : file.triangles) fmt::format_to(out, "3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

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
  write_file(folder / "models_info.json", json_text(all));
}

}  // namespace vantage
