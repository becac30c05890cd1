#include "plan/report/picture_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "plan/report/plan_shapes.hpp"
#include "simulator/sheet/lettering.hpp"

namespace vantage {
namespace {

constexpr int kMinWidth = 480;  // pixels
const cv::Scalar kLegendPaper(250, 250, 249), kLegendBorder(205, 207, 210), kLegendInk(44, 48, 54);

cv::Scalar ink_of(const Eigen::Vector3f& color) {
  return {255.0 * double(color.x()), 255.0 * double(color.y()), 255.0 * double(color.z())};
}

struct LegendEntry {
  std::string text;
  cv::Scalar ink;
  bool is_camera = false;
};

std::vector<LegendEntry> legend_entries(const Plan& plan, const WorldModel& world) {
  const PlanColors colors = plan_colors();
  const auto pale = [](const Eigen::Vector3f& color, float share) {
    return ink_of(share * color + (1 - share) * Eigen::Vector3f::Constant(0.95f));
  };
  std::vector<LegendEntry> entries{{"occupied", ink_of(colors.occupied)},
                                   {"newly seen", pale(colors.revealed, 0.5f)},
                                   {"stays in shadow", ink_of(colors.shadow)}};
  if (plan.views.empty()) entries.erase(entries.begin() + 1);
  const std::vector<ColoredMesh> structures = structure_meshes(plan, world);
  if (!structures.empty()) {
    entries.push_back({"known structures", pale(colors.structure, structures.front().opacity)});
  }
  const auto plural = [](const char* what, std::size_t count) {
    return fmt::format("{}{}", what, count == 1 ? "" : "s");
  };
  if (!world.cameras.empty()) {
    entries.push_back(
        {plural("given camera", world.cameras.size()), ink_of(colors.given_camera), true});
  }
  if (!plan.views.empty()) {
    entries.push_back(
        {plural("suggested camera", plan.views.size()), ink_of(colors.suggested_camera), true});
  }
  return entries;
}

/// Where something is that the legend should not hide.
std::vector<cv::Point> subject_points(const Plan& plan, const WorldModel& world,
                                      const PinholeCamera& camera) {
  std::vector<cv::Point> points;
  for (const ColoredMesh& part : camera_meshes(plan, world)) {
    for (const Triangle& triangle : part.mesh.triangles()) {
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const std::uint32_t corner : triangle) {
        middle += part.mesh.vertices()[corner].cast<double>() / 3;
      }
      const std::optional<ImagePoint> p = camera.project(middle);
      if (p) points.emplace_back(int(p->u), int(p->v));
      for (const std::uint32_t corner : triangle) {
        const auto q = camera.project(part.mesh.vertices()[corner].cast<double>());
        if (q) points.emplace_back(int(q->u), int(q->v));
      }
    }
  }
  return points;
}

/// The double strokes of the usual font run into each other where it is small.
Lettering legend_letters(double px) {
  return px < 9.5 ? Lettering(std::max(8.0, px), cv::FONT_HERSHEY_SIMPLEX) : Lettering(px);
}

/// The legend's panel.
class LegendPanel {
 public:
  LegendPanel(std::vector<LegendEntry> entries, int picture_width)
      : entries_(std::move(entries)),
        letters_(legend_letters(picture_width * 0.0082)),
        line_(letters_.capital_px * 23 / 10),
        border_(letters_.capital_px * 12 / 10) {
    for (const LegendEntry& entry : entries_) {
      text_width_ = std::max(text_width_, letters_.width(entry.text));
    }
  }

  cv::Size size() const {
    return {2 * border_ + mark_width() + letters_.capital_px + text_width_,
            2 * border_ + line_ * (int(entries_.size()) - 1) + letters_.capital_px * 3 / 2};
  }

