#include "vantage/raycore/advanced/scene_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "geometry/coordinates.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace raycore::detail {

SceneImpl::SceneImpl() : top(rtcNewScene(device)) {
  device.check();
}

SceneImpl::~SceneImpl() {
  rtcReleaseScene(top);
  for (const RTCScene scene : shared) rtcReleaseScene(scene);
}

namespace {

void attach(const SceneImpl& impl, RTCScene scene, RTCGeometry geometry, ObjectId id) {
  rtcSetGeometryMask(geometry, kAllMasks);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
  impl.device.check();
}

ObjectTriangles attach_mesh(const SceneImpl& impl, RTCScene scene, const TriangleMesh& mesh,
                            ObjectId id) {
  if (mesh.empty()) return {};
  RTCGeometry geometry = rtcNewGeometry(impl.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto fill = [&](RTCBufferType type, RTCFormat format, const auto& items) {
    const std::size_t item_bytes = sizeof(items[0]);
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, item_bytes, items.size());
    impl.device.check();
    std::memcpy(buffer, items.data(), items.size() * item_bytes);
    return static_cast<decltype(items.data())>(buffer);
  };
  const ObjectTriangles copies{fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices()),
                               fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles()),
                               mesh.triangles().size()};
  attach(impl, scene, geometry, id);
  return copies;
}

}  // namespace
}  // namespace raycore::detail

struct SceneBuilder::Impl {
  std::unique_ptr<raycore::detail::SceneImpl> scene =
      std::make_unique<raycore::detail::SceneImpl>();
  struct SharedMesh {
    RTCScene scene;
    raycore::detail::ObjectTriangles triangles;
  };
  std::map<std::shared_ptr<const TriangleMesh>, SharedMesh> shared;

  ObjectId next_object(const Eigen::Matrix3f& normal_to_world) {
    scene->normal_to_world.push_back(normal_to_world);
    scene->triangles.emplace_back();
    return ObjectId(scene->normal_to_world.size() - 1);
  }

  const SharedMesh& shared_mesh(const std::shared_ptr<const TriangleMesh>& mesh) {
    const auto [entry, is_new] = shared.try_emplace(mesh);
    SharedMesh& found = entry->second;
    if (is_new) {
      found.scene = rtcNewScene(scene->device);
      scene->shared.push_back(found.scene);
      found.triangles = raycore::detail::attach_mesh(*scene, found.scene, *mesh, 0);
      raycore::detail::commit_scene(scene->device, found.scene);
    }
    return found;
  }
};

SceneBuilder::SceneBuilder() : impl_(std::make_unique<Impl>()) {}
SceneBuilder::~SceneBuilder() = default;

ObjectId SceneBuilder::add_mesh(const TriangleMesh& mesh) {
  const ObjectId id = impl_->next_object(Eigen::Matrix3f::Identity());
  impl_->scene->triangles[id] =
      raycore::detail::attach_mesh(*impl_->scene, impl_->scene->top, mesh, id);
  impl_->scene->triangle_count += mesh.triangles().size();
  return id;
}

ObjectId SceneBuilder::add_box(const Box& box, const Pose& T_world_box) {
  return add_mesh(TriangleMesh::from_box(box).transformed(T_world_box));
}

ObjectId SceneBuilder::add_instance(std::shared_ptr<const TriangleMesh> mesh,
                                    const Pose& T_world_mesh) {
  if (mesh == nullptr) throw bad_input("scene", "an instance without a mesh (null pointer)");
  const Eigen::Vector3d& place = T_world_mesh.translation();
  if (!raycore::detail::is_coordinate(place)) {
    throw bad_input("scene",
                    fmt::format("an instance lies at {} m; expected coordinates below "
                                "{:g} m (is the unit right?)",
                                raycore::detail::to_text(place), raycore::detail::kMaxCoordinate));
  }
  const Eigen::Matrix3f rotation = T_world_mesh.rotation().cast<float>();
  const ObjectId id = impl_->next_object(rotation);
  if (mesh->empty()) return id;

  raycore::detail::SceneImpl& scene = *impl_->scene;
  Eigen::Matrix<float, 3, 4> transform;
  transform << rotation, place.cast<float>();
  RTCGeometry geometry = rtcNewGeometry(scene.device, RTC_GEOMETRY_TYPE_INSTANCE);
  const Impl::SharedMesh& shared = impl_->shared_mesh(mesh);
  scene.triangles[id] = shared.triangles;
  scene.triangles[id].is_instance = true;
  scene.triangles[id].T_world_mesh = T_world_mesh;
  rtcSetGeometryInstancedScene(geometry, shared.scene);
  rtcSetGeometryTimeStepCount(geometry, 1);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  raycore::detail::attach(scene, scene.top, geometry, id);
  scene.triangle_count += mesh->triangles().size();
  scene.has_instances = true;
  return id;
}

std::shared_ptr<const Scene> SceneBuilder::build() {
  raycore::detail::commit_scene(impl_->scene->device, impl_->scene->top);
  std::shared_ptr<const Scene> scene(new Scene(std::move(impl_->scene)));
  impl_ = std::make_unique<Impl>();
  return scene;
}

}  // namespace vantage
