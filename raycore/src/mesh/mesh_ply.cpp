// PLY: a header that declares elements and their properties, then the elements. Vertices have x, y
// and z; a face has a list of vertex indices; everything else is passed over.
#include <fmt/format.h>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "core/byte_order.hpp"
#include "mesh/mesh_readers.hpp"
#include "mesh/ply_header.hpp"
#include "mesh/text_scanner.hpp"
#include "mesh/triangle_strip.hpp"

namespace vantage::raycore::detail {

/// The values behind a PLY header, one after the other, whatever the file's format. A value comes
/// as double, which holds every PLY type exactly. Every error names the place.
class PlyBody {
 public:
  virtual ~PlyBody() = default;

  virtual void begin_element(const PlyElement& element, std::uint64_t number) = 0;
  virtual double value(PlyType type) = 0;
  virtual void end_element() = 0;
  /// How many values of a type the rest of the file can hold at most.
  virtual std::uint64_t room_for(PlyType type) const = 0;
  virtual FilePlace place() const = 0;
  /// Whether more follows than a line's end. Called last.
  virtual bool more_follows() = 0;
};

/// One element on each line.
class AsciiPlyBody : public PlyBody {
 public:
  AsciiPlyBody(TextScanner text, std::uint64_t size) : text_(text), end_(text.position() + size) {}

  void begin_element(const PlyElement& element, std::uint64_t number) override;
  double value(PlyType type) override;
  void end_element() override;
  std::uint64_t room_for(PlyType type) const override;
  FilePlace place() const override { return text_.place(); }
  bool more_follows() override;

 private:
  bool skip_blank_lines();

  TextScanner text_;
  std::uint64_t end_;
};

class BinaryPlyBody : public PlyBody {
 public:
  BinaryPlyBody(std::span<const std::uint8_t> left, std::endian order, std::string_view file)
      : left_(left), order_(order), place_{file, "byte", 0} {}

  void begin_element(const PlyElement& element, std::uint64_t number) override;
  double value(PlyType type) override;
  void end_element() override {}
  std::uint64_t room_for(PlyType type) const override { return left_.size() / size_of(type); }
  FilePlace place() const override { return place_; }
  bool more_follows() override;

 private:
  template <class T>
  double take();

  std::span<const std::uint8_t> left_;
  std::endian order_;
  FilePlace place_;
};

bool AsciiPlyBody::skip_blank_lines() {
  do {
    TextScanner ahead = text_;
    if (!ahead.word().empty()) return true;
  } while (text_.next_line());
  return false;
}

void AsciiPlyBody::begin_element(const PlyElement& element, std::uint64_t number) {
  if (skip_blank_lines()) return;
  text_.fail(fmt::format("the file ends after {} of {} of the element {}; it is truncated", number,
                         element.count, in_quotes(element.name)));
}

double AsciiPlyBody::value(PlyType) {
  return text_.number("the next value");
}

void AsciiPlyBody::end_element() {
  const std::string_view word = text_.word();
  if (!word.empty()) {
    text_.fail(fmt::format("{} follows the last value that the header declares for this line",
                           in_quotes(word)));
  }
  text_.next_line();
}

std::uint64_t AsciiPlyBody::room_for(PlyType) const {
  return (end_ - text_.position() + 1) / 2;
}

bool AsciiPlyBody::more_follows() {
  return skip_blank_lines();
}

void BinaryPlyBody::begin_element(const PlyElement& element, std::uint64_t number) {
  place_.unit = element.name;
  place_.number = number;
}

template <class T>
double BinaryPlyBody::take() {
  if (left_.size() < sizeof(T)) place_.fail("the file ends here; it is truncated");
  const T result = load<T>(left_.data(), order_);
  left_ = left_.subspan(sizeof(T));
  return double(result);
}

double BinaryPlyBody::value(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return take<std::int8_t>();
    case PlyType::uint8:
      return take<std::uint8_t>();
    case PlyType::int16:
      return take<std::int16_t>();
    case PlyType::uint16:
      return take<std::uint16_t>();
    case PlyType::int32:
      return take<std::int32_t>();
    case PlyType::uint32:
      return take<std::uint32_t>();
    case PlyType::float32:
      return take<float>();
    case PlyType::float64:
      return take<double>();
  }
  place_.fail("a property of a known type");
}

bool BinaryPlyBody::more_follows() {
  return left_.size() > 2;  // some programs end a binary file with a line end as well
}

namespace {

/// Marks a property of a vertex that is not a coordinate.
constexpr int kNotUsed = -1;

/// For each property of a vertex: 0, 1, 2 for x, y, z, or kNotUsed.
std::vector<int> vertex_axes(const PlyElement& element, const std::string& file) {
  std::vector<int> axes;
  int found = 0;
  for (const PlyProperty& property : element.properties) {
    const bool is_axis = property.name == "x" || property.name == "y" || property.name == "z";
    axes.push_back(is_axis && !property.count_type ? property.name[0] - 'x' : kNotUsed);
    found += axes.back() != kNotUsed ? 1 : 0;
  }
  if (found == 3) return axes;
  throw bad_input(file,
                  "the header's element \"vertex\" has no properties x, y and z that are "
                  "single numbers");
}

/// The number of the property that has a face's corners.
std::size_t corner_property(const PlyElement& element, const std::string& file) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
    if (property.count_type && property.type < PlyType::float32) return i;
  }
  throw bad_input(file,
                  fmt::format("the header's element {} has no property \"vertex_indices\" that is "
                              "a list of integers",
                              in_quotes(element.name)));
}

