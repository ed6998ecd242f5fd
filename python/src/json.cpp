// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "json.h"

#include "failure.h"

namespace tenon::python {

using answers::Json;

// Answers are as deep as the code that makes them; nothing of an input nests them.
nb::object to_python(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return nb::bool_(json.get<bool>());
    case Json::value_t::number_integer:
      return nb::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return nb::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float:
      return nb::float_(json.get<double>());
    case Json::value_t::string:
      return message(json.get_ref<const std::string&>());
    case Json::value_t::array: {
      nb::list items;
      for (const Json& item : json) {
        items.append(to_python(item));
      }
      return items;
    }
    case Json::value_t::object: {
      nb::dict items;
      for (const auto& [key, item] : json.items()) {
        items[message(key)] = to_python(item);
      }
      return items;
    }
    default:
      return nb::none();
  }
}

}  // namespace tenon::python
