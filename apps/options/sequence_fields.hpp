#pragma once

#include "documents/document_value.hpp"
#include "options/field.hpp"
#include "simulator/sequence/sequence_settings.hpp"

namespace vantage {

/// What happens in a random sequence. The description points into what it describes.
FieldGroup fields_of(RandomSequence& sequence);

/// Reads a workcell's key `sequence`, as assets/schema/workcell.schema.json describes it.
/// @throws Error bad_input with file, line and key for a type that the knowledge base does not
/// have, and as `read_fields` does.
SequenceSettings read_sequence(const Value& value, const KnowledgeBase& knowledge);

}  // namespace vantage
