// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// First all elements are put into tables, in the order of the text, nested models and includes with
// a stack in the place of recursion. Names are looked up when all are there, since each may name
// what comes later. A merged model lends its elements to the model that includes it: they are
// among its names, and only their own <pose> counts from a frame that the merged model leaves
// behind.
#include "tenon/sdf/model_tree.h"

#include <algorithm>
#include <utility>

#include "tenon/base/limits/reading_limits.h"

namespace tenon::sdf {
namespace {

struct Pending {
  SdfFile* file = nullptr;
  pugi::xml_node element;  ///< <model> or <include>
  Index parent = 0;
  std::size_t depth = 0;
};

/// A model and what an <include> says of it.
struct Opened {
  SdfFile* file = nullptr;
  pugi::xml_node model;
  SdfFile* include_file = nullptr;
  pugi::xml_node include;  ///< none
};

class Gathering {
 public:
  explicit Gathering(ModelFiles& files) : files_(files) {}

  Result<ModelTree> run(const ChosenModel& chosen) {
    tree_.models.emplace_back();
    tree_.nodes.emplace_back();
    tree_.models[0].file = chosen.file;
    tree_.nodes[0].file = chosen.file;
    TENON_CHECK(take_world(chosen));
    pending_.push_back({chosen.file, chosen.element, 0, 0});
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      TENON_CHECK(take(next));
    }
    find_first_links();
    for (Index i = 1; i < tree_.nodes.size(); ++i) {
      TENON_CHECK(link_names(tree_.nodes[i]));
    }
    return std::move(tree_);
  }

 private:
  /// The frames of a world, which its models may name.
  Result<void> take_world(const ChosenModel& chosen) {
    tree_.models[0].element = chosen.world;
    for (const pugi::xml_node child : chosen.world.children("frame")) {
      TENON_CHECK(add_node(NodeKind::Frame, 0, *chosen.world_file, child));
    }
    return {};
  }

  Result<void> take(const Pending& next) {
    const bool is_include = std::string_view(next.element.name()) == "include";
    Opened opened{next.file, next.element, next.file, {}};
    if (is_include) {
      auto included = open(next);
      if (!included) {
        if (tree_.models.size() == 1) {
          return std::move(included).error();  // the chosen model itself
        }
        return {};
      }
      opened = *included;
    }
    if (next.depth > limits::kSdfDepth || tree_.models.size() > limits::kSdfModels) {
      return next.file->fault(
          next.element, "sdf.limit",
          next.depth > limits::kSdfDepth
              ? "models are nested deeper than " + std::to_string(limits::kSdfDepth)
              : "there are more than " + std::to_string(limits::kSdfModels) + " models",
          "convert the models on their own");
    }
    return add_model(opened, next);
  }

  /// What an <include> leads to; reported where there is none.
  Result<Opened> open(const Pending& next) {
    SdfFile& from = *next.file;
    const std::string uri = SdfFile::text_of(next.element.child("uri"));
    const auto skipped = [&](const char* rule, const std::string& message, std::string fix) {
      from.warn(next.element, rule, message + "; it is skipped", fix, Severity::Error);
      return from.fault(next.element, rule, message, std::move(fix));
    };
    auto file = files_.open_included(uri, from);
    if (!file) {
      const Diagnostic& why = file.error().diagnostic();
      const bool missing = why.rule.empty();
      return skipped(missing ? "sdf.include-missing" : why.rule.c_str(),
                     missing ? "\"" + uri + "\" cannot be found"
                             : "\"" + uri + "\" cannot be read: " + file.error().to_string(),
                     missing ? ModelFiles::advice(uri) : why.fix);
    }
    const pugi::xml_node model = (*file)->root().child("model");
    if (!model) {
      return skipped("sdf.include-missing", "\"" + uri + "\" has no model", "include a <model>");
    }
    return Opened{*file, model, next.file, next.element};
  }

