// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/editing/prim_sites.h"

#include "tenon/base/text/shown_path.h"
#include "tenon/compose/prim_index.h"
#include "tenon/stage/sources/opinion_sources.h"

namespace tenon {
namespace {

class SiteSearch {
 public:
  SiteSearch(const structure::RolesOfFiles& roles, Path prim) : roles_(roles), prim_(prim) {}

  Result<void> look(const stage::Stage& stage) {
    const stage::Prim found = stage.prim(prim_);
    if (!found) {
      return {};
    }
    if (found.is_instance_proxy() || found.is_in_prototype()) {
      return Error(ErrorCode::Invalid,
                   "<" + prim_.str() + "> is inside an instance: all instances share it")
          .with_prim(prim_.str())
          .with_rule("edit.instance-proxy")
          .with_fix("edit the file that they share; tenon where names it");
    }
    there_ = true;
    const auto site = stage::site_in_layer(stage, prim_, stage.root_layer().identifier());
    if (!site || site->index == nullptr) {
      return {};
    }
    for (const compose::Node& node : site->index->nodes()) {
      if (!node.due_to_direct_arc && (node.due_to_ancestor || node.arc == compose::ArcKind::Root)) {
        TENON_CHECK(add(stage, node));
      }
    }
    return {};
  }

  Result<PrimSites> sites() const {
    if (!there_) {
      return Error(ErrorCode::NotFound, "there is no prim <" + prim_.str() + ">, in no variant")
          .with_prim(prim_.str())
          .with_rule("edit.no-prim")
          .with_fix("tenon tree lists all prims");
    }
    return sites_;
  }

 private:
  bool is_own(const stage::Stage& stage, const compose::Node& node, const std::string& layer) {
    if (node.layer_stack == &stage.layer_stack() || node.arc == compose::ArcKind::Root) {
      return true;
    }
    const auto role = roles_.find(layer);
    return role != roles_.end() && role->second != structure::Role::Other;
  }

  Result<void> add(const stage::Stage& stage, const compose::Node& node) {
    const Path path = node.path.strip_variants();
    for (const compose::StackedLayer& stacked : node.layer_stack->layers) {
      const std::string& layer = stacked.layer->identifier();
      if (stacked.layer == node.layer_stack->session) {
        continue;
      }
      const bool own = is_own(stage, node, layer);
      const bool same = own && sites_.emplace(layer, path).first->second == path;
      if (!same && node.has_specs) {
        return over_arc(layer, path);
      }
    }
    return {};
  }

  Error over_arc(const std::string& layer, Path path) const {
    Message message = "<" + prim_.str() + "> comes over an arc of a prim above it, from <" +
                      path.str() + "> of " + shown_path(layer);
    message.about(path, RelatedRole::Prim, layer);
    return Error(ErrorCode::Invalid, message)
        .with_prim(prim_.str())
        .with_rule("edit.over-arc")
        .with_fix("edit that file: tenon where names all that define it");
  }

  const structure::RolesOfFiles& roles_;
  Path prim_;
  bool there_ = false;
  PrimSites sites_;
};

}  // namespace

Result<PrimSites> own_sites(const std::vector<std::shared_ptr<const stage::Stage>>& stages,
                            const structure::RolesOfFiles& roles, Path prim) {
  SiteSearch search(roles, prim);
  for (const auto& stage : stages) {
    TENON_CHECK(search.look(*stage));
  }
  return search.sites();
}

}  // namespace tenon
