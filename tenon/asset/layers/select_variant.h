// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/made_file.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"

namespace tenon {

struct SelectOptions {
  OpenOptions open;
  std::string assignment;  ///< SET=VARIANT
  std::string prim;        ///< with the set; empty: the default prim
  bool in_place = false;   ///< in the asset's root layer; else:
  std::string output;      ///< a file, or "-" for standard output
};

struct VariantSelection {
  Path prim;
  std::string set;
  std::string variant;
};

struct SelectedVariant {
  VariantSelection selection;
  MadeFile file;
  std::string root;            ///< layer that is changed, or over which the new one lies
  bool is_layer_over = false;  ///< the file has the asset as its sublayer
  bool kept_layout = true;     ///< comments and layout of text stay
};

/// Authors a selection of a variant that there is. No file is touched. Errors: those of
/// tenon::open; NotFound, with what there is; Unsupported, in place in a package.
Result<SelectedVariant> select_variant(const std::string& path, const SelectOptions& options,
                                       Diagnostics& diagnostics);

/// {"prim", "set", "selection"}.
answers::Json selected_json(const VariantSelection& selection);

}  // namespace tenon
