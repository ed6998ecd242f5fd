// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/compose/prim_index.h"
#include "tenon/layer/field_values.h"

/// What the opinions of a prim say about the kind of thing it is.
namespace tenon::stage {

/// The contents of the strongest opinion on a field that is a T; nullptr when there is none.
template <class T>
const T* strongest_opinion(const compose::PrimIndex& index, Token field) {
  for (const compose::Opinion& opinion : index.opinions()) {
    if (const T* value = opinion.spec->get<T>(field)) {
      return value;
    }
  }
  return nullptr;
}

/// The strongest def or class wins over any over; a class that comes over a direct inherit or
/// specialize arc only where nothing else defines the prim.
layer::Specifier composed_specifier(const compose::PrimIndex& index);
bool is_active(const compose::PrimIndex& index);
/// Empty when no opinion names a type.
Token composed_type_name(const compose::PrimIndex& index);
/// The combined list edits of apiSchemas.
std::vector<Token> composed_api_schemas(const compose::PrimIndex& index);

}  // namespace tenon::stage
