#include "vantage/raycore/camera.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/packet_bits.hpp"
#include "geometry/pixel_direction.hpp"
#include "vantage/raycore/detail/multiversion.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr int kMaxImageSide = 16384;

/// World to camera in float: rotation row by row, and the camera's centre. Subtracting the centre
/// first keeps the rounding small for a camera far from the origin.
struct WorldToCamera {
  float r[9];
  float cx, cy, cz;

  explicit WorldToCamera(const Pose& T_world_cam)
      : cx(float(T_world_cam.translation().x())),
        cy(float(T_world_cam.translation().y())),
        cz(float(T_world_cam.translation().z())) {
    for (int row = 0; row < 3; ++row)
      for (int col = 0; col < 3; ++col) r[3 * row + col] = float(T_world_cam.rotation()(col, row));
  }
};

/// The image's borders as planes through the camera's centre: u >= -0.5 means
/// fx * x + left * z >= 0, and so on; no division, and no special case for z <= 0.
struct ViewBounds {
  float fx, fy, left, right, top, bottom, near_m, far_m;

  ViewBounds(const Intrinsics& k, const DepthRange& range)
      : fx(float(k.fx)),
        fy(float(k.fy)),
        left(float(k.cx + 0.5)),
        right(float(k.cx + 0.5 - k.width)),
        top(float(k.cy + 0.5)),
        bottom(float(k.cy + 0.5 - k.height)),
        near_m(float(range.near_m)),
        far_m(float(range.far_m)) {}
};

/// The one test that every variant of in_view makes, to the bit.
[[gnu::always_inline]] inline bool is_in_view(const WorldToCamera& c, const ViewBounds& b, float px,
                                              float py, float pz) {
  const float dx = px - c.cx, dy = py - c.cy, dz = pz - c.cz;
  const float x = c.r[0] * dx + c.r[1] * dy + c.r[2] * dz;
  const float y = c.r[3] * dx + c.r[4] * dy + c.r[5] * dz;
  const float z = c.r[6] * dx + c.r[7] * dy + c.r[8] * dz;
  const float u = b.fx * x, v = b.fy * y;
  return (z >= b.near_m) & (z <= b.far_m) & (u + b.left * z >= 0) & (u + b.right * z < 0) &
         (v + b.top * z >= 0) & (v + b.bottom * z < 0);
}

[[gnu::always_inline]] inline void in_view_body(const WorldToCamera& c, const ViewBounds& b,
                                                const float* __restrict px,
                                                const float* __restrict py,
                                                const float* __restrict pz, std::size_t count,
                                                std::uint8_t* __restrict result) {
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = std::uint8_t(is_in_view(c, b, px[i], py[i], pz[i]));
  }
}
constexpr Multiversion<in_view_body> in_view_kernel;

[[gnu::always_inline]] inline void in_view_packets_body(const WorldToCamera& c, const ViewBounds& b,
                                                        PointsView points,
                                                        const std::uint32_t* packets,
                                                        std::size_t count, std::uint16_t* masks) {
  for (std::size_t i = 0; i < count; ++i) {
    const PointsView packet = points.part(packets[i] * kPacketWidth, kPacketWidth);
    std::uint8_t flags[kPacketWidth];
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
      flags[lane] = std::uint8_t(is_in_view(c, b, packet.x[lane], packet.y[lane], packet.z[lane]));
    }
    masks[i] = raycore::detail::to_bits(flags);
  }
}
constexpr Multiversion<in_view_packets_body> in_view_packets_kernel;

[[gnu::always_inline]] inline void project_body(const WorldToCamera& c, float fx, float fy,
                                                float cx, float cy, const float* __restrict px,
                                                const float* __restrict py,
                                                const float* __restrict pz, std::size_t count,
                                                float* __restrict u, float* __restrict v,
                                                float* __restrict depth) {
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = px[i] - c.cx, dy = py[i] - c.cy, dz = pz[i] - c.cz;
    const float z = c.r[6] * dx + c.r[7] * dy + c.r[8] * dz;
    u[i] = fx * (c.r[0] * dx + c.r[1] * dy + c.r[2] * dz) / z + cx;
    v[i] = fy * (c.r[3] * dx + c.r[4] * dy + c.r[5] * dz) / z + cy;
    depth[i] = z;
  }
}
constexpr Multiversion<project_body> project_kernel;

void check_sizes(std::initializer_list<std::size_t> sizes, std::size_t expected) {
  for (const std::size_t size : sizes) {
    if (size == expected) continue;
    throw bad_input("batch", fmt::format("an array has {} elements; expected {}", size, expected));
  }
}

void check_positive(double value, const char* name, std::string_view where) {
  if (std::isfinite(value) && value > 0) return;
  throw bad_input(std::string(where),
                  fmt::format("{} is {}; expected a finite number above 0", name, value));
}

constexpr double kMaxPixels = 1e7;        // of a focal length, and of a principal point
constexpr double kMinFocalLength = 1e-6;  // image sides: what it sees then is a half-space

