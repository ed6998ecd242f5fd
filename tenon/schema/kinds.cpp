// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/kinds.h"

namespace tenon::schema {

bool is_kind(Token kind, Token base) {
  static const Token model{"model"}, component{"component"}, group{"group"};
  static const Token assembly{"assembly"}, subcomponent{"subcomponent"};
  const bool known = kind == model || kind == component || kind == group || kind == assembly ||
                     kind == subcomponent;
  if (!known) {
    return false;
  }
  if (kind == base) {
    return true;
  }
  if (base == group) {
    return kind == assembly;
  }
  return base == model && kind != subcomponent;
}

}  // namespace tenon::schema
