#include "scoring/expected/given_depth.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vantage/volume/advanced/classify.hpp"

namespace vantage::planner::detail {
namespace {

constexpr int kColumns = 160;       // of a thinned-out image, about
constexpr int kPixelStep = 2;       // of it, where every pixel would tell the same
constexpr float kEdge = 0.04f;      // neighbours whose depths differ by more belong to two things
constexpr double kLargestM = 0.3;   // what looks wider is a wall, and is not expected to end
constexpr float kJump = 1.2f;       // neighbours with depths of a larger ratio are not one surface
constexpr double kTolerance = 3;    // σ
constexpr double kFloorM = 0.02;    // of models of the floor
constexpr double kMinCosine = 0.2;  // rays along the floor tell nothing

PinholeCamera thinned_out(const PinholeCamera& camera, int step) {
  const Intrinsics& k = camera.intrinsics();
  return PinholeCamera({(k.width - 1) / step + 1, (k.height - 1) / step + 1, k.fx / step,
                        k.fy / step, k.cx / step, k.cy / step},
                       camera.T_world_cam(), camera.range());
}

/// Finds runs of pixels on one unknown surface along a row or a column, and notes how long they
/// are.
void add_runs(GivenDepth& image, std::size_t first, std::size_t stride, std::size_t count,
              double focal_px) {
  const auto pixel = [&](std::size_t i) { return first + i * stride; };
  for (std::size_t begin = 0; begin < count;) {
    if (!image.unknown_at(pixel(begin))) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    float sum = image.measured[pixel(begin)];
    for (; end < count && image.unknown_at(pixel(end)); ++end) {
      const float a = image.measured[pixel(end - 1)], b = image.measured[pixel(end)];
      if (std::abs(a - b) > kEdge * std::min(a, b)) break;
      sum += b;
    }
    const double depth = double(sum) / double(end - begin);
    const auto width = float(double(end - begin) * depth / focal_px);
    for (std::size_t i = begin; i < end; ++i) {
      image.width[pixel(i)] = std::min(image.width[pixel(i)], width);
    }
    begin = end;
  }
}

void add_widths(GivenDepth& image) {
  const Intrinsics& k = image.camera.intrinsics();
  const auto width = std::size_t(k.width), height = std::size_t(k.height);
  image.width.assign(width * height, std::numeric_limits<float>::infinity());
  for (std::size_t v = 0; v < height; ++v) add_runs(image, v * width, 1, width, k.fx);
  for (std::size_t u = 0; u < width; ++u) add_runs(image, u, width, height, k.fy);
}

GivenDepth given_depth(const DepthCamera& given, const Scene& known, double sigma_1m,
                       double voxel_m) {
  const int step = std::max(1, given.camera.intrinsics().width / kColumns);
  GivenDepth image{thinned_out(given.camera, step), {}, {}, {}, sigma_1m, voxel_m};
  const Intrinsics& k = image.camera.intrinsics();
  for (int v = 0; v < k.height; ++v)
    for (int u = 0; u < k.width; ++u) image.measured.push_back(given.depth->at(step * u, step * v));
  const DepthImage rendered = known.render_depth(image.camera);
  for (const float z : rendered.metres()) {
    image.known.push_back(std::isnan(z) ? std::numeric_limits<float>::infinity() : z);
  }
  add_widths(image);
  return image;
}

/// Calls `visit(pixel, ray)` for some of an image's pixels.
template <class Visit>
void for_each_ray(const GivenDepth& image, const Visit& visit) {
  const Intrinsics& k = image.camera.intrinsics();
  for (int v = 0; v < k.height; v += kPixelStep) {
    for (int u = 0; u < k.width; u += kPixelStep) {
      visit(std::size_t(v) * std::size_t(k.width) + std::size_t(u), image.camera.pixel_ray(u, v));
    }
  }
}

/// Depths at which a ray enters and leaves a box: the first above the second if it misses it.
std::array<double, 2> crossing(const PixelRay& ray, const Box& box) {
  double in = 0, out = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = 1 / ray.direction[axis];
    const double a = (box.min()[axis] - ray.origin[axis]) * slope;
    const double b = (box.max()[axis] - ray.origin[axis]) * slope;
    in = std::max(in, std::min(a, b)), out = std::min(out, std::max(a, b));
  }
  return {in, out};
}

/// How far rays went through the work area, and how many of them something unknown stopped.
struct Passage {
  double length_m = 0;
  std::size_t stops = 0;

