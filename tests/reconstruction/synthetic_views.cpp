#include "reconstruction/synthetic_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::test {
namespace {

constexpr Intrinsics kViewIntrinsics{640, 480, 615, 612, 320.5, 238.5};
constexpr Distortion kViewDistortion{-0.05, 0.03, 0.0006, -0.0004, -0.005};

/// The middle of a box's side; z points outwards.
Pose side_frame(const Eigen::Vector3d& size, int side) {
  const int axis = side / 2;
  const double sign = side % 2 == 0 ? 1 : -1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  rotation((axis + 1) % 3, 0) = 1;
  rotation((axis + 2) % 3, 1) = sign;
  rotation(axis, 2) = sign;
  return Pose::from_rotation(rotation, rotation.col(2) * size[axis] / 2);
}

double sphere_radius(const ObjectType& type) {
  double radius = 0;
  for (const Eigen::Vector3f& vertex : type.mesh->vertices()) {
    radius = std::max(radius, double(vertex.norm()));
  }
  return radius;
}

std::vector<FeatureKey> keys_of(const std::vector<PlacedObject>& objects) {
  std::vector<FeatureKey> keys;
  for (const PlacedObject& object : objects) {
    for (const ObjectFeature& feature : object.type->features) keys.push_back(feature.key);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// The pixels of a marker at its true place, if a camera at its true place sees it.
bool sees(const Lens& lens, const Pose& T_world_cam, const Marker& marker,
          const Pose& T_world_object, const Scene* scene, std::vector<Eigen::Vector2d>& pixels) {
  const Pose T_cam_object = T_world_cam.inverse() * T_world_object;
  const Pose T_cam_marker = T_cam_object * marker.T_object_marker;
  const Eigen::Vector3d to_camera = -T_cam_marker.translation().normalized();
  if (T_cam_marker.rotation().col(2).dot(to_camera) < std::sin(20 * std::numbers::pi / 180)) {
    return false;
  }
  for (const Eigen::Vector3d& corner : marker.corners()) {
    const Eigen::Vector3d p = T_cam_object * corner;
    if (p.z() < 0.05) return false;
    const Eigen::Vector2d pixel = lens.project(p);
    const Intrinsics& k = lens.intrinsics();
    if (!(pixel.x() > 3 && pixel.y() > 3 && pixel.x() < k.width - 4 && pixel.y() < k.height - 4)) {
      return false;
    }
    const Eigen::Vector3d above = corner + 0.0005 * marker.T_object_marker.rotation().col(2);
    if (scene && scene->occluded((T_world_object * above).cast<float>(),
                                 T_world_cam.translation().cast<float>())) {
      return false;
    }
    pixels.push_back(pixel);
  }
  return true;
}

/// Moves the view's pose off the truth, by what its covariance then says.
void disturb(CameraView& view, const ViewNoise& noise, Random& random) {
  if (noise.camera_m == 0 && noise.camera_rad == 0) return;
  const Eigen::Vector3d t = normal_vector(random, noise.camera_m);
  const Eigen::Vector3d r = normal_vector(random, noise.camera_rad);
  view.T_world_cam = moved_by(*view.T_world_cam, t, r);
  view.covariance.setZero();
  view.covariance.diagonal().head<3>().setConstant(noise.camera_m * noise.camera_m);
  view.covariance.diagonal().tail<3>().setConstant(noise.camera_rad * noise.camera_rad);
}

}  // namespace

Eigen::Vector3d normal_vector(Random& random, double sigma) {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = sigma * normal(random);
  return v;
}

Pose moved_by(const Pose& pose, const Eigen::Vector3d& t, const Eigen::Vector3d& r) {
  const double angle = r.norm();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (angle > 0) turn = Eigen::AngleAxisd(angle, r / angle).toRotationMatrix();
  return Pose::from_rotation(turn * pose.rotation(), pose.translation() + t);
}

Eigen::Matrix<double, 6, 1> difference(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.rotation() * from.rotation().transpose()));
  Eigen::Matrix<double, 6, 1> d;
  d << to.translation() - from.translation(), turn.angle() * turn.axis();
  return d;
}

