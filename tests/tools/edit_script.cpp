// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a script of edits for tests/differential/edit_stage.py.
//
// usage: tenon_edit_script SCRIPT.json, with {"root": FILE, "session": bool, "edits": [...]}
// Prints {"results": [true | "message"...], "layers": {name: text}, "flat": text, "history": bool,
// "astray": the first edit after which the scene that follows edits is not the one of the layers,
// "edited": {name: {"text": the file's text edited, "kept": its layout was kept}}}.
// Exit: 0 printed; 2 wrong usage or script; 3 a layer could not be opened.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "tenon/edit/stage_editor.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/layout/layout_edit.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/stage/flatten/flatten.h"

namespace {

using namespace tenon;
using Json = nlohmann::json;
using Done = Result<void>;
using Op = std::function<Done(edit::StageEditor&, const Json&)>;

Path path_in(const Json& json, const char* key = "path") {
  return Path::from(json.at(key).get<std::string>());
}
std::string text_in(const Json& json, const char* key) { return json.at(key).get<std::string>(); }
Token token_in(const Json& json, const char* key) { return Token(text_in(json, key)); }

std::vector<Token> tokens_in(const Json& json) {
  std::vector<Token> tokens;
  for (const Json& name : json.at("names")) {
    tokens.emplace_back(name.get<std::string>());
  }
  return tokens;
}

Result<layer::Value> value_in(const Json& json) {
  return formats::parse_value(text_in(json, "text"),
                              *layer::find_type_name(token_in(json, "type")));
}

stage::Time time_in(const Json& json) {
  return json.at("time").is_null() ? stage::Time() : stage::Time(json.at("time").get<double>());
}

layer::LayerOffset offset_in(const Json& json) {
  return {json.value("offset", 0.0), json.value("scale", 1.0)};
}

edit::ListPosition position_in(const Json& json) {
  const std::map<std::string, edit::ListPosition> names = {
      {"front_prepend", edit::ListPosition::FrontOfPrependList},
      {"back_prepend", edit::ListPosition::BackOfPrependList},
      {"front_append", edit::ListPosition::FrontOfAppendList},
      {"back_append", edit::ListPosition::BackOfAppendList}};
  return names.at(json.value("position", "back_prepend"));
}

Path item_in(const Json& json, const Path*) { return Path::from(json.get<std::string>()); }

template <class Arc>
Arc item_in(const Json& json, const Arc*) {
  Arc arc;
  arc.asset_path = json.value("asset", "");
  const std::string prim = json.value("prim", "");
  arc.prim_path = prim.empty() ? Path() : Path::from(prim);
  arc.offset = offset_in(json);
  return arc;
}

template <class T>
edit::ListEdit<T> list_edit_in(const Json& json) {
  using Kind = typename edit::ListEdit<T>::Kind;
  const std::map<std::string, Kind> kinds = {
      {"add", Kind::Add}, {"remove", Kind::Remove}, {"set", Kind::Set}, {"clear", Kind::Clear}};
  edit::ListEdit<T> edit;
  edit.kind = kinds.at(text_in(json, "edit"));
  edit.position = position_in(json);
  for (const Json& item : json.at("items")) {
    edit.items.push_back(item_in(item, static_cast<const T*>(nullptr)));
  }
  return edit;
}

layer::Variability variability_in(const Json& json) {
  return json.value("uniform", false) ? layer::Variability::Uniform : layer::Variability::Varying;
}

Done set_value(edit::StageEditor& editor, const Json& json) {
  TENON_TRY(layer::Value value, value_in(json));
  return editor.set_value(path_in(json), std::move(value), time_in(json));
}

Done set_metadata(edit::StageEditor& editor, const Json& json) {
  TENON_TRY(layer::Value value, value_in(json));
  return editor.set_metadata(path_in(json), token_in(json, "field"), json.value("key", ""),
                             std::move(value));
}

Done target_variant(edit::StageEditor& editor, const Json& json) {
  TENON_TRY(edit::EditTarget target,
            editor.variant_target(path_in(json), text_in(json, "set"), text_in(json, "variant")));
  return editor.set_target(std::move(target));
}

std::string g_folder;  // of the root layer

Done target_arc(edit::StageEditor& editor, const Json& json) {
  TENON_TRY(edit::EditTarget target,
            editor.arc_target(path_in(json), g_folder + text_in(json, "layer")));
  return editor.set_target(std::move(target));
}

Done set_relocates(edit::StageEditor& editor, const Json& json) {
  layer::Relocates relocates;
  for (const Json& pair : json.at("pairs")) {
    relocates.pairs.emplace_back(item_in(pair.at(0), static_cast<Path*>(nullptr)),
                                 item_in(pair.at(1), static_cast<Path*>(nullptr)));
  }
  return editor.set_relocates(std::move(relocates));
}

using Editor = edit::StageEditor;

void add_prim_ops(std::map<std::string, Op>& ops) {
  ops["define"] = [](Editor& e, const Json& j) {
    return e.define_prim(path_in(j), token_in(j, "type"));
  };
  ops["override"] = [](Editor& e, const Json& j) { return e.override_prim(path_in(j)); };
  ops["class"] = [](Editor& e, const Json& j) { return e.create_class(path_in(j)); };
  ops["remove"] = [](Editor& e, const Json& j) { return e.remove_prim(path_in(j)); };
  ops["move"] = [](Editor& e, const Json& j) { return e.move_prim(path_in(j), path_in(j, "to")); };
  ops["type_name"] = [](Editor& e, const Json& j) {
    return e.set_type_name(path_in(j), token_in(j, "type"));
  };
  ops["reorder_children"] = [](Editor& e, const Json& j) {
    return e.reorder_children(path_in(j), tokens_in(j));
  };
  ops["reorder_properties"] = [](Editor& e, const Json& j) {
    return e.reorder_properties(path_in(j), tokens_in(j));
  };
  ops["metadata"] = set_metadata;
  ops["clear_metadata"] = [](Editor& e, const Json& j) {
    return e.clear_metadata(path_in(j), token_in(j, "field"), j.value("key", ""));
  };
  ops["apply_api"] = [](Editor& e, const Json& j) {
    return e.apply_api(path_in(j), token_in(j, "schema"));
  };
  ops["remove_api"] = [](Editor& e, const Json& j) {
    return e.remove_api(path_in(j), token_in(j, "schema"));
  };
  ops["add_schema"] = [](Editor& e, const Json& j) {
    return e.add_applied_schema(path_in(j), token_in(j, "schema"));
  };
  ops["remove_schema"] = [](Editor& e, const Json& j) {
    return e.remove_applied_schema(path_in(j), token_in(j, "schema"));
  };
}

void add_property_ops(std::map<std::string, Op>& ops) {
  ops["attribute"] = [](Editor& e, const Json& j) {
    return e.create_attribute(path_in(j), token_in(j, "type"), j.value("custom", true),
                              variability_in(j));
  };
  ops["relationship"] = [](Editor& e, const Json& j) {
    return e.create_relationship(path_in(j), j.value("custom", true));
  };
  ops["remove_property"] = [](Editor& e, const Json& j) { return e.remove_property(path_in(j)); };
  ops["set"] = set_value;
  ops["clear_value"] = [](Editor& e, const Json& j) {
    return e.clear_value(path_in(j), time_in(j));
  };
  ops["clear_values"] = [](Editor& e, const Json& j) { return e.clear_values(path_in(j)); };
  ops["block"] = [](Editor& e, const Json& j) { return e.block_value(path_in(j)); };
  ops["connections"] = [](Editor& e, const Json& j) {
    return e.edit_connections(path_in(j), list_edit_in<Path>(j));
  };
  ops["targets"] = [](Editor& e, const Json& j) {
    return e.edit_targets(path_in(j), list_edit_in<Path>(j));
  };
}

void add_arc_ops(std::map<std::string, Op>& ops) {
  ops["references"] = [](Editor& e, const Json& j) {
    return e.edit_references(path_in(j), list_edit_in<layer::Reference>(j));
  };
  ops["payloads"] = [](Editor& e, const Json& j) {
    return e.edit_payloads(path_in(j), list_edit_in<layer::Payload>(j));
  };
  ops["inherits"] = [](Editor& e, const Json& j) {
    return e.edit_inherits(path_in(j), list_edit_in<Path>(j));
  };
  ops["specializes"] = [](Editor& e, const Json& j) {
    return e.edit_specializes(path_in(j), list_edit_in<Path>(j));
  };
  ops["insert_sublayer"] = [](Editor& e, const Json& j) {
    return e.insert_sublayer(j.at("index").get<std::size_t>(), text_in(j, "asset"), offset_in(j));
  };
  ops["remove_sublayer"] = [](Editor& e, const Json& j) {
    return e.remove_sublayer(j.at("index").get<std::size_t>());
  };
  ops["relocates"] = set_relocates;
  ops["variant_set"] = [](Editor& e, const Json& j) {
    return e.add_variant_set(path_in(j), text_in(j, "set"), position_in(j));
  };
  ops["variant"] = [](Editor& e, const Json& j) {
    return e.add_variant(path_in(j), text_in(j, "set"), text_in(j, "variant"), position_in(j));
  };
  ops["select"] = [](Editor& e, const Json& j) {
    return e.set_variant_selection(path_in(j), text_in(j, "set"), text_in(j, "variant"));
  };
  ops["unselect"] = [](Editor& e, const Json& j) {
    return e.clear_variant_selection(path_in(j), text_in(j, "set"));
  };
  ops["target_layer"] = [](Editor& e, const Json& j) {
    return e.set_target(g_folder + text_in(j, "layer"));
  };
  ops["target_variant"] = target_variant;
  ops["target_arc"] = target_arc;
}

std::string texts_of(const Editor& editor) {
  std::string all;
  for (const auto& [identifier, layer] : editor.edited_layers()) {
    all += formats::write_text(*layer);
  }
  return all;
}

using Registry = std::shared_ptr<formats::LayerRegistry>;

/// The scene that follows the edits is the one that is composed of the layers as they are now.
bool follows(Editor& editor, const layer::LayerPtr& root, const Registry& registry) {
  const auto edited = editor.edited_layers();
  const auto now = [&edited](const layer::LayerPtr& layer) {
    const auto found = edited.find(layer->identifier());
    return found == edited.end() ? layer : found->second;
  };
  const auto working = editor.working_stage();
  const auto fresh = stage::Stage::open(
      now(root), nullptr,
      [&](const std::string& asset, const layer::Layer& anchor) -> Result<layer::LayerPtr> {
        TENON_TRY(const layer::LayerPtr opened, registry->open(asset, &anchor));
        return now(opened);
      });
  return working && fresh &&
         formats::write_text(stage::flatten(**working)) ==
             formats::write_text(stage::flatten(*fresh));
}

/// Taking everything back leads to the layers as they were, and forward again to the same.
bool history_holds(Editor& editor, const std::function<bool()>& holds) {
  const std::string before = texts_of(editor);
  bool held = true;
  while (editor.undo()) {
    held = held && holds();
  }
  const bool back = editor.changes().empty();
  while (editor.redo()) {
    held = held && holds();
  }
  return held && back && texts_of(editor) == before;
}

int run(const Json& script) {
  const auto registry = std::make_shared<formats::LayerRegistry>();
  const auto root = registry->open_root(script.at("root").get<std::string>());
  if (!root) {
    std::fprintf(stderr, "%s\n", root.error().to_string().c_str());
    return 3;
  }
  g_folder = std::filesystem::path((*root)->identifier()).parent_path().string() + "/";
  Editor editor = Editor::over(*root, nullptr,
                               [registry](const std::string& asset, const layer::Layer& anchor) {
                                 return registry->open(asset, &anchor);
                               });
  std::map<std::string, Op> ops;
  add_prim_ops(ops);
  add_property_ops(ops);
  add_arc_ops(ops);
  Json output = {
      {"results", Json::array()}, {"layers", Json::object()}, {"edited", Json::object()}};
  const auto holds = [&] { return follows(editor, *root, registry); };
  for (const Json& one : script.at("edits")) {
    const Done done = ops.at(text_in(one, "op"))(editor, one);
    output["results"].push_back(done ? Json(true) : Json(done.error().to_string()));
    if (!holds() && !output.contains("astray")) {
      output["astray"] = one;
    }
  }
  output["history"] = history_holds(editor, holds);
  for (const auto& [identifier, layer] : editor.edited_layers()) {
    const std::string name = identifier.substr(g_folder.size());
    output["layers"][name] = formats::write_text(*layer);
    std::ifstream file(identifier, std::ios::binary);
    const std::string original{std::istreambuf_iterator<char>(file), {}};
    const formats::EditedText edited = formats::edit_text(original, *layer);
    output["edited"][name] = {{"text", edited.text}, {"kept", edited.kept_layout}};
  }
  const auto stage = editor.stage();
  output["flat"] = formats::write_text(stage::flatten(**stage));
  const std::string text = output.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: tenon_edit_script SCRIPT.json\n", stderr);
    return 2;
  }
  std::ifstream file(words[1]);
  const Json script = Json::parse(file, nullptr, false);
  return script.is_discarded() ? 2 : run(script);
}
