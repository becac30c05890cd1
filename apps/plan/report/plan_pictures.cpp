#include "plan/report/plan_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "plan/report/picture_legend.hpp"
#include "plan/report/plan_shapes.hpp"
#include "simulator/scene/resized_camera.hpp"
#include "vantage/raycore/advanced/picture.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/mesh_io.hpp"

namespace vantage {
namespace {

double azimuth_of(const Eigen::Vector3d& v) {
  return std::atan2(v.y(), v.x());
}

/// From which azimuth to look: beside the suggested camera, on the side where the mean of the given
/// ones is, so that both of them are seen and neither stands in the way.
double overview_azimuth(const Plan& plan, const WorldModel& world) {
  const Eigen::Vector3d centre = plan.request.work_area.centre();
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  for (const DepthCamera& observer : world.cameras) given += observer.camera.centre() - centre;
  const double given_azimuth = azimuth_of(given);
  const std::vector<PinholeCamera> cameras = suggested_cameras(plan);
  if (cameras.empty()) return given_azimuth + std::numbers::pi / 3;
  const Eigen::Vector3d suggested = cameras.front().centre() - centre;
  const bool from_above = suggested.head<2>().norm() < 0.3 * suggested.norm();
  if (from_above) return given_azimuth + std::numbers::pi / 3;
  const double turn = std::remainder(given_azimuth - azimuth_of(suggested), 2 * std::numbers::pi);
  return azimuth_of(suggested) + (turn < 0 ? -1 : 1) * std::numbers::pi / 3.6;
}

}  // namespace

PinholeCamera overview_camera(const Plan& plan, const WorldModel& world, int width) {
  const int height = std::max(1, width * 5 / 8);
  std::vector<Eigen::Vector3d> points;
  for (const ColoredMesh& part : camera_meshes(plan, world)) {
    for (const Eigen::Vector3f& p : part.mesh.vertices()) points.push_back(p.cast<double>());
  }
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Eigen::Vector3d centre = 0.5 * (low + high);
  const double azimuth = overview_azimuth(plan, world), elevation = 0.48;
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Pose pose = Pose::looking_at(centre + 1.5 * (high - low).norm() * direction, centre);

  const PinholeCamera unit({width, height, 1, 1, 0, 0}, pose);
  Eigen::Array2d least(1e9, 1e9), most(-1e9, -1e9);
  for (const Eigen::Vector3d& p : points) {
    const std::optional<ImagePoint> q = unit.project(p);
    least = least.min(Eigen::Array2d(q->u, q->v)), most = most.max(Eigen::Array2d(q->u, q->v));
  }
  const Eigen::Array2d size(width, height);
  const double focal = (0.93 * size / (most - least)).minCoeff();
  const Eigen::Array2d principal = 0.5 * size - focal * 0.5 * (least + most);
  return PinholeCamera({width, height, focal, focal, principal.x(), principal.y()}, pose);
}

namespace {

const Eigen::Vector3f kFloor(0.90f, 0.90f, 0.91f);

/// Pictures of one size, each with its share of their mean.
class Blend {
 public:
  void add(const ColorImage& image, double share) {
    if (sums_.empty()) {
      result_ = image;
      sums_.assign(image.samples.size(), kOne / 2);
    }
    const auto part = std::uint32_t(std::lround(share * kOne));
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += part * image.samples[i];
  }

  ColorImage image() && {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      result_.samples[i] = std::uint8_t(std::min(255u, sums_[i] / kOne));
    }
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t kOne = 1u << 16;
  ColorImage result_;
  std::vector<std::uint32_t> sums_;
};

ColorImage enlarged(ColorImage image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  ColorImage result(width, height);
  cv::Mat3b small(image.height, image.width, reinterpret_cast<cv::Vec3b*>(image.samples.data()));
  cv::Mat3b large(height, width, reinterpret_cast<cv::Vec3b*>(result.samples.data()));
  cv::resize(small, large, large.size(), 0, 0, cv::INTER_CUBIC);
  return result;
}

/// A scene to draw, with its objects' looks.
class Stage {
 public:
  Stage(const Plan& plan, PictureQuality quality) : plan_(plan), quality_(quality) {}

