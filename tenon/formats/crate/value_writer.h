// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/row_index.h"
#include "tenon/formats/crate/table_writer.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::crate {

/// Puts values into a file: as their own word where they fit, else once at an offset, however often
/// they occur.
class ValueWriter {
 public:
  ValueWriter(bytes::ByteWriter& out, TableWriter& tables) : out_(out), tables_(tables) {}

  /// The word of a field's value. Some fields hold lists of tokens or strings that the format
  /// tells from arrays; `field` decides.
  Result<ValueWord> write(Token field, const layer::Value& value);
  Result<ValueWord> write(const layer::Value& value);

  /// The lowest version of files that can hold what was written.
  Version needed() const { return needed_; }

 private:
  // Appends one item in its storage form; the counterparts of ItemReader::read.
  template <class T>
  Result<void> item(bytes::ByteWriter& to, const T& value);
  template <class T>
  Result<void> item(bytes::ByteWriter& to, const std::vector<T>& values);
  template <class T>
  Result<void> item(bytes::ByteWriter& to, const layer::ListOp<T>& edit);
  template <class A, class B>
  Result<void> item(bytes::ByteWriter& to, const std::pair<A, B>& pair);
  Result<void> samples(bytes::ByteWriter& to, const layer::TimeSamples& samples);
  Result<void> curve(bytes::ByteWriter& to, const layer::Spline& spline);

  template <class T>
  Result<ValueWord> single(unsigned type, const T& value);
  template <class T>
  ValueWord array(unsigned type, const layer::Array<T>& array);
  ValueWord array_edit(const layer::ArrayEdit& edit);
  template <class T>
  Result<ValueWord> stored(unsigned type, const T& value);
  /// Writes `data` unless equal data of the type stand somewhere already; where they stand.
  std::uint64_t place(std::string_view data, std::size_t alignment);
  void need(Version version) { needed_ = std::max(needed_, version); }

  bytes::ByteWriter& out_;
  TableWriter& tables_;
  Version needed_ = kPayloadOffsets;
  struct Placed {
    std::uint64_t offset;
    std::size_t size;
  };
  std::vector<Placed> placed_;
  RowIndex placed_index_;  // by the data
};

}  // namespace tenon::formats::crate
