#include "documents/document_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vantage {
namespace {

std::size_t text_bytes(const nlohmann::json& scalar) {
  const auto* text = scalar.get_ptr<const nlohmann::json::string_t*>();
  return text != nullptr ? text->size() : 0;
}

/// A key as a JSON pointer has it: "a/b" is "a~1b".
std::string pointer_token(const std::string& key) {
  if (key.find_first_of("~/") == std::string::npos) return key;
  return child({}, key).substr(1);
}

}  // namespace

std::string place_in_text(const std::string& name, TextPosition at) {
  return at.column > 0 ? fmt::format("{}:{}:{}", name, at.line, at.column)
                       : fmt::format("{}:{}", name, at.line);
}

DocumentBuilder::DocumentBuilder(std::string name, const DocumentLimits& limits,
                                 const StopToken& stop)
    : document_{std::move(name), {}}, limits_(limits), stop_(stop) {}

void DocumentBuilder::fail(TextPosition at, std::string message) const {
  throw bad_input(place_in_text(document_.name, at), std::move(message));
}

void DocumentBuilder::begin_map(TextPosition at, const std::string& anchor) {
  begin(nlohmann::json::object(), at, anchor);
}

void DocumentBuilder::begin_list(TextPosition at, const std::string& anchor) {
  begin(nlohmann::json::array(), at, anchor);
}

void DocumentBuilder::begin(nlohmann::json empty, TextPosition at, const std::string& anchor) {
  if (expects_key()) fail(at, "a key that is not a plain word; expected one, such as \"name\"");
  if (open_.size() >= std::size_t(limits_.max_depth)) {
    fail(at, fmt::format("nested deeper than {} levels, which no file for vantage needs",
                         limits_.max_depth));
  }
  Open next{std::move(empty), at, anchor, next_pointer_hash(), next_line(at), weight_};
  charge({1, 0}, at);
  note_line(next.pointer_hash, next.line);
  open_.push_back(std::move(next));
}

void DocumentBuilder::end() {
  Open done = std::move(open_.back());
  open_.pop_back();
  if (done.merged.is_object()) {
    done.merged.update(done.value);  // own keys win
    done.value = std::move(done.merged);
  }
  const Weight own{weight_.values - done.before.values, weight_.bytes - done.before.bytes};
  remember(done.anchor, done.value, own, done.at);
  add(std::move(done.value), done.at);
}

bool DocumentBuilder::expects_key() const {
  return !open_.empty() && open_.back().value.is_object() && !open_.back().has_key &&
         !open_.back().merges;
}

void DocumentBuilder::key(const std::string& text, TextPosition at) {
  if (text.size() > limits_.max_key_bytes) {
    fail(at, fmt::format("a key of {} bytes; the limit is {}", text.size(), limits_.max_key_bytes));
  }
  charge({0, text.size()}, at);
  Open& map = open_.back();
  map.key = text;
  map.key_line = at.line;
  map.has_key = true;
  const std::uint64_t pointer = next_pointer_hash();
  if (map.value.contains(text)) {
    document_.lines.finish();
    const int first = document_.lines.find_hash(pointer).value_or(map.line);
    fail(at, fmt::format("the key \"{}\" is given twice, first in line {}; remove one of them",
                         text, first));
  }
  note_line(pointer, at.line);
}

void DocumentBuilder::merge_key(TextPosition at) {
  Open& map = open_.back();
  if (!map.merged.is_null()) {
    fail(at, "the key \"<<\" is given twice; give it once, with a list: <<: [*one, *other]");
  }
  map.merges = true;
}

void DocumentBuilder::value(nlohmann::json scalar, TextPosition at, const std::string& anchor) {
  if (expects_key()) fail(at, "a value without a key; expected a key before it");
  const Weight own{1, text_bytes(scalar)};
  charge(own, at);
  note_line(next_pointer_hash(), next_line(at));
  remember(anchor, scalar, own, at);
  add(std::move(scalar), at);
}