ObjectType marked_box(const std::string& name, const Eigen::Vector3d& size_m, int first_id,
                      int faces, double share) {
  ObjectType type;
  type.name = name;
  type.mesh = std::make_shared<const TriangleMesh>(box_solid(size_m));
  for (int side = 0; side < faces; ++side) {
    const int axis = side / 2;
    const double edge = std::min(size_m[(axis + 1) % 3], size_m[(axis + 2) % 3]);
    type.features.push_back(
        marker_feature({"4X4_250", first_id + side, share * edge, side_frame(size_m, side)}));
  }
  return type;
}

std::vector<CameraView> cameras_around(Random& random, int count, double radius_m) {
  // Made once: a lens looks at its whole border first.
  static const Lens plain(kViewIntrinsics, {}), bent(kViewIntrinsics, kViewDistortion);
  std::vector<CameraView> views;
  for (int i = 0; i < count; ++i) {
    const double height = random.uniform(0.35, 0.9), turn = random.uniform(0, 2 * std::numbers::pi);
    const double across = std::sqrt(1 - height * height);
    const Eigen::Vector3d eye(across * std::cos(turn), across * std::sin(turn), height);
    views.push_back({"camera " + std::to_string(i), i % 2 == 0 ? plain : bent,
                     Pose::looking_at(radius_m * eye, random.in_cube(0.02))});
  }
  return views;
}

std::vector<PlacedObject> scattered(Random& random, const std::vector<TypePtr>& types, int count,
                                    double half_m) {
  std::vector<PlacedObject> objects;
  for (int tries = 0; int(objects.size()) < count && tries < 100000; ++tries) {
    const TypePtr& type = types[random.below(std::uint32_t(types.size()))];
    const Pose turn = random.pose(0.0);
    const double radius = sphere_radius(*type);
    const Eigen::Vector3d place(random.uniform(-half_m, half_m), random.uniform(-half_m, half_m),
                                radius);
    const bool apart = std::all_of(objects.begin(), objects.end(), [&](const PlacedObject& other) {
      const double distance = (other.T_world_object.translation() - place).norm();
      return distance > radius + sphere_radius(*other.type);
    });
    if (apart) objects.push_back({type, Pose::from_rotation(turn.rotation(), place)});
  }
  return objects;
}

std::vector<std::vector<int>> look_at(std::vector<CameraView>& views,
                                      const std::vector<PlacedObject>& objects,
                                      const ViewNoise& noise, Random& random) {
  SceneBuilder builder;
  for (const PlacedObject& object : objects) {
    builder.add_mesh(object.type->mesh->transformed(object.T_world_object));
  }
  const auto scene = noise.occlusion ? builder.build() : nullptr;
  const std::vector<FeatureKey> keys = keys_of(objects);
  std::vector<std::vector<int>> owners(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    CameraView& view = views[v];
    for (std::size_t i = 0; i < objects.size(); ++i) {
      for (const ObjectFeature& feature : objects[i].type->features) {
        const auto* marker = std::get_if<Marker>(&feature.geometry);
        SeenPoints seen{{}, noise.sigma_px > 0 ? noise.sigma_px : 0.1};
        if (!marker || !sees(view.lens, *view.T_world_cam, *marker, objects[i].T_world_object,
                             scene.get(), seen.pixels)) {
          continue;
        }
        if (random.uniform(0, 1) < noise.missing) continue;
        for (Eigen::Vector2d& pixel : seen.pixels) {
          for (int axis = 0; axis < 2; ++axis) pixel[axis] += noise.sigma_px * normal(random);
        }
        FeatureKey key = feature.key;
        const bool wrong = random.uniform(0, 1) < noise.wrong_id;
        while (wrong && key == feature.key) key = keys[random.below(std::uint32_t(keys.size()))];
        owners[v].push_back(wrong ? kNobody : int(i));
        view.observations.push_back({key, std::move(seen)});
      }
    }
    disturb(view, noise, random);
  }
  return owners;
}

PoseError pose_error(const ObjectType& type, const Pose& found, const Pose& truth) {
  const auto error = [&](const Pose& same) {
    const auto d = difference(same, found);
    return PoseError{d.head<3>().norm(), d.tail<3>().norm()};
  };
  PoseError best = error(truth);
  for (const Pose& symmetry : type.symmetries.discrete) {
    const PoseError other = error(truth * symmetry);
    if (std::pair(other.m, other.rad) < std::pair(best.m, best.rad)) best = other;
  }
  return best;
}

}  // namespace vantage::test
