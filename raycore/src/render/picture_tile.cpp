#include "render/picture_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vantage::raycore::detail {
namespace {

// The light on a surface that faces the sun; the last part reaches the deepest corner.
constexpr float kSunShare = 0.60f, kSkyShare = 0.30f, kFillShare = 0.10f;

constexpr std::uint32_t kNoLabel = 0xFFFFFFFFu;
constexpr float kSameNormal = 0.999f;  // cosine
constexpr float kOwnPlane = 0.1f;      // how far off it a pixel's samples may lie, in its widths
constexpr float kNeighbourPlane = 0.25f;
constexpr float kSteep = 0.25f;   // of the depth, that it changes by within half a pixel
constexpr float kMinSupport = 8;  // of the 16 that a whole neighbourhood weighs
constexpr float kSunTolerance = 0.2f;
constexpr int kMinSunSamples = 16;  // with fewer, no pixel knows its part of the sun that well

/// Weights of the neighbours in a row: any 4 × 4 pixels that differ by multiples of four in their
/// places weigh the same, so that each of the 4 × 4 patterns counts once.
constexpr std::array<float, 5> kWeights = {0.5f, 1, 1, 1, 0.5f};

/// Calls `use(first, weight)` with where the row begins that lies beside row y by each neighbour's
/// offset.
template <int kReach, int kWidth, class Use>
void for_neighbours(int y, const Use& use) {
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      use((y + dy) * kWidth + dx,
          kWeights[std::size_t(dy + kReach)] * kWeights[std::size_t(dx + kReach)]);
    }
  }
}

/// Every pixel of a square, ordered by `key(x, y)`.
template <class Key>
std::vector<std::uint32_t> ordered_pixels(int width, const Key& key) {
  std::vector<std::uint32_t> order(std::size_t(width) * std::size_t(width));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::uint32_t(i);
  const auto key_of = [&](std::uint32_t at) { return key(int(at) % width, int(at) / width); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key_of(a) < key_of(b); });
  return order;
}

/// 4 × 4 neighbours after each other: for rays from the camera.
template <int kWidth>
const std::vector<std::uint32_t>& neighbours_first() {
  static const std::vector<std::uint32_t> order =
      ordered_pixels(kWidth, [](int x, int y) { return y / 4 * kWidth + x / 4; });
  return order;
}

/// Pixels of the same pattern after each other, 4 × 4 of them at a time: their rays to the light
/// are parallel where their surfaces are.
template <int kWidth>
const std::vector<std::uint32_t>& patterns_first() {
  static const std::vector<std::uint32_t> order = ordered_pixels(kWidth, [](int x, int y) {
    const int pattern = y % 4 * 4 + x % 4;
    return (pattern * kWidth + y / 16) * kWidth + x / 16;
  });
  return order;
}

}  // namespace

PictureTile::PictureTile(const PictureSetup& setup, int left, int top, TileScratch& scratch)
    : setup_(setup),
      left_(left - kMargin),
      top_(top - kMargin),
      corner_(setup.fan.at(left_, top_)),
      per_u_(setup.fan.per_u()),
      per_v_(setup.fan.per_v()),
      s_(scratch) {
  constexpr std::size_t kPixels = std::size_t(kWidth) * kWidth;
  s_.surface.assign(kPixels, {});
  s_.label.assign(kPixels, kNoLabel);
  s_.sky_hits.assign(kPixels, 0);
  s_.sun_hits.assign(kPixels, 0);
  s_.sky_share.assign(kPixels, 0);
  s_.sun_share.assign(kPixels, 0);
  s_.light.assign(kPixels, Eigen::Vector3f::Zero());
}

