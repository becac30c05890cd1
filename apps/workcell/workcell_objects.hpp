#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {

/// What the workcell file puts somewhere.
struct PlacedObject {
  std::string name;                               ///< unique in the workcell
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< never null; that of its type, if it has one
  Pose T_world_object = {};
  TypePtr type = {};                              ///< null: of no type of the knowledge base
  Eigen::Vector3f color = {0.75f, 0.75f, 0.75f};  ///< sRGB, 0 to 1; that of its type

  /// As planner and volume see it; shares the mesh.
  KnownObject known() const {
    return {name, mesh, T_world_object, type == nullptr ? "" : type->name};
  }
};

std::vector<KnownObject> known(const std::vector<PlacedObject>& objects);

/// Reads the elements of the workcell's lists of objects; remembers their names.
class ObjectReader {
 public:
  /// @param files  gets every mesh file that is read. All three have to outlive the reader.
  ObjectReader(const std::filesystem::path& folder, const KnowledgeBase& knowledge,
               std::vector<std::filesystem::path>& files)
      : folder_(folder), knowledge_(knowledge), files_(files) {}

  /// @throws Error bad_input for a name that was there before, in whatever list; a type that the
  /// knowledge base does not have; sizes and meshes as `load_workcell` says.
  PlacedObject read(const Value& value);

 private:
  const std::filesystem::path& folder_;
  const KnowledgeBase& knowledge_;
  std::vector<std::filesystem::path>& files_;
  std::map<std::string, std::string> places_;  // name → where it stands
};

}  // namespace vantage
