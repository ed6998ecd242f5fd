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
class TargetMemo;
class ValueMemo;
struct PrimData;
struct StageData;

/// What attributes and relationships have in common: a name on a composed prim.
class Property {
 public:
  Path path() const;
  Token name() const { return name_; }
  std::map<std::string, layer::Value> all_authored_metadata() const;

  /// Layer, spec path and spec of every opinion, strongest first.
  std::vector<SpecSite> spec_stack() const;
  /// A diagnostic with the place of the strongest opinion (of the prim's when none is authored).
  Diagnostic located(Severity severity, std::string rule, const Message& message,
                     StatementPart part = {}) const;
  /// The same with the place of one of its connections or targets, given in the stage's namespace.
  Diagnostic located_target(Severity severity, std::string rule, const Message& message,
                            Path target) const;

 protected:
  friend class TargetMemo;
  friend class ValueMemo;
  class ValueMemo;
  Property() = default;
  Property(const StageData* stage, const PrimData* prim, Path proxy_path, Token name)
      : stage_(stage), prim_(prim), proxy_path_(proxy_path), name_(name) {}

  bool is_authored_as(layer::SpecKind kind) const;
  /// Connections or targets in the stage's namespace, list edits combined.
  std::vector<Path> composed_targets() const;

  const StageData* stage_ = nullptr;
  const PrimData* prim_ = nullptr;
  Path proxy_path_;  // of the prim; empty unless it is an instance proxy
  Token name_;
};

}  // namespace tenon::stage
