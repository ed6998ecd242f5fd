// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/formats/crate/array_reader.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/tables.h"
#include "tenon/formats/crate/work_budget.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::crate {

/// False for values that are read without the table of paths.
bool may_hold_paths(ValueWord word);

/// Decodes the values of one file.
class ValueReader {
 public:
  ValueReader(const Tables& tables, WorkBudget& budget, Diagnostics& diagnostics)
      : tables_(tables), file_(*tables.file), budget_(budget), diagnostics_(diagnostics) {}

  /// The value that `word` is or points at. An empty value, with a diagnostic, where this program
  /// has no type for it.
  Result<layer::Value> read(ValueWord word);

 private:
  // One item at the cursor; the overloads are the storage forms of the format.
  Result<void> item(bytes::ByteReader& in, std::int32_t& out);
  Result<void> item(bytes::ByteReader& in, std::uint32_t& out);
  Result<void> item(bytes::ByteReader& in, std::int64_t& out);
  Result<void> item(bytes::ByteReader& in, std::uint64_t& out);
  Result<void> item(bytes::ByteReader& in, double& out);
  Result<void> item(bytes::ByteReader& in, std::string& out);
  Result<void> item(bytes::ByteReader& in, Token& out);
  Result<void> item(bytes::ByteReader& in, Path& out);
  Result<void> item(bytes::ByteReader& in, layer::LayerOffset& out);
  Result<void> item(bytes::ByteReader& in, layer::Reference& out);
  Result<void> item(bytes::ByteReader& in, layer::Payload& out);
  Result<void> item(bytes::ByteReader& in, layer::UnregisteredValue& out);
  Result<void> item(bytes::ByteReader& in, layer::Value& out);
  Result<void> item(bytes::ByteReader& in, std::pair<Path, Path>& out);
  template <class T>
  Result<void> item(bytes::ByteReader& in, std::vector<T>& out);
  template <class T>
  Result<void> item(bytes::ByteReader& in, layer::ListOp<T>& out);
  Result<void> item(bytes::ByteReader& in, layer::Dictionary& out);
  Result<void> item(bytes::ByteReader& in, layer::VariantSelections& out);
  Result<void> item(bytes::ByteReader& in, layer::Relocates& out);
  Result<void> item(bytes::ByteReader& in, layer::TimeSamples& out);
  Result<void> item(bytes::ByteReader& in, layer::Spline& out);
  Result<void> item(bytes::ByteReader& in, layer::TimeCode& out);
  Result<void> item(bytes::ByteReader& in, layer::Duration& out);
  Result<void> item(bytes::ByteReader& in, layer::PathExpression& out);

  template <class T>
  Result<layer::Value> single(ValueWord word);
  template <class T>
  Result<layer::Value> stored(ValueWord word);
  template <class T>
  Result<layer::Value> inlined(std::uint32_t bits);
  Result<layer::Value> text(std::uint32_t index);
  Result<void> pay_for_text(std::uint32_t token, std::size_t size);
  Result<layer::Value> other(ValueWord word);
  Result<layer::Value> unsupported(ValueWord word, const char* what);
  Result<std::vector<double>> times(ValueWord word);
  Result<layer::Value> array(layer::ValueType element, ValueWord word);
  Result<layer::Value> array_edit(layer::ValueType element, ValueWord word);

  const Tables& tables_;
  const CrateFile& file_;
  WorkBudget& budget_;
  Diagnostics& diagnostics_;
  std::size_t depth_ = 0;
  std::map<std::uint64_t, std::vector<double>> times_;      // by the word that names them
  std::unordered_map<std::uint64_t, layer::Value> arrays_;  // the same, deferred ones
  std::unordered_map<std::uint32_t, layer::Value> texts_;   // long ones, by their string
  std::unordered_set<std::uint32_t> copied_;                // tokens whose long text was copied
};

}  // namespace tenon::formats::crate
