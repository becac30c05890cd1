#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "classify/camera_visibility.hpp"
#include "classify/depth_integration.hpp"
#include "objects/known_objects.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::volume::detail {

struct StateGridImpl;

/// All that one camera contributes.
struct CameraEvidence {
  PinholeCamera camera;  ///< in the grid's frame
  CameraVisibility sight;
  std::optional<DepthEvidence> depth;

  CameraEvidence(const PinholeCamera& c, const BlockLayout& layout) : camera(c), sight(layout) {}
};

/// Decides every voxel from what is known and what the cameras say, as `classify` documents it, and
/// goes on from there: of the next grid, only blocks are decided of which something else is said.
class Fusion {
 public:
  explicit Fusion(const GridGeometry& geometry);

  /// What is said of the blocks in which two sets differ has changed. Null is a set of nothing.
  void changed(const BlockSet* before, const BlockSet* after);
  /// The same for what a camera sees, for what its depth image says, and for both; null: there is
  /// none.
  void changed(const CameraVisibility* before, const CameraVisibility* after);
  void changed(const DepthEvidence* before, const DepthEvidence* after,
               const CameraVisibility& sight);
  void changed(const CameraEvidence* before, const CameraEvidence* after);
  /// The same for the known objects, but for what cameras see past them.
  void changed(const KnownObjects& before, const KnownObjects& after);

  /// The state of every voxel. If nothing has changed, the very grid that it gave before.
  /// @param anti_alias always the same.
  std::shared_ptr<const StateGrid> grid(const KnownObjects& known,
                                        std::span<const CameraEvidence* const> cameras,
                                        bool anti_alias);

 private:
  /// The voxels by what became of them, before anti-aliasing. Disjoint but for `measured`, part of
  /// `occupied`, and `unmeasured` and `outside`, parts of `shadow`.
  struct States {
    BlockSet occupied, measured, shadow, unmeasured, outside, conflict;
    BlockSet aliased;  ///< of `shadow`, what anti-aliasing frees

    explicit States(const BlockLayout& layout)
        : occupied(layout),
          measured(layout),
          shadow(layout),
          unmeasured(layout),
          outside(layout),
          conflict(layout),
          aliased(layout) {}
  };

  void mark(std::size_t chunk, std::size_t block);
  void decide(std::size_t block, const KnownObjects& known,
              std::span<const CameraEvidence* const> cameras);
  void decide_marked(const KnownObjects& known, std::span<const CameraEvidence* const> cameras);
  void mark_neighbours_of_shadow();
  void find_aliased();
  void update(bool anti_alias, StateGridImpl& grid) const;

  GridGeometry geometry_;
  States states_;
  std::vector<std::uint8_t> blocks_, chunks_;  ///< marked
  std::vector<std::uint8_t> shadow_changed_;   ///< of the marked blocks
  bool report_changed_ = true;
  std::shared_ptr<const StateGrid> last_;
};

/// All of it at once.
std::shared_ptr<const StateGrid> combine(const GridGeometry& geometry, const KnownObjects& known,
                                         std::span<const CameraEvidence> cameras, bool anti_alias);

}  // namespace vantage::volume::detail
