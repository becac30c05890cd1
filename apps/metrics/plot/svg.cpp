#include "metrics/plot/svg.hpp"

#include <fmt/format.h>

namespace vantage {
namespace {

// All below .plot: in an HTML page the style is the whole page's.
constexpr const char* kLooks =
    ".plot text{font-family:'DejaVu Sans',Helvetica,Arial,sans-serif;fill:#222;font-size:12px}\n"
    ".plot .title{font-size:17px;font-weight:bold}\n"
    ".plot .panel{font-size:14px;text-anchor:middle}\n"
    ".plot .label,.plot .tick-x,.plot .beside{text-anchor:middle}.plot .tick-y{text-anchor:end}\n"
    ".plot .beside{paint-order:stroke;stroke:#fff;stroke-width:3px}\n"
    ".plot .legend{font-size:13px}.plot .note{fill:#666;font-size:11px}\n"
    ".plot .grid{stroke:#ddd;stroke-width:1}.plot .axis{stroke:#222;stroke-width:1.2}\n";

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string svg_text(double x, double y, const char* look, const std::string& content) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", look, x, y,
                     xml_escaped(content));
}

std::string svg_line(double x0, double y0, double x1, double y1, const std::string& look) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0,
                     x1, y1, look);
}

std::string svg_page(double width, double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<style>{2}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{3}</svg>\n",
      width, height, kLooks, content);
}

}  // namespace vantage
