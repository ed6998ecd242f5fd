// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/spec_site.h"

namespace tenon::stage {

class Prim;
struct PrimData;
struct StageData;

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
  std::vector<SpecSite> spec_stack() const;
  Diagnostic located(Severity severity, std::string rule, std::string message,
                     StatementPart part = {}) const;
  /// The same with the place of one of its targets, given in the stage's namespace.
  Diagnostic located_target(Severity severity, std::string rule, std::string message,
                            Path target) const;

 private:
  friend class Prim;
  Relationship(const StageData* stage, const PrimData* prim, Path proxy_path, Token name)
      : stage_(stage), prim_(prim), proxy_path_(proxy_path), name_(name) {}

  const StageData* stage_ = nullptr;
  const PrimData* prim_ = nullptr;
  Path proxy_path_;  // of the prim; empty unless it is an instance proxy
  Token name_;
};

}  // namespace tenon::stage
