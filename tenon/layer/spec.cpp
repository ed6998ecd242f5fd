// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/spec.h"

namespace tenon::layer {

void Spec::set(Token name, Value value) {
  if (!has(name)) {
    fields_.append(name, std::move(value));
    return;
  }
  for (Field& field : fields_.own_items()) {
    if (field.name == name) {
      field.value = std::move(value);
      return;
    }
  }
}

}  // namespace tenon::layer
