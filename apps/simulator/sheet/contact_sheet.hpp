#pragma once

#include <span>
#include <string>

#include "vantage/raycore/image.hpp"

namespace vantage {

/// A picture of a scene by one of its cameras.
struct LabelledPicture {
  std::string scene;
  std::string camera;
  ColorImage image;
};

/// Sizes in pixels.
struct ContactSheetOptions {
  int columns = 5;       ///< of thumbnails
  int cell_width = 240;  ///< of a thumbnail, and the height of one of 4 : 3 follows from it
  int gap = 14;          ///< between thumbnails
  int margin = 36;       ///< around everything
};

/// All pictures on one sheet: a heading for each scene, and under it its cameras' thumbnails with
/// their names, averaged over areas in linear light. Scenes follow in the order in which they first
/// come, but one that fits into what an earlier row has left goes there. A scene with more pictures
/// than columns goes on in the next row. Pictures of another shape than 4 : 3 are fitted into the
/// thumbnail's place.
///
/// Text that is too long for its place ends in dots; OpenCV's fonts have ASCII alone, and show "?"
/// for anything else. The same pictures give the same bytes. Thread-safe.
/// @throws Error bad_input for no pictures, one without pixels, and options that are not 1 to 64
/// columns, 40 to 4096 pixels' width, and 0 to 1000 pixels' gap and margin.
ColorImage contact_sheet(std::span<const LabelledPicture> pictures,
                         const ContactSheetOptions& options = {});

}  // namespace vantage
