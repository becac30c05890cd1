#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vantage/reconstruction/marker.hpp"
#include "simulator/textured_mesh.hpp"

namespace vantage {

/// Turns around this line leave the object as it is. Object's frame.
struct ContinuousSymmetry {
  Eigen::Vector3d axis;  ///< of length 1
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
};

/// Motions that leave an object as it is, with BOP's meaning (models_info.json).
struct Symmetries {
  std::vector<Eigen::Quaterniond> discrete;  ///< about the object's origin; the identity left out
  std::vector<ContinuousSymmetry> continuous;
  bool none() const { return discrete.empty() && continuous.empty(); }
};

/// What the knowledge base says of a kind of object.
struct ObjectType {
  std::string name;
  std::vector<std::string> is_a = {};              ///< ancestors; need not be types of their own
  std::shared_ptr<const TexturedMesh> shape = {};  ///< never null; its markers are printed on it
  std::vector<Marker> markers = {};                ///< the features that cameras recognise
  Symmetries symmetries = {};
};

/// The types of one or several knowledge base files, in their order. Immutable.
class KnowledgeBase {
 public:
  KnowledgeBase() = default;  ///< without types

  /// Reads the files, whose keys assets/schema/knowledge.schema.json describes, and the meshes that
  /// they name, relative to their folders.
  /// @throws Error bad_input with file, line and key for anything that is not as the schema has it,
  /// sizes and markers as solids.hpp and marker.hpp say, a name that is used twice, and a marker
  /// that is used twice – by id and cells: 4X4_50's markers are the first of 4X4_250's, too. With
  /// the mesh file for one that is damaged.
  explicit KnowledgeBase(const std::vector<std::filesystem::path>& files);

  const std::vector<std::shared_ptr<const ObjectType>>& types() const noexcept { return types_; }

  /// Every file that was read, once.
  const std::vector<std::filesystem::path>& files() const noexcept { return files_; }

  /// @throws Error bad_input, with `where` as the place, for a name that is no type's; the message
  /// has the nearest name.
  std::shared_ptr<const ObjectType> type(const std::string& name, const std::string& where) const;

 private:
  std::vector<std::shared_ptr<const ObjectType>> types_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace vantage
