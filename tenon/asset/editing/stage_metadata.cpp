// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A table says which metadata there is, which form its values have, and what keeps its numbers when
// a unit changes: that is not rescaled, because tenon cannot know which numbers of a file are
// lengths or masses of the asset, so it is told.
#include "tenon/asset/editing/stage_metadata.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/asset/editing/whole_prim_edits.h"
#include "tenon/base/assignment.h"
#include "tenon/base/path.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/text_number.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/value.h"

namespace tenon {
namespace {

enum class Form : std::uint8_t { Positive, Number, Axis, PrimName };

struct Row {
  std::string_view name;
  Form form;
  std::string_view kept;  ///< what keeps its numbers when this changes; empty: nothing means less
};

constexpr Row kRows[] = {
    {"timeCodesPerSecond", Form::Positive, "time samples keep their time codes"},
    {"startTimeCode", Form::Number, ""},
    {"endTimeCode", Form::Number, ""},
    {"metersPerUnit", Form::Positive,
     "lengths, positions and all that depends on them keep their numbers"},
    {"kilogramsPerUnit", Form::Positive, "masses and all that depends on them keep their numbers"},
    {"upAxis", Form::Axis, "nothing is turned"},
    {"defaultPrim", Form::PrimName, ""},
};

const Row* find_row(std::string_view name) {
  const auto* const found = std::find_if(std::begin(kRows), std::end(kRows),
                                         [&](const Row& row) { return row.name == name; });
  return found == std::end(kRows) ? nullptr : found;
}

std::string listed_names() { return comma_list(kRows, &Row::name); }

Error bad_value(const std::string& text, const std::string& fix) {
  return Error(ErrorCode::Invalid, "--layer " + text + " is not a value of this kind")
      .with_rule("edit.bad-argument")
      .with_fix(fix);
}

/// The value as layers hold it; nothing where the text does not have the form.
std::optional<layer::Value> value_of(const Row& row, const std::string& text) {
  if (row.form == Form::Axis) {
    return text == "Y" || text == "Z" ? std::optional(layer::Value(Token(text))) : std::nullopt;
  }
  if (row.form == Form::PrimName) {
    const std::string name = text.starts_with('/') ? text.substr(1) : text;
    return is_identifier(name) ? std::optional(layer::Value(Token(name))) : std::nullopt;
  }
  const std::optional<double> number = parse_double(text);
  const bool fits = number && std::isfinite(*number) && (row.form == Form::Number || *number > 0);
  return fits ? std::optional(layer::Value(*number)) : std::nullopt;
}

const char* form_text(Form form) {
  switch (form) {
    case Form::Positive:
      return "write a number above 0";
    case Form::Number:
      return "write a number";
    case Form::Axis:
      return "write Y or Z";
    case Form::PrimName:
      break;
  }
  return "write the name of a prim without a parent, as in defaultPrim=World";
}

std::string text_of(const stage::Stage& stage, Token field) {
  const layer::Value value = stage.metadata(field);
  return value.empty() ? std::string() : formats::value_text(value);
}

bool has_samples(const stage::Stage& stage) {
  const auto& layers = stage.used_layers();
  return std::any_of(layers.begin(), layers.end(), [](const layer::LayerPtr& layer) {
    for (const layer::Layer::Entry& entry : layer->entries()) {
      if (!entry.path.empty() && entry.spec.has(layer::fields::timeSamples)) {
        return true;
      }
    }
    return false;
  });
}

/// Whether there are numbers that mean something else once the unit is another one.
bool means_something_else(const stage::Stage& stage, const Row& row) {
  return !row.kept.empty() && (row.name != "timeCodesPerSecond" || has_samples(stage));
}

}  // namespace

std::vector<std::string> stage_metadata_names() {
  std::vector<std::string> names;
  for (const Row& row : kRows) {
    names.emplace_back(row.name);
  }
  return names;
}

Result<std::vector<AssetEdit>> stage_metadata_edits(const std::vector<std::string>& texts) {
  std::vector<AssetEdit> edits;
  for (const std::string& text : texts) {
    TENON_TRY(const auto parts, split_assignment(text));
    const Row* row = find_row(parts.first);
    if (row == nullptr) {
      std::vector<std::string_view> names;
      for (const Row& known : kRows) {
        names.push_back(known.name);
      }
      const std::string near(nearest_name(parts.first, names));
      return Error(ErrorCode::Invalid, "unknown metadata \"" + parts.first + "\" of a layer" +
                                           (near.empty() ? "" : "; did you mean " + near + "?"))
          .with_rule("edit.bad-argument")
          .with_fix("--layer takes NAME=VALUE for " + listed_names());
    }
    if (!value_of(*row, parts.second)) {
      return bad_value(text, form_text(row->form));
    }
    AssetEdit edit;
    edit.kind = AssetEdit::Kind::SetStageMetadata;
    edit.object = Path::absolute_root();
    edit.field = Token(parts.first);
    edit.value = parts.second;
    edit.may_rest = true;
    edits.push_back(std::move(edit));
  }
  return edits;
}

namespace {

/// By the table, or by the type of the field.
Result<layer::Value> wanted_value(const stage::Stage& stage, const AssetEdit& edit) {
  const Row* row = find_row(edit.field.view());
  if (row == nullptr) {
    return read_metadata(stage.pseudo_root(), edit);
  }
  const std::optional<layer::Value> value = value_of(*row, edit.value);
  return value ? Result<layer::Value>(*value)
               : Result<layer::Value>(
                     bad_value(edit.field.str() + "=" + edit.value, "names are " + listed_names()));
}

}  // namespace

Result<EditedPlace> set_stage_metadata(const AllFiles& files, const AssetEdit& edit,
                                       Diagnostics& diagnostics) {
  const stage::Stage& stage = *files.stages.front();
  const Row* row = find_row(edit.field.view());
  TENON_TRY(const layer::Value value, wanted_value(stage, edit));
  const std::string file = stage.root_layer().identifier();
  if (row != nullptr && row->form == Form::PrimName) {
    const Path prim = Path::absolute_root().child(value.get_or(Token()));
    if (!stage.prim(prim)) {
      return Error(ErrorCode::NotFound, "there is no prim " + named(prim))
          .in_file(file)
          .with_rule("edit.no-prim")
          .with_fix("name a prim without a parent; tenon tree lists all prims");
    }
  }
  EditedPlace place;
  place.file = file;
  place.spec = Path::absolute_root();
  place.why = "the root layer holds it for the asset";
  place.before = text_of(stage, edit.field);
  place.after = formats::value_text(value);
  if (row != nullptr && place.before != place.after && means_something_else(stage, *row)) {
    Diagnostic finding;
    finding.severity = Severity::Warning;
    finding.rule = "edit.not-rescaled";
    finding.file = file;
    finding.message = edit.field.str() + " is " + place.after + " instead of " +
                      (place.before.empty() ? "the default" : place.before) + ", and " +
                      std::string(row->kept);
    finding.fix =
        "change them too, if the asset is to stay as large, heavy, fast and upright as "
        "it was";
    diagnostics.add(std::move(finding));
  }
  edit::StageEditor* editor = files.editor_of(file);
  if (editor == nullptr) {
    return Error(ErrorCode::Unsupported, "the root layer cannot be edited").in_file(file);
  }
  TENON_CHECK(editor->edit_layer(file, [&](edit::LayerEditor& specs) -> Result<void> {
    specs.set(Path::absolute_root(), edit.field, value);
    return {};
  }));
  return place;
}

bool has_stage_metadata(const stage::Stage& stage, const AssetEdit& edit) {
  const auto value = wanted_value(stage, edit);
  return value && text_of(stage, edit.field) == formats::value_text(*value);
}

}  // namespace tenon
