#include "process/printable_text.hpp"

#include <doctest/doctest.h>

#include "process/process_setup.hpp"

namespace vantage::test {

TEST_CASE("printable text stays as it is") {
  for (const char* text :
       {"", "cell.yaml:3: boxes[0]", "line\n\ttab", "Größe 10 µm ≥ 9", "漢字 🤖"}) {
    CHECK(printable(text) == text);
  }
}

TEST_CASE("control characters and bytes that are no UTF-8 are escaped") {
  CHECK(printable("a\x1b[2Jb\r\x07\x7f") == "a\\x1b[2Jb\\x0d\\x07\\x7f");
  CHECK(printable(std::string_view("\0", 1)) == "\\x00");
  CHECK(printable("\xc2\x9b") == "\\xc2\\x9b");           // CSI as one character
  CHECK(printable("\xe2\x80\xae") == "\\xe2\\x80\\xae");  // right to left from here on
  CHECK(printable("\xff\xc3") == "\\xff\\xc3");
  CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");                      // too long for what it says
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");             // half of a pair of UTF-16
  CHECK(printable("\xf4\x90\x80\x80x") == "\\xf4\\x90\\x80\\x80x");  // beyond Unicode
}

TEST_CASE("what is very long loses its middle, and no character is cut in two") {
  const std::string usual(14000, 'x');
  CHECK(shortened(usual) == usual);
  std::string text;
  for (int i = 0; i < 10000; ++i) text += "€";
  const std::string cut = shortened("ab" + text + "c");
  CHECK(cut.size() < 8000);
  CHECK(cut.starts_with("ab€"));
  CHECK(cut.ends_with("€c"));
  CHECK(cut.find("bytes left out") != std::string::npos);
  CHECK(printable(cut) == cut);  // all of it is UTF-8
}

TEST_CASE("numbers that begin with a dot are no options") {
  const char* words[] = {"vantage", "-.5", "-.x", "-.", "-o", "-0.5", "--a=-.5", ".5"};
  const auto plain = plain_arguments(int(std::size(words)), const_cast<char**>(words));
  CHECK(plain ==
        std::vector<std::string>{"vantage", "-0.5", "-.x", "-.", "-o", "-0.5", "--a=-.5", ".5"});
}

}  // namespace vantage::test
