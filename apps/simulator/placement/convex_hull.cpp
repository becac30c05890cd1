#include "simulator/placement/convex_hull.hpp"

#include <fmt/format.h>
#include <libqhull_r/qhull_ra.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// Between the points and a frame in which they are one unit apart, so that tolerances fit.
struct UnitFrame {
  Eigen::Vector3d centre;
  double size_m;

  Eigen::Vector3d back(const double* p) const {
    return centre + size_m * Eigen::Map<const Eigen::Vector3d>(p);
  }
};

UnitFrame unit_frame(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : points) bounds.extend(point);
  return {bounds.center(), bounds.diagonal().norm()};
}

// Qhull's reentrant C library, freed with everything in it; its C++ interface is not C++20.
class Hull {
 public:
  Hull() { qh_zero(&state_, messages_); }
  ~Hull() {
    int long_blocks = 0, their_bytes = 0;
    qh_freeqhull(&state_, !qh_ALL);
    qh_memfreeshort(&state_, &long_blocks, &their_bytes);
    if (messages_ != nullptr) std::fclose(messages_);
    std::free(text_);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// Qhull keeps the pointer to the coordinates.
  void run(std::vector<double>& coordinates) {
    // Merges facets whose centres are that near to each other's plane, as soon as they appear:
    // merging afterwards ("C1e-6") takes minutes for a smooth ball of 30,000 corners.
    char command[] = "qhull C-1e-6";
    if (qh_new_qhull(&state_, 3, int(coordinates.size() / 3), coordinates.data(), False, command,
                     nullptr, messages_) == 0) {
      return;
    }
    std::fflush(messages_);
    const std::string said(text_, size_);
    throw bad_input("mesh", "it has no convex hull; expected a body with a volume. Qhull says: " +
                                said.substr(0, said.find('\n')));
  }

  qhT* get() { return &state_; }

 private:
  qhT state_;
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* messages_ = open_memstream(&text_, &size_);
};

HullFace to_face(qhT* qh, facetT* facet, const UnitFrame& frame) {
  HullFace face;
  face.normal = Eigen::Map<const Eigen::Vector3d>(facet->normal);
  face.centre.setZero();
  vertexT *vertex, **vertexp;
  FOREACHvertex_(facet->vertices) face.centre += frame.back(vertex->point);
  face.centre /= qh_setsize(qh, facet->vertices);
  return face;
}

// The facets' ids have been replaced by their numbers.
void add_edge(HullFace& face, vertexT* a, vertexT* b, const facetT* beyond,
              const UnitFrame& frame) {
  HullEdge edge{frame.back(a->point), frame.back(b->point), beyond->id};
  const Eigen::Vector3d inwards = face.normal.cross(edge.b - edge.a);
  if (inwards.dot(face.centre - edge.a) < 0) std::swap(edge.a, edge.b);
  face.edges.push_back(edge);
}

// Qhull keeps the edges of merged facets only; those of a triangle lie opposite to its corners.
void add_edges(HullFace& face, facetT* facet, const UnitFrame& frame) {
  if (facet->simplicial) {
    const auto corner = [&](int i) { return SETelemt_(facet->vertices, i % 3, vertexT); };
    for (int i = 0; i < 3; ++i) {
      add_edge(face, corner(i + 1), corner(i + 2), SETelemt_(facet->neighbors, i, facetT), frame);
    }
    return;
  }
  ridgeT *ridge, **ridgep;
  FOREACHridge_(facet->ridges) {
    add_edge(face, SETfirstt_(ridge->vertices, vertexT), SETsecondt_(ridge->vertices, vertexT),
             otherfacet_(ridge, facet), frame);
  }
}

}  // namespace

std::vector<HullFace> convex_hull_faces(std::span<const Eigen::Vector3d> points) {
  if (points.size() < 4) {
    throw bad_input("mesh", fmt::format("it has {} corners; expected the four or more that a body "
                                        "with a volume has",
                                        points.size()));
  }
  const UnitFrame frame = unit_frame(points);
  std::vector<double> coordinates;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = (point - frame.centre) / frame.size_m;
    coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  }
  Hull hull;
  hull.run(coordinates);
  qhT* const qh = hull.get();  // FORALLfacets knows it by this name

  std::vector<HullFace> faces;
  facetT* facet;
  unsigned number = 0;
  FORALLfacets {
    facet->id = number++;
    faces.push_back(to_face(qh, facet, frame));
  }
  FORALLfacets add_edges(faces[facet->id], facet, frame);
  return faces;
}

}  // namespace vantage
