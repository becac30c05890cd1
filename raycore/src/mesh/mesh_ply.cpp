#include "mesh/mesh_ply.hpp"

#include <fmt/format.h>

#include "core/byte_order.hpp"

namespace vantage::detail {

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

void AsciiPlyBody::expect_end() {
  if (skip_blank_lines()) text_.fail("expected the file's end: the header claims no more elements");
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
  place_.fail("a property of no known type");
}

void BinaryPlyBody::expect_end() {
  // Some programs end a binary file with a line end as well.
  if (left_.size() <= 2) return;
  throw bad_input(std::string(place_.file),
                  fmt::format("{} bytes follow the last element that the header claims; its counts "
                              "are wrong or the file is damaged",
                              left_.size()));
}

}  // namespace vantage::detail