  void add(const GivenDepth& image, std::size_t pixel, const PixelRay& ray, const Box& area) {
    const float measured = image.measured[pixel];
    if (std::isnan(measured)) return;
    const auto [in, out] = crossing(ray, area);
    const double end = std::min({double(measured), double(image.known[pixel]), out});
    if (!(end > in)) return;
    length_m += (end - in) * ray.direction.norm();
    // The floor stops rays, too, and is no thing in the work area.
    const double height = (ray.origin + double(measured) * ray.direction).z();
    const double noise = kTolerance * image.sigma_m(double(measured)) + image.voxel_m;
    stops += double(measured) < out && height - area.min().z() > noise && image.unknown_at(pixel);
  }
};

/// Where a ray meets the floor, if it does within the range.
std::optional<double> floor_depth(const GivenDepth& image, const PixelRay& ray,
                                  const std::optional<double>& floor_z_m) {
  if (!floor_z_m) return std::nullopt;
  const double depth = (*floor_z_m - ray.origin.z()) / ray.direction.z();
  const bool there = ray.direction.z() < 0 && depth >= image.camera.range().near_m &&
                     depth <= image.camera.range().far_m;
  if (!there) return std::nullopt;
  return depth;
}

void add_reading(const GivenDepth& image, std::size_t pixel, const PixelRay& ray,
                 const std::optional<double>& floor_z_m, LearnedRates& rates) {
  const double measured = double(image.measured[pixel]);
  if (std::isfinite(image.known[pixel])) return;
  const std::optional<double> floor = floor_depth(image, ray, floor_z_m);
  if (!floor) {
    ++rates.beyond.pixels;
    rates.beyond.readings += measured <= image.camera.range().far_m;
    return;
  }
  const double tolerance = kTolerance * image.sigma_m(*floor) + kFloorM;
  if (measured < *floor - tolerance) return;  // something stands on it
  if (-ray.direction.normalized().z() < kMinCosine) return;
  rates.floor.add((ray.origin + *floor * ray.direction).head<2>(), measured < *floor + tolerance);
}

}  // namespace

bool GivenDepth::unknown_at(std::size_t pixel) const {
  const double depth = double(measured[pixel]);
  return double(known[pixel]) > depth + kTolerance * sigma_m(depth) + voxel_m;
}

std::vector<GivenDepth> given_depths(const WorldModel& world, const VolumeOptions& volume,
                                     double voxel_m) {
  const auto known = known_scene(world);
  std::vector<GivenDepth> images;
  for (const DepthCamera& camera : world.cameras) {
    if (camera.depth == nullptr) continue;
    images.push_back(given_depth(camera, *known, volume.noise.sigma_m(1), voxel_m));
  }
  return images;
}

LearnedRates learned_rates(const std::vector<GivenDepth>& images, const Box& work_area,
                           const std::optional<double>& floor_z_m) {
  LearnedRates rates{0, FloorRates(work_area.centre().head<2>()), {}};
  Passage passage;
  for (const GivenDepth& image : images) {
    for_each_ray(image, [&](std::size_t pixel, const PixelRay& ray) {
      passage.add(image, pixel, ray, work_area);
      add_reading(image, pixel, ray, floor_z_m, rates);
    });
  }
  if (passage.stops > 0) rates.hazard_per_m = double(passage.stops) / passage.length_m;
  return rates;
}

namespace {

/// The background of one image.
class BackgroundGrid {
 public:
  BackgroundGrid(const GivenDepth& image, std::vector<Eigen::Vector3f>& points,
                 std::vector<Triangle>& triangles)
      : image_(image), width_(image.camera.intrinsics().width), triangles_(triangles) {
    vertex_.assign(image.measured.size(), kNone);
    for_each_ray(image, [&](std::size_t pixel, const PixelRay& ray) {
      const double depth = double(image.measured[pixel]);
      if (std::isnan(depth)) return;
      const Eigen::Vector3d point = ray.origin + depth * ray.direction;
      vertex_[pixel] = std::uint32_t(points.size());
      points.push_back(point.cast<float>());
    });
    const int height = image.camera.intrinsics().height;
    for (int v = 0; v + kPixelStep < height; v += kPixelStep)
      for (int u = 0; u + kPixelStep < width_; u += kPixelStep) add_square(u, v);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);

