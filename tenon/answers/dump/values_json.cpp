// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/values_json.h"

#include <optional>
#include <sstream>

#include "tenon/answers/dump/json_writer.h"
#include "tenon/answers/dump/layer_json.h"
#include "tenon/base/text/text_number.h"

namespace tenon::answers {
namespace {

Result<stage::Time> parse_time(const std::string& text) {
  if (text == "default") {
    return stage::Time();
  }
  const std::optional<double> code = parse_double(text);
  if (!code) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" is neither a time code nor \"default\"");
  }
  return stage::Time(*code);
}

}  // namespace

Result<std::string> values_at_times(const stage::Attribute& attribute,
                                    const std::vector<std::string>& times) {
  std::ostringstream out;
  {
    JsonWriter json(out);
    json.begin_object();
    for (const std::string& text : times) {
      TENON_TRY(const stage::Time time, parse_time(text));
      json.key(text);
      write_plain_value(json, attribute.get(time));
    }
    json.end_object();
  }
  return out.str();
}

}  // namespace tenon::answers
