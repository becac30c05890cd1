#include "locate/board_readings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d centre_of(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / double(points.size());
}

std::vector<Points> points_of(std::span<const ObjectFeature> board) {
  std::vector<Points> all;
  for (const ObjectFeature& feature : board) all.push_back(feature.points());
  return all;
}

/// Every feature's centre moved by `place`, its points around it by `shape`.
std::vector<Points> remapped(std::vector<Points> all,
                             const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place,
                             const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& shape) {
  for (Points& points : all) {
    if (points.empty()) continue;
    const Eigen::Vector3d centre = centre_of(points);
    for (Eigen::Vector3d& point : points) point = place(centre) + shape(point - centre);
  }
  return all;
}

/// A polynomial may fold over with other intrinsics: then there is no such lens.
std::optional<Lens> lens_with(const Lens& lens, const Intrinsics& intrinsics) {
  try {
    return Lens(intrinsics, lens.distortion());
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// In steps of a tenth, so that the best one is close enough to settle from.
std::vector<double> factors_between(double least, double most) {
  std::vector<double> factors;
  for (double factor = least; factor <= most; factor *= kFactorStep) factors.push_back(factor);
  return factors;
}

ReadingFamily focal_factor(const Lens& lens, const std::vector<Points>& board) {
  return {[=](double factor) -> std::optional<BoardReading> {
            Intrinsics k = lens.intrinsics();
            k.fx *= factor, k.fy *= factor;
            const auto other = lens_with(lens, k);
            if (!other) return std::nullopt;
            return BoardReading{
                fmt::format("the focal length is {:.3f} times that of the intrinsics", factor),
                *other, board};
          },
          factors_between(0.4, 2.5)};
}

ReadingFamily resolution(const Lens& lens, const std::vector<Points>& board) {
  return {[=](double factor) -> std::optional<BoardReading> {
            Intrinsics k = lens.intrinsics();
            k.fx *= factor, k.fy *= factor, k.cx *= factor, k.cy *= factor;
            const auto other = lens_with(lens, k);
            if (!other) return std::nullopt;
            return BoardReading{
                fmt::format("the intrinsics are those of another resolution: multiply fx, fy, cx "
                            "and cy by {:.3f}",
                            factor),
                *other, board};
          },
          {0.25, 1.0 / 3, 0.5, 2.0 / 3, 0.75, 0.8, 1.25, 4.0 / 3, 1.5, 2, 3, 4}};
}

/// Intrinsics of another image format: the middle of the image is known without them.
ReadingFamily other_format(const Lens& lens, const std::vector<Points>& board) {
  return {[=](double factor) -> std::optional<BoardReading> {
            Intrinsics k = lens.intrinsics();
            k.fx *= factor, k.fy *= factor;
            k.cx = 0.5 * (k.width - 1), k.cy = 0.5 * (k.height - 1);
            const auto other = lens_with(lens, k);
            if (!other) return std::nullopt;
            return BoardReading{
                fmt::format("the intrinsics are those of another resolution: the focal length is "
                            "{:.3f} times theirs, and the principal point the image's middle, "
                            "({:g}, {:g})",
                            factor, k.cx, k.cy),
                *other, board};
          },
          factors_between(0.4, 2.5)};
}

/// Whether the principal point is elsewhere than in the middle, by more than lenses are off.
bool is_off_centre(const Intrinsics& k) {
  constexpr double kUsual = 0.04;
  return std::abs(k.cx - 0.5 * (k.width - 1)) > kUsual * k.width ||
         std::abs(k.cy - 0.5 * (k.height - 1)) > kUsual * k.height;
}

ReadingFamily marker_size(const Lens& lens, const std::vector<Points>& board) {
  return {[=](double factor) -> std::optional<BoardReading> {
            const auto same = [](const Eigen::Vector3d& p) { return p; };
            const auto scaled = [=](const Eigen::Vector3d& p) {
              return Eigen::Vector3d(factor * p);
            };
            return BoardReading{
                fmt::format("the board's markers are {:.3f} times as large as size_m says, for the "
                            "distances between them",
                            factor),
                lens, remapped(board, same, scaled)};
          },
          factors_between(0.4, 2.5)};
}

ReadingFamily fixed(std::string cause, const Lens& lens, std::vector<Points> points) {
  return {[=](double) -> std::optional<BoardReading> {
            return BoardReading{cause, lens, points};
          },
          {1.0}};
}

void add_layouts(const Lens& lens, const std::vector<Points>& board,
                 std::vector<ReadingFamily>& families) {
  using V = Eigen::Vector3d;
  const auto same = [](const V& p) { return p; };
  families.push_back(fixed("the y axis of the markers' positions points the other way", lens,
                           remapped(
                               board, [](const V& p) { return V(p.x(), -p.y(), p.z()); }, same)));
  families.push_back(fixed("the x axis of the markers' positions points the other way", lens,
                           remapped(
                               board, [](const V& p) { return V(-p.x(), p.y(), p.z()); }, same)));
  families.push_back(fixed("x and y of the markers' positions are exchanged", lens,
                           remapped(
                               board, [](const V& p) { return V(p.y(), p.x(), p.z()); }, same)));
}

/// Markers that are printed, or whose corners are listed, with a turn or from the other side.
void add_corner_orders(const Lens& lens, const std::vector<Points>& board,
                       std::vector<ReadingFamily>& families) {
  for (int quarters = 1; quarters < 4; ++quarters) {
    std::vector<Points> turned = board;
    for (Points& points : turned) {
      if (points.size() == 4) std::rotate(points.begin(), points.begin() + quarters, points.end());
    }
    families.push_back(
        fixed(fmt::format("each marker of the board is turned by {} degrees (turn)", 90 * quarters),
              lens, std::move(turned)));
  }
  std::vector<Points> mirrored = board;
  for (Points& points : mirrored) {
    if (points.size() == 4) std::swap(points[0], points[1]), std::swap(points[3], points[2]);
  }
  families.push_back(
      fixed("the markers' corners are in mirrored order", lens, std::move(mirrored)));
}

void add_turned_pictures(const Lens& lens, const std::vector<Points>& board,
                         std::vector<ReadingFamily>& families) {
  const Intrinsics k = lens.intrinsics();
  const auto add = [&](double cx, double cy, bool swapped, const char* how) {
    Intrinsics turned = k;
    turned.cx = cx, turned.cy = cy;
    if (swapped) std::swap(turned.fx, turned.fy);
    const auto other = lens_with(lens, turned);
    if (!other) return;
    families.push_back(
        fixed(fmt::format("the picture is turned by {} degrees against the intrinsics", how),
              *other, board));
  };
  add(k.cy, k.width - 1 - k.cx, true, "90");
  add(k.height - 1 - k.cy, k.cx, true, "90");
  add(k.width - 1 - k.cx, k.height - 1 - k.cy, false, "180");
}

}  // namespace

std::vector<ReadingFamily> reading_families(const Lens& lens,
                                            std::span<const ObjectFeature> board) {
  const std::vector<Points> points = points_of(board);
  std::vector<ReadingFamily> families;
  add_turned_pictures(lens, points, families);
  add_layouts(lens, points, families);
  add_corner_orders(lens, points, families);
  if (auto parity = other_parity(board)) {
    families.push_back(
        fixed("the markers of the checkerboard are on the squares of the other "
              "colour (its parity; OpenCV before 4.6 printed it so: legacy)",
              lens, *std::move(parity)));
  }
  families.push_back(focal_factor(lens, points));
  families.push_back(resolution(lens, points));
  families.push_back(marker_size(lens, points));
  if (is_off_centre(lens.intrinsics())) families.push_back(other_format(lens, points));
  return families;
}

std::vector<BoardPair> pairs_of(const BoardReading& reading, std::span<const BoardPair> pairs) {
  std::vector<BoardPair> result(pairs.begin(), pairs.end());
  for (BoardPair& pair : result) {
    pair.term.lens = &reading.lens;
    pair.term.points_m = reading.points_m[pair.feature];
  }
  return result;
}

}  // namespace vantage::reconstruction::detail
