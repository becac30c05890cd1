#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "options/view_options.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"
#include "vantage/volume/volume_options.hpp"
#include "workcell/board.hpp"
#include "workcell/random_objects.hpp"
#include "workcell/workcell_objects.hpp"

namespace vantage {

/// A camera of the simulated cell.
struct CellCamera {
  std::string name;  ///< unique among the cameras
  PinholeCamera camera;
};

/// How the dataset's depth images were taken, where a calibration says that the lens distorts.
enum class DepthLens {
  unsaid,      ///< as a pinhole's, with a warning
  pinhole,     ///< they are rectified, and `cam_K` is theirs
  calibrated,  ///< registered to the colour image, and distorted as it is
};

/// A RealSense D435's colour stream at 640 × 480, rounded.
inline constexpr Intrinsics kUsualIntrinsics{640, 480, 615, 615, 319.5, 239.5};

/// What a workcell file says; assets/schema/workcell.schema.json describes the keys.
struct Workcell {
  Box work_area;
  DepthRange sensor_range = {};                          ///< of the dataset's cameras
  Intrinsics sensor_intrinsics = kUsualIntrinsics;       ///< of the simulated cell's cameras
  std::vector<std::filesystem::path> calibrations = {};  ///< of the dataset's: one, or one for each
  DepthLens depth_lens = DepthLens::unsaid;              ///< of the dataset's depth images
  std::optional<Intrinsics> movable_intrinsics = {};     ///< none: like the dataset's first camera
  DepthRange movable_range = {};
  CandidateSet candidates = production_views();
  ViewConstraints constraints = ViewConstraints();  ///< of the movable camera
  std::shared_ptr<const KnowledgeBase> knowledge =
      std::make_shared<const MemoryKnowledgeBase>();  ///< never null; without types if there is
                                                      ///< none
  std::vector<PlacedObject> static_structures = {};   ///< may lie outside the work area
  std::vector<PlacedObject> known_objects = {};
  std::vector<PlacedObject> foreign_objects =
      {};  ///< stand there too, but only the simulator knows
  std::optional<Board> board = {};
  std::vector<CellCamera> cameras = {};              ///< for the simulator
  std::optional<RandomObjects> random_objects = {};  ///< not placed yet: `place_random_objects`
  double voxel_size_m = 0.009375;                    ///< the thesis' smallest voxel
  VolumeOptions volume = {};
  ViewOptions plan = {};  ///< how views are scored and chosen, where the command line is silent
  std::vector<std::filesystem::path> files = {};  ///< every file that was read, once
};

/// Reads a workcell and the files that it names, relative to its folder: meshes, the knowledge
/// base, the board, views, a reach map.
/// @param usual where the movable camera may be, as far as the file says nothing of it.
/// @throws Error bad_input with file, line and key for anything that is not as the schema has it, a
/// box without volume, a quaternion that is none, ranges the wrong way round, a name used twice, a
/// type that the knowledge base does not have, a marker of the board that a type has too, and a
/// file that is not there; with the mesh file for one that is damaged; as `FileKnowledgeBase`,
/// `read_candidates` and `read_constraints` do.
Workcell load_workcell(const std::filesystem::path& path, const ViewConstraints& usual = {});

}  // namespace vantage