/// Whatever lies outside is no camera's, and what is computed with it is no number.
void check_focal_length(double f, int side, const char* name, std::string_view where) {
  check_positive(f, name, where);
  if (f >= kMinFocalLength * side && f <= kMaxPixels) return;
  throw bad_input(std::string(where),
                  fmt::format("{} is {}; expected {:g} to {:g} pixels for an image of {}", name, f,
                              kMinFocalLength * side, kMaxPixels, side));
}

}  // namespace

void Intrinsics::check(std::string_view where) const {
  for (const auto& [side, name] : {std::pair{width, "width"}, std::pair{height, "height"}}) {
    if (side >= 1 && side <= kMaxImageSide) continue;
    throw bad_input(std::string(where),
                    fmt::format("{} is {}; expected 1 to {} pixels", name, side, kMaxImageSide));
  }
  check_focal_length(fx, width, "fx", where);
  check_focal_length(fy, height, "fy", where);
  for (const auto& [value, name] : {std::pair{cx, "cx"}, std::pair{cy, "cy"}}) {
    if (std::abs(value) <= kMaxPixels) continue;
    throw bad_input(std::string(where), fmt::format("{} is {}; expected pixels, of at most {:g}",
                                                    name, value, kMaxPixels));
  }
}

void DepthRange::check(std::string_view where) const {
  check_positive(near_m, "the near depth", where);
  check_positive(far_m, "the far depth", where);
  if (near_m < far_m) return;
  throw bad_input(std::string(where), fmt::format("the depth range goes from {} to {} m; expected "
                                                  "near below far",
                                                  near_m, far_m));
}

PinholeCamera::PinholeCamera(const Intrinsics& intrinsics, const Pose& T_world_cam,
                             const DepthRange& range, std::string_view where)
    : intrinsics_(intrinsics), T_world_cam_(T_world_cam), range_(range) {
  intrinsics.check(where);
  range.check(where);
}

PinholeCamera PinholeCamera::moved_to(const Pose& T_world_cam) const {
  return {intrinsics_, T_world_cam, range_};
}

std::optional<ImagePoint> PinholeCamera::project(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p_cam = T_world_cam_.rotation().transpose() * (p_world - centre());
  if (!(p_cam.z() > 0)) return std::nullopt;
  return ImagePoint{intrinsics_.fx * p_cam.x() / p_cam.z() + intrinsics_.cx,
                    intrinsics_.fy * p_cam.y() / p_cam.z() + intrinsics_.cy, p_cam.z()};
}

PixelRay PinholeCamera::pixel_ray(double u, double v) const {
  const raycore::detail::PixelRotation R(T_world_cam_.rotation());
  const double x = (u - intrinsics_.cx) / intrinsics_.fx, y = (v - intrinsics_.cy) / intrinsics_.fy;
  return {centre(), {R.turned<0>(x, y), R.turned<1>(x, y), R.turned<2>(x, y)}};
}

Eigen::Vector3d PinholeCamera::unproject(double u, double v, double depth) const {
  const PixelRay ray = pixel_ray(u, v);
  return ray.origin + depth * ray.direction;
}

void PinholeCamera::project(PointsView p_world, std::span<float> u, std::span<float> v,
                            std::span<float> depth) const {
  check_sizes({u.size(), v.size(), depth.size()}, p_world.size);
  project_kernel(WorldToCamera(T_world_cam_), float(intrinsics_.fx), float(intrinsics_.fy),
                 float(intrinsics_.cx), float(intrinsics_.cy), p_world.x, p_world.y, p_world.z,
                 p_world.size, u.data(), v.data(), depth.data());
}

Points PinholeCamera::unproject(std::span<const float> u, std::span<const float> v,
                                std::span<const float> depth) const {
  check_sizes({v.size(), depth.size()}, u.size());
  Points points(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    points.set(i, unproject(double(u[i]), double(v[i]), double(depth[i])).cast<float>());
  }
  return points;
}

Points PinholeCamera::pixel_directions(std::span<const float> u, std::span<const float> v) const {
  check_sizes({v.size()}, u.size());
  Points directions(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    directions.set(i, pixel_ray(double(u[i]), double(v[i])).direction.cast<float>());
  }
  return directions;
}

bool PinholeCamera::in_view(const Eigen::Vector3f& p_world) const {
  std::uint8_t result = 0;
  in_view({&p_world.x(), &p_world.y(), &p_world.z(), 1}, {&result, 1});
  return result != 0;
}

void PinholeCamera::in_view(PointsView p_world, std::span<std::uint8_t> result) const {
  check_sizes({result.size()}, p_world.size);
  in_view_kernel(WorldToCamera(T_world_cam_), ViewBounds(intrinsics_, range_), p_world.x, p_world.y,
                 p_world.z, p_world.size, result.data());
}

void PinholeCamera::in_view(PointsView p_world, std::span<const std::uint32_t> packets,
                            std::span<std::uint16_t> masks) const {
  raycore::detail::check_packets(p_world.size, packets, {masks.size()});
  in_view_packets_kernel(WorldToCamera(T_world_cam_), ViewBounds(intrinsics_, range_), p_world,
                         packets.data(), packets.size(), masks.data());
}

}  // namespace vantage
