#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vantage {

/// Rays are traced sixteen at a time. Packet p of an array of points is points 16 p to 16 p + 15.
inline constexpr std::size_t kPacketWidth = 16;

/// A read-only view of N points or directions, one array per coordinate. Does not own them.
struct PointsView {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t size = 0;

  Eigen::Vector3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  PointsView part(std::size_t first, std::size_t count) const {
    return {x + first, y + first, z + first, count};
  }
};

/// N points or directions, metres, one array per coordinate: what 16-wide packets load directly.
struct Points {
  std::vector<float> x, y, z;

  Points() = default;
  explicit Points(std::size_t size) : x(size), y(size), z(size) {}

  std::size_t size() const noexcept { return x.size(); }
  void resize(std::size_t size) { x.resize(size), y.resize(size), z.resize(size); }
  void reserve(std::size_t size) { x.reserve(size), y.reserve(size), z.reserve(size); }
  void clear() { resize(0); }
  void push_back(const Eigen::Vector3f& p) {
    x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
  }
  void set(std::size_t i, const Eigen::Vector3f& p) { x[i] = p.x(), y[i] = p.y(), z[i] = p.z(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  operator PointsView() const { return {x.data(), y.data(), z.data(), x.size()}; }
  PointsView view() const { return *this; }
};

}  // namespace vantage
