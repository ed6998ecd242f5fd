// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/list_op_json.h"

#include <array>
#include <utility>
#include <vector>

#include "tenon/layer/lists/fold_list_ops.h"

namespace tenon::answers {
namespace {

using layer::ListOp;

template <class T>
using Member = std::pair<const char*, std::vector<T> ListOp<T>::*>;

template <class T>
constexpr std::array<Member<T>, 5> kEdits{{{"deleted_items", &ListOp<T>::deleted},
                                           {"added_items", &ListOp<T>::added},
                                           {"prepended_items", &ListOp<T>::prepended},
                                           {"appended_items", &ListOp<T>::appended},
                                           {"ordered_items", &ListOp<T>::ordered}}};
constexpr const char* kExplicit = "explicit_items";

template <class T>
ListOp<T> list_op_from(const Json& json) {
  if (json.contains(kExplicit)) {
    return ListOp<T>::make_explicit(json[kExplicit].template get<std::vector<T>>());
  }
  ListOp<T> op;
  for (const auto& [name, member] : kEdits<T>) {
    if (json.contains(name)) {
      op.*member = json[name].template get<std::vector<T>>();
    }
  }
  return op;
}

template <class T>
Json json_from(const ListOp<T>& op) {
  Json json = Json::object();
  if (op.is_explicit) {
    json[kExplicit] = op.explicit_items;
  }
  for (const auto& [name, member] : kEdits<T>) {
    if (!(op.*member).empty()) {
      json[name] = op.*member;
    }
  }
  return json;
}

template <class T>
Result<Json> fold_chain(const Json& chain) {
  ListOp<T> folded;
  for (auto op = chain.rbegin(); op != chain.rend(); ++op) {
    std::optional<ListOp<T>> reduced = layer::fold(list_op_from<T>(*op), {});
    reduced = reduced ? layer::fold(*reduced, folded) : reduced;
    if (!reduced) {
      return Error(ErrorCode::Unsupported,
                   "added and ordered items depend on the list they are applied to: no single "
                   "edit does the same as this chain");
    }
    folded = std::move(*reduced);
  }
  return json_from(folded);
}

/// All members are arrays of integers, or all of strings; nullptr when they are neither.
const char* item_type(const Json& chain) {
  bool integers = true;
  bool strings = true;
  for (const Json& op : chain) {
    if (!op.is_object()) {
      return nullptr;
    }
    for (const auto& [name, items] : op.items()) {
      if (!items.is_array()) {
        return nullptr;
      }
      for (const Json& item : items) {
        integers = integers && item.is_number_integer();
        strings = strings && item.is_string();
      }
    }
  }
  return integers ? "integer" : strings ? "string" : nullptr;
}

}  // namespace

Result<Json> fold_list_ops(const std::string& text) {
  const Json json = parsed(text);
  const Json chain = json.is_object() && json.contains("chain") ? json["chain"] : json;
  const char* type = chain.is_array() ? item_type(chain) : nullptr;
  if (type == nullptr) {
    return Error(ErrorCode::Parse,
                 "expected a JSON array of list edits, such as "
                 "[{\"appended_items\": [1]}, {\"explicit_items\": [2, 3]}]");
  }
  return type == std::string_view("integer") ? fold_chain<std::int64_t>(chain)
                                             : fold_chain<std::string>(chain);
}

}  // namespace tenon::answers
