#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "documents/document.hpp"
#include "documents/document_limits.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// How YAML is read.
struct YamlOptions {
  DocumentLimits limits = kYamlLimits;
  /// Files of OpenCV's cv::FileStorage, and what Python programs dump: a first line `%YAML:1.0` is
  /// passed over, and so are tags (`!!opencv-matrix`, `!!python/tuple`); what they are on is read
  /// as if they were not there.
  bool ignore_tags = false;
};

/// Reads one YAML document. Plain scalars are typed by YAML 1.2's core schema (`yes` is a string,
/// `true` a bool); quoted ones are strings. Aliases and merge keys (`<<`) are expanded. Lines may
/// end with LF, CR LF or CR; the text is UTF-8, or UTF-16 with a byte order mark.
/// @throws Error bad_input with file:line:column for invalid YAML, a key that is there twice, a key
/// that is no word, an unknown tag, a number out of range, and what exceeds the limits; for an
/// empty file, several documents in one file, a file that is missing or too large. Error cancelled
/// if `stop` was.
Document read_yaml(const std::filesystem::path& path, const YamlOptions& options = {},
                   const StopToken& stop = {});

/// The same for text; `name` is for the messages.
Document parse_yaml(std::string_view text, const std::string& name, const YamlOptions& options = {},
                    const StopToken& stop = {});

}  // namespace vantage