  void add_voxels() {
    const GridGeometry& geometry = plan_.grid->geometry();
    for (const ColoredMesh& part : voxel_meshes(*plan_.grid)) {
      if (part.mesh.empty()) continue;
      Material material{part.color};
      material.line_spacing_m = float(geometry.voxel_size_m());
      material.line_width_m = 0.1f * material.line_spacing_m;
      material.line_shade = 0.55f;
      material.line_origin = geometry.origin().cast<float>();
      if (part.opacity < 1) opacity_ = double(part.opacity);
      (part.opacity < 1 ? veil_ : props_).push_back({part.mesh, material});
    }
  }

  void add_cameras(const WorldModel& world) {
    for (const ColoredMesh& part : camera_meshes(plan_, world)) {
      props_.push_back({part.mesh, {part.color}});
    }
  }

  void add_structures(const WorldModel& world) {
    for (const ColoredMesh& part : structure_meshes(plan_, world)) {
      structures_.push_back({part.mesh, {part.color}});
      structure_opacity_ = double(part.opacity);
    }
  }

  void add_floor() {
    const double scale = scale_of(plan_), side = 40 * scale;
    const Eigen::Vector3d centre = plan_.request.work_area.centre();
    const double top = floor_height(plan_);
    Material material{kFloor};
    material.line_spacing_m = 0.1f;
    material.line_width_m = 0.002f;
    material.line_shade = 0.85f;
    material.fade_centre = Eigen::Vector3d(centre.x(), centre.y(), top).cast<float>();
    material.fade_from_m = float(2 * scale);
    material.fade_to_m = float(7 * scale);
    const Box slab(Eigen::Vector3d(centre.x() - side, centre.y() - side, top - 0.1),
                   Eigen::Vector3d(centre.x() + side, centre.y() + side, top));
    props_.push_back({TriangleMesh::from_box(slab), material});
  }

  std::uint64_t steps(const PinholeCamera& camera) const {
    const Intrinsics k = drawn(camera).intrinsics();
    return layers().size() * picture_steps(k.width, k.height);
  }

  /// Draws what is there with and without what is half transparent, and lays one over the other.
  /// @returns nothing if it was stopped.
  std::optional<ColorImage> draw(const PinholeCamera& camera, const StopToken& stop) const {
    Blend blend;
    for (const Layer& layer : layers()) {
      std::vector<Prop> props = props_;
      if (layer.more) props.insert(props.end(), layer.more->begin(), layer.more->end());
      const auto image = picture(props, drawn(camera), stop);
      if (!image) return std::nullopt;
      blend.add(*image, layer.share);
    }
    const Intrinsics& k = camera.intrinsics();
    return enlarged(std::move(blend).image(), k.width, k.height);
  }

 private:
  struct Prop {
    TriangleMesh mesh;
    Material material;
  };

  struct Layer {
    double share;  ///< of the picture
    const std::vector<Prop>* more;
  };

  /// Each half transparent part for its share, and the rest without any of them.
  std::vector<Layer> layers() const {
    std::vector<Layer> layers;
    double rest = 1;
    const auto add = [&](const std::vector<Prop>& part, double opacity) {
      if (part.empty()) return;
      layers.push_back({opacity, &part});
      rest -= opacity;
    };
    add(veil_, opacity_);
    add(structures_, structure_opacity_);
    layers.push_back({rest, nullptr});
    return layers;
  }

  /// A draft has half as many pixels along each side, and is enlarged.
  PinholeCamera drawn(const PinholeCamera& camera) const {
    if (quality_ == PictureQuality::final) return camera;
    const Intrinsics& k = camera.intrinsics();
    return resized_camera(camera, (k.width + 1) / 2, (k.height + 1) / 2);
  }

