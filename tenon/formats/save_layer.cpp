// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/save_layer.h"

#include "tenon/bytes/atomic_write.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/package/writer.h"
#include "tenon/formats/text/writer.h"

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
  return Error(ErrorCode::Invalid, "\"" + std::string(name) + "\" is no format of layers")
      .with_fix("use usda, usdc or usdz");
}

Result<LayerFormat> layer_format_for(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return layer_format_named(dot == std::string_view::npos ? std::string_view()
                                                          : path.substr(dot + 1));
}

Result<std::string> encode_layer(const layer::Layer& layer, LayerFormat format) {
  switch (format) {
    case LayerFormat::Text:
      return write_text(layer);
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
