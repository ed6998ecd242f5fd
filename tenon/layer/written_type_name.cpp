// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/written_type_name.h"

#include "tenon/layer/type_names.h"

namespace tenon::layer {

Token written_type_name(Token name) {
  std::string_view scalar = name.view();
  if (scalar.ends_with("[]")) {
    scalar.remove_suffix(2);
  }
  const bool kept = scalar == "Transform" || scalar == "PointIndex" || scalar == "EdgeIndex" ||
                    scalar == "FaceIndex" || scalar == "Schema";
  const TypeName* type = kept ? nullptr : find_type_name(name);
  return type == nullptr ? name : type->name;
}

}  // namespace tenon::layer
