// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Binding looks up each function once and turns it with its arguments into a closure. Operands
// precede their operators in the list of nodes, so one scan of it answers without recursion,
// however deep the expression is. A property is judged by its prim for `abstract` and `defined`.
// All other functions are false for properties. Arguments are silently ignored where OpenUSD does
// so.
#include "tenon/stage/collections/prim_predicate.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "tenon/layer/fields.h"
#include "tenon/schema/kinds.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/collections/name_pattern.h"

namespace tenon::stage {
namespace {

using layer::PredicateArgument;
using Arguments = std::vector<PredicateArgument>;
using Matcher = PrimPredicate::Matcher;

Error wrong_arguments(std::string_view function, std::string_view expected) {
  return Error(ErrorCode::Parse,
               "the predicate `" + std::string(function) + "` takes " + std::string(expected))
      .with_rule("stage.predicate");
}

bool as_bool(const layer::Value& value, bool& result) {
  if (const auto* flag = value.get<bool>()) {
    result = *flag;
  } else if (const auto* whole = value.get<std::int64_t>()) {
    result = *whole != 0;
  } else if (const auto* number = value.get<double>()) {
    result = *number != 0;
  } else {
    return false;
  }
  return true;
}

/// The one argument of `abstract`, `defined`, `model` and `group`, true when it is not there.
Result<bool> expected_state(std::string_view function, const Arguments& arguments,
                            std::string_view keyword) {
  bool expected = true;
  if (arguments.size() > 1) {
    return wrong_arguments(function, "one argument at most");
  }
  if (!arguments.empty() && (arguments[0].keyword.empty() || arguments[0].keyword == keyword) &&
      !as_bool(arguments[0].value, expected)) {
    return wrong_arguments(function, "true or false");
  }
  return expected;
}

bool is_strict(const Arguments& arguments) {
  for (const PredicateArgument& argument : arguments) {
    if (argument.keyword == "strict") {
      bool flag = false;
      if (as_bool(argument.value, flag)) {
        return flag;
      }
      const auto* text = argument.value.get<std::string>();
      return text != nullptr && !text->empty() &&
             (text->front() == '1' || text->front() == 'y' || text->front() == 'Y');
    }
  }
  return false;
}

/// Strings given by position.
std::vector<Token> names_of(const Arguments& arguments) {
  std::vector<Token> result;
  for (const PredicateArgument& argument : arguments) {
    const auto* text = argument.value.get<std::string>();
    if (argument.keyword.empty() && text != nullptr) {
      result.emplace_back(*text);
    }
  }
  return result;
}

Result<Matcher> bind_abstract(const Arguments& arguments) {
  TENON_TRY(const bool expected, expected_state("abstract", arguments, "isAbstract"));
  return Matcher([expected](const Prim& prim, bool) { return prim.is_abstract() == expected; });
}

Result<Matcher> bind_defined(const Arguments& arguments) {
  TENON_TRY(const bool expected, expected_state("defined", arguments, "isDefined"));
  return Matcher([expected](const Prim& prim, bool) { return prim.is_defined() == expected; });
}

Result<Matcher> bind_model(const Arguments& arguments) {
  TENON_TRY(const bool expected, expected_state("model", arguments, "isModel"));
  return Matcher([expected](const Prim& prim, bool is_property) {
    return !is_property && prim.is_model() == expected;
  });
}

Result<Matcher> bind_group(const Arguments& arguments) {
  TENON_TRY(const bool expected, expected_state("group", arguments, "isGroup"));
  return Matcher([expected](const Prim& prim, bool is_property) {
    return !is_property && prim.is_group() == expected;
  });
}

Result<Matcher> bind_kind(const Arguments& arguments) {
  std::vector<Token> kinds = names_of(arguments);
  std::erase_if(kinds, [](Token kind) { return !schema::is_kind(kind, kind); });
  if (kinds.empty()) {
    return wrong_arguments("kind", "kinds such as component");
  }
  return Matcher([kinds, strict = is_strict(arguments)](const Prim& prim, bool is_property) {
    if (is_property) {
      return false;
    }
    const Token kind = prim.metadata(layer::fields::kind).get_or(Token());
    return std::any_of(kinds.begin(), kinds.end(), [&](Token wanted) {
      return strict ? kind == wanted : schema::is_kind(kind, wanted);
    });
  });
}

Result<Matcher> bind_specifier(const Arguments& arguments) {
  std::array<bool, 3> wanted{};
  for (const PredicateArgument& argument : arguments) {
    const auto* text = argument.value.get<std::string>();
    constexpr std::array<std::string_view, 3> kNames{"def", "over", "class"};
    const auto* found =
        text == nullptr ? kNames.end() : std::find(kNames.begin(), kNames.end(), *text);
    if (!argument.keyword.empty() || found == kNames.end()) {
      return wrong_arguments("specifier", "def, over or class");
    }
    wanted[static_cast<std::size_t>(found - kNames.begin())] = true;
  }
  return Matcher([wanted](const Prim& prim, bool is_property) {
    return !is_property && wanted[static_cast<std::size_t>(prim.specifier())];
  });
}

Result<Matcher> bind_isa(const Arguments& arguments) {
  return Matcher([types = names_of(arguments), strict = is_strict(arguments)](const Prim& prim,
                                                                              bool is_property) {
    return !is_property && std::any_of(types.begin(), types.end(), [&](Token type) {
      return strict ? prim.type_name() == type && schema::Registry::instance().find(type) != nullptr
                    : prim.is_a(type);
    });
  });
}

Result<Matcher> bind_has_api(const Arguments& arguments) {
  std::string instance;
  for (const PredicateArgument& argument : arguments) {
    if (argument.keyword == "instanceName") {
      const auto* text = argument.value.get<std::string>();
      if (text == nullptr) {
        return wrong_arguments("hasAPI", "the name of an instance as text");
      }
      instance = *text;
      break;
    }
  }
  return Matcher([schemas = names_of(arguments), instance](const Prim& prim, bool is_property) {
    return !is_property && std::any_of(schemas.begin(), schemas.end(), [&](Token schema) {
      return instance.empty() ? prim.has_api(schema) || !prim.api_instances(schema).empty()
                              : prim.has_api(Token(schema.str() + ":" + instance));
    });
  });
}

Result<Matcher> bind_variant(const Arguments& arguments) {
  std::vector<std::pair<std::string, std::string>> wanted;
  for (const PredicateArgument& argument : arguments) {
    const auto* text = argument.value.get<std::string>();
    if (argument.keyword.empty() || text == nullptr || text->empty()) {
      return wrong_arguments("variant", "selections such as modelingVariant=blue");
    }
    // What is no plain name is looked for anywhere in the selection.
    wanted.emplace_back(argument.keyword, is_identifier(*text) ? *text : '*' + *text + '*');
  }
  return Matcher([wanted](const Prim& prim, bool is_property) {
    return !is_property && std::all_of(wanted.begin(), wanted.end(), [&](const auto& one) {
      return name_matches(one.second, prim.variant_selection(one.first));
    });
  });
}

Result<Matcher> bind_call(const layer::PredicateCall& call) {
  struct Known {
    std::string_view name;
    Result<Matcher> (*bind)(const Arguments&);
  };
  constexpr Known kFunctions[] = {
      {"abstract", bind_abstract}, {"defined", bind_defined}, {"model", bind_model},
      {"group", bind_group},       {"kind", bind_kind},       {"specifier", bind_specifier},
      {"isa", bind_isa},           {"hasAPI", bind_has_api},  {"variant", bind_variant}};
  for (const Known& known : kFunctions) {
    if (known.name == call.function) {
      return known.bind(call.arguments);
    }
  }
  return Error(ErrorCode::Parse, "there is no predicate `" + call.function + "`")
      .with_rule("stage.predicate");
}

}  // namespace

Result<PrimPredicate> PrimPredicate::bind(const layer::PredicateExpression& expression) {
  PrimPredicate result;
  result.nodes_ = expression.nodes;
  for (const layer::PredicateCall& call : expression.calls) {
    TENON_TRY(Matcher function, bind_call(call));
    result.functions_.push_back(std::move(function));
  }
  return result;
}

bool PrimPredicate::holds(const Prim& prim, bool is_property) const {
  using layer::PredicateExpression;
  std::vector<bool> values;
  values.reserve(nodes_.size());
  const auto at = [&values](std::int32_t node) { return values[static_cast<std::size_t>(node)]; };
  for (const layer::ExpressionNode& node : nodes_) {
    switch (node.op) {
      case PredicateExpression::Call:
        values.push_back(functions_[static_cast<std::size_t>(node.left)](prim, is_property));
        break;
      case PredicateExpression::Not:
        values.push_back(!at(node.left));
        break;
      case PredicateExpression::Or:
        values.push_back(at(node.left) || at(node.right));
        break;
      default:
        values.push_back(at(node.left) && at(node.right));
    }
  }
  return !values.empty() && values.back();
}

}  // namespace tenon::stage
