// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A layer from a binary file may hold what no text can say, and its text is read back to find out
// (save_layer.cpp). This check spares that: it accepts only forms that surely can be read back, so
// each test is sufficient and none has to be exact. A wrong "no" costs one reading, a wrong "yes"
// would let a text be written that nobody can read. The answers about type names are kept in a
// small table by hash, because a layer repeats few of them.
#include "tenon/formats/text/write/plain_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/words.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/metadata_fields.h"
#include "tenon/layer/type_names.h"

namespace tenon::formats::text {
namespace {

using layer::SpecKind;
using layer::Value;
using layer::ValueType;
namespace fields = layer::fields;

constexpr int kDepth = 32;  // of dictionaries
/// Of prims, with their metadata inside; binary layers may have more than text may.
constexpr std::size_t kLevels = limits::kTextNestingDepth - std::size_t{2} * kDepth;

template <class T>
bool are_unique(const std::vector<T>& items) {
  constexpr std::size_t kFew = 8;  // compared with each other
  if (items.size() > kFew) {
    std::vector<T> sorted = items;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    if (std::find(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i), items[i]) !=
        items.begin() + static_cast<std::ptrdiff_t>(i)) {
      return false;
    }
  }
  return true;
}

template <class T, class IsPlain>
bool is_plain_list(const layer::ListOp<T>& op, const IsPlain& is_plain) {
  for (const auto* items :
       {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added, &op.ordered}) {
    if (!are_unique(*items) || !std::all_of(items->begin(), items->end(), is_plain)) {
      return false;
    }
  }
  return true;
}

bool is_plain_target(Path path) {
  const Path prim = path.is_property() ? path.parent() : path;
  return path.is_absolute() && prim.is_prim() && !prim.has_variants();
}

bool is_plain_asset(const Value& value) {
  const auto* asset = value.get<layer::AssetPath>();
  return asset != nullptr && std::all_of(asset->authored.begin(), asset->authored.end(),
                                         [](char c) { return c >= ' ' && c <= '~' && c != '@'; });
}

/// Of a type that has a name; numbers and strings of any contents have a text.
bool is_plain_value(const Value& value) {
  return value.type() == ValueType::Asset ? is_plain_asset(value)
                                          : value.type() != ValueType::PathExpression;
}

bool is_plain_dictionary(const layer::Dictionary& dictionary, int depth) {
  return depth < kDepth &&
         std::all_of(
             dictionary.items.begin(), dictionary.items.end(),
             [&](const auto& item) {
               const Value& value = item.second;
               if (const auto* inner = value.template get<layer::Dictionary>()) {
                 return is_plain_dictionary(*inner, depth + 1);
               }
               return layer::type_name_of(value.type(), value.is_array()) != nullptr &&
                      is_plain_value(value);
             });
}

bool is_plain_word(std::string_view word) {
  return is_identifier(word) && !is_reserved_word(word) &&
         std::all_of(word.begin(), word.end(), [](char c) { return (c & '\x80') == 0; });
}

bool is_plain_metadata(const layer::Field& field, SpecKind kind) {
  if (field.name == fields::comment) {
    return field.value.holds<std::string>();
  }
  if (!layer::is_value_of_metadata(field.name, kind, field.value) ||
      field.name == fields::symmetryFunction || field.name == fields::displayUnit ||
      field.name == fields::framesPerSecond || field.name == fields::prefixSubstitutions ||
      field.name == fields::suffixSubstitutions) {
    return false;
  }
  if (const auto* dictionary = field.value.get<layer::Dictionary>()) {
    return is_plain_dictionary(*dictionary, 0);
  }
  if (const auto* tokens = field.value.get<layer::ListOp<Token>>()) {
    return is_plain_list(*tokens, [](Token) { return true; });
  }
  return layer::type_name_of(field.value.type(), field.value.is_array()) != nullptr &&
         is_plain_value(field.value);
}

bool is_of_type(const Value& value, const layer::TypeName* type) {
  return value.holds<layer::ValueBlock>() ||
         (type != nullptr && value.type() == type->type && value.is_array() == type->is_array &&
          is_plain_value(value));
}

bool are_plain_samples(const layer::TimeSamples& samples, const layer::TypeName* type) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool ascends = i == 0 || samples.times[i - 1] < samples.times[i];
    if (!ascends || !std::isfinite(samples.times[i]) || !is_of_type(samples.values[i], type)) {
      return false;
    }
  }
  return true;
}

