// The same work area, less what four cameras saw (every 8th pixel), in two ways: as a mesh, by
// CGAL's corefinement, one camera after the other, with exact predicates and inexact constructions;
// and by rays, as a UnobservedSpace and its first view of 160×120 pixels. Prints both times and
// their ratio, of one thread's processor time. CGAL is under the GPL: nothing but this program uses
// it.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "reference/random_scene.hpp"
#include "seen_scene.hpp"
#include "timing.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"

namespace vantage::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface surface_of(const TriangleMesh& mesh) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Eigen::Vector3f& p : mesh.vertices()) {
    vertices.push_back(surface.add_vertex({double(p.x()), double(p.y()), double(p.z())}));
  }
  for (const auto& [a, b, c] : mesh.triangles()) {
    surface.add_face(vertices[a], vertices[b], vertices[c]);
  }
  return surface;
}

/// What the lattices did not see of the box, by points in it: the two ways must mean the same.
double unseen_litres(const std::vector<VisibilityMesh>& lattices) {
  constexpr int kPoints = 400000;
  const Box box = seen_box();
  test::Random random(1);
  int unseen = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d p(random.uniform(box.min().x(), box.max().x()),
                            random.uniform(box.min().y(), box.max().y()),
                            random.uniform(box.min().z(), box.max().z()));
    unseen += std::none_of(lattices.begin(), lattices.end(),
                           [&](const VisibilityMesh& lattice) { return lattice.sees(p); });
  }
  return 1e3 * box.volume_m3() * unseen / kPoints;
}

/// How often each way is measured; CGAL takes seconds.
constexpr int kRounds = 5;

struct Measured {
  double boolean_s, build_s, view_s;
};

Measured measure() {
  const std::vector<VisibilityMesh> lattices = seen_lattices(8);
  std::vector<Surface> seen;
  for (const VisibilityMesh& lattice : lattices)
    seen.push_back(surface_of(visibility_mesh(lattice)));
  const PinholeCamera viewer = seen_viewers()[0];
  std::vector<PixelTile> tiles;
  for (int i = 0; i < 30 * 40; ++i) tiles.push_back({std::uint16_t(i % 40), std::uint16_t(i / 40)});
  std::vector<UnseenHits> hits(tiles.size());

  std::vector<double> boolean, build, view;
  for (int round = 0; round < kRounds; ++round) {
    Surface unseen = surface_of(TriangleMesh::from_box(seen_box()));
    std::vector<Surface> volumes = seen;  // corefinement adds to both
    bool ok = true;
    boolean.push_back(thread_seconds([&] {
      for (Surface& volume : volumes) {
        ok &= PMP::corefine_and_compute_difference(unseen, volume, unseen);
      }
    }));
    std::printf("corefinement %d: %s, %zu faces, %.3f litres are left\n", round + 1,
                ok ? "done" : "failed", std::size_t(unseen.number_of_faces()),
                ok ? 1e3 * CGAL::to_double(PMP::volume(unseen)) : 0);
    std::unique_ptr<UnobservedSpace> space;
    build.push_back(
        thread_seconds([&] { space = std::make_unique<UnobservedSpace>(lattices, seen_box()); }));
    view.push_back(thread_seconds([&] { space->first_unseen(viewer, tiles, hits); }));
  }
  std::printf("by points: %.3f litres\n", unseen_litres(lattices));
  return {median(boolean), median(build), median(view)};
}

}  // namespace
}  // namespace vantage::bench

int main() {
  using namespace vantage::bench;
  Measured m{};
  tbb::task_arena(1).execute([&] { m = measure(); });
  std::printf("medians: boolean %.0f ms; SeenSpace %.2f ms and its first view %.2f ms\n",
              1e3 * m.boolean_s, 1e3 * m.build_s, 1e3 * m.view_s);
  std::printf("boolean / (SeenSpace + view) = %.0f; boolean / view = %.0f\n",
              m.boolean_s / (m.build_s + m.view_s), m.boolean_s / m.view_s);
  return 0;
}
