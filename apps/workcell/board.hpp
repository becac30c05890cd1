#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "documents/document_value.hpp"
#include "simulator/scene/textured_mesh.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {

/// A plate with markers on it, by which cameras find where they are. It lies flat around the
/// world's origin; its top is z = 0.
struct Board {
  std::string place;  ///< in the file, for errors
  Eigen::Vector2d size_m;
  double thickness_m = 0.01;
  Eigen::Vector3f color = {0.9f, 0.9f, 0.9f};  ///< sRGB, 0 to 1
  std::vector<Marker> markers = {};            ///< their poses are T_world_marker

  /// The markers, by which cameras are located; world frame.
  std::vector<ObjectFeature> features() const;
};

/// Reads a board, or the file that `value` names instead, relative to `folder`; adds that file to
/// `files`.
/// @throws Error bad_input with file, line and key for what is not as the schema of the workcell
/// has it, a marker that OpenCV does not have, and one that is there twice or that a type of the
/// knowledge base has.
Board read_board(const Value& value, const KnowledgeBase& knowledge,
                 const std::filesystem::path& folder, std::vector<std::filesystem::path>& files);

/// The plate with its markers printed on it, world frame.
/// @throws Error bad_input as `with_markers` does, for markers beyond the edge or on one another.
TexturedMesh board_shape(const Board& board);

}  // namespace vantage