/// What was found out about words met before: a layer has few.
class Memory {
 public:
  const layer::TypeName* type_named(Token name) {
    auto& [known, type] = types_[std::hash<Token>()(name) / alignof(std::max_align_t) % kTypes];
    if (name != known) {
      known = name;
      type = layer::find_type_name(name);
    }
    return type;
  }
  bool is_prim_type(Token name) {
    if (name != prim_type_) {
      prim_type_ = name;
      is_prim_type_ = name.empty() || is_plain_word(name.view());
    }
    return is_prim_type_;
  }

 private:
  static constexpr std::size_t kTypes = 32;

  std::array<std::pair<Token, const layer::TypeName*>, kTypes> types_{};
  Token prim_type_;
  bool is_prim_type_ = true;
};

bool is_plain_attribute(const layer::Spec& spec, Memory& memory) {
  const layer::TypeName* const type = memory.type_named(spec.get_or(fields::typeName, Token()));
  for (const layer::Field& field : spec.fields()) {
    bool plain = false;
    if (field.name == fields::typeName) {
      plain = type != nullptr;
    } else if (field.name == fields::default_value) {
      plain = is_of_type(field.value, type);
    } else if (const auto* samples = field.value.get<layer::TimeSamples>()) {
      plain = field.name == fields::timeSamples && are_plain_samples(*samples, type);
    } else if (field.name == fields::variability) {
      plain = field.value.holds<layer::Variability>();
    } else if (field.name == fields::custom) {
      plain = field.value.holds<bool>();
    } else if (const auto* targets = field.value.get<layer::ListOp<Path>>()) {
      plain = field.name == fields::connectionPaths && is_plain_list(*targets, is_plain_target);
    } else {
      plain = is_plain_metadata(field, spec.kind);
    }
    if (!plain) {
      return false;
    }
  }
  return type != nullptr;
}

bool is_plain_relationship(const layer::Spec& spec) {
  const auto& all = spec.fields();
  return std::all_of(all.begin(), all.end(), [&](const layer::Field& field) {
    if (const auto* targets = field.value.get<layer::ListOp<Path>>()) {
      return field.name == fields::targetPaths && is_plain_list(*targets, is_plain_target);
    }
    return field.name == fields::variability ? field.value.holds<layer::Variability>()
           : field.name == fields::custom    ? field.value.holds<bool>()
                                             : is_plain_metadata(field, spec.kind);
  });
}

/// A prim, or the layer itself.
bool is_plain_prim(const layer::Spec& spec, Memory& memory) {
  const bool is_prim = spec.kind == SpecKind::Prim;
  const auto& all = spec.fields();
  return std::all_of(all.begin(), all.end(), [&](const layer::Field& field) {
    if (const auto* names = field.value.get<std::vector<Token>>()) {
      const bool is_list =
          field.name == fields::primChildren || (is_prim && field.name == fields::properties);
      return is_list && are_unique(*names);
    }
    if (is_prim && field.name == fields::specifier) {
      return field.value.holds<layer::Specifier>();
    }
    if (is_prim && field.name == fields::typeName) {
      const auto* type = field.value.get<Token>();
      return type != nullptr && memory.is_prim_type(*type);
    }
    return is_plain_metadata(field, spec.kind);
  });
}

}  // namespace

bool has_plain_text(const layer::Layer& layer) {
  Memory memory;
  return std::all_of(layer.entries().begin(), layer.entries().end(), [&](const auto& entry) {
    const layer::Spec& spec = entry.spec;
    if (entry.path.depth() > kLevels) {
      return false;
    }
    switch (spec.kind) {
      case SpecKind::PseudoRoot:
      case SpecKind::Prim:
        return entry.path.empty() || is_plain_prim(spec, memory);
      case SpecKind::Attribute:
        return entry.path.empty() || is_plain_attribute(spec, memory);
      case SpecKind::Relationship:
        return entry.path.empty() || is_plain_relationship(spec);
      default:
        return entry.path.empty();
    }
  });
}

}  // namespace tenon::formats::text
