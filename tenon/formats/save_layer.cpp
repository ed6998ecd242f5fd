// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/save_layer.h"

#include <vector>

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

/// Arrays that still lie in a file can be damaged or too many: nothing is written without them.
Result<void> decode_arrays(const layer::Value& value) {
  std::vector<const layer::Value*> pending{&value};
  while (!pending.empty()) {
    const layer::Value& next = *pending.back();
    pending.pop_back();
    if (next.is_deferred()) {
      TENON_CHECK(next.decoded());
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

Result<void> decode_arrays(const layer::Layer& layer) {
  for (const layer::Layer::Entry& entry : layer.entries()) {
    for (const layer::Field& field : entry.spec.fields()) {
      if (!field.value.is_deferred() && !field.value.holds<layer::TimeSamples>() &&
          !field.value.holds<layer::Dictionary>()) {
        continue;
      }
      if (const auto decoded = decode_arrays(field.value); !decoded) {
        return Error(decoded.error()).with_prim(entry.path.str());
      }
    }
  }
  return {};
}

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
    case LayerFormat::Text:
      TENON_CHECK(decode_arrays(layer));
      return encode_text(layer);
    case LayerFormat::Crate:
      return write_crate(layer);
    case LayerFormat::Package:
      break;
  }
  return write_package(layer, {});
}

Result<void> save_layer(const layer::Layer& layer, const std::string& path) {
  TENON_TRY(const LayerFormat format, layer_format_for(path));
  TENON_TRY(const std::string contents, encode_layer(layer, format));
  return bytes::write_file(path, contents);
}

}  // namespace tenon::formats