/// Reads a list's length and checks it against what the file can still hold.
std::uint64_t read_length(PlyBody& body, const PlyProperty& list) {
  const double length = body.value(*list.count_type);
  const std::uint64_t room = body.room_for(list.type);
  if (length >= 0 && length <= double(room) && length == std::floor(length)) {
    return std::uint64_t(length);
  }
  body.place().fail(
      fmt::format("the list {} has the length {}; expected an integer from 0 to {}, "
                  "as many as the file can still hold",
                  in_quotes(list.name), length, room));
}

void skip(PlyBody& body, const PlyProperty& property) {
  const std::uint64_t count = property.count_type ? read_length(body, property) : 1;
  for (std::uint64_t i = 0; i < count; ++i) body.value(property.type);
}

void read_vertices(PlyBody& body, const PlyElement& element, MeshBuilder& mesh) {
  const std::vector<int> axes = vertex_axes(element, mesh.file());
  mesh.reserve(element.count, 0);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_element(element, i);
    Eigen::Vector3d p_file;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      if (axes[k] == kNotUsed) {
        skip(body, element.properties[k]);
      } else {
        p_file[axes[k]] = body.value(element.properties[k].type);
      }
    }
    FilePlace place = body.place();
    if (place.unit != "line") place.unit = "vertex";  // the header is gone when the builder reports
    mesh.add_vertex(p_file, place);
    body.end_element();
  }
}

std::int64_t read_index(PlyBody& body, PlyType type) {
  const double index = body.value(type);
  // An ASCII file can have anything here; what fits no index fits no integer either.
  if (std::abs(index) < 1e15 && index == std::floor(index)) return std::int64_t(index);
  body.place().fail(fmt::format("the face has a corner at vertex {}; expected an integer", index));
}

void read_faces(PlyBody& body, const PlyElement& element, std::uint64_t vertex_count,
                MeshBuilder& mesh) {
  const std::size_t used = corner_property(element, mesh.file());
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_element(element, i);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != used) {
        skip(body, property);
        continue;
      }
      corners.resize(read_length(body, property));
      for (std::int64_t& corner : corners) corner = read_index(body, property.type);
    }
    mesh.add_polygon(corners, vertex_count, body.place());
    body.end_element();
  }
}

/// Long strips, one after the other in each list, parted by -1. Their triangles change direction
/// one by one.
void read_strips(PlyBody& body, const PlyElement& element, std::uint64_t vertex_count,
                 MeshBuilder& mesh) {
  const std::size_t used = corner_property(element, mesh.file());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_element(element, i);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != used) {
        skip(body, property);
        continue;
      }
      TriangleStrip strip;
      for (std::uint64_t left = read_length(body, property); left > 0; --left) {
        const std::int64_t index = read_index(body, property.type);
        if (index == -1) {
          strip = {};
        } else if (const auto triangle = strip.next(index)) {
          mesh.add_polygon(*triangle, vertex_count, body.place());
        }
      }
    }
    body.end_element();
  }
}

void read_elements(PlyBody& body, const PlyHeader& header, MeshBuilder& mesh) {
  const PlyElement* vertices = header.find("vertex");
  if (vertices == nullptr) throw bad_input(mesh.file(), "the header has no element \"vertex\"");
  for (const PlyElement& element : header.elements) {
    if (&element == vertices) {
      read_vertices(body, element, mesh);
    } else if (element.name == "face") {
      read_faces(body, element, vertices->count, mesh);
    } else if (element.name == "tristrips") {
      read_strips(body, element, vertices->count, mesh);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        body.begin_element(element, i);
        for (const PlyProperty& property : element.properties) skip(body, property);
        body.end_element();
      }
    }
  }
  if (body.more_follows()) {
    mesh.add_remark(
        "there is more after the last element that the header declares; left out (is a count "
        "wrong?)");
  }
}

}  // namespace

void read_ply(std::span<const std::uint8_t> bytes, MeshBuilder& mesh) {
  TextScanner text(as_text(bytes), mesh.file());
  const PlyHeader header = read_ply_header(text);
  const std::span<const std::uint8_t> data = bytes.subspan(text.position());
  check_ply_counts(header, data.size(), mesh.file());
  if (header.format == PlyFormat::ascii) {
    AsciiPlyBody body(text, data.size());
    return read_elements(body, header, mesh);
  }
  const bool little = header.format == PlyFormat::little_endian;
  BinaryPlyBody body(data, little ? std::endian::little : std::endian::big, mesh.file());
  read_elements(body, header, mesh);
}

}  // namespace vantage::raycore::detail
