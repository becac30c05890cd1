#include "objects/known_objects.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <map>

#include "vantage/raycore/error.hpp"

namespace vantage::volume::detail {
namespace {

std::string open_mesh_warning(const KnownObject& object, const MeshTopology& topology) {
  std::string text = fmt::format(
      "object {}: its mesh is not closed ({} of its {} edges belong to an odd number of "
      "triangles), "
      "so it has no inside: only the voxels at its surface count as occupied",
      object.name, topology.unmatched_edges, topology.edges.size());
  if (object.mesh->dropped_degenerate() > 0) {
    text += fmt::format(". {} faces without area were dropped: if they closed it, repair the mesh",
                        object.mesh->dropped_degenerate());
  }
  return text;
}

using Topologies = std::map<const TriangleMesh*, std::shared_ptr<const MeshTopology>>;

/// One for each mesh, however many objects share it.
Topologies topologies_of(const std::vector<const KnownObject*>& objects) {
  Topologies topologies;
  for (const KnownObject* object : objects) topologies.try_emplace(object->mesh.get());
  std::vector<Topologies::iterator> entries;
  for (auto entry = topologies.begin(); entry != topologies.end(); ++entry)
    entries.push_back(entry);
  tbb::parallel_for(std::size_t(0), entries.size(), [&](std::size_t i) {
    entries[i]->second = std::make_shared<const MeshTopology>(*entries[i]->first);
  });
  return topologies;
}

}  // namespace

void check_meshes(const WorldModel& world) {
  for_each_known(world, [](const KnownObject& object) {
    if (object.mesh == nullptr) throw bad_input("object " + object.name, "it has no mesh");
  });
}

KnownObjects::KnownObjects(const WorldModel& world, const GridFrame& frame,
                           const Pose& T_grid_world, const StopToken& stop)
    : solid(frame.layout), surface_octants(frame.layout.block_count()) {
  std::vector<const KnownObject*> objects;
  for_each_known(world, [&](const KnownObject& object) { objects.push_back(&object); });
  const Topologies topologies = topologies_of(objects);
  for (const KnownObject* object : objects) {
    const std::shared_ptr<const MeshTopology>& topology = topologies.at(object->mesh.get());
    meshes.push_back({object->mesh, topology, T_grid_world * object->T_world_object});
    names.push_back(object->name);
    if (topology->closure == Closure::open && !object->mesh->empty()) {
      warnings.push_back(open_mesh_warning(*object, *topology));
    }
  }
  voxels.resize(objects.size());
  tbb::parallel_for(std::size_t(0), objects.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    const PlacedTriangles mesh(meshes[i]);
    voxels[i] = object_voxels(mesh, meshes[i].topology->closure, frame.layout, frame.voxel_size_m);
    mark_surface_octants(mesh, frame.layout, frame.voxel_size_m, surface_octants);
  });
  for (const ObjectVoxels& object : voxels) {
    for (const ObjectVoxels::Block& block : object.blocks) {
      solid.set(block.block, solid.bits(block.block) | block.bits);
    }
  }
}

}  // namespace vantage::volume::detail