void PictureTile::draw(ColorImage& image) {
  find_surfaces();
  if (setup_.adaptive) {
    find_edges();
    light_plain();
  }
  draw_mixed();
  for (int y = kMargin; y < kWidth - kMargin; ++y) {
    RowSums sums;
    add_up(y, sums);
    for (int x = kMargin; x < kWidth - kMargin; ++x) {
      const std::uint32_t at = std::uint32_t(y * kWidth + x);
      const PixelSurface::Kind kind = s_.surface[at].kind;
      if (kind == PixelSurface::outside) continue;
      Eigen::Vector3f light = kind == PixelSurface::mixed ? s_.light[at] : setup_.background;
      if (kind == PixelSurface::plain) {
        light = plain_light(at, sums.sky[x] / sums.weight[x], sums.sun[x] / sums.sun_weight[x]);
      }
      std::uint8_t* out = image.pixel(u(at), v(at));
      for (int c = 0; c < 3; ++c) out[c] = setup_.srgb(light[c]);
    }
  }
}

void PictureTile::find_surfaces() {
  const Intrinsics& k = setup_.camera.intrinsics();
  s_.list.clear();
  for (const std::uint32_t at : neighbours_first<kWidth>()) {
    const bool inside = u(at) >= 0 && v(at) >= 0 && u(at) < k.width && v(at) < k.height;
    if (!inside) continue;
    s_.list.push_back(at);
    s_.surface[at].kind = setup_.adaptive ? PixelSurface::background : PixelSurface::mixed;
  }
  if (!setup_.adaptive) return;
  for (int sample = 0; sample < setup_.first.samples(); ++sample) {
    const Eigen::Vector2f& position = setup_.first.position(sample);
    for (std::size_t begin = 0; begin < s_.list.size(); begin += LightBatch::kCapacity) {
      const std::size_t count = std::min(LightBatch::kCapacity, s_.list.size() - begin);
      s_.directions.resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = s_.list[begin + i];
        s_.directions.set(i, direction(at, position));
      }
      setup_.scene.closest_hits(setup_.eye, s_.directions, s_.hits, RayOrder::coherent);
      for (std::size_t i = 0; i < count; ++i) {
        add_hit(s_.surface[s_.list[begin + i]], i, sample == 0);
      }
    }
  }
  for (const std::uint32_t at : s_.list) {
    if (s_.surface[at].kind == PixelSurface::plain) flatten(at);
  }
}

void PictureTile::add_hit(PixelSurface& pixel, std::size_t ray, bool first) const {
  const bool found = s_.hits.hit(ray);
  if (!first && found != (pixel.kind == PixelSurface::plain)) pixel.kind = PixelSurface::mixed;
  if (!found || pixel.kind == PixelSurface::mixed) return;
  const Eigen::Vector3f normal = normal_of_hit(ray), point = point_of_hit(ray);
  if (first) {
    pixel.kind = PixelSurface::plain;
    pixel.object = s_.hits.object[ray];
    pixel.normal = normal, pixel.point = point;
    pixel.depth_m = s_.hits.t[ray];
    return;
  }
  const float width_m = pixel.depth_m * setup_.pixel_width;
  const bool same = s_.hits.object[ray] == pixel.object && normal.dot(pixel.normal) > kSameNormal &&
                    std::abs(pixel.normal.dot(point - pixel.point)) < kOwnPlane * width_m;
  if (!same) pixel.kind = PixelSurface::mixed;
}

/// Finds the pixel's place on its plane, unless that comes close to its edge or the horizon.
void PictureTile::flatten(std::uint32_t at) {
  PixelSurface& pixel = s_.surface[at];
  const Eigen::Vector3f ray = direction(at, {0, 0});
  const float towards = pixel.normal.dot(ray);
  const float by_u = pixel.normal.dot(per_u_), by_v = pixel.normal.dot(per_v_);
  if (0.5f * (std::abs(by_u) + std::abs(by_v)) > kSteep * std::abs(towards)) {
    pixel.kind = PixelSurface::mixed;
    return;
  }
  const float t = pixel.normal.dot(pixel.point - setup_.eye) / towards;
  pixel.middle = setup_.eye + t * ray;
  pixel.per_x = t * (per_u_ - by_u / towards * ray);
  pixel.per_y = t * (per_v_ - by_v / towards * ray);
}

