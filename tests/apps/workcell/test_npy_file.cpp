#include "workcell/npy_file.hpp"

#include <doctest/doctest.h>

#include <string>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

using namespace std::string_literals;

const std::string kDictionary = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 4), }";

/// What numpy.save writes: padded so that the array begins at a multiple of 64 bytes.
std::string npy(const std::string& dictionary, const std::string& array, int version = 1) {
  const std::size_t before = version == 1 ? 10 : 12;
  std::string text = dictionary;
  while ((before + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string bytes = "\x93NUMPY"s + char(version) + '\0';
  bytes += char(text.size() & 0xff);
  bytes += char(text.size() >> 8);
  if (version > 1) bytes += "\0\0"s;
  return bytes + text + array;
}

/// The numbers from 0 to 23.
std::string counting() {
  std::string bytes;
  for (char i = 0; i < 24; ++i) bytes += i;
  return bytes;
}

ByteArray3 read(const std::string& bytes) {
  TemporaryFolder folder;
  return read_npy_bytes(folder.write("a.npy", bytes));
}

void expect_npy_refused(const std::string& bytes, std::string_view part,
                        ErrorCode code = ErrorCode::bad_input) {
  CAPTURE(part);
  expect_error(code, "a.npy", part, [&] { read(bytes); });
}

void expect_dictionary_refused(const std::string& dictionary, std::string_view part) {
  CAPTURE(dictionary);
  expect_npy_refused(npy(dictionary, counting()), part);
}

}  // namespace

TEST_CASE("arrays as NumPy writes them, in every format") {
  for (const int version : {1, 2, 3}) {
    CAPTURE(version);
    const ByteArray3 array = read(npy(kDictionary, counting(), version));
    CHECK(array.shape == Eigen::Vector3i(2, 3, 4));
    REQUIRE(array.values.size() == 24);
    for (std::size_t i = 0; i < 24; ++i) CHECK(array.values[i] == i);
  }
  const ByteArray3 truth =
      read(npy("{'descr': '|b1', 'fortran_order': False, 'shape': (1, 2, 2), }", "\1\0\0\1"s));
  CHECK(truth.values == std::vector<std::uint8_t>{1, 0, 0, 1});
  // As others may write it: other quotes, another order, no comma at the end, no spaces.
  CHECK(read(npy("{\"shape\":(1,2,2),\"descr\":\"|u1\",\"fortran_order\":False}", "abcd")).values ==
        std::vector<std::uint8_t>{'a', 'b', 'c', 'd'});
}

TEST_CASE("files that are not arrays of bytes are refused") {
  expect_npy_refused("", "not a NumPy array");
  expect_npy_refused("work_area: 1\n", "not a NumPy array");
  expect_npy_refused(npy(kDictionary, counting(), 4), "format 4.0");
  expect_npy_refused(npy(kDictionary, counting() + "x"), "25 bytes follow its header; expected 24");
  expect_npy_refused(npy(kDictionary, ""), "0 bytes follow");
  std::string long_header = npy(kDictionary, counting(), 2);
  long_header[10] = 1;  // 64 KiB more
  expect_npy_refused(long_header, "truncated");

  const auto with = [](const char* type, const char* order, const char* shape) {
    return "{'descr': '"s + type + "', 'fortran_order': " + order + ", 'shape': " + shape + "}";
  };
  expect_dictionary_refused(with("<f4", "False", "(2, 3, 4)"), "\"<f4\"");
  expect_dictionary_refused(with("|u1", "True", "(2, 3, 4)"), "Fortran");
  expect_dictionary_refused(with("|u1", "False", "(24,)"), "(24)");
  expect_dictionary_refused(with("|u1", "False", "()"), "three sizes");
  expect_dictionary_refused(with("|u1", "False", "(2, 3, 2, 2)"), "(2, 3, 2, 2)");
  expect_dictionary_refused(with("|u1", "False", "(2, 0, 4)"), "(2, 0, 4)");
  expect_dictionary_refused(with("|u1", "False", "(2, -3, 4)"), "0 or more");
  expect_dictionary_refused(with("|u1", "False", "(99999999999999999999, 3, 4)"), "whole number");
  expect_npy_refused(npy(with("|u1", "False", "(2048, 1024, 1024)"), counting()), "2.15e+09",
                     ErrorCode::out_of_resources);
  expect_npy_refused(npy(with("|u1", "False", "(9223372036854775807, 9223372036854775807, 4)"), ""),
                     "elements", ErrorCode::out_of_resources);
  expect_npy_refused(npy(with("|b1", "False", "(2, 3, 4)"), counting()), "element 2 is 2");
  expect_bad_input("missing.npy", "o such file", [] { read_npy_bytes("missing.npy"); });
}

TEST_CASE("a header that is not such a dictionary is refused, with the place in it") {
  expect_dictionary_refused("[]", "\"[]");
  expect_dictionary_refused("{'descr': '|u1', 'shape': (2, 3, 4)}", "all of the keys");
  expect_dictionary_refused("{'descr': '|u1', 'descr': '|u1'}", "every key once");
  expect_dictionary_refused("{'descr': '|u1', 'order': 'C'}", "only");
  expect_dictionary_refused("{'descr: 1", "closing quote");
  expect_dictionary_refused("{descr: 1}", "quoted text");
  expect_dictionary_refused("{'descr' '|u1'}", "\":\"");
  expect_dictionary_refused("{'fortran_order': 0}", "True or False");
  expect_dictionary_refused("{'shape': [2, 3, 4]}", "\"(\"");
  expect_dictionary_refused("{'shape': (2 3)}", "\")\"");
  expect_dictionary_refused("{'shape': (2.5, 3)}", "\")\"");
  expect_dictionary_refused("{'descr': '|u1' 'shape'}", "\"}\"");
  expect_dictionary_refused(kDictionary + " 1", "nothing more");
  expect_dictionary_refused("{'shape': (2,", "whole number");
}

TEST_CASE("damaged arrays are refused or still arrays, byte by byte") {
  const std::string good = npy(kDictionary, counting());
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    expect_npy_refused(good.substr(0, size), "");
  }
  TemporaryFolder folder;
  int refused = 0;
  for (std::size_t at = 0; at < good.size() - 24; ++at) {
    for (const char byte : {'\0', '\xff', '(', '}', '9', '\''}) {
      std::string damaged = good;
      damaged[at] = byte;
      const auto file = folder.write("a.npy", damaged);
      try {
        const ByteArray3 array = read_npy_bytes(file);
        CHECK(std::size_t(array.shape.prod()) == array.values.size());
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  CHECK(refused > 300);
}

}  // namespace vantage::test
