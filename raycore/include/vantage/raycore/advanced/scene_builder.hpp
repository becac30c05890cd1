#pragma once

#include <memory>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// Collects objects and builds an immutable Scene from them. Not thread-safe.
class VANTAGE_API SceneBuilder {
 public:
  SceneBuilder();
  ~SceneBuilder();
  SceneBuilder(const SceneBuilder&) = delete;
  SceneBuilder& operator=(const SceneBuilder&) = delete;

  /// Triangles in the world frame. An empty mesh is an object that no ray hits.
  ObjectId add_mesh(const TriangleMesh& mesh);

  /// A box that is axis-aligned in its own frame.
  ObjectId add_box(const Box& box, const Pose& T_world_box = {});

  /// A mesh at a pose. Instances of the same mesh (the same pointer) share its BVH: worth it for
  /// many copies; a few small meshes are faster to hit as `add_mesh(mesh.transformed(pose))`.
  /// @throws Error bad_input for a null pointer.
  ObjectId add_instance(std::shared_ptr<const TriangleMesh> mesh, const Pose& T_world_mesh);

  /// Builds the BVHs and hands the scene over; the builder is empty afterwards.
  /// @throws Error out_of_resources if memory runs out.
  std::shared_ptr<const Scene> build();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