bool PictureTile::same_surface(const PixelSurface& a, const PixelSurface& b) const {
  const float width_m = std::max(a.depth_m, b.depth_m) * setup_.pixel_width;
  return a.object == b.object && a.normal.dot(b.normal) > kSameNormal &&
         std::abs(a.normal.dot(b.point - a.point)) < kNeighbourPlane * width_m;
}

std::uint32_t PictureTile::root(std::uint32_t label) const {
  while (s_.parent[label] != label) label = s_.parent[label] = s_.parent[s_.parent[label]];
  return label;
}

/// Marks an edge between two neighbours, or gives them one label.
void PictureTile::compare(std::uint32_t a, std::uint32_t b) {
  PixelSurface &here = s_.surface[a], &there = s_.surface[b];
  const auto pure = [](const PixelSurface& p) {
    return p.kind == PixelSurface::plain || p.kind == PixelSurface::background;
  };
  if (!pure(here) || !pure(there)) return;
  if (here.kind != there.kind) {
    here.on_edge = there.on_edge = true;
  } else if (here.kind == PixelSurface::plain) {
    if (same_surface(here, there)) {
      const std::uint32_t first = root(a), second = root(b);
      s_.parent[std::max(first, second)] = std::min(first, second);
    } else {
      here.on_edge = there.on_edge = true;
    }
  }
}

void PictureTile::find_edges() {
  s_.parent.resize(s_.surface.size());
  for (std::uint32_t at = 0; at < s_.parent.size(); ++at) s_.parent[at] = at;
  for (std::uint32_t at = 0; at < s_.surface.size(); ++at) {
    if (at % kWidth > 0) compare(at - 1, at);
    if (at >= std::uint32_t(kWidth)) compare(at - std::uint32_t(kWidth), at);
  }
  for (std::uint32_t at = 0; at < s_.surface.size(); ++at) {
    PixelSurface& pixel = s_.surface[at];
    if (pixel.on_edge) pixel.kind = PixelSurface::mixed;
    if (pixel.kind == PixelSurface::plain) s_.label[at] = root(at);
  }
}

void PictureTile::light_plain() {
  list_marked([&](std::uint32_t at) { return s_.surface[at].kind == PixelSurface::plain; });
  const int samples = setup_.first.samples(), half = samples / 2;
  if (half > 1) {  // enough to tell the open floor
    light_listed(setup_.first, 0, half);
    find_shaded(half);
    list_marked([&](std::uint32_t at) { return s_.marked[at] != 0; });
  }
  light_listed(setup_.first, half > 1 ? half : 0, samples);
  if (setup_.all.samples() < kMinSunSamples) return;
  find_unsettled();
  list_marked([&](std::uint32_t at) { return s_.marked[at] != 0; });
  for (const std::uint32_t at : s_.list) {
    s_.sun_hits[at] = 0;
    if (s_.surface[at].asks_sky) s_.sky_hits[at] = 0;
  }
  light_listed(setup_.all, 0, setup_.all.samples());
}

template <class Wanted>
void PictureTile::list_marked(const Wanted& wanted) {
  s_.list.clear();
  for (const std::uint32_t at : patterns_first<kWidth>()) {
    if (wanted(at)) s_.list.push_back(at);
  }
}

/// Sends the light rays of the listed pixels, which are plain: of the samples `begin` to `end`, the
/// ones before them have been sent.
void PictureTile::light_listed(const SamplePatterns& patterns, int begin, int end) {
  const auto flush = [&] {
    s_.batch.trace(setup_.scene, [&](std::size_t i, bool sky, bool sun) {
      s_.sky_hits[s_.owners[i]] += sky;
      s_.sun_hits[s_.owners[i]] += sun;
    });
    s_.owners.clear();
  };
  s_.owners.clear();
  for (int sample = begin; sample < end; ++sample) {
    for (const std::uint32_t at : s_.list) {
      const PixelSurface& pixel = s_.surface[at];
      s_.owners.push_back(at);
      s_.batch.add({lifted(pixel.at(patterns.position(sample)), pixel.normal, pixel.depth_m),
                    pixel.normal, pixel.asks_sky, facing(pixel.normal) > 0},
                   patterns.light(u(at), v(at), sample), setup_.sky_reach_m);
      if (s_.batch.full()) flush();
    }
  }
  flush();
  const float part = 1 / float(end);
  for (const std::uint32_t at : s_.list) {
    if (s_.surface[at].asks_sky) s_.sky_share[at] = part * float(s_.sky_hits[at]);
    s_.sun_share[at] = part * float(s_.sun_hits[at]);
  }
}

