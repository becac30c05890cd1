#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "render/light_batch.hpp"
#include "render/picture_setup.hpp"

namespace vantage::raycore::detail {

/// What the first few samples found out about a pixel.
struct PixelSurface {
  enum Kind : std::uint8_t {
    outside,     ///< of the picture
    background,  ///< nothing else
    plain,       ///< one flat surface
    mixed,       ///< an edge: its samples differ, or its neighbour shows another surface
  };
  Kind kind = outside;
  bool on_edge = false;                              ///< becomes mixed
  bool asks_sky = true;                              ///< in the next pass, as it asks the sun
  ObjectId object = 0;                               ///< of the first sample, as is what follows
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the camera
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  float depth_m = 0;
  /// The pixel on its plane: its centre there, and how far one pixel to the right and down is.
  Eigen::Vector3f middle, per_x, per_y;

  Eigen::Vector3f at(const Eigen::Vector2f& position) const {
    return middle + position.x() * per_x + position.y() * per_y;
  }
};

/// Room for a tile; a task keeps one for all that it draws. Fields are of its pixels, row by row.
struct TileScratch {
  std::vector<PixelSurface> surface;
  std::vector<std::uint32_t> label;         ///< connected plain pixels of one surface share one
  std::vector<std::uint32_t> parent;        ///< of labels, until they are settled
  std::vector<int> sky_hits, sun_hits;      ///< of a plain pixel's rays, those that got there
  std::vector<float> sky_share, sun_share;  ///< the same as parts of 1
  std::vector<Eigen::Vector3f> light;       ///< of a mixed pixel, linear, summed up
  std::vector<std::uint8_t> marked;
  std::vector<std::uint32_t> list, owners;
  Points directions;
  Hits hits;
  LightBatch batch;
};

/// A square part of a picture, drawn in passes:
///  1. The first few samples of each pixel say which surface it shows; where they differ, or those
///     of neighbours do, is an edge.
///  2. Pixels without an edge send these samples' rays to sky and sun. Where neighbours on a
///  surface
///     disagree about the sun (a shadow's border), pixels send all that they may to the sun; where
///     too few show it to stand in for each other, to the sky as well.
///  3. Edges take all samples, each with a surface and light of its own.
///  4. Pixels without an edge take the mean of their neighbours' light on the same surface;
///  sunlight
///     only from those that have about as much, so that borders of shadows stay as sharp as they
///     are. Colours are no neighbour's: lines are sampled in the pixel's own plane.
///
/// A tile knows nothing of other tiles: it has a margin as wide as what its pixels look at.
class PictureTile {
 public:
  static constexpr int kSide = 96;

  /// The tile whose upper left pixel is (left, top), multiples of kSide.
  PictureTile(const PictureSetup& setup, int left, int top, TileScratch& scratch);

  void draw(ColorImage& image);

 private:
  // What a pixel's mean reaches, and twice that: neighbours have to be settled as it is.
  static constexpr int kReach = 2, kMargin = 2 * kReach, kWidth = kSide + 2 * kMargin;

  /// What the neighbours of a row's pixels on their surfaces say together: weighted sums.
  struct RowSums {
    float weight[kWidth], sky[kWidth], sun_weight[kWidth], sun[kWidth];
  };

  int u(std::uint32_t at) const { return left_ + int(at % kWidth); }
  int v(std::uint32_t at) const { return top_ + int(at / kWidth); }
  Eigen::Vector3f direction(std::uint32_t at, const Eigen::Vector2f& position) const {
    return corner_ + (float(at % kWidth) + position.x()) * per_u_ +
           (float(at / kWidth) + position.y()) * per_v_;
  }

  void find_surfaces();
  void add_hit(PixelSurface& pixel, std::size_t ray, bool first) const;
  void flatten(std::uint32_t at);
  void find_edges();
  void compare(std::uint32_t a, std::uint32_t b);
  bool same_surface(const PixelSurface& a, const PixelSurface& b) const;
  std::uint32_t root(std::uint32_t label) const;
  void light_plain();
  template <class Wanted>
  void list_marked(const Wanted& wanted);
  void light_listed(const SamplePatterns& patterns, int begin, int end);
  void find_shaded(int samples);
  void find_unsettled();
  void draw_mixed();
  void light_mixed(const std::uint32_t* pixels, std::size_t count);
  Eigen::Vector3f light_of_hit(std::size_t ray, bool sky, bool sun) const;
  Eigen::Vector3f normal_of_hit(std::size_t ray) const;
  Eigen::Vector3f point_of_hit(std::size_t ray) const {
    return setup_.eye + s_.hits.t[ray] * s_.directions[ray];
  }
  void add_up(int y, RowSums& sums) const;
  Eigen::Vector3f plain_light(std::uint32_t at, float sky, float sun) const;
  Eigen::Vector3f reflected(const SurfaceLook& look, float lines, float sky, float sun,
                            float faded) const;
  float facing(const Eigen::Vector3f& normal) const {
    return std::max(0.0f, normal.dot(setup_.to_sun));
  }
  static Eigen::Vector3f lifted(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                                float depth_m) {
    return point + 1e-4f * std::max(0.1f, depth_m) * normal;
  }

  const PictureSetup& setup_;
  int left_, top_;                          ///< of the margin
  Eigen::Vector3f corner_, per_u_, per_v_;  ///< directions of the margin's first pixel, and steps
  TileScratch& s_;
};

}  // namespace vantage::raycore::detail
