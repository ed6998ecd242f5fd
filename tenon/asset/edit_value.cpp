// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/edit_value.h"

#include <algorithm>

#include "tenon/asset/editing/whole_prim_edits.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"

namespace tenon {
namespace {

stage::Time time_of(const AssetEdit& edit) {
  return edit.time ? stage::Time(*edit.time) : stage::Time();
}

std::string text_of(const std::vector<Path>& targets) {
  std::string text;
  for (const Path& target : targets) {
    text += (text.empty() ? "<" : ", <") + target.str() + ">";
  }
  return text;
}

/// A sample that is a block.
bool has_blocked_sample(const stage::Attribute& attribute, double time) {
  const std::vector<double> times = attribute.time_samples();
  return std::find(times.begin(), times.end(), time) != times.end() &&
         (attribute.is_blocked(time) || attribute.get(time).empty());
}

}  // namespace

Result<PropertyValue> typed_edit(const stage::Prim& prim, const AssetEdit& edit,
                                 const layer::Spec* spec) {
  if (edit.is_about_metadata()) {
    PropertyValue metadata;
    TENON_TRY(metadata.value, read_metadata(prim, edit));
    return metadata;
  }
  return edit.kind == AssetEdit::Kind::ClearProperty || edit.kind == AssetEdit::Kind::Connect
             ? known_property(prim, edit.object.name(), edit.type_name, spec)
             : read_property_value(prim, {edit.object, edit.value, edit.type_name}, spec);
}

std::string composed_text(const stage::Prim& prim, const AssetEdit& edit) {
  const Token property = edit.object.is_property() ? edit.object.name() : Token();
  if (edit.is_about_metadata()) {
    const layer::Value found = composed_metadata(prim, edit);
    return found.empty() ? std::string() : formats::value_text(found);
  }
  if (edit.kind == AssetEdit::Kind::Connect) {
    return text_of(prim.attribute(property).connections());
  }
  return composed_text(prim, property, time_of(edit));
}

std::string composed_text(const stage::Prim& prim, Token property, stage::Time time) {
  if (prim.is_relationship(property)) {
    return text_of(prim.relationship(property).targets());
  }
  const layer::Value value = prim.attribute(property).get(time);
  return value.empty() ? std::string() : formats::value_text(value);
}

namespace {

bool is_prim_as_asked(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed) {
  const std::size_t equals = edit.value.find('=');
  switch (edit.kind) {
    case AssetEdit::Kind::DefinePrim:
      return prim.is_defined() && (prim.type_name() == edit.type_name ||
                                   (edit.arc && edit.type_name.empty()));  // what it brings in has
    case AssetEdit::Kind::AddVariant: {
      const auto names = prim.variant_names(edit.value.substr(0, equals));
      return std::find(names.begin(), names.end(), edit.value.substr(equals + 1)) != names.end();
    }
    case AssetEdit::Kind::SelectVariant:
      return equals == std::string::npos ||
             prim.variant_selection(edit.value.substr(0, equals)) == edit.value.substr(equals + 1);
    case AssetEdit::Kind::SetMetadata:
      return has_metadata(prim, edit, typed.value);
    default:
      return true;  // lists of arcs and names hold what all files say
  }
}

bool has_value(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed) {
  const Token name = edit.object.name();
  if (typed.is_relationship) {
    return prim.relationship(name).targets() == typed.targets;
  }
  const stage::Attribute attribute = prim.attribute(name);
  if (typed.value.is_block()) {
    return edit.time ? has_blocked_sample(attribute, *edit.time) : attribute.is_blocked();
  }
  // Asset paths come back resolved: what was authored counts.
  const layer::Value value = attribute.get(time_of(edit));
  return value == typed.value || formats::value_text(value) == formats::value_text(typed.value);
}

}  // namespace

bool is_as_asked(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed) {
  if (edit.is_about_specs()) {
    return true;  // looked at where they are made
  }
  if (edit.is_about_prim() || edit.is_about_metadata()) {
    return is_prim_as_asked(prim, edit, typed);
  }
  const Token name = edit.object.name();
  switch (edit.kind) {
    case AssetEdit::Kind::ApplyApi:
    case AssetEdit::Kind::RemoveApi: {
      const std::vector<Token> apis = prim.authored_api_schemas();
      const bool there = std::find(apis.begin(), apis.end(), edit.api) != apis.end();
      return there == (edit.kind == AssetEdit::Kind::ApplyApi);
    }
    case AssetEdit::Kind::AddTargets:
    case AssetEdit::Kind::RemoveTargets: {
      const std::vector<Path> targets = prim.relationship(name).targets();
      return std::all_of(typed.targets.begin(), typed.targets.end(), [&](Path target) {
        const bool there = std::find(targets.begin(), targets.end(), target) != targets.end();
        return there == (edit.kind == AssetEdit::Kind::AddTargets);
      });
    }
    case AssetEdit::Kind::Connect:
      return prim.attribute(name).connections() == edit.targets;
    default:
      return edit.kind == AssetEdit::Kind::ClearProperty || has_value(prim, edit, typed);
  }
}

void warn_of_samples(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed,
                     Diagnostics& diagnostics) {
  if (edit.kind != AssetEdit::Kind::SetProperty || edit.time || typed.is_relationship) {
    return;
  }
  const stage::Attribute attribute = prim.attribute(edit.object.name());
  if (attribute.value_source(stage::Time(0.0)) != attribute.value_source()) {
    diagnostics.add(attribute.located(
        Severity::Warning, "edit.has-samples",
        "the value has time samples, which count at all times but the default one"));
  }
}

}  // namespace tenon