/// Marks plain pixels, unless all that is known of their neighbourhood has the whole sky, and all
/// or nothing of the sun.
void PictureTile::find_shaded(int samples) {
  s_.marked.assign(s_.surface.size(), 1);
  for (int y = kReach; y < kWidth - kReach; ++y) {
    int shaded[kWidth] = {};
    const int here = y * kWidth;
    const std::uint32_t* label = s_.label.data() + here;
    const int* sun = s_.sun_hits.data() + here;
    for_neighbours<kReach, kWidth>(y, [&](int there, float) {
      const std::uint32_t* other = s_.label.data() + there;
      const int *other_sky = s_.sky_hits.data() + there, *other_sun = s_.sun_hits.data() + there;
      for (int x = kReach; x < kWidth - kReach; ++x) {
        shaded[x] |= int(label[x] == other[x]) &
                     (int(other_sky[x] != samples) | int(other_sun[x] != sun[x]));
      }
    });
    for (int x = kReach; x < kWidth - kReach; ++x) {
      const bool half = sun[x] > 0 && sun[x] < samples;
      s_.marked[std::size_t(here + x)] = shaded[x] != 0 || half;
    }
  }
  for (std::size_t at = 0; at < s_.marked.size(); ++at) s_.marked[at] &= s_.label[at] != kNoLabel;
}

/// Marks plain pixels whose neighbours on their surface are few, or disagree about the sun.
void PictureTile::find_unsettled() {
  s_.marked.assign(s_.surface.size(), 0);
  for (int y = kReach; y < kWidth - kReach; ++y) {
    float support[kWidth] = {};
    int others[kWidth] = {};
    const int here = y * kWidth;
    const std::uint32_t* label = s_.label.data() + here;
    const float* sun = s_.sun_share.data() + here;
    for_neighbours<kReach, kWidth>(y, [&](int there, float weight) {
      const std::uint32_t* other = s_.label.data() + there;
      const float* other_sun = s_.sun_share.data() + there;
      for (int x = kReach; x < kWidth - kReach; ++x) {
        const int same = label[x] == other[x];
        support[x] += same ? weight : 0;
        others[x] |= same & int(sun[x] != other_sun[x]);
      }
    });
    for (int x = kReach; x < kWidth - kReach; ++x) {
      const bool half = sun[x] > 0 && sun[x] < 1, few = support[x] < kMinSupport;
      s_.surface[std::size_t(here + x)].asks_sky = few;
      s_.marked[std::size_t(here + x)] = label[x] != kNoLabel && (half || few || others[x] != 0);
    }
  }
}

void PictureTile::draw_mixed() {
  s_.list.clear();
  for (const std::uint32_t at : patterns_first<kWidth>()) {
    const int x = int(at) % kWidth, y = int(at) / kWidth;
    const bool drawn = std::min(x, y) >= kMargin && std::max(x, y) < kWidth - kMargin;
    if (drawn && s_.surface[at].kind == PixelSurface::mixed) s_.list.push_back(at);
  }
  const std::size_t samples = std::size_t(setup_.all.samples());
  const std::size_t at_once = std::max<std::size_t>(1, LightBatch::kCapacity / samples);
  for (std::size_t begin = 0; begin < s_.list.size(); begin += at_once) {
    light_mixed(s_.list.data() + begin, std::min(at_once, s_.list.size() - begin));
  }
  const float part = 1 / float(samples);
  for (const std::uint32_t at : s_.list) s_.light[at] *= part;
}

