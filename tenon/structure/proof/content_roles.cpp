// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/layer/fields.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/proof/content.h"

namespace tenon::structure {
namespace {

using layer::Layer;

bool is_simulated(Role role) { return role == Role::Physics || is_engine(role); }

class RoleFilter {
 public:
  RoleFilter(Layer& content, RoleSet present) : content_(content), present_(present) {}

  void run() {
    for (const Path& prim : prims_below(content_)) {
      if (!content_.has(prim)) {
        continue;  // went with one above
      }
      if (goes(owner_of_type(type_of(content_, prim)).owner)) {
        remove_with_scopes(prim);
        continue;
      }
      filter_prim(prim);
    }
    drop_lost_targets();
  }

 private:
  bool goes(Role owner) const { return is_simulated(owner) && !present_.contains(owner); }

  void filter_prim(Path prim) {
    const Token type = type_of(content_, prim);
    std::vector<Token> apis = apis_of(content_, prim);
    // A material does nothing by itself: its neutral physics may stay.
    const auto is_lost = [&](Role owner) {
      return goes(owner) && !(type == "Material" && owner == Role::Physics);
    };
    for (const Path& property : properties_of(content_, prim)) {
      if (is_lost(owner_of_property(property.name(), type, apis).owner)) {
        remove_property(content_, property);
      }
    }
    const std::size_t before = apis.size();
    std::erase_if(apis, [&](Token api) { return is_lost(owner_of_api(api).owner); });
    if (apis.size() != before) {
      set_apis(*content_.find(prim), std::move(apis));
    }
  }

  /// Of thousands no more than two are looked at.
  bool has_one_child(Path prim) const {
    std::size_t count = 0;
    for (const Token name : content_.children(prim, layer::fields::primChildren)) {
      count += content_.has(prim.child(name)) ? 1 : 0;
      if (count > 1) {
        return false;
      }
    }
    return count == 1;
  }

  /// A scope was there for what it held.
  void remove_with_scopes(Path prim) {
    Path at = prim;
    while (at.parent().is_prim() && type_of(content_, at.parent()) == "Scope" &&
           has_one_child(at.parent()) && properties_of(content_, at.parent()).empty()) {
      at = at.parent();
    }
    remove_tree(content_, at);
  }

  void drop_lost_targets() {
    for (const Path& prim : prims_below(content_)) {
      for (const Path& property : properties_of(content_, prim)) {
        layer::Spec& spec = *content_.find(property);
        if (owner_of_property(property.name(), Token(), {}).owner == Role::Robot) {
          std::vector<Path> targets = targets_of(spec);
          const std::size_t before = targets.size();
          std::erase_if(targets, [&](Path target) { return !content_.has(target); });
          if (targets.empty() && before != 0) {
            spec.erase(layer::fields::targetPaths);
          } else if (targets.size() != before) {
            set_targets(spec, std::move(targets));
          }
        }
      }
    }
  }

  Layer& content_;
  RoleSet present_;
};

}  // namespace

void keep_roles(Layer& content, RoleSet present) { RoleFilter(content, present).run(); }

bool has_opinion_of(const Layer& content, Path prim, Role owner) {
  const Token type = type_of(content, prim);
  const std::vector<Token> apis = apis_of(content, prim);
  const std::vector<Path> properties = properties_of(content, prim);
  return std::any_of(apis.begin(), apis.end(),
                     [&](Token api) { return owner_of_api(api).owner == owner; }) ||
         std::any_of(properties.begin(), properties.end(), [&](Path property) {
           return owner_of_property(property.name(), type, apis).owner == owner;
         });
}

bool has_content_of(const Layer& content, Role owner) {
  const std::vector<Path> prims = prims_below(content);
  return std::any_of(prims.begin(), prims.end(), [&](Path prim) {
    return owner_of_type(type_of(content, prim)).owner == owner ||
           has_opinion_of(content, prim, owner);
  });
}

}  // namespace tenon::structure
