#include "scoring/shadow/lane_projection.hpp"

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::planner::detail {
namespace {

struct BoxPointers {
  const double *x, *y, *z, *half_x, *half_y, *half_z;
};

[[gnu::always_inline]] inline void project_all_body(const Projection& p, const PointArrays& points,
                                                    std::size_t count, double* __restrict u,
                                                    double* __restrict v,
                                                    double* __restrict depth) {
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = points.x[i] - p.eye[0], dy = points.y[i] - p.eye[1],
                 dz = points.z[i] - p.eye[2];
    const double x = p.r[0] * dx + p.r[1] * dy + p.r[2] * dz;
    const double y = p.r[3] * dx + p.r[4] * dy + p.r[5] * dz;
    const double z = p.r[6] * dx + p.r[7] * dy + p.r[8] * dz;
    const double inverse = 1 / z;
    u[i] = p.fx * x * inverse + p.cx;
    v[i] = p.fy * y * inverse + p.cy;
    depth[i] = z;
  }
}
constexpr Multiversion<project_all_body> project_all;

[[gnu::always_inline]] inline void project_eight_body(const Projection& p, const BoxPointers& boxes,
                                                      BoxImages& images) {
  for (std::size_t i = 0; i < kBoxLanes; ++i) {
    images.left[i] = images.top[i] = images.nearest[i] = 1e300;
    images.right[i] = images.bottom[i] = images.farthest[i] = -1e300;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const double sx = (corner & 1) != 0 ? 1 : -1, sy = (corner & 2) != 0 ? 1 : -1,
                 sz = (corner & 4) != 0 ? 1 : -1;
    for (std::size_t i = 0; i < kBoxLanes; ++i) {
      const double dx = boxes.x[i] + sx * boxes.half_x[i] - p.eye[0],
                   dy = boxes.y[i] + sy * boxes.half_y[i] - p.eye[1],
                   dz = boxes.z[i] + sz * boxes.half_z[i] - p.eye[2];
      const double z = p.r[6] * dx + p.r[7] * dy + p.r[8] * dz, inverse = 1 / z;
      const double u = p.fx * (p.r[0] * dx + p.r[1] * dy + p.r[2] * dz) * inverse + p.cx;
      const double v = p.fy * (p.r[3] * dx + p.r[4] * dy + p.r[5] * dz) * inverse + p.cy;
      images.left[i] = u < images.left[i] ? u : images.left[i];
      images.right[i] = u > images.right[i] ? u : images.right[i];
      images.top[i] = v < images.top[i] ? v : images.top[i];
      images.bottom[i] = v > images.bottom[i] ? v : images.bottom[i];
      images.nearest[i] = z < images.nearest[i] ? z : images.nearest[i];
      images.farthest[i] = z > images.farthest[i] ? z : images.farthest[i];
    }
  }
}
constexpr Multiversion<project_eight_body> project_eight;

}  // namespace

Projection::Projection(const PinholeCamera& camera)
    : eye{camera.centre().x(), camera.centre().y(), camera.centre().z()},
      fx(camera.intrinsics().fx),
      fy(camera.intrinsics().fy),
      cx(camera.intrinsics().cx),
      cy(camera.intrinsics().cy) {
  for (int i = 0; i < 9; ++i) r[i] = camera.T_world_cam().rotation()(i % 3, i / 3);
}

void project_points(const Projection& p, const PointArrays& points, std::size_t count, double* u,
                    double* v, double* depth) {
  project_all(p, points, count, u, v, depth);
}

void project_boxes(const Projection& p, const BoxLanes& boxes, std::size_t first,
                   BoxImages& images) {
  project_eight(p,
                {&boxes.centre_x[first], &boxes.centre_y[first], &boxes.centre_z[first],
                 &boxes.half_x[first], &boxes.half_y[first], &boxes.half_z[first]},
                images);
}

}  // namespace vantage::planner::detail