  Result<void> add_model(const Opened& opened, const Pending& next) {
    SdfModel model;
    model.name = opened.include ? SdfFile::text_of(opened.include.child("name")) : "";
    if (model.name.empty()) {
      TENON_TRY(model.name, opened.file->attribute(opened.model, "name"));
    }
    model.parent = next.parent;
    model.file = opened.file;
    model.element = opened.model;
    const auto number = static_cast<Index>(tree_.models.size());
    const bool merged = number > 1 && opened.include && opened.include.attribute("merge").as_bool();
    const Index outer = tree_.models[next.parent].scope;
    model.scope = merged ? outer : number;
    const std::string& prefix = tree_.models[outer].prefix;
    model.prefix = number == 1 ? "" : merged ? prefix : prefix + model.name + "::";
    TENON_TRY(const bool fixed, opened.file->flag(opened.model, "static", false));
    TENON_TRY(const bool fixed_here, opened.include_file->flag(opened.include, "static", fixed));
    model.is_static = fixed_here || tree_.models[next.parent].is_static;
    model.placement_frame = SdfFile::text_of(opened.include.child("placement_frame"));
    if (model.placement_frame.empty()) {
      model.placement_frame = opened.model.attribute("placement_frame").value();
    }
    model.node = static_cast<Index>(tree_.nodes.size());
    SdfNode node{NodeKind::Model, prefix + model.name, number, opened.file, opened.model};
    if (opened.include) {
      node.file = opened.include_file;
      node.element = opened.include;
      TENON_TRY(node.pose, opened.include_file->pose(opened.include));
    }
    if (!node.pose.is_there) {
      TENON_TRY(node.pose, opened.file->pose(opened.model));
    }
    const std::string known_as = merged ? "_merged__" + model.name + "__model__" : model.name;
    if (!merged) {
      tree_.models[outer].children.emplace(model.name, number);
    }
    tree_.models.push_back(std::move(model));
    TENON_CHECK(register_node(std::move(node), outer, known_as));
    return take_elements(*opened.file, opened.model, number, next.depth + 1);
  }

  Result<void> take_elements(SdfFile& file, pugi::xml_node element, Index model,
                             std::size_t depth) {
    const std::size_t before = pending_.size();
    for (const pugi::xml_node child : element.children()) {
      const std::string_view kind = child.name();
      if (kind == "link") {
        TENON_CHECK(add_node(NodeKind::Link, model, file, child));
      } else if (kind == "joint") {
        TENON_CHECK(add_node(NodeKind::Joint, model, file, child));
      } else if (kind == "frame") {
        TENON_CHECK(add_node(NodeKind::Frame, model, file, child));
      } else if (kind == "model" || kind == "include") {
        pending_.push_back({&file, child, model, depth});
      }
    }
    std::reverse(pending_.begin() + static_cast<std::ptrdiff_t>(before), pending_.end());
    return {};
  }

  Result<void> add_node(NodeKind kind, Index model, SdfFile& file, pugi::xml_node element) {
    TENON_TRY(const std::string name, file.attribute(element, "name"));
    const Index scope = tree_.models[model].scope;
    SdfNode node{kind, tree_.models[scope].prefix + name, model, &file, element};
    TENON_TRY(node.pose, file.pose(element));
    if (kind == NodeKind::Link) {
      const auto number = static_cast<Index>(tree_.nodes.size());
      for (const Index holder : {model, scope}) {
        auto& first = tree_.models[holder].first_link;
        first = first ? first : std::optional(number);
      }
    }
    return register_node(std::move(node), scope, name);
  }

  Result<void> register_node(SdfNode node, Index scope, const std::string& name) {
    if (tree_.nodes.size() > limits::kSdfNodes) {
      return node.file->fault(node.element, "sdf.limit",
                              "there are more than " + std::to_string(limits::kSdfNodes) +
                                  " links, joints, frames and models",
                              "convert the models on their own");
    }
    const auto number = static_cast<Index>(tree_.nodes.size());
    const auto [known, is_new] = tree_.models[scope].nodes.emplace(name, number);
    if (!is_new) {
      const SdfNode& other = tree_.nodes[known->second];
      const std::uint32_t line = other.file->place_of(other.element).line;
      return node.file->fault(
          node.element, "sdf.duplicate-name",
          "the model \"" + tree_.models[scope].name + "\" has two elements named \"" + name + "\"" +
              (line == 0 ? "" : "; the first is in line " + std::to_string(line)),
          "rename one of them");
    }
    tree_.nodes.push_back(std::move(node));
    return {};
  }

