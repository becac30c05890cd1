#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage {

using TypePtr = std::shared_ptr<const ObjectType>;

/// A feature of a type: `type->features[index]`.
struct TypeFeature {
  TypePtr type;
  std::size_t index = 0;
};

/// What reconstruction asks about objects: their types, their hierarchy, and how to recognise them
/// (thesis, section 5.2). Derive from it to put another store behind it; implementations have to be
/// safe to read from many threads at once.
class VANTAGE_API KnowledgeBase {
 public:
  virtual ~KnowledgeBase() = default;

  /// All types, in an order that stays the same.
  virtual const std::vector<TypePtr>& types() const = 0;

  /// Null for a name of no type.
  virtual TypePtr find(std::string_view name) const = 0;

  /// Whether "a `name` is a(n) `ancestor`": itself, its parents, theirs and so on. Neither needs to
  /// be a type.
  virtual bool is_a(std::string_view name, std::string_view ancestor) const = 0;

  /// Every feature with this key, of whatever type; in the order of the types.
  virtual const std::vector<TypeFeature>& with_feature(const FeatureKey& key) const = 0;

  /// The types that are an `ancestor`, in their order.
  std::vector<TypePtr> types_that_are(std::string_view ancestor) const;

  /// @throws Error bad_input, with `where` as the place, for a name of no type; the message has the
  /// nearest name.
  TypePtr get(const std::string& name, const std::string& where) const;
};

/// Parents of names that are no types: {"cube", {"block"}} says that every cube is a block.
using Hierarchy = std::map<std::string, std::vector<std::string>>;

/// Types in memory. Immutable.
class VANTAGE_API MemoryKnowledgeBase final : public KnowledgeBase {
 public:
  MemoryKnowledgeBase() = default;  ///< without types

  /// @throws Error bad_input, the type's `place` or name as the place, for a name that is empty or
  /// used twice, a type without mesh, an ancestor that is its own, features without a type, a value
  /// or points, invalid sizes and points, axes that are not of length 1, and two features of a type
  /// that are the same in everything.
  explicit MemoryKnowledgeBase(std::vector<ObjectType> types, Hierarchy hierarchy = {});

  const std::vector<TypePtr>& types() const override { return types_; }
  TypePtr find(std::string_view name) const override;
  bool is_a(std::string_view name, std::string_view ancestor) const override;
  const std::vector<TypeFeature>& with_feature(const FeatureKey& key) const override;

 private:
  std::vector<TypePtr> types_;
  std::map<std::string, TypePtr, std::less<>> by_name_;
  std::map<std::string, std::vector<std::string>, std::less<>> parents_;
  std::map<FeatureKey, std::vector<TypeFeature>> by_feature_;
};

/// The types of knowledge base files, in their order: YAML as assets/schema/knowledge.schema.json
/// describes it, and folders of BOP models (models_info.json and obj_%06d.ply, millimetres), whose
/// types are called obj_000001 and carry a feature {"pose", "obj_000001"} at their origin.
/// Immutable.
class VANTAGE_API FileKnowledgeBase final : public KnowledgeBase {
 public:
  /// @throws Error bad_input with file, line and key for anything that is not as the schema has it,
  /// sizes and markers as solids.hpp and marker.hpp say, one marker under two dictionaries' names,
  /// and what MemoryKnowledgeBase refuses; with the mesh file for one that is damaged.
  explicit FileKnowledgeBase(const std::vector<std::filesystem::path>& files);

  const std::vector<TypePtr>& types() const override { return memory_.types(); }
  TypePtr find(std::string_view name) const override { return memory_.find(name); }
  bool is_a(std::string_view name, std::string_view ancestor) const override {
    return memory_.is_a(name, ancestor);
  }
  const std::vector<TypeFeature>& with_feature(const FeatureKey& key) const override {
    return memory_.with_feature(key);
  }

  /// Every file that was read, once.
  const std::vector<std::filesystem::path>& files() const noexcept { return files_; }

 private:
  std::vector<std::filesystem::path> files_;
  MemoryKnowledgeBase memory_;
};

}  // namespace vantage
