// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/tables.h"
#include "tenon/formats/crate/work_budget.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::crate {

class ValueReader;

/// Decodes the parts of values that are stored at an offset.
class ItemReader {
 public:
  ItemReader(const Tables& tables, WorkBudget& budget, ValueReader& values)
      : tables_(tables), file_(*tables.file), budget_(budget), values_(values) {}

  /// One item at the cursor, which moves behind it; the overloads are the storage forms of the
  /// format. Errors: Corrupt, and Limit where values are nested too deeply.
  Result<void> read(bytes::ByteReader& in, std::int32_t& out);
  Result<void> read(bytes::ByteReader& in, std::uint32_t& out);
  Result<void> read(bytes::ByteReader& in, std::int64_t& out);
  Result<void> read(bytes::ByteReader& in, std::uint64_t& out);
  Result<void> read(bytes::ByteReader& in, double& out);
  Result<void> read(bytes::ByteReader& in, std::string& out);
  Result<void> read(bytes::ByteReader& in, Token& out);
  Result<void> read(bytes::ByteReader& in, Path& out);
  Result<void> read(bytes::ByteReader& in, layer::LayerOffset& out);
  Result<void> read(bytes::ByteReader& in, layer::Reference& out);
  Result<void> read(bytes::ByteReader& in, layer::Payload& out);
  Result<void> read(bytes::ByteReader& in, layer::UnregisteredValue& out);
  Result<void> read(bytes::ByteReader& in, layer::Value& out);
  Result<void> read(bytes::ByteReader& in, std::pair<Path, Path>& out);
  template <class T>
  Result<void> read(bytes::ByteReader& in, std::vector<T>& out);
  template <class T>
  Result<void> read(bytes::ByteReader& in, layer::ListOp<T>& out);
  Result<void> read(bytes::ByteReader& in, layer::Dictionary& out);
  Result<void> read(bytes::ByteReader& in, layer::VariantSelections& out);
  Result<void> read(bytes::ByteReader& in, layer::Relocates& out);
  Result<void> read(bytes::ByteReader& in, layer::TimeSamples& out);
  Result<void> read(bytes::ByteReader& in, layer::Spline& out);
  Result<void> read(bytes::ByteReader& in, layer::TimeCode& out);
  Result<void> read(bytes::ByteReader& in, layer::Duration& out);
  Result<void> read(bytes::ByteReader& in, layer::PathExpression& out);

  /// For a copy of the text of a token, of so many bytes. Errors: Limit.
  Result<void> pay_for_text(std::uint32_t token, std::size_t size);

 private:
  Result<layer::Value> nested(ValueWord word);
  Result<std::vector<double>> times(ValueWord word);

  const Tables& tables_;
  const CrateFile& file_;
  WorkBudget& budget_;
  ValueReader& values_;
  std::size_t depth_ = 0;
  std::map<std::uint64_t, std::vector<double>> times_;  // by the word that names them
  std::unordered_set<std::uint32_t> copied_;            // tokens whose long text was copied
};

}  // namespace tenon::formats::crate
