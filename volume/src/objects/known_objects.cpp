#include "objects/known_objects.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <map>
#include <optional>
#include <set>

#include "vantage/raycore/error.hpp"

namespace vantage::volume::detail {
namespace {

/// Below this share of undecided voxels an open mesh is a closed one with cracks.
constexpr double kHardlyAny = 1e-3;

/// Nothing to say of an open mesh whose inside is as good as certain.
std::optional<std::string> open_mesh_warning(const KnownObject& object,
                                             const MeshTopology& topology,
                                             const ObjectVoxels& voxels) {
  const double share = voxels.wound > 0 ? double(voxels.ambiguous) / double(voxels.wound) : 0;
  if (topology.sheets.empty() && share < kHardlyAny) return std::nullopt;
  std::string text = fmt::format(
      "object {}: its mesh is not closed ({} of its {} edges belong to an odd number of "
      "triangles); its inside is where its winding number is above one half, which is ambiguous "
      "(0.25 to 0.75) for {:.0f} % of the voxels in question; {} of its {} triangles are sheets "
      "that enclose nothing: close the mesh if it is meant to be solid",
      object.name, topology.unmatched_edges, topology.edges.size(), 100 * share,
      topology.sheets.size(), topology.solid->triangles.size());
  if (object.mesh->dropped_degenerate() > 0) {
    text += fmt::format(". {} faces without area were dropped: if they closed it, repair the mesh",
                        object.mesh->dropped_degenerate());
  }
  return text;
}

/// What is wrong with a mesh, independent of its pose.
void add_mesh_warnings(const KnownObject& object, const MeshTopology& topology,
                       std::vector<std::string>& warnings) {
  for (const std::string& remark : object.mesh->remarks()) {
    warnings.push_back(fmt::format("object {}: {}", object.name, remark));
  }
  if (topology.solid == nullptr || topology.solid->unexplained_pairs == 0) return;
  warnings.push_back(fmt::format(
      "object {}: {} faces of its mesh exist twice with opposite normals and could not be told "
      "apart, so parts of it may have lost their inside; remove the double faces",
      object.name, topology.solid->unexplained_pairs));
}

using Topologies = std::map<const TriangleMesh*, std::shared_ptr<const MeshTopology>>;

/// One for each mesh, however many objects share it; those of meshes known before are taken over.
Topologies topologies_of(const std::vector<const KnownObject*>& objects,
                         const KnownObjects* before) {
  Topologies topologies;
  for (const KnownObject* object : objects) topologies.try_emplace(object->mesh.get());
  if (before != nullptr) {
    for (const PlacedMesh& placed : before->meshes) {
      const auto found = topologies.find(placed.mesh.get());
      if (found != topologies.end()) found->second = placed.topology;
    }
  }
  std::vector<Topologies::iterator> missing;
  for (auto entry = topologies.begin(); entry != topologies.end(); ++entry) {
    if (entry->second == nullptr) missing.push_back(entry);
  }
  tbb::parallel_for(std::size_t(0), missing.size(), [&](std::size_t i) {
    missing[i]->second = std::make_shared<const MeshTopology>(*missing[i]->first);
  });
  return topologies;
}

bool same_place(const PlacedMesh& a, const PlacedMesh& b) {
  return a.mesh == b.mesh && a.T_grid_mesh.translation() == b.T_grid_mesh.translation() &&
         a.T_grid_mesh.rotation() == b.T_grid_mesh.rotation();
}

/// The body of an object that has not moved; null if there is none.
std::shared_ptr<const ObjectBody> body_before(const PlacedMesh& placed,
                                              const KnownObjects* before) {
  for (std::size_t i = 0; before != nullptr && i < before->meshes.size(); ++i) {
    if (same_place(placed, before->meshes[i])) return before->bodies[i];
  }
  return nullptr;
}

std::shared_ptr<const ObjectBody> body_of(const PlacedMesh& placed, const GridFrame& frame,
                                          const StopToken& stop) {
  const PlacedTriangles mesh(placed);
  auto body = std::make_shared<ObjectBody>();
  body->voxels = object_voxels(placed, frame.layout, frame.voxel_size_m, stop);
  body->surface = surface_octants(mesh, frame.layout, frame.voxel_size_m);
  if (mesh.triangles.empty()) return body;
  for (const Eigen::Vector3f& vertex : mesh.vertices) body->bounds.extend(vertex.cast<double>());
  const Eigen::Vector3d voxel = Eigen::Vector3d::Constant(frame.voxel_size_m);
  body->bounds.extend(Eigen::Vector3d(body->bounds.min() - voxel));
  body->bounds.extend(Eigen::Vector3d(body->bounds.max() + voxel));
  return body;
}

}  // namespace

void check_meshes(const WorldModel& world) {
  for_each_known(world, [](const KnownObject& object) {
    if (object.mesh == nullptr) throw bad_input("object " + object.name, "it has no mesh");
  });
}

KnownObjects::KnownObjects(const WorldModel& world, const GridFrame& frame,
                           const Pose& T_grid_world, const StopToken& stop,
                           const KnownObjects* before)
    : solid(frame.layout), surface_octants(frame.layout.block_count()) {
  std::vector<const KnownObject*> objects;
  for_each_known(world, [&](const KnownObject& object) { objects.push_back(&object); });
  const Topologies topologies = topologies_of(objects, before);
  for (const KnownObject* object : objects) {
    const std::shared_ptr<const MeshTopology>& topology = topologies.at(object->mesh.get());
    meshes.push_back({object->mesh, topology, T_grid_world * object->T_world_object});
    names.push_back(object->name);
  }
  bodies.resize(objects.size());
  tbb::parallel_for(std::size_t(0), objects.size(), [&](std::size_t i) {
    bodies[i] = body_before(meshes[i], before);
    if (bodies[i] != nullptr) return;
    bodies[i] = stop.stop_requested() ? std::make_shared<const ObjectBody>()
                                      : body_of(meshes[i], frame, stop);
  });
  std::set<const TriangleMesh*> told;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const MeshTopology& topology = *meshes[i].topology;
    if (told.insert(meshes[i].mesh.get()).second) {
      add_mesh_warnings(*objects[i], topology, warnings);
    }
    if (topology.closure != Closure::open || objects[i]->mesh->empty()) continue;
    const auto warning = open_mesh_warning(*objects[i], topology, bodies[i]->voxels);
    if (warning) warnings.push_back(*warning);
  }
  for (const std::shared_ptr<const ObjectBody>& body : bodies) {
    for (const ObjectVoxels::Block& block : body->voxels.blocks) {
      solid.set(block.block, solid.bits(block.block) | block.bits);
    }
    for (const SurfaceOctants::Block& block : body->surface.blocks) {
      surface_octants[block.block] |= block.octants;
    }
  }
}

std::vector<Extent> changed_extents(const KnownObjects& before, const KnownObjects& after) {
  const std::vector<bool> shared_before = share_geometry(before.meshes),
                          shared_after = share_geometry(after.meshes);
  std::vector<Extent> changed;
  const auto add = [&](const ObjectBody& body) {
    if (body.bounds.isEmpty()) return;
    changed.push_back({body.bounds.center(), 0.5 * body.bounds.sizes()});
  };
  std::vector<bool> stays(before.meshes.size());
  for (std::size_t i = 0; i < after.meshes.size(); ++i) {
    std::size_t j = 0;
    while (j < stays.size() && (stays[j] || shared_before[j] != shared_after[i] ||
                                !same_place(before.meshes[j], after.meshes[i]))) {
      ++j;
    }
    j < stays.size() ? void(stays[j] = true) : add(*after.bodies[i]);
  }
  for (std::size_t j = 0; j < stays.size(); ++j) {
    if (!stays[j]) add(*before.bodies[j]);
  }
  return changed;
}

}  // namespace vantage::volume::detail
