#pragma once

#include <string>

namespace vantage::test {

// One tetrahedron (corners at the origin and one unit along each axis, faces outwards) in every
// format that is read by readers of ours.

std::string stl_binary();
std::string stl_ascii();
std::string obj_text();

/// With properties and an element that a reader has to pass over.
/// @param format ascii, binary_little_endian or binary_big_endian
std::string ply(const std::string& format);

/// The bytes of `value`, first byte lowest (`big` turns them round).
template <class T>
std::string raw(T value, bool big = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
  return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// `bytes` with `part` written over what is at `at`.
std::string overwritten(const std::string& bytes, std::size_t at, const std::string& part);

/// `text` with its first `from` replaced by `to`; fails the test if there is none.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace vantage::test
