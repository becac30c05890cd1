#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "mesh/ply_header.hpp"
#include "mesh/text_scanner.hpp"

namespace vantage::detail {

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
  /// Called last.
  virtual void expect_end() = 0;
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
  void expect_end() override;

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
  void expect_end() override;

 private:
  template <class T>
  double take();

  std::span<const std::uint8_t> left_;
  std::endian order_;
  FilePlace place_;
};

}  // namespace vantage::detail