void DocumentBuilder::alias(const std::string& anchor, TextPosition at) {
  const auto found = anchors_.find(anchor);
  if (found == anchors_.end()) {
    const bool inside_itself =
        std::any_of(open_.begin(), open_.end(), [&](const Open& o) { return o.anchor == anchor; });
    fail(at, inside_itself ? fmt::format("the alias *{} contains itself; remove it", anchor)
                           : fmt::format("the alias *{} has no anchor; expected &{} before it",
                                         anchor, anchor));
  }
  if (expects_key()) {
    if (!found->second.value.is_string())
      fail(at, fmt::format("the alias *{} is not a plain word", anchor));
    return key(found->second.value.get<std::string>(), at);
  }
  charge(found->second.weight, at);
  note_line(next_pointer_hash(), next_line(at));
  add(found->second.value, at);
}

Document DocumentBuilder::finish() {
  document_.lines.finish();
  return std::move(document_);
}

void DocumentBuilder::add(nlohmann::json value, TextPosition at) {
  if (open_.empty()) {
    document_.root = std::move(value);
    return;
  }
  Open& parent = open_.back();
  if (parent.merges) {
    merge(parent, std::move(value), at);
  } else if (parent.value.is_array()) {
    parent.value.push_back(std::move(value));
  } else {
    parent.value[parent.key] = std::move(value);
    parent.has_key = false;
  }
}

/// YAML's type "merge": a map, or a list of maps of which the first ones win.
void DocumentBuilder::merge(Open& map, nlohmann::json value, TextPosition at) const {
  if (value.is_object()) value = nlohmann::json::array({std::move(value)});
  const bool fits =
      value.is_array() &&
      std::all_of(value.begin(), value.end(), [](const auto& one) { return one.is_object(); });
  if (!fits) fail(at, "\"<<\" merges mappings; expected *name, or a list of such names");
  map.merges = false;
  map.merged = nlohmann::json::object();
  std::for_each(value.rbegin(), value.rend(), [&](const auto& one) { map.merged.update(one); });
}

void DocumentBuilder::charge(const Weight& more, TextPosition at) {
  constexpr std::size_t kValuesBetweenLooks = 4096;
  if (more.values > limits_.max_values - weight_.values) {
    fail(at, fmt::format("more than {} values, aliases expanded, which is the limit",
                         limits_.max_values));
  }
  if (more.bytes > limits_.max_bytes - weight_.bytes) {
    fail(at, fmt::format("more than {} bytes of text, aliases expanded, which is the limit",
                         limits_.max_bytes));
  }
  const std::size_t looks = weight_.values / kValuesBetweenLooks;
  weight_.values += more.values;
  weight_.bytes += more.bytes;
  if (weight_.values / kValuesBetweenLooks != looks && stop_.reason() == StopReason::cancelled) {
    throw Error(ErrorCode::cancelled, document_.name, "cancelled while it was read");
  }
}

/// Keeps a copy, which is charged for, too.
void DocumentBuilder::remember(const std::string& anchor, const nlohmann::json& value,
                               const Weight& weight, TextPosition at) {
  if (anchor.empty()) return;
  charge(weight, at);
  anchors_.insert_or_assign(anchor, Anchored{value, weight});
}

std::uint64_t DocumentBuilder::next_pointer_hash() const {
  if (open_.empty()) return LineMap::hash("");
  const Open& parent = open_.back();
  if (parent.merges) return parent.pointer_hash;  // its keys become the map's
  const std::string token =
      parent.value.is_array() ? std::to_string(parent.value.size()) : pointer_token(parent.key);
  return LineMap::hash(token, LineMap::hash("/", parent.pointer_hash));
}

/// Where the next value is found: people look for its key.
int DocumentBuilder::next_line(TextPosition at) const {
  const bool has_key = !open_.empty() && open_.back().has_key;
  return has_key ? open_.back().key_line : at.line;
}

/// A value in the line of what is around it needs no entry.
void DocumentBuilder::note_line(std::uint64_t pointer_hash, int line) {
  if (open_.empty() || open_.back().line != line) document_.lines.add(pointer_hash, line);
}

}  // namespace vantage