  /// Of a model without links of its own: that of the first model in it.
  void find_first_links() {
    std::vector<char> own(tree_.models.size(), 0);
    for (std::size_t i = 0; i < own.size(); ++i) {
      own[i] = tree_.models[i].first_link ? 1 : 0;
    }
    for (std::size_t i = own.size(); i-- > 1;) {
      const SdfModel& model = tree_.models[i];
      SdfModel& parent = tree_.models[model.parent];
      if (own[model.parent] == 0 && model.first_link) {
        parent.first_link = model.first_link;
      }
    }
    tree_.models[0].first_link.reset();
  }

  /// The node that an element names.
  Result<Index> named(const SdfNode& node, Index model, const std::string& name) const {
    if (const auto found = tree_.find(model, name)) {
      return *found;
    }
    return node.file->fault(node.element, "sdf.frame-missing",
                            "no link, joint, frame or model is named \"" + name + "\" in \"" +
                                tree_.models[tree_.models[model].scope].name + "\"",
                            "name one that is there: NAME, or MODEL::NAME in a nested model");
  }

  Result<Index> end_of_joint(const SdfNode& node, const char* end) const {
    const std::string name = SdfFile::text_of(node.element.child(end));
    if (name.empty()) {
      return node.file->fault(node.element, "sdf.missing", std::string("needs a <") + end + ">",
                              std::string("add <") + end + ">NAME</" + end + ">");
    }
    return named(node, node.model, name);
  }

  Result<void> link_names(SdfNode& node) {
    const SdfModel& model = tree_.models[node.model];
    Index scope = node.model;
    Index reference = model.node;
    switch (node.kind) {
      case NodeKind::World:
      case NodeKind::Link:
        break;
      case NodeKind::Model:
        scope = model.parent;
        reference = tree_.models[model.parent].node;
        TENON_CHECK(choose_first_link(node));
        break;
      case NodeKind::Frame: {
        const std::string attached = node.element.attribute("attached_to").value();
        TENON_TRY(node.attached,
                  attached.empty() ? Result<Index>(reference) : named(node, scope, attached));
        reference = node.attached;
        break;
      }
      case NodeKind::Joint:
        TENON_TRY(node.parent, end_of_joint(node, "parent"));
        TENON_TRY(node.attached, end_of_joint(node, "child"));
        reference = node.attached;
        break;
    }
    node.reference = reference;
    if (!node.pose.relative_to.empty()) {
      TENON_TRY(node.reference, named(node, scope, node.pose.relative_to));
    }
    return {};
  }

  /// The canonical link that a model names.
  Result<void> choose_first_link(const SdfNode& node) {
    SdfModel& model = tree_.models[node.model];
    const std::string name = model.element.attribute("canonical_link").value();
    if (name.empty()) {
      return {};
    }
    TENON_TRY(const Index link, named(node, node.model, name));
    if (tree_.nodes[link].kind == NodeKind::Link) {
      model.first_link = link;
    }
    return {};
  }

  ModelFiles& files_;
  ModelTree tree_;
  std::vector<Pending> pending_;
};

}  // namespace

std::optional<Index> ModelTree::find(Index model, const std::string& name) const {
  if (name == "__model__") {
    return models[model].node;
  }
  Index at = models[model].scope;
  std::string rest = name;
  if (const auto found = models[at].nodes.find(rest); found != models[at].nodes.end()) {
    return found->second;
  }
  if (name == "world") {
    return Index{0};
  }
  for (std::size_t end = rest.find("::"); end != rest.npos; end = rest.find("::")) {
    const std::string first = rest.substr(0, end);
    const auto child = models[at].children.find(first);
    if (child != models[at].children.end()) {
      at = child->second;
    } else if (at != models[model].scope || first != models[at].name) {  // its own name in front
      return std::nullopt;
    }
    rest = rest.substr(end + 2);
    if (const auto found = models[at].nodes.find(rest); found != models[at].nodes.end()) {
      return found->second;
    }
  }
  return rest == "__model__" && rest != name ? std::optional(models[at].node) : std::nullopt;
}

Result<ModelTree> gather_model(const ChosenModel& chosen, ModelFiles& files) {
  return Gathering(files).run(chosen);
}

}  // namespace tenon::sdf
