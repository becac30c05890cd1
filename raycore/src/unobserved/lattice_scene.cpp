#include "unobserved/lattice_scene.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace vantage::raycore::detail {
namespace {

constexpr float kWallTop = kHighest / kNearestPart;

/// Cells of a lattice, each 1 or 0.
class CellMask {
 public:
  explicit CellMask(const VisibilityMesh& lattice)
      : width_(int(lattice.width()) - 1),
        height_(int(lattice.height()) - 1),
        present_(std::size_t(width_) * std::size_t(height_)) {
    for (int j = 0; j < height_; ++j) {
      for (int i = 0; i < width_; ++i) {
        present_[at(i, j)] = lattice.has_cell(std::size_t(i), std::size_t(j));
      }
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool has(int i, int j) const { return contains(i, j) && present_[at(i, j)] != 0; }
  bool is_hole(int i, int j) const { return contains(i, j) && present_[at(i, j)] == 0; }
  void take(int i, int j) { present_[at(i, j)] = 0; }

 private:
  bool contains(int i, int j) const { return i >= 0 && j >= 0 && i < width_ && j < height_; }
  std::size_t at(int i, int j) const {
    return std::size_t(j) * std::size_t(width_) + std::size_t(i);
  }
  int width_, height_;
  std::vector<std::uint8_t> present_;
};

/// Takes the longest run of cells to the right of (i, j), and as many like it below as there are.
RTCGrid take_rectangle(CellMask& cells, int i, int j) {
  int right = i, bottom = j;
  while (cells.has(right, j)) ++right;
  const auto is_full = [&](int row) {
    for (int column = i; column < right; ++column) {
      if (!cells.has(column, row)) return false;
    }
    return true;
  };
  while (is_full(bottom)) {
    for (int column = i; column < right; ++column) cells.take(column, bottom);
    ++bottom;
  }
  const unsigned stride = unsigned(cells.width()) + 1;
  return {unsigned(j) * stride + unsigned(i), stride, std::uint16_t(right - i + 1),
          std::uint16_t(bottom - j + 1)};
}

/// Upright walls on edges of the lattice, two triangles each.
class Walls {
 public:
  std::vector<Triangle> triangles;

  explicit Walls(std::vector<Eigen::Vector3f>& vertices)
      : vertices_(vertices), tops_(vertices.size()) {}

  void add(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t above_from = top_of(from), above_to = top_of(to);
    triangles.push_back({from, to, above_to});
    triangles.push_back({from, above_to, above_from});
  }

 private:
  std::uint32_t top_of(std::uint32_t vertex) {
    if (tops_[vertex] == 0) {
      tops_[vertex] = std::uint32_t(vertices_.size());
      vertices_.push_back({vertices_[vertex].x(), vertices_[vertex].y(), kWallTop});
    }
    return tops_[vertex];
  }

  std::vector<Eigen::Vector3f>& vertices_;
  std::vector<std::uint32_t> tops_;  ///< 0: none yet
};

template <class Item>
void fill(const EmbreeDevice& device, RTCGeometry geometry, RTCBufferType type, RTCFormat format,
          const std::vector<Item>& items) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
  device.check();
  std::memcpy(buffer, items.data(), items.size() * sizeof(Item));
}

/// Gives the scene a geometry on the vertices in `buffer`.
template <class Item>
void attach(const EmbreeDevice& device, RTCScene scene, RTCGeometryType type, RTCBuffer buffer,
            std::size_t vertex_count, unsigned mask, RTCBufferType item_type, RTCFormat format,
            const std::vector<Item>& items) {
  if (items.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, type);
  rtcSetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, buffer, 0,
                       sizeof(Eigen::Vector3f), vertex_count);
  fill(device, geometry, item_type, format, items);
  rtcSetGeometryMask(geometry, mask);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  device.check();
}

}  // namespace

std::vector<Eigen::Vector3f> lattice_vertices(const VisibilityMesh& lattice,
                                              const LatticeProbe& probe) {
  std::vector<Eigen::Vector3f> vertices(lattice.depth.size());
  for (std::size_t j = 0, at = 0; j < lattice.height(); ++j) {
    for (std::size_t i = 0; i < lattice.width(); ++i, ++at) {
      const float w = probe.nearness[at];
      vertices[at] = {lattice.columns[i], lattice.rows[j], std::isnan(w) ? 0 : w};
    }
  }
  return vertices;
}

std::vector<RTCGrid> present_rectangles(const VisibilityMesh& lattice) {
  CellMask cells(lattice);
  std::vector<RTCGrid> rectangles;
  for (int j = 0; j < cells.height(); ++j) {
    for (int i = 0; i < cells.width(); ++i) {
      if (cells.has(i, j)) rectangles.push_back(take_rectangle(cells, i, j));
    }
  }
  return rectangles;
}

std::vector<Triangle> hole_walls(const VisibilityMesh& lattice,
                                 std::vector<Eigen::Vector3f>& vertices) {
  const CellMask cells(lattice);
  Walls walls(vertices);
  for (int j = 0; j < cells.height(); ++j) {
    for (int i = 0; i < cells.width(); ++i) {
      if (!cells.has(i, j)) continue;
      const auto width = std::uint32_t(lattice.width());
      const std::uint32_t a = std::uint32_t(j) * width + std::uint32_t(i), b = a + 1;
      const std::uint32_t c = b + width, d = a + width;  // a, b, c, d: clockwise in the image
      if (cells.is_hole(i, j - 1)) walls.add(b, a);
      if (cells.is_hole(i + 1, j)) walls.add(c, b);
      if (cells.is_hole(i, j + 1)) walls.add(d, c);
      if (cells.is_hole(i - 1, j)) walls.add(a, d);
    }
  }
  return std::move(walls.triangles);
}

LatticeScene::LatticeScene(const EmbreeDevice& device, const VisibilityMesh& lattice,
                           const LatticeProbe& probe)
    : scene_(rtcNewScene(device)) {
  std::vector<Eigen::Vector3f> vertices = lattice_vertices(lattice, probe);
  const std::vector<Triangle> walls = hole_walls(lattice, vertices);
  has_walls_ = !walls.empty();
  // One more than there are: Embree reads sixteen bytes at the last one.
  const std::size_t bytes = vertices.size() * sizeof(Eigen::Vector3f);
  RTCBuffer buffer = rtcNewBuffer(device, bytes + sizeof(Eigen::Vector3f));
  device.check();
  std::memcpy(rtcGetBufferData(buffer), vertices.data(), bytes);
  attach(device, scene_.get(), RTC_GEOMETRY_TYPE_GRID, buffer, vertices.size(), kCellsMask,
         RTC_BUFFER_TYPE_GRID, RTC_FORMAT_GRID, present_rectangles(lattice));
  attach(device, scene_.get(), RTC_GEOMETRY_TYPE_TRIANGLE, buffer, vertices.size(), kHolesMask,
         RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, walls);
  rtcReleaseBuffer(buffer);
  commit_scene(device, scene_.get());
}

}  // namespace vantage::raycore::detail
