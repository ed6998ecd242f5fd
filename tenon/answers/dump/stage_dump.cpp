// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The dump has to be the same whichever program composed the stage, so nothing in it is a matter of
// that program: prototypes are named after the smallest path that uses them, files by their place
// from the folder of the root layer, errors as OpenUSD names them, and sets are sorted. All prims
// are visited before the first line, because any path in a value may be in a prototype and needs
// its name. Session layers are not in the layer stack.
#include "tenon/answers/dump/stage_dump.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tenon/answers/dump/dump_properties.h"
#include "tenon/answers/dump/dump_values.h"
#include "tenon/answers/dump/json_writer.h"
#include "tenon/answers/specifier_word.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/transform_at.h"

namespace tenon::answers {
namespace {

using stage::Prim;

// Every prim below `root`, without itself, depth first, proxies included or not.
std::vector<Prim> traverse(const Prim& root, bool proxies) {
  std::vector<Prim> result;
  std::vector<Prim> pending{root};
  while (!pending.empty()) {
    const Prim prim = pending.back();
    pending.pop_back();
    if (!(prim == root)) {
      result.push_back(prim);
    }
    if (prim.is_instance() && !proxies) {
      continue;
    }
    const std::vector<Prim> children = prim.children();
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
  return result;
}

// "compose.invalid-asset-path" -> "InvalidAssetPath"
std::string error_name(const std::string& rule) {
  std::string result;
  bool upper = true;
  for (const char c : rule.substr(rule.find('.') + 1)) {
    if (c == '-') {
      upper = true;
      continue;
    }
    result += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    upper = false;
  }
  return result;
}

class StageDump {
 public:
  StageDump(const stage::Stage& stage, const DumpOptions& options, std::ostream& out)
      : stage_(stage), options_(options), json_(out), transforms_(stage::Time()) {
    folder_ = std::filesystem::path(file_of(stage.root_layer().identifier())).parent_path();
    style_.full_arrays = options.full_arrays;
    style_.path_text = [this](Path path) { return path_text(path); };
    style_.expression_text = [this](const std::string& text) { return expression_text(text); };
    style_.file_text = [this](const std::string& file) { return relative(file); };
    prims_ = traverse(stage.pseudo_root(), true);
    name_prototypes();
  }

  void write() {
    json_.begin_object();
    write_head();
    write_layers();
    json_.key("rootChildren");
    write_children(stage_.pseudo_root());
    json_.key("prims");
    json_.begin_object();
    for (const Prim& prim : prims_) {
      json_.key(prim.path().str());
      write_prim(prim);
    }
    json_.end_object();
    write_prototypes();
    json_.end_object();
  }

 private:
  static std::string file_of(const std::string& identifier) {
    return identifier.substr(0, identifier.find('['));
  }

  std::string relative(const std::string& file) const {
    const std::filesystem::path path(file);
    return path.is_absolute() ? path.lexically_normal().lexically_relative(folder_).generic_string()
                              : file;
  }

  std::string layer_text(const layer::Layer& layer) const {
    const std::string& identifier = layer.identifier();
    if (identifier.starts_with("anon:")) {
      return "<anon>";
    }
    const std::string file = file_of(identifier);
    return relative(file) + identifier.substr(file.size());
  }

  std::string path_text(Path path) const {
    std::string text = path.str();
    if (text.starts_with("/__Prototype_")) {
      const std::size_t end = text.find_first_not_of("0123456789", 13);
      const auto it = prototype_names_.find(text.substr(0, end));
      if (it != prototype_names_.end()) {
        return it->second + (end == std::string::npos ? "" : text.substr(end));
      }
    }
    return text;
  }

  std::string expression_text(std::string_view text) const {
    constexpr std::string_view kPrototype = "/__Prototype_";
    std::string result;
    for (std::size_t at = text.find(kPrototype); at != text.npos; at = text.find(kPrototype)) {
      const std::size_t end = text.find_first_not_of("0123456789", at + kPrototype.size());
      const auto it = prototype_names_.find(std::string(text.substr(at, end - at)));
      const std::size_t length = std::min(end, text.size());
      result += text.substr(0, at);
      result += it == prototype_names_.end() ? text.substr(at, length - at) : it->second;
      text.remove_prefix(length);
    }
    return result += text;
  }

  void name_prototypes() {
    std::map<std::string, std::set<std::string>> users;
    for (const Prim& prim : prims_) {
      if (prim.is_instance()) {
        users[prim.prototype().path().str()].insert(prim.path().str());
      }
    }
    for (auto& [prototype, paths] : users) {
      const std::string name = "<proto:" + *paths.begin() + ">";
      prototype_names_[prototype] = name;
      prototype_users_[name] = std::move(paths);
    }
  }

  void write_head() {
    const std::string& identifier = stage_.root_layer().identifier();
    json_.key("format");
    json_.string("tenon-stage-dump-1");
    json_.key("root");
    json_.string(identifier.substr(identifier.rfind('/') + 1));
    json_.key("defaultPrim");
    json_.string(stage_.root_layer().default_prim().view());
    json_.key("stageMetadata");
    write_metadata(json_, stage_.all_authored_metadata(), style_);
    json_.key("startTimeCode");
    json_.number(stage_.start_time_code());
    json_.key("endTimeCode");
    json_.number(stage_.end_time_code());
    json_.key("timeCodesPerSecond");
    json_.number(stage_.time_codes_per_second());
    json_.key("framesPerSecond");
    json_.number(stage_.frames_per_second());
  }

  void write_strings(std::string_view key, const auto& strings) {
    json_.key(key);
    json_.array(strings, [this](const std::string& text) { json_.string(text); });
  }

  void write_layers() {
    std::vector<std::string> stack;
    bool session = true;
    for (const compose::StackedLayer& stacked : stage_.layer_stack().layers) {
      session = session && stacked.layer.get() != &stage_.root_layer();
      if (!session) {
        stack.push_back(layer_text(*stacked.layer));
      }
    }
    write_strings("layerStack", stack);
    std::set<std::string> used;
    for (const layer::LayerPtr& layer : stage_.used_layers()) {
      used.insert(layer_text(*layer));
    }
    used.erase("<anon>");
    write_strings("usedLayers", used);
    std::multiset<std::string> errors;
    for (const Diagnostic& diagnostic : stage_.diagnostics()) {
      if (diagnostic.rule.starts_with("compose.")) {
        errors.insert(error_name(diagnostic.rule));
      }
    }
    write_strings("compositionErrors", errors);
  }

  void write_children(const Prim& prim) {
    json_.array(prim.children(), [this](const Prim& child) { json_.string(child.name().view()); });
  }

  void flag(std::string_view key, bool value) {
    json_.key(key);
    json_.boolean(value);
  }

  void write_flags(const Prim& prim) {
    flag("active", prim.is_active());
    flag("loaded", prim.is_loaded());
    flag("defined", prim.is_defined());
    flag("abstract", prim.is_abstract());
    flag("model", prim.is_model());
    flag("group", prim.is_group());
    flag("instance", prim.is_instance());
    flag("instanceProxy", prim.is_instance_proxy());
  }

  void write_prim(const Prim& prim) {
    json_.begin_object();
    json_.key("specifier");
    json_.string(specifier_word(prim.specifier()));
    json_.key("type");
    json_.string(prim.type_name().view());
    write_flags(prim);
    json_.key("appliedSchemas");
    json_.array(prim.applied_schemas(), [this](Token name) { json_.string(name.view()); });
    json_.key("children");
    write_children(prim);
    if (prim.is_instance()) {
      json_.key("prototype");
      json_.string(path_text(prim.prototype().path()));
    }
    write_prim_metadata(prim);
    write_variant_sets(prim);
    write_properties(prim);
    if (options_.stacks) {
      write_stack(prim.spec_stack());
    }
    if (options_.xforms && prim.is_a("Xformable") && !prim.definition()->schema()->vendor) {
      json_.key("localToWorld");
      write_value(json_, transforms_.local_to_world(prim), style_);
    }
    json_.end_object();
  }

  void write_prim_metadata(const Prim& prim) {
    auto fields = prim.all_authored_metadata();
    for (const char* name : {"clips", "clipSets"}) {
      fields.erase(name);
    }
    const bool has_clips = prim.has_authored_metadata("clips");
    const bool has_sets = prim.has_authored_metadata("clipSets");
    std::erase_if(fields, [](const auto& field) { return is_composition_field(field.first); });
    if (fields.empty() && !has_clips && !has_sets) {
      return;
    }
    json_.key("metadata");
    json_.begin_object();
    for (const auto& [name, value] : fields) {
      json_.key(name);
      write_value(json_, value, style_);
    }
    for (const char* name : {"clips", "clipSets"}) {
      if (prim.has_authored_metadata(name)) {
        json_.key(name);
        write_value(json_, prim.metadata(name), style_);
      }
    }
    json_.end_object();
  }

  void write_variant_sets(const Prim& prim) {
    const std::vector<std::string> sets = prim.variant_set_names();
    if (sets.empty()) {
      return;
    }
    json_.key("variantSets");
    json_.begin_object();
    for (const std::string& set : sets) {
      json_.key(set);
      json_.begin_object();
      json_.key("selection");
      json_.string(prim.variant_selection(set));
      write_strings("variants", prim.variant_names(set));
      json_.end_object();
    }
    json_.end_object();
  }

  void write_properties(const Prim& prim) {
    json_.key("properties");
    json_.begin_object();
    const auto names = options_.builtins ? prim.property_names() : prim.authored_property_names();
    for (const Token name : names) {
      json_.key(name.view());
      json_.begin_object();
      if (prim.is_relationship(name)) {
        write_relationship(json_, prim.relationship(name), style_);
      } else {
        write_attribute(json_, prim.attribute(name), style_);
      }
      if (options_.stacks) {
        write_stack(prim.is_relationship(name) ? prim.relationship(name).spec_stack()
                                               : prim.attribute(name).spec_stack());
      }
      json_.end_object();
    }
    json_.end_object();
  }

  void write_stack(const std::vector<stage::SpecSite>& sites) {
    json_.key("stack");
    json_.begin_array();
    for (const stage::SpecSite& site : sites) {
      json_.begin_array();
      json_.string(layer_text(*site.layer));
      json_.string(site.path.str());
      json_.end_array();
    }
    json_.end_array();
  }

  void write_prototypes() {
    std::map<std::string, Prim> prims;
    for (const Prim& prototype : stage_.prototypes()) {
      prims.emplace(path_text(prototype.path()), prototype);
      for (const Prim& prim : traverse(prototype, false)) {
        prims.emplace(path_text(prim.path()), prim);
      }
    }
    json_.key("prototypes");
    json_.begin_object();
    for (const auto& [name, prim] : prims) {
      json_.key(name);
      write_prim(prim);
    }
    json_.end_object();
    json_.key("prototypeInstances");
    json_.begin_object();
    for (const auto& [name, users] : prototype_users_) {
      write_strings(name, users);
    }
    json_.end_object();
  }

  const stage::Stage& stage_;
  const DumpOptions& options_;
  JsonWriter json_;
  ValueStyle style_;
  stage::TransformCache transforms_;
  std::filesystem::path folder_;
  std::vector<Prim> prims_;
  std::map<std::string, std::string> prototype_names_;
  std::map<std::string, std::set<std::string>> prototype_users_;
};

}  // namespace

void write_stage_dump(const stage::Stage& stage, const DumpOptions& options, std::ostream& out) {
  StageDump(stage, options, out).write();
}

}  // namespace tenon::answers
