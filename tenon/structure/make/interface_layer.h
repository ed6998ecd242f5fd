// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/layer.h"

namespace tenon::structure {

/// A variant of the interface and the file that it loads; an empty name for none.
struct InterfaceVariant {
  std::string set;
  std::string variant;
  std::string file;
};

struct InterfaceParts {
  Token robot;
  std::string base;                             ///< file names, relative to the asset's folder
  std::vector<InterfaceVariant> runtimes = {};  ///< of sets that are stronger than "Physics"
  std::vector<InterfaceVariant> physics;
  std::vector<InterfaceVariant> others;
  std::map<std::string, std::string> selections;
};

/// The file that opens the asset: one prim with a reference to the base, the variant sets with
/// their payloads, and what is selected. Metadata of the stage come from `content`.
layer::Layer interface_layer(const layer::Layer& content, const InterfaceParts& parts,
                             std::string identifier);

/// Units, axes and times of the stage; with `of_robot` the default prim as well.
void put_stage_metadata(const layer::Layer& content, layer::Layer& file, bool of_robot);

/// "payloads/<Set>/<variant>.usda", with the variant in lower case.
std::string file_of_variant(const std::string& set, const std::string& variant);

}  // namespace tenon::structure
