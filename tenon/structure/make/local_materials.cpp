// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/local_materials.h"

#include <map>
#include <unordered_map>

#include "tenon/layer/fields.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/mesh_wrappers.h"

namespace tenon::structure {
namespace {

using layer::Layer;

/// Where the copy of a material comes below one wrapper; copied when first asked for.
class Copies {
 public:
  Copies(Layer& content, Path wrapper, Token scope)
      : content_(content), scope_(wrapper.child(scope)) {}

  Path of(Path material) {
    const auto known = copies_.find(material);
    if (known != copies_.end()) {
      return known->second;
    }
    if (!content_.has(scope_)) {
      define_prim(content_, scope_, "Scope");
    }
    Path copy = scope_.child(material.name());
    std::size_t& last = last_[material.name()];
    while (content_.has(copy)) {
      copy = scope_.child(Token(material.name().str() + "_" + std::to_string(++last)));
    }
    copy_tree(content_, material, content_, copy);
    copies_.emplace(material, copy);
    return copy;
  }

 private:
  Layer& content_;
  Path scope_;
  std::map<Path, Path> copies_;
  std::unordered_map<Token, std::size_t> last_;  // number behind a name
};

}  // namespace

std::vector<Path> wrapped_meshes(const Layer& content) {
  std::vector<Path> meshes;
  for (const Path& prim : prims_below(content)) {
    if (type_of(content, prim) == "Mesh") {
      meshes.push_back(prim);
    }
  }
  return meshes;
}

void localize_materials(Layer& content, std::string_view scope) {
  for (const Path& mesh : wrapped_meshes(content)) {
    const Path wrapper = mesh.parent();
    Copies copies(content, wrapper, Token(scope));
    for (const Path& prim : prims_below(content, mesh)) {
      for (const Path& property : properties_of(content, prim)) {
        if (content.find(property)->kind != layer::SpecKind::Relationship) {
          continue;
        }
        std::vector<Path> targets = targets_of(*content.find(property));
        bool changed = false;
        for (Path& target : targets) {
          if (!target.has_prefix(wrapper) && type_of(content, target) == "Material") {
            target = copies.of(target);
            changed = true;
          }
        }
        if (changed) {
          set_targets(*content.find(property), std::move(targets));
        }
      }
    }
  }
}

}  // namespace tenon::structure