  void add_square(int u, int v) {
    const auto at = [&](int du, int dv) {
      return std::size_t(v + dv * kPixelStep) * std::size_t(width_) +
             std::size_t(u + du * kPixelStep);
    };
    add_triangle(at(0, 0), at(0, 1), at(1, 0));
    add_triangle(at(1, 0), at(0, 1), at(1, 1));
  }

  void add_triangle(std::size_t a, std::size_t b, std::size_t c) {
    if (vertex_[a] == kNone || vertex_[b] == kNone || vertex_[c] == kNone) return;
    const auto [near, far] =
        std::minmax({image_.measured[a], image_.measured[b], image_.measured[c]});
    if (far <= kJump * near) triangles_.push_back({vertex_[a], vertex_[b], vertex_[c]});
  }

  const GivenDepth& image_;
  int width_;
  std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t> vertex_;
};

/// How probable it is that a point in the shadow is inside a thing whose front was measured.
double solid_probability(const GivenDepth& image, float u, float v, float z, double depth_widths) {
  const Intrinsics& k = image.camera.intrinsics();
  if (!(z > 0 && u >= -0.5f && v >= -0.5f && u < float(k.width) - 0.5f &&
        v < float(k.height) - 0.5f)) {
    return 0;
  }
  const std::size_t pixel =
      std::size_t(int(v + 0.5f)) * std::size_t(k.width) + std::size_t(int(u + 0.5f));
  const float measured = image.measured[pixel];
  if (!(measured < z) || measured > float(image.camera.range().far_m)) return 0;
  if (!image.unknown_at(pixel)) return 0;
  const double width = std::min(double(image.width[pixel]), kLargestM);
  const double behind = double(z - measured) / (depth_widths * width);
  return std::exp(-behind * behind);
}

}  // namespace

TriangleMesh background_mesh(const std::vector<GivenDepth>& images) {
  std::vector<Eigen::Vector3f> points;
  std::vector<Triangle> triangles;
  for (const GivenDepth& image : images) BackgroundGrid(image, points, triangles);
  return TriangleMesh(std::move(points), std::move(triangles), "background");
}

void fill_cells(PointsView shadow, const std::vector<GivenDepth>& images, double unknown_depth,
                ShadowCells& cells) {
  std::vector<float> not_solid(shadow.size, 1);
  constexpr std::size_t kChunk = 4096;
  tbb::parallel_for(std::size_t(0), (shadow.size + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk, count = std::min(kChunk, shadow.size - first);
    std::array<float, kChunk> u, v, z;
    for (const GivenDepth& image : images) {
      image.camera.project(shadow.part(first, count), {u.data(), count}, {v.data(), count},
                           {z.data(), count});
      for (std::size_t i = 0; i < count; ++i) {
        const double p =
            unknown_depth > 0 ? solid_probability(image, u[i], v[i], z[i], unknown_depth) : 0.0;
        not_solid[first + i] *= float(1 - p);
      }
    }
  });
  std::vector<float> voxels(cells.unseen.size()), sum(voxels.size());
  for (std::size_t i = 0; i < shadow.size; ++i) {
    const std::size_t cell = cells.index_of(shadow[i].cast<double>());
    voxels[cell] += 1, sum[cell] += 1 - not_solid[i];
  }
  const double all = std::pow(std::round(cells.cell_m / cells.voxel_m), 3);
  for (std::size_t cell = 0; cell < voxels.size(); ++cell) {
    cells.unseen[cell] = std::uint8_t(std::lround(255 * std::min(1.0, double(voxels[cell]) / all)));
    if (voxels[cell] > 0)
      cells.solid[cell] = std::uint8_t(std::lround(255 * double(sum[cell] / voxels[cell])));
  }
}

}  // namespace vantage::planner::detail
