// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A text counts as a path where it is one of the prims' paths up to its end, a '/' or a '.'. Such
// heads of a text are looked up from the longest down, so that many prims cost no more than one.
#include "tenon/asset/editing/path_texts.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/layer/dictionary.h"
#include "tenon/layer/fields.h"

namespace tenon {
namespace {

using layer::Value;
namespace fields = layer::fields;

class PathTexts {
 public:
  explicit PathTexts(const PrimMoves& moves) {
    for (const auto& [from, to] : moves) {
      moves_.emplace(from.str(), to.str());
    }
  }

  /// Nothing: it stays.
  std::optional<std::string> moved(const std::string& text) const {
    if (!text.starts_with('/')) {
      return std::nullopt;
    }
    for (std::size_t end = text.size(); end > 0; end = text.find_last_of("/.", end - 1)) {
      const auto known = moves_.find(std::string_view(text).substr(0, end));
      if (known != moves_.end()) {
        return known->second + text.substr(end);
      }
    }
    return std::nullopt;
  }

  std::optional<Value> moved_value(const Value& value) const {
    const auto* dictionary = value.get<layer::Dictionary>();
    return dictionary == nullptr ? moved(value) : moved_items(*dictionary);
  }

 private:
  std::optional<Value> moved(const Value& value) const {
    if (const auto* text = value.get<std::string>()) {
      const auto now = moved(*text);
      return now ? std::optional(Value(*now)) : std::nullopt;
    }
    if (const auto* token = value.get<Token>()) {
      const auto now = moved(token->str());
      return now ? std::optional(Value(Token(*now))) : std::nullopt;
    }
    if (const auto* texts = value.get<layer::Array<std::string>>()) {
      return moved_list<std::string>({texts->begin(), texts->end()});
    }
    if (const auto* tokens = value.get<layer::Array<Token>>()) {
      return moved_list<Token>({tokens->begin(), tokens->end()});
    }
    return std::nullopt;
  }

  static std::string text_of(const std::string& text) { return text; }
  static std::string text_of(Token token) { return token.str(); }

  template <class T>
  std::optional<Value> moved_list(std::vector<T> list) const {
    bool changed = false;
    for (T& one : list) {
      if (const auto now = moved(text_of(one))) {
        one = T(*now);
        changed = true;
      }
    }
    return changed ? std::optional(Value(layer::Array<T>(std::move(list)))) : std::nullopt;
  }

  /// A dictionary that is being rebuilt, up to the next item.
  struct Open {
    const layer::Dictionary* from;
    std::map<std::string, Value, std::less<>>::const_iterator next;
    std::string key;  ///< where it goes in the one around it
    layer::Dictionary made{};
    bool changed = false;
  };

  /// Those within too, by a list of what is open instead of recursion.
  std::optional<Value> moved_items(const layer::Dictionary& dictionary) const {
    std::vector<Open> open{{&dictionary, dictionary.items.begin(), ""}};
    while (true) {
      Open& inner = open.back();
      if (inner.next != inner.from->items.end()) {
        const auto& [key, item] = *inner.next++;
        const auto name = moved(key);
        inner.changed = inner.changed || name;
        if (const auto* deeper = item.get<layer::Dictionary>()) {
          open.push_back({deeper, deeper->items.begin(), name.value_or(key)});
          continue;
        }
        auto contents = moved(item);
        inner.changed = inner.changed || contents;
        inner.made.items.insert_or_assign(name.value_or(key),
                                          contents ? *std::move(contents) : item);
        continue;
      }
      Open done = std::move(open.back());
      open.pop_back();
      if (open.empty()) {
        return done.changed ? std::optional(Value(std::move(done.made))) : std::nullopt;
      }
      open.back().changed = open.back().changed || done.changed;
      open.back().made.items.insert_or_assign(done.key, Value(std::move(done.made)));
    }
  }

  std::map<std::string, std::string, std::less<>> moves_;
};

}  // namespace

std::vector<Path> follow_in_texts(edit::LayerEditor& editor, const PrimMoves& moves) {
  const PathTexts texts(moves);
  struct TextChange {
    Path spec;
    Token field;
    Value value;
  };
  std::vector<TextChange> changes;
  for (const layer::Layer::Entry& entry : editor.layer().entries()) {
    for (const Token field :
         {fields::default_value, fields::customData, fields::assetInfo, fields::customLayerData}) {
      const layer::Spec* spec = editor.layer().find(entry.path);
      const Value* value = spec == nullptr ? nullptr : spec->find(field);
      if (auto now = value == nullptr ? std::nullopt : texts.moved_value(*value)) {
        changes.push_back({entry.path, field, *std::move(now)});
      }
    }
  }
  std::vector<Path> changed;
  for (TextChange& change : changes) {
    editor.set(change.spec, change.field, std::move(change.value));
    changed.push_back(change.spec);
  }
  return changed;
}

}  // namespace tenon
