#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "documents/document_value.hpp"
#include "object_types.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// What the workcell file puts somewhere.
struct PlacedObject {
  std::string name;                                ///< unique in the workcell
  std::shared_ptr<const TexturedMesh> shape = {};  ///< never null; shared by all objects of a type
  Pose T_world_object = {};
  std::shared_ptr<const ObjectType> type = {};  ///< null: of no type of the knowledge base

  /// As planner and volume see it; shares the mesh.
  KnownObject known() const { return {name, {shape, &shape->mesh}, T_world_object}; }
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
