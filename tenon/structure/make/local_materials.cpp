// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/local_materials.h"

#include <map>
#include <set>
#include <unordered_map>

#include "tenon/base/limits/work_limits.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/mesh_wrappers.h"

namespace tenon::structure {
namespace {

using layer::Layer;
using layer::Spec;

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

bool is_outer_material(const Layer& content, Path target, Path wrapper) {
  return !target.has_prefix(wrapper) && type_of(content, target) == "Material";
}

/// Materials outside of its wrapper that a mesh and its subsets name.
std::set<Path> outer_materials(const Layer& content, Path mesh) {
  std::set<Path> materials;
  for (const Path& prim : prims_below(content, mesh)) {
    for (const Path& property : properties_of(content, prim)) {
      const Spec& spec = *content.find(property);
      if (spec.kind != layer::SpecKind::Relationship) {
        continue;
      }
      for (const Path& target : targets_of(spec)) {
        if (is_outer_material(content, target, mesh.parent())) {
          materials.insert(target);
        }
      }
    }
  }
  return materials;
}

Result<void> check_copies(const Layer& content) {
  const std::size_t most =
      limits::kMaterialCopies + limits::kMaterialCopiesPerSpec * content.spec_count();
  std::map<Path, std::size_t> prims;  // of each material
  std::size_t copies = 0;
  for (const Path& mesh : wrapped_meshes(content)) {
    for (const Path& material : outer_materials(content, mesh)) {
      const auto [known, is_new] = prims.emplace(material, 0);
      if (is_new) {
        known->second = prims_below(content, material).size();
      }
      copies += known->second;
    }
    if (copies > most) {
      return Error(ErrorCode::Limit,
                   "each mesh gets a copy of its material, and all copies "
                   "together would have more than " +
                       std::to_string(most) + " prims")
          .with_rule("structure.materials")
          .with_prim(mesh.str())
          .with_fix("bind materials with fewer shaders, or make one mesh of several");
    }
  }
  return {};
}

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

Result<void> localize_materials(Layer& content, std::string_view scope) {
  TENON_CHECK(check_copies(content));
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
          if (is_outer_material(content, target, wrapper)) {
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
  return {};
}

}  // namespace tenon::structure
