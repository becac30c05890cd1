#include "cli/picture_file.hpp"

#include <fmt/format.h>

#include <string>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"
#include "vantage/reconstruction/color_image.hpp"

namespace vantage {
void write_picture(const std::filesystem::path& path, const ColorImage& image) {
  const std::string ending = path.extension().string();
  if (ending == ".png") {
    write_png(path, image);
  } else if (ending == ".jpg" || ending == ".jpeg") {
    write_file(path, jpeg_bytes(image));
  } else {
    throw bad_input(path.string(),
                    fmt::format("found the ending \"{}\"; expected .png or .jpg", ending));
  }
}

}  // namespace vantage