  void draw(cv::Mat3b picture, cv::Point corner) const {
    const cv::Rect place(corner, size());
    cv::Mat3b part = picture(place);
    cv::Mat3b paper(part.size());
    paper.setTo(kLegendPaper);
    cv::addWeighted(paper, 0.8, part, 0.2, 0, part);
    cv::rectangle(picture, place, kLegendBorder);
    cv::Point at = corner + cv::Point(border_, border_);
    for (const LegendEntry& entry : entries_) {
      const cv::Rect mark(at, cv::Size(mark_width(), letters_.capital_px * 3 / 2));
      if (entry.is_camera) {
        draw_camera(picture, mark, entry.ink);
      } else {
        cv::rectangle(picture, mark, entry.ink, cv::FILLED);
        cv::rectangle(picture, mark, entry.ink * 0.75);
      }
      const cv::Point text =
          at + cv::Point(mark_width() + letters_.capital_px, letters_.capital_px / 4);
      letters_.write(picture, entry.text, text, text_width_ + 1, kLegendInk);
      at.y += line_;
    }
  }

 private:
  int mark_width() const { return letters_.capital_px * 2; }

  /// A small camera with its frustum, as the picture has it.
  static void draw_camera(cv::Mat3b picture, const cv::Rect& mark, const cv::Scalar& ink) {
    const cv::Point left(mark.x, mark.y + mark.height / 2);
    const cv::Point body(mark.x + mark.width * 2 / 5, left.y);
    const int right = mark.x + mark.width - 1, bottom = mark.y + mark.height - 1;
    const cv::Rect box(left.x, left.y - mark.height / 4, mark.width * 2 / 5, mark.height / 2);
    cv::rectangle(picture, box, ink, cv::FILLED);
    const int width = std::max(1, mark.height / 10);
    cv::line(picture, body, {right, mark.y}, ink, width, cv::LINE_AA);
    cv::line(picture, body, {right, bottom}, ink, width, cv::LINE_AA);
    cv::line(picture, {right, mark.y}, {right, bottom}, ink, width, cv::LINE_AA);
  }

  std::vector<LegendEntry> entries_;
  Lettering letters_;
  int line_, border_, text_width_ = 0;
};

/// The corner of the picture where a panel hides the fewest points; the first of the best.
cv::Point emptiest_corner(const std::vector<cv::Point>& points, cv::Size panel, cv::Size picture) {
  const int gap = std::max(6, picture.width / 80);
  const int right = picture.width - panel.width - gap, bottom = picture.height - panel.height - gap;
  const std::array<cv::Point, 4> corners = {
      {{gap, bottom}, {right, bottom}, {gap, gap}, {right, gap}}};
  const auto hidden = [&](const cv::Point& corner) {
    const cv::Rect place(corner - cv::Point(gap / 2, gap / 2), panel + cv::Size(gap, gap));
    return std::ranges::count_if(points, [&](const cv::Point& p) { return place.contains(p); });
  };
  return *std::ranges::min_element(corners, {}, hidden);
}

/// A number in a white disc.
void draw_number(cv::Mat3b picture, cv::Point middle, std::size_t number, const cv::Scalar& ink) {
  const Lettering letters = legend_letters(picture.cols * 0.0092);
  const std::string text = fmt::format("{}", number);
  const int width = letters.width(text);
  const int radius = std::max(letters.capital_px, width / 2 + letters.capital_px / 3);
  cv::circle(picture, middle, radius, kLegendPaper, cv::FILLED, cv::LINE_AA);
  cv::circle(picture, middle, radius, ink, std::max(1, radius / 6), cv::LINE_AA);
  letters.write(picture, text, middle - cv::Point(width / 2, letters.capital_px / 2), width + 1,
                kLegendInk);
}

}  // namespace

void add_legend(ColorImage& overview, const Plan& plan, const WorldModel& world,
                const PinholeCamera& camera) {
  if (overview.width < kMinWidth) return;
  cv::Mat3b picture(overview.height, overview.width,
                    reinterpret_cast<cv::Vec3b*>(overview.samples.data()));
  const LegendPanel panel(legend_entries(plan, world), overview.width);
  const std::vector<cv::Point> points = subject_points(plan, world, camera);
  panel.draw(picture, emptiest_corner(points, panel.size(), picture.size()));
  const std::vector<Eigen::Vector3d> bodies = suggested_bodies(plan);
  if (bodies.size() < 2) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::optional<ImagePoint> p = camera.project(bodies[i]);
    if (!p) continue;
    draw_number(picture, {int(std::lround(p->u)), int(std::lround(p->v))}, i + 1,
                ink_of(plan_colors().suggested_camera));
  }
}

}  // namespace vantage
