// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon::stage {

class Prim;

/// A relationship of a composed prim; a small handle by value.
class Relationship {
 public:
  Relationship() = default;

  bool is_defined() const;
  bool is_authored() const;
  Path path() const;
  Token name() const { return name_; }
  bool is_custom() const;

  bool has_authored_targets() const;
  /// Targets in the stage's namespace, list edits combined.
  std::vector<Path> targets() const;
  /// The same with relationships followed to what they target.
  std::vector<Path> forwarded_targets() const;

  layer::Value metadata(Token field) const;
  std::map<std::string, layer::Value> all_authored_metadata() const;
  struct SpecSite {
    const layer::Layer* layer = nullptr;
    Path path;
    const layer::Spec* spec = nullptr;
  };
  std::vector<SpecSite> spec_stack() const;
  Diagnostic located(Severity severity, std::string rule, std::string message) const;

 private:
  friend class Prim;
  const void* stage_ = nullptr;
  const void* prim_ = nullptr;
  Path prim_path_;
  Token name_;
};

}  // namespace tenon::stage
