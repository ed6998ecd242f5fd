// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// How the parts of values lie at an offset. A value within a value has the distance to its word in
// front, because its own data stand between.
#include "tenon/formats/crate/value_items.h"

#include <cmath>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/crate/spline_codec.h"
#include "tenon/formats/crate/value_reader.h"
#include "tenon/layer/expressions/path_expression.h"

namespace tenon::formats::crate {
namespace {

template <class T>
Result<void> read_plain(bytes::ByteReader& in, T& out) {
  TENON_TRY(out, in.read<T>());
  return {};
}

/// Moves over a distance that is counted from its own place.
Result<void> skip_distance(bytes::ByteReader& in) {
  const auto start = static_cast<std::int64_t>(in.offset());
  TENON_TRY(const std::int64_t distance, in.read<std::int64_t>());
  const auto size = static_cast<std::int64_t>(in.size());
  if (distance < -start || distance > size - start) {
    return corrupt("a nested value reaches beyond the end of the file");
  }
  return in.seek(static_cast<std::uint64_t>(start + distance));
}

}  // namespace

/// A value within a value.
Result<layer::Value> ItemReader::nested(ValueWord word) {
  if (depth_ == limits::kCrateValueDepth) {
    return Error(ErrorCode::Limit, "values are nested too deeply").with_rule("crate.too-much");
  }
  ++depth_;
  Result<layer::Value> value = values_.read(word);
  --depth_;
  return value;
}

/// Copies of one text cost its size, except the first.
Result<void> ItemReader::pay_for_text(std::uint32_t token, std::size_t size) {
  const bool is_first = size > limits::kCrateBytesPerUnit && copied_.insert(token).second;
  return is_first ? budget_.spend(1) : budget_.spend_bytes(size);
}

Result<void> ItemReader::read(bytes::ByteReader& in, std::int32_t& out) {
  return read_plain(in, out);
}
Result<void> ItemReader::read(bytes::ByteReader& in, std::uint32_t& out) {
  return read_plain(in, out);
}
Result<void> ItemReader::read(bytes::ByteReader& in, std::int64_t& out) {
  return read_plain(in, out);
}
Result<void> ItemReader::read(bytes::ByteReader& in, std::uint64_t& out) {
  return read_plain(in, out);
}
Result<void> ItemReader::read(bytes::ByteReader& in, double& out) { return read_plain(in, out); }
Result<void> ItemReader::read(bytes::ByteReader& in, layer::TimeCode& out) {
  return read_plain(in, out.value);
}
Result<void> ItemReader::read(bytes::ByteReader& in, layer::Duration& out) {
  return read_plain(in, out.value);
}

Result<void> ItemReader::read(bytes::ByteReader& in, std::string& out) {
  TENON_TRY(const std::uint32_t index, in.read<std::uint32_t>());
  TENON_TRY(const std::string_view text, string_at(file_, index));
  TENON_CHECK(pay_for_text(file_.strings[index], text.size()));
  out = text;
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, Token& out) {
  TENON_TRY(const std::uint32_t index, in.read<std::uint32_t>());
  TENON_TRY(out, token_at(file_, index));
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, Path& out) {
  TENON_TRY(const std::uint32_t index, in.read<std::uint32_t>());
  if (index >= tables_.paths.size()) {
    return corrupt("a value names a path that is not there");
  }
  out = tables_.paths[index];
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::PathExpression& out) {
  TENON_CHECK(read(in, out.text));
  layer::Value value(std::move(out));
  layer::make_canonical(value);
  out = *value.get<layer::PathExpression>();
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::LayerOffset& out) {
  TENON_CHECK(read(in, out.offset));
  return read(in, out.scale);
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::Reference& out) {
  TENON_CHECK(read(in, out.asset_path));
  TENON_CHECK(read(in, out.prim_path));
  TENON_CHECK(read(in, out.offset));
  return read(in, out.custom_data);
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::Payload& out) {
  TENON_CHECK(read(in, out.asset_path));
  TENON_CHECK(read(in, out.prim_path));
  return file_.version >= kPayloadOffsets ? read(in, out.offset) : Result<void>();
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::UnregisteredValue& out) {
  TENON_CHECK(read(in, out.value));
  const bool known = out.value.holds<std::string>() || out.value.holds<layer::Dictionary>() ||
                     out.value.holds<layer::ListOp<layer::UnregisteredValue>>();
  return known ? Result<void>() : corrupt("an unknown field holds a value of a wrong type");
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::Value& out) {
  TENON_CHECK(budget_.spend(1));
  TENON_CHECK(skip_distance(in));
  TENON_TRY(const ValueWord word, in.read<ValueWord>());
  TENON_TRY(out, nested(word));
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, std::pair<Path, Path>& out) {
  TENON_CHECK(read(in, out.first));
  return read(in, out.second);
}

template <class T>
Result<void> ItemReader::read(bytes::ByteReader& in, std::vector<T>& out) {
  constexpr std::uint64_t kSmallestItem = 4;  // an index
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  if (count > in.remaining() / kSmallestItem) {
    return bytes::out_of_bounds(in.offset(), count, in.size());
  }
  TENON_CHECK(budget_.spend(count));
  out.clear();
  out.reserve(static_cast<std::size_t>(count));
  for (std::uint64_t i = 0; i < count; ++i) {
    TENON_CHECK(read(in, out.emplace_back()));
  }
  return {};
}
template Result<void> ItemReader::read(bytes::ByteReader&, std::vector<Token>&);
template Result<void> ItemReader::read(bytes::ByteReader&, std::vector<double>&);
template Result<void> ItemReader::read(bytes::ByteReader&, std::vector<std::string>&);
template Result<void> ItemReader::read(bytes::ByteReader&, std::vector<Path>&);
template Result<void> ItemReader::read(bytes::ByteReader&, std::vector<layer::LayerOffset>&);

template <class T>
Result<void> ItemReader::read(bytes::ByteReader& in, layer::ListOp<T>& out) {
  TENON_TRY(const std::uint8_t bits, in.read<std::uint8_t>());
  out.is_explicit = (bits & list_bits::kExplicit) != 0;
  const std::pair<std::uint8_t, std::vector<T>*> lists[] = {
      {list_bits::kExplicitItems, &out.explicit_items},
      {list_bits::kAdded, &out.added},
      {list_bits::kPrepended, &out.prepended},
      {list_bits::kAppended, &out.appended},
      {list_bits::kDeleted, &out.deleted},
      {list_bits::kOrdered, &out.ordered},
  };
  for (const auto& [bit, list] : lists) {
    if ((bits & bit) != 0) {
      TENON_CHECK(read(in, *list));
    }
  }
  return {};
}
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<Token>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<std::string>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<Path>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<layer::Reference>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<layer::Payload>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<std::int32_t>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<std::int64_t>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<std::uint32_t>&);
template Result<void> ItemReader::read(bytes::ByteReader&, layer::ListOp<std::uint64_t>&);
template Result<void> ItemReader::read(bytes::ByteReader&,
                                       layer::ListOp<layer::UnregisteredValue>&);

