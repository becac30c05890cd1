#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "simulator/scene/textured_mesh.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// The bytes of a PLY file as BOP's models are: ASCII, millimetres, a normal for each vertex (the
/// mean of its faces', weighted by their angles), and its colour, or where the mesh is textured
/// `texture_u`, `texture_v` (from the image's lower left corner, 0 to 1) and a comment that names
/// the texture.
std::string bop_ply(const TexturedMesh& shape, const std::string& name,
                    const std::string& texture_file);

/// An object model of a BOP dataset.
struct BopModel {
  int id = 0;  ///< BOP's obj_id, from 1
  std::string name;
  std::shared_ptr<const TexturedMesh> shape;
  Symmetries symmetries = {};
  TypePtr type = {};                              ///< null: the model of an object without a type
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< that of the type or the object
};

/// The types of the knowledge base in their order, then each known object without a type. A type
/// that comes from a BOP model keeps its id; the others get the lowest that are free, in order.
/// @throws Error bad_input as `ObjectLooks`.
std::vector<BopModel> bop_models(const Workcell& workcell);

/// The model of a known object of the workcell from which `models` were made.
const BopModel& model_of(const std::vector<BopModel>& models, const PlacedObject& object);

/// Writes `folder`/obj_%06d.ply (ASCII, mm, with normals; a texture beside it as obj_%06d.png) and
/// `folder`/models_info.json, as the BOP format describes them.
void write_bop_models(const std::filesystem::path& folder, const std::vector<BopModel>& models);

/// The largest distance between two vertices, metres: models_info.json's diameter.
double diameter_m(const TriangleMesh& mesh);

}  // namespace vantage
