#include "objects/solid_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace vantage::volume::detail {
namespace {

constexpr float kWeldShare = 1e-6f;  // of the mesh's size

using Vertices = std::vector<Eigen::Vector3f>;

std::vector<std::uint32_t> welded_at_same_place(const Vertices& vertices) {
  const auto place = [&](std::uint32_t v) {
    return std::tuple(vertices[v].x(), vertices[v].y(), vertices[v].z());
  };
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(place(a), a) < std::tuple(place(b), b);
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// Vertices in cells as large as the distance: near ones are in the same or a neighbouring cell.
class WeldCells {
 public:
  WeldCells(const Vertices& vertices, float distance) : vertices_(vertices), distance_(distance) {}

  /// The first vertex near this one; itself if there is none, and then it is the first for others.
  std::uint32_t first_near(std::uint32_t vertex) {
    const Eigen::Vector3d p = vertices_[vertex].cast<double>() / double(distance_);
    const Eigen::Array3d cell = p.array().floor();
    for (int n = 0; n < 27; ++n) {
      const Eigen::Array3d neighbour = cell + Eigen::Array3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const auto found = cells_.find(key(neighbour));
      if (found == cells_.end()) continue;
      for (const std::uint32_t other : found->second) {
        if ((vertices_[other] - vertices_[vertex]).norm() <= distance_) return other;
      }
    }
    cells_[key(cell)].push_back(vertex);
    return vertex;
  }

 private:
  /// Different cells may share one: distances are looked at anyway.
  static std::uint64_t key(const Eigen::Array3d& cell) {
    const auto at = [&](int axis) { return std::uint64_t(std::int64_t(cell[axis])); };
    return at(0) * 73856093u ^ at(1) * 19349663u ^ at(2) * 83492791u;
  }

  const Vertices& vertices_;
  float distance_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// An edge's ends, the lower first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(const Triangle& t, std::size_t side) {
  return std::minmax({t[side], t[(side + 1) % 3]});
}
/// +1 if the triangle passes the edge from its lower end to its higher one, -1 otherwise.
int direction(const Triangle& t, std::size_t side) {
  return t[side] < t[(side + 1) % 3] ? 1 : -1;
}

Triangle turned_over(const Triangle& t) {
  return {t[0], t[2], t[1]};
}

/// Faces with the same corners, however they look.
struct Faces {
  std::vector<Triangle> single;  ///< seen from one side, once each
  std::vector<Triangle> paired;  ///< as many look one way as the other; one of them
};

Faces sorted_faces(const std::vector<Triangle>& triangles) {
  struct Entry {
    Triangle corners;  // in ascending order
    int sense;         // +1 if the triangle passes them in that order
    std::uint32_t triangle;
  };
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Triangle c = triangles[i];
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    const int sense = c[1] < c[2] ? 1 : -1;
    if (sense < 0) std::swap(c[1], c[2]);
    entries.push_back({c, sense, i});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
  });
  Faces faces;
  for (std::size_t i = 0; i < entries.size();) {
    int balance = 0;
    std::size_t end = i;
    for (; end < entries.size() && entries[end].corners == entries[i].corners; ++end) {
      balance += entries[end].sense;
    }
    const Triangle& c = entries[i].corners;
    if (balance != 0) {
      faces.single.push_back(balance > 0 ? c : turned_over(c));
    } else {
      faces.paired.push_back(c);
    }
    i = end;
  }
  return faces;
}

/// Decides which of the paired faces stay, and how they look: part by part, a part being what is
/// connected by edges that have exactly two of them.
class PairedFaces {
 public:
  PairedFaces(SolidSurface& surface, const Faces& faces) : surface_(surface), faces_(faces) {
    for (std::uint32_t i = 0; i < faces.paired.size(); ++i) {
      for (std::size_t side = 0; side < 3; ++side)
        at_edge_[edge_of(faces.paired[i], side)].push_back(i);
    }
    for (const Triangle& t : faces.single) {
      for (std::size_t side = 0; side < 3; ++side) single_[edge_of(t, side)] += direction(t, side);
    }
    flip_.resize(faces.paired.size(), 0);
  }

  void resolve() {
    for (std::uint32_t i = 0; i < flip_.size(); ++i) {
      if (flip_[i] == 0) resolve_part(part_from(i));
    }
  }

 private:
  struct Part {
    std::vector<std::uint32_t> faces;
    bool orientable = true;
  };

  /// Orients a part's faces consistently: `flip_` becomes +1 or -1 for each.
  Part part_from(std::uint32_t first) {
    Part part;
    part.faces.push_back(first);
    flip_[first] = 1;
    for (std::size_t done = 0; done < part.faces.size(); ++done) {
      const std::uint32_t i = part.faces[done];
      for (std::size_t side = 0; side < 3; ++side) {
        const std::vector<std::uint32_t>& both = at_edge_.at(edge_of(faces_.paired[i], side));
        if (both.size() != 2) continue;
        const std::uint32_t other = both[0] == i ? both[1] : both[0];
        const int flip = -flip_[i] * direction(faces_.paired[i], side) *
                         direction_at(other, edge_of(faces_.paired[i], side));
        if (flip_[other] == 0) {
          flip_[other] = flip;
          part.faces.push_back(other);
        } else if (flip_[other] != flip) {
          part.orientable = false;
        }
      }
    }
    return part;
  }

