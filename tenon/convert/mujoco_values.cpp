// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/mujoco_values.h"

namespace tenon::convert {

using layer::Value;

void write_range(LayerBuilder& builder, Path prim, const char* type, const std::string& name,
                 const char* limited, const std::optional<std::array<double, 2>>& range) {
  if (range) {
    builder.set_value(prim, type, limited, Value(Token("true")));
    builder.set_number(prim, type, name + ":max", (*range)[1]);
    builder.set_number(prim, type, name + ":min", (*range)[0]);
  }
}

void write_settings(LayerBuilder& builder, Path prim, const char* schema,
                    const std::vector<robot::MujocoSetting>& settings) {
  for (const robot::MujocoSetting& setting : settings) {
    const std::string name = "mjc:" + setting.name;
    if (setting.token.empty()) {
      builder.set_numbers(prim, schema, name, setting.numbers);
    } else {
      builder.set_value(prim, schema, name, Value(Token(setting.token)));
    }
  }
}

}  // namespace tenon::convert
