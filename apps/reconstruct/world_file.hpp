#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {

/// What a world.json says.
struct WorldFile {
  std::map<int, std::optional<Pose>> T_world_cam;  ///< by image; none: not located
  std::vector<KnownObject> objects;
};

/// @throws Error bad_input with file, line and key for what is not as
/// assets/schema/world.schema.json has it, a type that the knowledge base does not have, an image
/// or a name that is there twice, and a covariance that is not symmetric.
WorldFile read_world(const std::filesystem::path& file, const KnowledgeBase& knowledge);

}  // namespace vantage
