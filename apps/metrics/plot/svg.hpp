#pragma once

#include <string>

namespace vantage {

/// Text for XML and HTML: with &amp; for & and so on.
std::string xml_escaped(const std::string& text);

/// A text element. `look` is one of the classes of `svg_page`: title, panel, label, tick-x, tick-y,
/// beside (a mark, on white), legend, note.
std::string svg_text(double x, double y, const char* look, const std::string& content);

/// A line; `look` has further attributes, e.g. class="axis" or class="grid".
std::string svg_line(double x0, double y0, double x1, double y1, const std::string& look);

/// A self-contained SVG: white paper, the plots' typeface and classes, and the content. Many may
/// stand in one HTML page.
std::string svg_page(double width, double height, const std::string& content);

}  // namespace vantage
