#include "mesh/surface_nets.hpp"

#include <cstddef>
#include <utility>

namespace vantage::raycore::detail {
namespace {

using Index = std::array<int, 3>;

/// Corners of a cell and of the cells around it, numbered; a cell has its lowest corner's number.
class Nets {
 public:
  Nets(const Field& field, const SamplingGrid& grid) : grid_(grid) {
    step_ = {1, std::size_t(grid.corners[0]),
             std::size_t(grid.corners[0]) * std::size_t(grid.corners[1])};
    values_.reserve(step_[2] * std::size_t(grid.corners[2]));
    for_each({0, 0, 0},
             [&](const Index& i) { values_.push_back(field(grid_.corner(i[0], i[1], i[2]))); });
    vertex_of_cell_.resize(values_.size());
  }

  QuadMesh run() {
    for_each({1, 1, 1}, [&](const Index& i) { add_vertex(i); });
    for_each({1, 1, 1}, [&](const Index& i) {
      for (std::size_t axis = 0; axis < 3; ++axis) add_quad(number(i), axis);
    });
    return std::move(mesh_);
  }

 private:
  /// Calls for all corners but the last `margin` ones along each axis, x fastest.
  template <class Action>
  void for_each(const Index& margin, Action&& action) const {
    for (int k = 0; k < grid_.corners[2] - margin[2]; ++k) {
      for (int j = 0; j < grid_.corners[1] - margin[1]; ++j) {
        for (int i = 0; i < grid_.corners[0] - margin[0]; ++i) action(Index{i, j, k});
      }
    }
  }

  std::size_t number(const Index& i) const {
    return std::size_t(i[0]) + step_[1] * std::size_t(i[1]) + step_[2] * std::size_t(i[2]);
  }

  bool crossed(std::size_t a, std::size_t b) const { return (values_[a] < 0) != (values_[b] < 0); }

  void add_vertex(const Index& cell) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int crossings = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
      for (int edge = 0; edge < 4; ++edge) {
        Index low = cell;
        low[b] += edge & 1;
        low[c] += edge >> 1;
        const std::size_t from = number(low), to = from + step_[axis];
        if (!crossed(from, to)) continue;
        Eigen::Vector3d at(low[0], low[1], low[2]);
        at[Eigen::Index(axis)] += values_[from] / (values_[from] - values_[to]);
        sum += at;
        ++crossings;
      }
    }
    if (crossings == 0) return;
    vertex_of_cell_[number(cell)] = std::uint32_t(mesh_.vertices.size());
    mesh_.vertices.push_back(grid_.origin + grid_.cell / crossings * sum);
  }

  /// Around the edge from a corner along an axis, where the surface crosses it.
  void add_quad(std::size_t from, std::size_t axis) {
    if (!crossed(from, from + step_[axis])) return;
    const std::size_t b = step_[(axis + 1) % 3], c = step_[(axis + 2) % 3];
    const std::array<std::uint32_t, 4> around = {vertex_of_cell_[from - b - c],
                                                 vertex_of_cell_[from - c], vertex_of_cell_[from],
                                                 vertex_of_cell_[from - b]};
    if (values_[from] < 0) {
      mesh_.quads.push_back(around);
    } else {
      mesh_.quads.push_back({around[3], around[2], around[1], around[0]});
    }
  }

  const SamplingGrid& grid_;
  std::array<std::size_t, 3> step_;
  std::vector<double> values_;
  std::vector<std::uint32_t> vertex_of_cell_;
  QuadMesh mesh_;
};

}  // namespace

QuadMesh surface_nets(const Field& field, const SamplingGrid& grid) {
  return Nets(field, grid).run();
}

std::vector<Triangle> cut_in_two(const QuadMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * mesh.quads.size());
  for (const auto& [a, b, c, d] : mesh.quads) {
    const auto& v = mesh.vertices;
    if ((v[a] - v[c]).squaredNorm() <= (v[b] - v[d]).squaredNorm()) {
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    } else {
      triangles.push_back({a, b, d});
      triangles.push_back({b, c, d});
    }
  }
  return triangles;
}

}  // namespace vantage::raycore::detail
