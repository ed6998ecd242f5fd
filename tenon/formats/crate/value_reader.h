// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "tenon/base/diagnostics.h"
#include "tenon/formats/crate/array_reader.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/tables.h"
#include "tenon/formats/crate/value_items.h"
#include "tenon/formats/crate/work_budget.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::crate {

/// False for values that are read without the table of paths.
bool may_hold_paths(ValueWord word);

/// Decodes the values of one file.
class ValueReader {
 public:
  ValueReader(const Tables& tables, WorkBudget& budget, Diagnostics& diagnostics)
      : tables_(tables),
        file_(*tables.file),
        budget_(budget),
        diagnostics_(diagnostics),
        items_(tables, budget, *this) {}

  ValueReader(const ValueReader&) = delete;
  ValueReader& operator=(const ValueReader&) = delete;

  /// The value that `word` is or points at. An empty value, with a diagnostic, where this program
  /// has no type for it.
  Result<layer::Value> read(ValueWord word);

 private:
  template <class T>
  Result<layer::Value> single(ValueWord word);
  template <class T>
  Result<layer::Value> stored(ValueWord word);
  template <class T>
  Result<layer::Value> inlined(std::uint32_t bits);
  Result<layer::Value> text(std::uint32_t index);
  Result<layer::Value> other(ValueWord word);
  Result<layer::Value> unsupported(ValueWord word, const char* what);
  Result<layer::Value> array(layer::ValueType element, ValueWord word);
  Result<layer::Value> array_edit(layer::ValueType element, ValueWord word);

  const Tables& tables_;
  const CrateFile& file_;
  WorkBudget& budget_;
  Diagnostics& diagnostics_;
  ItemReader items_;
  std::unordered_map<std::uint64_t, layer::Value> arrays_;  // deferred ones, by their word
  std::unordered_map<std::uint32_t, layer::Value> texts_;   // long ones, by their string
};

}  // namespace tenon::formats::crate
