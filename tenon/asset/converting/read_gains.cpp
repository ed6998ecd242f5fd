// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/converting/read_gains.h"

#include <optional>

#include "tenon/answers/json.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/file_bytes.h"

namespace tenon {
namespace {

using answers::Json;

/// "K,D", both numbers.
std::optional<convert::Gains> gains_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    return std::nullopt;
  }
  const auto stiffness = parse_double(text.substr(0, comma));
  const auto damping = parse_double(text.substr(comma + 1));
  if (!stiffness || !damping || !(*stiffness >= 0) || !(*damping >= 0)) {
    return std::nullopt;
  }
  return convert::Gains{*stiffness, *damping};
}

/// A JSON object: joint -> [K, D], "*" for all others.
Result<void> read_gains_file(const std::string& path, const bytes::Files& files,
                             convert::ConvertOptions& options) {
  const auto fault = [&](const std::string& message) {
    return Error(ErrorCode::Invalid, message)
        .in_file(path)
        .with_fix("write {\"joint\": [K, D], \"*\": [K, D]} in N m/rad and N m s/rad");
  };
  const auto file = files->open(path, {});
  if (!file) {
    return fault("the gains are neither two numbers K,D nor a file that can be read");
  }
  const Json json = answers::parsed((*file)->text());
  if (!json.is_object()) {
    return fault("the gains file is not a JSON object");
  }
  for (const auto& [name, pair] : json.items()) {
    const bool sound = pair.is_array() && pair.size() == 2 && pair[0].is_number() &&
                       pair[1].is_number() && pair[0].get<double>() >= 0 &&
                       pair[1].get<double>() >= 0;
    if (!sound) {
      return fault("the gains of \"" + name + "\" are not two numbers of 0 or more");
    }
    const convert::Gains gains{pair[0].get<double>(), pair[1].get<double>()};
    if (name == "*") {
      options.gains = gains;
    } else {
      options.joint_gains[name] = gains;
    }
  }
  return {};
}

}  // namespace

Result<void> read_gains(const std::string& text, const bytes::Files& files,
                        convert::ConvertOptions& options) {
  options.gains = gains_of(text);
  return options.gains ? Result<void>() : read_gains_file(text, files, options);
}

}  // namespace tenon