  int direction_at(std::uint32_t face, const Edge& edge) const {
    for (std::size_t side = 0; side < 3; ++side) {
      if (edge_of(faces_.paired[face], side) == edge) return direction(faces_.paired[face], side);
    }
    return 0;
  }

  /// How a part lies in the rest of the surface.
  struct Fit {
    bool closed = true;         // it is closed by itself
    bool alone = true;          // nothing else has one of its edges
    bool closes = true;         // as oriented, it closes the hole of the rest that it lies in
    bool closes_turned = true;  // turned over, it does
  };

  Fit fit_of(const Part& part) const {
    std::map<Edge, std::pair<int, int>> edges;  // how many of the part's faces, and their balance
    for (const std::uint32_t i : part.faces) {
      for (std::size_t side = 0; side < 3; ++side) {
        auto& [count, balance] = edges[edge_of(faces_.paired[i], side)];
        ++count;
        balance += flip_[i] * direction(faces_.paired[i], side);
      }
    }
    Fit fit;
    for (const auto& [edge, found] : edges) {
      const auto& [count, balance] = found;
      const auto rest = single_.find(edge);
      const int missing = rest == single_.end() ? 0 : -rest->second;
      fit.closed = fit.closed && count % 2 == 0;
      fit.alone =
          fit.alone && rest == single_.end() && at_edge_.at(edge).size() == std::size_t(count);
      fit.closes = fit.closes && balance == missing;
      fit.closes_turned = fit.closes_turned && -balance == missing;
    }
    return fit;
  }

  void resolve_part(const Part& part) {
    const Fit fit = fit_of(part);
    if (!part.orientable) {
      surface_.unexplained_pairs += part.faces.size();
    } else if (fit.closed || fit.alone) {
      add(part, doubled_volume(part) < 0 ? -1 : 1);
    } else if (fit.closes || fit.closes_turned) {
      add(part, fit.closes ? 1 : -1);
    } else if (faces_.single.empty()) {
      surface_.unexplained_pairs += part.faces.size();
    }
  }

  /// Six times the volume between the part and its first corner: its sign says how it looks.
  double doubled_volume(const Part& part) const {
    const Eigen::Vector3d origin = corner(part.faces[0], 0);
    double volume = 0;
    for (const std::uint32_t i : part.faces) {
      volume += flip_[i] *
                (corner(i, 0) - origin).dot((corner(i, 1) - origin).cross(corner(i, 2) - origin));
    }
    return volume;
  }
  Eigen::Vector3d corner(std::uint32_t face, std::size_t c) const {
    return surface_.vertices[faces_.paired[face][c]].cast<double>();
  }

  void add(const Part& part, int sign) {
    for (const std::uint32_t i : part.faces) {
      const Triangle& t = faces_.paired[i];
      surface_.triangles.push_back(sign * flip_[i] > 0 ? t : turned_over(t));
    }
  }

  SolidSurface& surface_;
  const Faces& faces_;
  std::map<Edge, std::vector<std::uint32_t>> at_edge_;
  std::map<Edge, int> single_;
  std::vector<int> flip_;  // 0: not reached yet
};

}  // namespace

EdgeBalance::EdgeBalance(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<Edge, int>> sides;
  sides.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t side = 0; side < 3; ++side) {
      sides.emplace_back(edge_of(t, side), direction(t, side));
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); ++edges) {
    std::ptrdiff_t balance = 0;
    const std::size_t start = i;
    for (; i < sides.size() && sides[i].first == sides[start].first; ++i)
      balance += sides[i].second;
    odd += (i - start) % 2;
    unbalanced += balance != 0;
  }
}

std::vector<std::uint32_t> welded(const std::vector<Eigen::Vector3f>& vertices, float distance) {
  std::vector<std::uint32_t> first = welded_at_same_place(vertices);
  if (distance <= 0) return first;
  WeldCells cells(vertices, distance);
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    // A vertex that is not the first at its place comes after it.
    first[v] = first[v] == v ? cells.first_near(v) : first[first[v]];
  }
  return first;
}

SolidSurface solid_surface(const TriangleMesh& mesh, bool weld_near) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : mesh.vertices()) box.extend(p);
  const float size = mesh.empty() ? 0 : box.sizes().norm();
  const std::vector<std::uint32_t> first =
      welded(mesh.vertices(), weld_near ? kWeldShare * size : 0);
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles().size());
  for (const Triangle& t : mesh.triangles()) {
    const Triangle joined = {first[t[0]], first[t[1]], first[t[2]]};
    if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) continue;
    triangles.push_back(joined);
  }
  const Faces faces = sorted_faces(triangles);
  SolidSurface surface{mesh.vertices(), faces.single};
  if (!faces.paired.empty()) PairedFaces(surface, faces).resolve();
  return surface;
}

}  // namespace vantage::volume::detail
