#include "mesh/decoder/polygon_soup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t(512) << 20;
constexpr std::size_t kMaxFault = 1000;
constexpr std::size_t kMaxCorners = 1'000'000;

/// What comes first. Both processes are this program: no byte order to agree on.
struct SoupHeader {
  std::uint64_t points, words, fault;
  std::uint64_t up;
};

template <class T>
std::span<const std::uint8_t> raw_bytes(const T* values, std::size_t count) {
  return {reinterpret_cast<const std::uint8_t*>(values), count * sizeof(T)};
}

/// Reads in pieces: a call to the system for each number would take long.
class SoupStream {
 public:
  explicit SoupStream(ChildProcess& child) : child_(child) {}

  /// False if the message ends before it is full.
  template <class T>
  bool take(T& value) {
    std::array<std::uint8_t, sizeof(T)> raw;
    for (std::size_t done = 0; done < sizeof(T);) {
      if (at_ == size_ && !refill()) return false;
      const std::size_t count = std::min(sizeof(T) - done, size_ - at_);
      std::memcpy(raw.data() + done, buffer_.data() + at_, count);
      at_ += count;
      done += count;
    }
    std::memcpy(static_cast<void*>(&value), raw.data(), sizeof(T));
    return true;
  }

 private:
  bool refill() {
    at_ = 0;
    size_ = child_.read(buffer_);
    return size_ > 0;
  }

  ChildProcess& child_;
  std::vector<std::uint8_t> buffer_ = std::vector<std::uint8_t>(1 << 16);
  std::size_t at_ = 0, size_ = 0;
};

bool take_fault(SoupStream& stream, std::uint64_t size, MeshBuilder& mesh) {
  std::string fault;
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(size, kMaxFault); ++i) {
    char c = 0;
    if (!stream.take(c)) return false;
    fault += c >= ' ' && c <= '~' ? c : '?';
  }
  throw bad_input(mesh.file(), std::move(fault));
}

bool take_polygons(SoupStream& stream, std::uint64_t words, MeshBuilder& mesh) {
  std::vector<std::int64_t> corners;
  for (std::uint64_t done = 0, number = 0; done < words; ++number) {
    std::uint32_t count = 0;
    if (!stream.take(count)) return false;
    const FilePlace place = {mesh.file(), "face", number};
    if (count > kMaxCorners || count > words - done - 1) {
      place.fail(
          fmt::format("the face has {} corners, which is impossible; the file is damaged", count));
    }
    corners.clear();
    for (std::uint32_t k = 0; k < count; ++k) {
      std::uint32_t index = 0;
      if (!stream.take(index)) return false;
      corners.push_back(index);
    }
    mesh.add_polygon(corners, mesh.vertex_count(), place);
    done += 1 + count;
  }
  return true;
}

}  // namespace

void send(int pipe, const PolygonSoup& soup) {
  const SoupHeader header = {soup.points.size(), soup.polygons.size(), soup.fault.size(),
                             std::uint64_t(soup.up)};
  write_to_pipe(pipe, raw_bytes(&header, 1)) &&
      write_to_pipe(pipe, raw_bytes(soup.fault.data(), soup.fault.size())) &&
      write_to_pipe(pipe, raw_bytes(soup.points.data(), soup.points.size())) &&
      write_to_pipe(pipe, raw_bytes(soup.polygons.data(), soup.polygons.size()));
}

bool receive(ChildProcess& child, MeshBuilder& mesh) {
  SoupStream stream(child);
  SoupHeader header = {};
  if (!stream.take(header)) return false;
  if (header.fault > 0) return take_fault(stream, header.fault, mesh);
  if (header.points > kMaxBytes / sizeof(Eigen::Vector3d) ||
      header.words > kMaxBytes / sizeof(std::uint32_t)) {
    throw Error(
        ErrorCode::out_of_resources, mesh.file(),
        fmt::format("has {} points; a mesh of this format may take {} MiB: convert it to PLY",
                    header.points, kMaxBytes >> 20));
  }
  mesh.set_file_up(UpAxis(std::min<std::uint64_t>(header.up, std::uint64_t(UpAxis::minus_z))));
  for (std::uint64_t i = 0; i < header.points; ++i) {
    Eigen::Vector3d point;
    if (!stream.take(point)) return false;
    mesh.add_vertex(point, {mesh.file(), "vertex", i});
  }
  return take_polygons(stream, header.words, mesh);
}

}  // namespace vantage::raycore::detail
