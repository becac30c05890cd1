#include "reference/plain_classify.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage::test {
namespace {

bool near(double a, double b, double tolerance) {
  return std::abs(a - b) < tolerance;
}

/// Van Oosterom and Strackee's formula, signed.
double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    Eigen::Vector3d to_corner[3];
    for (int c = 0; c < 3; ++c) to_corner[c] = mesh.corner(t, c).cast<double>() - point;
    sum += solid_angle(to_corner[0], to_corner[1], to_corner[2]);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

bool plain_in_view(const PinholeCamera& camera, const Eigen::Vector3d& point, bool& close_call) {
  const std::optional<ImagePoint> p = camera.project(point);
  if (!p) return false;
  const Intrinsics& k = camera.intrinsics();
  const double pixels = 1e-2;  // generous: the float image is exact to a few thousandths of a pixel
  close_call |= near(p->u, -0.5, pixels) || near(p->u, k.width - 0.5, pixels) ||
                near(p->v, -0.5, pixels) || near(p->v, k.height - 0.5, pixels) ||
                near(p->depth, camera.range().near_m, kCloseCall) ||
                near(p->depth, camera.range().far_m, kCloseCall);
  return p->u >= -0.5 && p->u < k.width - 0.5 && p->v >= -0.5 && p->v < k.height - 0.5 &&
         p->depth >= camera.range().near_m && p->depth <= camera.range().far_m;
}

PlainClassifier::PlainClassifier(const WorldModel& world, const GridGeometry& geometry,
                                 const VolumeOptions& options)
    : world_(world), geometry_(geometry), options_(options) {
  for (const auto* list : {&world.objects, &world.static_structures}) {
    for (const KnownObject& object : *list) {
      known_.add(*object.mesh, object.T_world_object, ObjectId(solids_.size()));
      solids_.push_back(object.mesh->transformed(object.T_world_object));
    }
  }
}

Verdict PlainClassifier::hidden(const PinholeCamera& camera, const Eigen::Vector3d& point) const {
  return known_.occluded(point.cast<float>(), camera.centre().cast<float>());
}

bool PlainClassifier::inside_known(const Eigen::Vector3d& point, bool& close_call) const {
  for (const WorldTriangle& triangle : known_.triangles()) {
    close_call |= triangle.distance_to_plane(point) < kCloseCall;
  }
  for (const TriangleMesh& solid : solids_) {
    if (std::abs(winding_number(solid, point)) > 0.5) return true;
  }
  return false;
}

bool PlainClassifier::holds_measured_point(const DepthCamera& observer,
                                           const Eigen::Vector3i& voxel, bool& close_call) const {
  bool holds = false;
  const Eigen::Vector3d low = geometry_.corner(voxel);
  const Eigen::Vector3d high = geometry_.corner(voxel + Eigen::Vector3i::Ones());
  for (int v = 0; v < observer.depth->height(); ++v) {
    for (int u = 0; u < observer.depth->width(); ++u) {
      const double d = double(observer.depth->at(u, v));
      const DepthRange& range = observer.camera.range();
      if (!(d >= range.near_m && d <= range.far_m)) continue;  // beyond it there is no surface
      const Eigen::Vector3d p = observer.camera.unproject(u, v, d);
      const Eigen::Array3d inside = (p - low).cwiseMin(high - p).array();  // >= 0 within
      if (inside.minCoeff() > -1e-9) {
        close_call |= inside.minCoeff() < 1e-9;
        holds = true;
      }
    }
  }
  return holds;
}

PlainClassifier::Says PlainClassifier::compare_with_depth(const DepthCamera& observer,
                                                          const Eigen::Vector3i& voxel,
                                                          bool& close_call) const {
  const Eigen::Vector3d centre = geometry_.centre(voxel);
  if (!plain_in_view(observer.camera, centre, close_call)) return Says::outside;
  if (holds_measured_point(observer, voxel, close_call)) return Says::surface;
  const ImagePoint p = *observer.camera.project(centre);
  close_call |=
      near(p.u + 0.5, std::round(p.u + 0.5), 1e-2) || near(p.v + 0.5, std::round(p.v + 0.5), 1e-2);
  const Intrinsics& k = observer.camera.intrinsics();
  const int u = std::min(int(std::floor(p.u + 0.5)), k.width - 1);
  const int v = std::min(int(std::floor(p.v + 0.5)), k.height - 1);
  const double d = double(observer.depth->at(u, v));
  const DepthRange& range = observer.camera.range();
  if (!(d >= range.near_m)) return Says::unmeasured;
  const double band =
      std::max(geometry_.voxel_size_m(), options_.band_sigmas * options_.noise.sigma_m(d));
  close_call |= near(std::abs(p.depth - d), band / 2, kCloseCall);
  if (std::abs(p.depth - d) <= band / 2) return d <= range.far_m ? Says::surface : Says::hidden;
  return p.depth < d ? Says::free : Says::hidden;
}

bool PlainClassifier::sees_through(const DepthCamera& observer, const Eigen::Vector3i& voxel,
                                   bool& close_call) const {
  return observer.depth != nullptr && compare_with_depth(observer, voxel, close_call) == Says::free;
}

PlainClassifier::Says PlainClassifier::ask(const DepthCamera& observer,
                                           const Eigen::Vector3i& voxel, bool& close_call) const {
  const Eigen::Vector3d centre = geometry_.centre(voxel);
  if (observer.depth != nullptr) {
    const Says says = compare_with_depth(observer, voxel, close_call);
    if (says != Says::free && says != Says::unmeasured) return says;
    const Verdict verdict = hidden(observer.camera, centre);
    close_call |= verdict.close_call;
    return verdict.hit ? Says::hidden : says;
  }
  if (!plain_in_view(observer.camera, centre, close_call)) return Says::outside;
  const Verdict verdict = hidden(observer.camera, centre);
  close_call |= verdict.close_call;
  return verdict.hit ? Says::hidden : Says::free;
}

PlainState PlainClassifier::classify(const Eigen::Vector3i& voxel) const {
  PlainState result;
  if (inside_known(geometry_.centre(voxel), result.close_call)) {
    result.state = VoxelState::occupied;
    return result;
  }
  result.cause = ShadowCause::outside;
  for (const DepthCamera& observer : world_.cameras) {
    const Says says = ask(observer, voxel, result.close_call);
    if (says == Says::free) result.state = VoxelState::free;
    if (says == Says::surface) result.measured = true;
    if (says == Says::hidden) result.cause = ShadowCause::hidden;
    if (says == Says::unmeasured && result.cause == ShadowCause::outside) {
      result.cause = ShadowCause::unmeasured;
    }
  }
  result.measured = result.measured && result.state != VoxelState::free;
  if (result.measured) result.state = VoxelState::occupied;
  if (result.state != VoxelState::shadow) result.cause.reset();
  return result;
}

}  // namespace vantage::test
