// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/composed_change.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "tenon/layer/fields.h"

namespace tenon::edit {
namespace {

namespace fields = layer::fields;

/// Composition does not look at these fields of prims and variants; stages look them up.
bool is_followed(Token field) {
  return field == fields::properties || field == fields::typeName || field == fields::apiSchemas;
}

/// What a prim may say that is composed from nothing but its own specs.
bool is_plain(const layer::Spec& spec) {
  constexpr auto kPlain = [](Token field) {
    return is_followed(field) || field == fields::specifier || field == fields::primChildren ||
           field == fields::kind || field == fields::active || field == fields::comment ||
           field == fields::documentation || field == fields::customData;
  };
  return spec.kind == layer::SpecKind::Prim &&
         std::all_of(spec.fields().begin(), spec.fields().end(),
                     [&](const layer::Field& field) { return kPlain(field.name); });
}

/// All other fields than those that `skip` takes are equal.
template <class Skip>
bool same_fields(const layer::Spec& a, const layer::Spec& b, const Skip& skip) {
  const auto covers = [&](const layer::Spec& one, const layer::Spec& other) {
    return std::all_of(one.fields().begin(), one.fields().end(), [&](const layer::Field& field) {
      const layer::Value* value = skip(field.name) ? nullptr : other.find(field.name);
      return skip(field.name) || (value != nullptr && *value == field.value);
    });
  };
  return a.kind == b.kind && covers(a, b) && covers(b, a);
}

bool is_in_property(Path path) {
  while (!path.empty() && !path.is_property() && !path.is_prim_or_variant()) {
    path = path.parent();
  }
  return path.is_property();
}

/// The children that a spec has more, behind those that it had; nullopt where some went or moved.
std::optional<std::vector<Token>> new_children(const layer::Spec& before,
                                               const layer::Spec& after) {
  const std::vector<Token>& old = layer::Layer::children(before, fields::primChildren);
  const std::vector<Token>& now = layer::Layer::children(after, fields::primChildren);
  if (now.size() < old.size() || !std::equal(old.begin(), old.end(), now.begin())) {
    return std::nullopt;
  }
  return std::vector<Token>(now.begin() + static_cast<std::ptrdiff_t>(old.size()), now.end());
}

/// Of a spec that is there; nullopt where it says something else as well.
std::optional<stage::SpecNews> news_of(const SpecChange& change, const layer::Layer& layer) {
  auto children = new_children(change.before.value_or(layer::Spec()), *change.after);
  const bool follows =
      children && (!change.before || same_fields(*change.before, *change.after, [](Token field) {
        return is_followed(field) || field == fields::primChildren;
      }));
  const layer::Spec* const now = follows ? layer.find(change.path) : nullptr;
  return now == nullptr ? std::nullopt : std::optional(stage::SpecNews{now, *std::move(children)});
}

}  // namespace

bool changes_composition(const LayerChange& change) {
  return std::any_of(change.specs.begin(), change.specs.end(), [](const SpecChange& spec) {
    return !is_in_property(spec.path) &&
           !(spec.before && spec.after && same_fields(*spec.before, *spec.after, is_followed));
  });
}

bool add_news(const LayerChange& change, const layer::Layer& layer,
              std::vector<stage::SpecNews>& news) {
  for (const SpecChange& spec : change.specs) {
    if (is_in_property(spec.path)) {
      continue;
    }
    if (!spec.after || (!spec.before && !is_plain(*spec.after))) {
      return false;
    }
    auto one = news_of(spec, layer);
    if (!one) {
      return false;
    }
    news.push_back(*std::move(one));
  }
  return true;
}

}  // namespace tenon::edit
