#pragma once

#include "codecs/image_codec.hpp"

namespace vantage::reconstruction::detail {

/// The codecs of pictures; the first call loads them, which takes a tenth of a second.
/// Safe in many threads.
/// @throws std::runtime_error if their library is not beside this one: the installation is
/// incomplete.
const ImageCodec& image_codec();

}  // namespace vantage::reconstruction::detail
