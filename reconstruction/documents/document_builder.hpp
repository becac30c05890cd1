#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "documents/document.hpp"
#include "documents/document_limits.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Where something begins in a text; both count from 1, a column of 0 is not known.
struct TextPosition {
  int line = 1;
  int column = 0;
};

/// "name:line:column", as compilers write it.
std::string place_in_text(const std::string& name, TextPosition at);

/// Builds a document from the events of a parser, one after the other, without recursion. Keeps the
/// limits while it does, so that the parser can be stopped in time; an alias is charged for all
/// that it stands for.
///
/// Every method throws Error bad_input with file:line:column for what is there twice, too deep, too
/// long or too much, and Error cancelled soon after `stop` was.
class DocumentBuilder {
 public:
  /// @param name of the text, for messages.
  DocumentBuilder(std::string name, const DocumentLimits& limits, const StopToken& stop);

  /// `anchor` names what begins here for aliases; empty for none.
  void begin_map(TextPosition at, const std::string& anchor = {});
  void begin_list(TextPosition at, const std::string& anchor = {});
  void end();  ///< of the innermost map or list

  bool expects_key() const;
  void key(const std::string& text, TextPosition at);
  /// What follows adds its keys to the innermost map, below those that it has: YAML's `<<`.
  void merge_key(TextPosition at);

  /// A value that is neither map nor list.
  void value(nlohmann::json scalar, TextPosition at, const std::string& anchor = {});
  /// What was named `anchor` before; as a key where one is expected.
  void alias(const std::string& anchor, TextPosition at);

  /// After the last event.
  Document finish();

  [[noreturn]] void fail(TextPosition at, std::string message) const;

 private:
  /// What the limits see of a value and all that is in it.
  struct Weight {
    std::size_t values = 0;
    std::size_t bytes = 0;
  };
  struct Anchored {
    nlohmann::json value;
    Weight weight;
  };
  /// A map or list that is not complete yet.
  struct Open {
    nlohmann::json value;
    TextPosition at;
    std::string anchor;
    std::uint64_t pointer_hash;
    int line;              ///< that this value is found at
    Weight before;         ///< of all that came before it
    std::string key = {};  ///< that waits for its value
    int key_line = 0;
    bool has_key = false;
    bool merges = false;         ///< what comes next is the value of `<<`
    nlohmann::json merged = {};  ///< what `<<` stood for, or null
  };

  void begin(nlohmann::json empty, TextPosition at, const std::string& anchor);
  void add(nlohmann::json value, TextPosition at);
  void merge(Open& map, nlohmann::json value, TextPosition at) const;
  void charge(const Weight& more, TextPosition at);
  void remember(const std::string& anchor, const nlohmann::json& value, const Weight& weight,
                TextPosition at);
  std::uint64_t next_pointer_hash() const;
  int next_line(TextPosition at) const;
  void note_line(std::uint64_t pointer_hash, int line);

  Document document_;
  DocumentLimits limits_;
  const StopToken& stop_;
  Weight weight_;
  std::vector<Open> open_;
  std::map<std::string, Anchored> anchors_;
};

}  // namespace vantage
