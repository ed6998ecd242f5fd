// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/spec_equality.h"

namespace tenon::layer {

bool same_spec(const Spec& a, const Spec& b) {
  if (a.kind != b.kind || a.fields().size() != b.fields().size()) {
    return false;
  }
  for (const Field& field : a.fields()) {
    const Value* other = b.find(field.name);
    if (other == nullptr || !(*other == field.value)) {
      return false;
    }
  }
  return true;
}

}  // namespace tenon::layer
