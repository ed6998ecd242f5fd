// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/diff/layer_difference.h"
#include "tenon/open_stage.h"
#include "tenon/scene/fields/scene_difference.h"

/// Two layers, packages, folders or assets compared.
namespace tenon {

/// A side that is not there: an empty layer, or a package without files. Git's name of it.
inline constexpr const char* kNoFile = "/dev/null";

/// What is compared of the two.
enum class CompareMode : std::uint8_t {
  Files,     ///< layers as they are; two packages or folders file by file
  Composed,  ///< the scenes that they compose to
  Physics,   ///< what an engine receives
};

struct CompareOptions {
  CompareMode mode = CompareMode::Files;
  double tolerance = 0;  ///< numbers a, b are equal when |a - b| <= tolerance max(1, |a|, |b|)
  OpenOptions open;
};

/// A file of a package that only one side has, or that differs and is no layer.
struct FileChange {
  Change change = Change::Changed;
};

struct FileDifference {
  std::string file;  ///< below the package or folder; empty elsewhere
  std::variant<FileChange, diff::Difference, scene::SceneDifference> what;
};

struct ComparedFiles {
  std::string mode;  ///< "layers", "packages", "composed" or "physics"
  std::vector<FileDifference> differences;
  /// Nothing was kept from being compared: a file that may not be read is named in the diagnostics.
  bool complete = true;

  bool equal() const { return differences.empty() && complete; }
};

/// Errors: those of opening the two; Io for a folder that cannot be listed.
Result<ComparedFiles> compare_files(const std::string& before, const std::string& after,
                                    const CompareOptions& options, Diagnostics& diagnostics);

/// {"before", "after", "mode", "equal", "differences": rows of answers::difference_json, with the
/// "file" in packages; {"change", "file", "kind": "file"} for a FileChange}.
answers::Json compared_json(const std::string& before, const std::string& after,
                            const ComparedFiles& compared);

}  // namespace tenon
