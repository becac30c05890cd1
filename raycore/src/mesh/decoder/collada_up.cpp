#include "mesh/decoder/collada_up.hpp"

#include <algorithm>

namespace vantage::raycore::detail {
namespace {

/// UTF-16 with every zero byte left out: enough for tags, which are ASCII.
std::string narrowed(std::string_view xml) {
  std::string text(xml);
  if (xml.starts_with("\xff\xfe") || xml.starts_with("\xfe\xff")) std::erase(text, '\0');
  return text;
}

void erase_comments(std::string& text) {
  std::string kept;
  std::size_t at = 0;
  while (true) {
    const std::size_t start = text.find("<!--", at);
    kept.append(text, at, start - at);
    if (start == std::string::npos) break;
    at = text.find("-->", start + 4);
    if (at == std::string::npos) break;
    at += 3;
  }
  text = std::move(kept);
}

}  // namespace

UpAxis collada_up(std::string_view xml) {
  std::string text = narrowed(xml);
  erase_comments(text);
  const std::size_t tag = text.find("up_axis");  // whatever its namespace's prefix
  if (tag == std::string::npos) return UpAxis::y;
  const std::size_t start = text.find('>', tag);
  const std::string value =
      start == std::string::npos ? "" : text.substr(start + 1, text.find('<', start) - start - 1);
  if (value.find("X_UP") != std::string::npos) return UpAxis::x;
  if (value.find("Z_UP") != std::string::npos) return UpAxis::z;
  return UpAxis::y;
}

}  // namespace vantage::raycore::detail
