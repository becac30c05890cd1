#include "dataset/bop_types.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/yaml_document.hpp"
#include "knowledge/hierarchy.hpp"
#include "knowledge/type_reader.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Reads one file after the other; what they say of one name adds up.
class Files {
 public:
  /// @param read  gets every file that is read; has to outlive this.
  explicit Files(std::vector<fs::path>& read) : read_(read), types_reader_(read) {}

  void add(const fs::path& path) {
    if (!fs::is_directory(path)) return add_yaml(path);
    for (ObjectType& type : reconstruction::detail::read_bop_types(path, read_))
      add(std::move(type));
  }

  MemoryKnowledgeBase finished() && {
    reconstruction::detail::check_no_circle(
        parents_, places_);  // here, where the hierarchy's lines are known
    return MemoryKnowledgeBase(std::move(types_), std::move(hierarchy_));
  }

 private:
  void add_yaml(const fs::path& file) {
    const Document document = read_yaml(file);
    check_schema(document, knowledge_schema());
    read_.push_back(file);
    const Value root(document);
    if (root.has("hierarchy")) add_hierarchy(root["hierarchy"]);
    for (const Value& value : root["object_types"].elements()) {
      add(types_reader_.read(value, file.parent_path()));
    }
  }

  void add_hierarchy(const Value& value) {
    for (const auto& [name, parents] : value.members()) {
      const auto names = parents.as<std::vector<std::string>>();
      reconstruction::detail::add_parents(parents_, name, names);
      std::vector<std::string>& all = hierarchy_[name];
      all.insert(all.end(), names.begin(), names.end());
      places_.try_emplace(name, parents.place());
    }
  }

  void add(ObjectType type) {
    reconstruction::detail::add_parents(parents_, type.name, type.is_a);
    places_.try_emplace(type.name, type.place);
    types_.push_back(std::move(type));
  }

  std::vector<fs::path>& read_;
  reconstruction::detail::TypeReader types_reader_;
  std::vector<ObjectType> types_;
  Hierarchy hierarchy_;
  reconstruction::detail::Parents parents_;    // of both
  std::map<std::string, std::string> places_;  // name → where its parents are said first
};

}  // namespace

FileKnowledgeBase::FileKnowledgeBase(const std::vector<fs::path>& files) {
  Files all(files_);
  for (const fs::path& file : files) all.add(file);
  memory_ = std::move(all).finished();
}

}  // namespace vantage