Result<void> ItemReader::read(bytes::ByteReader& in, layer::Dictionary& out) {
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  for (std::uint64_t i = 0; i < count; ++i) {
    std::string key;
    layer::Value value;
    TENON_CHECK(read(in, key));
    TENON_CHECK(read(in, value));
    if (!value.empty()) {
      out.items.insert_or_assign(std::move(key), std::move(value));
    }
  }
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::VariantSelections& out) {
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  for (std::uint64_t i = 0; i < count; ++i) {
    std::string set;
    std::string variant;
    TENON_CHECK(read(in, set));
    TENON_CHECK(read(in, variant));
    TENON_CHECK(budget_.spend(1));
    out.items.insert_or_assign(std::move(set), std::move(variant));
  }
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::Relocates& out) {
  return read(in, out.pairs);
}

/// The times that `word` names; files share them between attributes.
Result<std::vector<double>> ItemReader::times(ValueWord word) {
  const auto known = times_.find(word.bits);
  if (known != times_.end()) {
    TENON_CHECK(budget_.spend(known->second.size()));
    return known->second;
  }
  TENON_TRY(const layer::Value value, values_.read(word));
  const auto* numbers = value.get<layer::Array<double>>();
  if (numbers == nullptr) {
    return corrupt("the times of samples are not a list of numbers");
  }
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    const bool ascends = i == 0 || (*numbers)[i - 1] < (*numbers)[i];
    if (std::isnan((*numbers)[i]) || !ascends) {
      return corrupt("the times of samples do not ascend");
    }
  }
  TENON_CHECK(budget_.spend(numbers->size()));
  const std::vector<double> times(numbers->begin(), numbers->end());
  times_.emplace(word.bits, times);
  return times;
}

namespace {

/// Samples whose values could not be read are skipped, as the finding about them says.
void drop_empty(layer::TimeSamples& samples) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    if (samples.values[i].empty()) {
      continue;
    }
    if (kept != i) {
      samples.times[kept] = samples.times[i];
      samples.values[kept] = std::move(samples.values[i]);
    }
    ++kept;
  }
  samples.times.resize(kept);
  samples.values.resize(kept);
}

}  // namespace

Result<void> ItemReader::read(bytes::ByteReader& in, layer::TimeSamples& out) {
  TENON_CHECK(skip_distance(in));
  TENON_TRY(const ValueWord times_word, in.read<ValueWord>());
  TENON_TRY(out.times, times(times_word));
  TENON_CHECK(skip_distance(in));
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  TENON_TRY(const std::vector<ValueWord> words, in.read_array<ValueWord>(count));
  if (words.size() != out.times.size()) {
    return corrupt("there are " + std::to_string(out.times.size()) + " times for " +
                   std::to_string(words.size()) + " samples");
  }
  TENON_CHECK(budget_.spend(count));
  out.values.reserve(words.size());
  for (const ValueWord word : words) {
    TENON_TRY(layer::Value value, nested(word));
    out.values.push_back(std::move(value));
  }
  drop_empty(out);
  return {};
}

Result<void> ItemReader::read(bytes::ByteReader& in, layer::Spline& out) {
  TENON_TRY(const std::uint64_t size, in.read<std::uint64_t>());
  TENON_TRY(const auto data, in.take(size));
  TENON_CHECK(budget_.spend_bytes(size));
  TENON_TRY(out, decode_spline(data));
  TENON_TRY(const std::uint64_t count, in.read<std::uint64_t>());
  for (std::uint64_t i = 0; i < count; ++i) {
    TENON_TRY(const double time, in.read<double>());
    layer::Dictionary custom_data;
    TENON_CHECK(read(in, custom_data));
    TENON_CHECK(budget_.spend(1));
    for (layer::SplineKnot& knot : out.knots) {
      if (knot.time == time) {
        knot.custom_data = std::move(custom_data);
        break;
      }
    }
  }
  return {};
}

}  // namespace tenon::formats::crate
