#include "simulator/scene/simulated_scene.hpp"

#include <fmt/format.h>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// Smaller meshes are hit faster as triangles of the scene's own BVH.
constexpr std::size_t kMinShared = 500;

void check_shape(const SimulatedBody& body) {
  if (body.shape == nullptr) throw bad_input("body " + body.name, "it has no shape");
  const std::size_t triangles = body.shape->mesh.triangles().size();
  if (body.shape->textured() && body.shape->uv.size() != triangles) {
    throw bad_input("body " + body.name,
                    fmt::format("{} texture coordinates for {} triangles; expected one for each",
                                body.shape->uv.size(), triangles));
  }
}

}  // namespace

SimulatedScene::SimulatedScene(std::vector<SimulatedBody> bodies) : bodies_(std::move(bodies)) {
  SceneBuilder builder;
  for (const SimulatedBody& body : bodies_) {
    check_shape(body);
    const TriangleMesh& mesh = body.shape->mesh;
    if (mesh.triangles().size() < kMinShared) {
      builder.add_mesh(mesh.transformed(body.T_world_body));
    } else {
      builder.add_instance({body.shape, &mesh}, body.T_world_body);
    }
  }
  rays_ = builder.build();
}

}  // namespace vantage
