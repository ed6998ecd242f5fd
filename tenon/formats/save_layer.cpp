// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Before a layer becomes text, arrays that still lie in a file are decoded, so that nothing is
// written without them, and what of them would be in it several times is counted. The text of a
// layer that came from a binary file is read back: not all that such files hold has a text.
#include "tenon/formats/save_layer.h"

#include <unordered_set>
#include <vector>

#include "tenon/base/limits/crate_limits.h"
#include "tenon/bytes/write/atomic_write.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/package/writer.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/plain_layer.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats {

Result<LayerFormat> layer_format_named(std::string_view name) {
  if (!name.empty() && name.front() == '.') {
    name.remove_prefix(1);
  }
  if (name == "usda") {
    return LayerFormat::Text;
  }
  if (name == "usdc" || name == "usd") {
    return LayerFormat::Crate;
  }
  if (name == "usdz") {
    return LayerFormat::Package;
  }
  return Error(ErrorCode::Invalid, "\"" + std::string(name) + "\" is not a format of layers")
      .with_fix("use usda, usdc or usdz");
}

Result<LayerFormat> layer_format_for(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return layer_format_named(dot == std::string_view::npos ? std::string_view()
                                                          : path.substr(dot + 1));
}

namespace {

/// One array: equal addresses, the same one.
struct HeldArray {
  const void* place = nullptr;
  std::uint64_t bytes = 0;
};

HeldArray held_array(const layer::Value& value) {
  using namespace layer;  // NOLINT(google-build-using-namespace): for the names in the table
  switch (value.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id)          \
  case ValueType::enumerator: {                                 \
    const auto* array = value.get<Array<type>>();               \
    return {array, value.size() * std::uint64_t{sizeof(type)}}; \
  }
#define TENON_FIELD(enumerator, type, crate_id) case ValueType::enumerator:
#include "tenon/layer/value_types.def"
    case ValueType::None:
      break;
  }
  return {};
}

/// Arrays that still lie in a file can be damaged or too many: nothing is written without them.
class FileArrays {
 public:
  Result<void> decode(const layer::Layer& layer) {
    for (const layer::Layer::Entry& entry : layer.entries()) {
      for (const layer::Field& field : entry.spec.fields()) {
        if (!field.value.is_deferred() && !field.value.holds<layer::TimeSamples>() &&
            !field.value.holds<layer::Dictionary>()) {
          continue;
        }
        if (const auto decoded = decode(field.value); !decoded) {
          return Error(decoded.error()).with_prim(entry.path.str());
        }
      }
    }
    return {};
  }

  /// That a text of those decoded is no more than it may be.
  Result<void> check_repeated(const layer::Layer& layer) const {
    const std::uint64_t most = limits::kRepeatedArrays + once_ * limits::kRepeatedArraysPerByte;
    if (repeated_ <= most) {
      return {};
    }
    return Error(ErrorCode::Limit, "as text it would repeat more than " +
                                       std::to_string(most >> 20) +
                                       " MB of arrays that the file holds once (kRepeatedArrays)")
        .in_file(layer.identifier())
        .with_rule("layer.repeated-arrays")
        .with_fix("write it as .usdc");
  }

 private:
  Result<void> decode(const layer::Value& value) {
    std::vector<const layer::Value*> pending{&value};
    while (!pending.empty()) {
      const layer::Value& next = *pending.back();
      pending.pop_back();
      if (next.is_deferred()) {
        TENON_CHECK(next.decoded());
        const HeldArray array = held_array(next);
        (met_.insert(array.place).second ? once_ : repeated_) += array.bytes;
      } else if (const auto* samples = next.get<layer::TimeSamples>()) {
        for (const layer::Value& sample : samples->values) {
          pending.push_back(&sample);
        }
      } else if (const auto* dictionary = next.get<layer::Dictionary>()) {
        for (const auto& [key, item] : dictionary->items) {
          pending.push_back(&item);
        }
      }
    }
    return {};
  }

  std::unordered_set<const void*> met_;
  std::uint64_t once_ = 0;      // bytes of the arrays
  std::uint64_t repeated_ = 0;  // of those that were met before
};

/// The text of a layer that is not from text is read back: what that one holds need not have a
/// text.
Result<std::string> encode_text(const layer::Layer& layer) {
  std::string text = write_text(layer);
  if (layer.may_lack_text() && !text::has_plain_text(layer)) {
    Diagnostics ignored;
    const auto again = read_text(text, layer.identifier(), ignored);
    if (!again) {
      const Diagnostic& fault = again.error().diagnostic();
      return Error(ErrorCode::Unsupported,
                   "this layer has no text form that can be read back: " + fault.message)
          .in_file(layer.identifier())
          .with_prim(fault.prim)
          .with_fix("write it as .usdc, or fix what the message names");
    }
  }
  return text;
}

}  // namespace

Result<std::string> encode_layer(const layer::Layer& layer, LayerFormat format) {
  switch (format) {
    case LayerFormat::Text: {
      FileArrays arrays;
      TENON_CHECK(arrays.decode(layer));
      TENON_CHECK(arrays.check_repeated(layer));
      return encode_text(layer);
    }
    case LayerFormat::Crate:
      return write_crate(layer);
    case LayerFormat::Package:
      break;
  }
  return write_package(layer, {});
}

Result<void> check_repeated_arrays(const layer::Layer& layer) {
  FileArrays arrays;
  const auto decoded = arrays.decode(layer);
  return decoded ? arrays.check_repeated(layer) : Result<void>();
}

Result<void> save_layer(const layer::Layer& layer, const std::string& path) {
  TENON_TRY(const LayerFormat format, layer_format_for(path));
  TENON_TRY(const std::string contents, encode_layer(layer, format));
  return bytes::write_file(path, contents);
}

}  // namespace tenon::formats