/// All samples of a few pixels: camera rays pixel by pixel, light rays sample by sample, so that
/// each kind has much in common.
void PictureTile::light_mixed(const std::uint32_t* pixels, std::size_t count) {
  const SamplePatterns& all = setup_.all;
  const std::size_t samples = std::size_t(all.samples());
  s_.directions.resize(count * samples);
  for (std::size_t ray = 0; ray < s_.directions.size(); ++ray) {
    s_.directions.set(ray, direction(pixels[ray / samples], all.position(int(ray % samples))));
  }
  setup_.scene.closest_hits(setup_.eye, s_.directions, s_.hits, RayOrder::coherent);
  s_.owners.clear();
  const auto flush = [&] {
    s_.batch.trace(setup_.scene, [&](std::size_t i, bool sky, bool sun) {
      const std::size_t ray = s_.owners[i];
      s_.light[pixels[ray / samples]] += light_of_hit(ray, sky, sun);
    });
    s_.owners.clear();
  };
  for (std::size_t sample = 0; sample < samples; ++sample) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t ray = i * samples + sample;
      if (!s_.hits.hit(ray)) {
        s_.light[pixels[i]] += setup_.background;
        continue;
      }
      const Eigen::Vector3f normal = normal_of_hit(ray);
      s_.owners.push_back(std::uint32_t(ray));
      s_.batch.add(
          {lifted(point_of_hit(ray), normal, s_.hits.t[ray]), normal, true, facing(normal) > 0},
          all.light(u(pixels[i]), v(pixels[i]), int(sample)), setup_.sky_reach_m);
      if (s_.batch.full()) flush();
    }
  }
  flush();
}

Eigen::Vector3f PictureTile::light_of_hit(std::size_t ray, bool sky, bool sun) const {
  const SurfaceLook& look = setup_.looks[s_.hits.object[ray]];
  const Eigen::Vector3f point = point_of_hit(ray), normal = normal_of_hit(ray);
  const bool line = look.has_lines() && look.on_line(point, normal);
  return reflected(look, line ? 1 : 0, sky ? 1 : 0, sun ? facing(normal) : 0, look.faded(point));
}

/// On the camera's side.
Eigen::Vector3f PictureTile::normal_of_hit(std::size_t ray) const {
  const Eigen::Vector3f normal = s_.hits.normal[ray];
  return normal.dot(s_.directions[ray]) > 0 ? Eigen::Vector3f(-normal) : normal;
}

Eigen::Vector3f PictureTile::reflected(const SurfaceLook& look, float lines, float sky, float sun,
                                       float faded) const {
  const float share = kFillShare + kSkyShare * sky + kSunShare * sun;
  return (1 - faded) * share * look.color(lines) + faded * setup_.background;
}

/// Adds up the light of the neighbours of a row's pixels.
void PictureTile::add_up(int y, RowSums& sums) const {
  sums = {};
  const int here = y * kWidth;
  const float tolerance =
      setup_.all.samples() >= kMinSunSamples ? kSunTolerance : std::numeric_limits<float>::max();
  for_neighbours<kReach, kWidth>(y, [&](int there, float weight) {
    const std::uint32_t *label = s_.label.data() + here, *other = s_.label.data() + there;
    const float *sun = s_.sun_share.data() + here, *other_sun = s_.sun_share.data() + there;
    const float* other_sky = s_.sky_share.data() + there;
    for (int x = kMargin; x < kWidth - kMargin; ++x) {
      const float same = label[x] == other[x] ? weight : 0;
      const float alike = std::abs(other_sun[x] - sun[x]) < tolerance ? same : 0;
      sums.weight[x] += same;
      sums.sky[x] += same * other_sky[x];
      sums.sun_weight[x] += alike;
      sums.sun[x] += alike * other_sun[x];
    }
  });
}

Eigen::Vector3f PictureTile::plain_light(std::uint32_t at, float sky, float sun) const {
  const PixelSurface& pixel = s_.surface[at];
  const SurfaceLook& look = setup_.looks[pixel.object];
  const float lines = look.line_share(pixel.middle, pixel.per_x, pixel.per_y, pixel.normal,
                                      setup_.lines.positions());
  return reflected(look, lines, sky, facing(pixel.normal) * sun, look.faded(pixel.middle));
}

}  // namespace vantage::raycore::detail
