#include "simulator/color/surface_color.hpp"

#include <fmt/format.h>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void check_look(const SimulatedBody& body) {
  const TexturedMesh& shape = *body.shape;
  const Eigen::Vector3f& c = shape.color;
  if (!((c.array() >= 0).all() && (c.array() <= 1).all())) {
    throw bad_input("body " + body.name, fmt::format("its colour is [{}, {}, {}]; expected sRGB "
                                                     "from 0 to 1",
                                                     c.x(), c.y(), c.z()));
  }
  if (!shape.textured()) return;
  const ColorImage& t = shape.texture;
  if (t.width < 1 || t.height < 1 ||
      t.samples.size() != std::size_t(t.width) * std::size_t(t.height) * 3) {
    throw bad_input("body " + body.name,
                    fmt::format("its texture of {} x {} texels has {} samples; expected three for "
                                "each of at least one",
                                t.width, t.height, t.samples.size()));
  }
  for (std::size_t i = 0; i < shape.uv.size(); ++i) {
    for (const Eigen::Vector2f& uv : shape.uv[i]) {
      if (uv.allFinite()) continue;
      throw bad_input("body " + body.name, fmt::format("a texture coordinate of triangle {} is "
                                                       "({}, {}); expected finite numbers",
                                                       i, uv.x(), uv.y()));
    }
  }
}

}  // namespace

SurfaceColors::SurfaceColors(std::span<const SimulatedBody> bodies) {
  for (const SimulatedBody& body : bodies) {
    check_look(body);
    const Eigen::Vector3f linear = body.shape->color.unaryExpr(&srgb_to_linear);
    looks_.push_back({linear, body.shape->textured() ? body.shape.get() : nullptr});
  }
}

}  // namespace vantage