  std::optional<ColorImage> picture(const std::vector<Prop>& props, const PinholeCamera& camera,
                                    const StopToken& stop) const {
    PictureOptions options;
    if (quality_ == PictureQuality::draft) options.first_samples = 2, options.samples_per_pixel = 8;
    options.sky_reach_m = float(1.2 * scale_of(plan_));
    // From above, over the viewer's left shoulder: what is seen is lit, and shadows fall aside.
    const Eigen::Matrix3d& R = camera.T_world_cam().rotation();
    const Eigen::Vector3d back =
        (-R.col(2) - 0.9 * R.col(0)).cwiseProduct(Eigen::Vector3d(1, 1, 0));
    options.to_sun = (back.normalized() + Eigen::Vector3d(0, 0, 1.25)).cast<float>();
    SceneBuilder builder;
    std::vector<Material> materials;
    for (const Prop& prop : props) {
      builder.add_mesh(prop.mesh);
      materials.push_back(prop.material);
    }
    return render_picture(*builder.build(), materials, camera, options, stop);
  }

  const Plan& plan_;
  PictureQuality quality_;
  std::vector<Prop> props_;
  std::vector<Prop> veil_;        ///< what is drawn half transparent: one sees what stands inside
  std::vector<Prop> structures_;  ///< what is drawn faintly
  double opacity_ = 1, structure_opacity_ = 0;
};

/// The overview without words on it.
struct Scenery {
  Stage stage;
  PinholeCamera camera;

  Scenery(const Plan& plan, const WorldModel& world, int width, PictureQuality quality)
      : stage(plan, quality), camera(overview_camera(plan, world, width)) {
    stage.add_voxels();
    stage.add_cameras(world);
    stage.add_structures(world);
    stage.add_floor();
  }
};

std::string view_name(std::size_t view) {
  return view == 0 ? "view.png" : fmt::format("view_{}.png", view + 1);
}

}  // namespace

std::optional<ColorImage> overview(const Plan& plan, const WorldModel& world, int width,
                                   const StopToken& stop) {
  const Scenery scenery(plan, world, width, PictureQuality::final);
  stop.expect(scenery.stage.steps(scenery.camera));
  return scenery.stage.draw(scenery.camera, stop);
}

struct PlanPictures::Picture {
  std::string name;
  Stage stage;
  PinholeCamera camera;
  bool is_overview;
};

PlanPictures::PlanPictures(const Plan& plan, const WorldModel& world, int width,
                           PictureQuality quality)
    : plan_(plan), world_(world) {
  Scenery scenery(plan, world, width, quality);
  pictures_.push_back({"overview.png", std::move(scenery.stage), scenery.camera, true});
  Stage stage(plan, quality);
  stage.add_voxels();
  stage.add_floor();
  const std::vector<PinholeCamera> views = suggested_cameras(plan);
  for (std::size_t i = 0; i < views.size(); ++i) {
    pictures_.push_back({view_name(i), stage, views[i], false});
  }
}

PlanPictures::~PlanPictures() = default;

std::size_t PlanPictures::count() const {
  return pictures_.size();
}

const std::string& PlanPictures::name(std::size_t picture) const {
  return pictures_[picture].name;
}

std::uint64_t PlanPictures::steps(std::size_t picture) const {
  return pictures_[picture].stage.steps(pictures_[picture].camera);
}

std::optional<ColorImage> PlanPictures::draw(std::size_t picture, const StopToken& stop) const {
  const Picture& wanted = pictures_[picture];
  std::optional<ColorImage> image = wanted.stage.draw(wanted.camera, stop);
  if (image && wanted.is_overview) add_legend(*image, plan_, world_, wanted.camera);
  return image;
}

void write_scene_model(const std::filesystem::path& path, const Plan& plan,
                       const WorldModel& world) {
  std::vector<ColoredMesh> meshes = voxel_meshes(*plan.grid);
  for (ColoredMesh& mesh : camera_meshes(plan, world)) meshes.push_back(std::move(mesh));
  for (ColoredMesh& mesh : structure_meshes(plan, world)) meshes.push_back(std::move(mesh));
  write_glb(path, meshes);
}

}  // namespace vantage
