#pragma once

#include <vector>

namespace vantage {

/// A rectangle on a page, y down.
struct PlotBox {
  double left = 0, top = 0, right = 0, bottom = 0;

  bool meets(const PlotBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool within(const PlotBox& other) const {
    return left >= other.left && right <= other.right && top >= other.top && bottom <= other.bottom;
  }
};

/// A point on a page that gets a label.
struct LabelledPoint {
  double x = 0, y = 0;
};

/// The middle of a label, and whether it is so far off that a line has to say what it belongs to.
struct LabelPlace {
  double x = 0, y = 0;
  bool away = false;
};

/// Places one label of `width` × `height` beside each point: the nearest place that is on the page
/// and hides no point's mark (`mark_radius` around it) and no label before it. Where there is none
/// within reach, the label stands to the right of its point.
std::vector<LabelPlace> label_places(const std::vector<LabelledPoint>& points, double width,
                                     double height, double mark_radius, const PlotBox& page);

}  // namespace vantage
