#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/yaml_document.hpp"
#include "type_reader.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

}  // namespace

FileKnowledgeBase::FileKnowledgeBase(const std::vector<fs::path>& files) {
  detail::TypeReader reader(files_);
  std::vector<ObjectType> types;
  for (const fs::path& file : files) {
    const Document document = read_yaml(file);
    check_schema(document, knowledge_schema());
    files_.push_back(file);
    for (const Value& value : Value(document)["object_types"].elements()) {
      types.push_back(reader.read(value, file.parent_path()));
    }
  }
  memory_ = MemoryKnowledgeBase(std::move(types));
}

}  // namespace vantage
