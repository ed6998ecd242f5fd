// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The pose graph: each node has a place relative to another one, and the world is the root. Chains
// may be as long as there are nodes, so they are walked with a list. A model with a placement frame
// is turned round: its <pose> is the place of that frame, so the place of the model is that
// times the inverse of the frame's place in the model. Nested models come first there, for a
// placement frame may lie in one.
#include <algorithm>

#include "tenon/sdf/model_tree.h"

namespace tenon::sdf {
namespace {

Error cycle(const SdfNode& node, const char* what) {
  return node.file->fault(
      node.element, "sdf.cycle",
      "the " + std::string(what) + " of \"" + node.name + "\" leads back to itself",
      "let one frame of the cycle be relative to the model");
}

/// Calls `place` for each node after the one that `next` leads to. Errors: a cycle.
template <class Next, class Place>
Result<void> for_each_after(const ModelTree& tree, const char* what, Next next, Place place) {
  enum : char { kNew, kOpen, kDone };
  std::vector<char> state(tree.nodes.size(), kNew);
  state[0] = kDone;
  std::vector<Index> chain;
  for (Index start = 0; start < tree.nodes.size(); ++start) {
    Index at = start;
    for (; state[at] == kNew; at = next(at)) {
      state[at] = kOpen;
      chain.push_back(at);
    }
    if (state[at] == kOpen) {
      return cycle(tree.nodes[at], what);
    }
    for (; !chain.empty(); chain.pop_back()) {
      place(chain.back());
      state[chain.back()] = kDone;
    }
  }
  return {};
}

/// The place of `node` in `model`'s frame, which its chain leads to; none: it does not.
std::optional<Pose> place_in(const ModelTree& tree, Index node, Index frame) {
  Pose place;
  for (std::size_t steps = 0; node != frame; ++steps) {
    if (node == 0 || steps > tree.nodes.size()) {
      return std::nullopt;
    }
    place = tree.nodes[node].in_reference * place;
    node = tree.nodes[node].reference;
  }
  return place;
}

Result<void> place_by_frame(ModelTree& tree, Index number) {
  SdfModel& model = tree.models[number];
  SdfNode& node = tree.nodes[model.node];
  const auto frame = tree.find(number, model.placement_frame);
  if (!frame) {
    return node.file->fault(
        node.element, "sdf.frame-missing",
        "no frame of \"" + model.name + "\" is named \"" + model.placement_frame + "\"",
        "let placement_frame name a link, joint or frame of the model");
  }
  const auto place = place_in(tree, *frame, model.node);
  if (!place) {
    return cycle(node, "placement frame");
  }
  node.in_reference = node.pose.pose * inverse(*place);
  return {};
}

/// Frames and joints that move with a model move with a link of it.
Result<void> find_links(ModelTree& tree) {
  TENON_CHECK(for_each_after(
      tree, "attached_to",
      [&](Index at) {
        const SdfNode& node = tree.nodes[at];
        return node.kind == NodeKind::Frame || node.kind == NodeKind::Joint ? node.attached : 0;
      },
      [&](Index at) {
        SdfNode& node = tree.nodes[at];
        node.link = node.kind == NodeKind::Link    ? std::optional(at)
                    : node.kind == NodeKind::Model ? tree.models[node.model].first_link
                                                   : tree.nodes[node.attached].link;
      }));
  const auto is_empty = [&](Index at) {
    const SdfNode& node = tree.nodes[at];
    return node.kind == NodeKind::Model && !tree.models[node.model].first_link;
  };
  for (const SdfNode& node : tree.nodes) {
    if (node.kind == NodeKind::Joint && (is_empty(node.attached) || is_empty(node.parent))) {
      return node.file->fault(node.element, "sdf.frame-missing", "joins a model that has no link",
                              "name a link");
    }
  }
  return {};
}

}  // namespace

Result<void> place_nodes(ModelTree& tree) {
  for (SdfNode& node : tree.nodes) {
    node.in_reference = node.pose.pose;
  }
  TENON_CHECK(find_links(tree));
  for (auto i = static_cast<Index>(tree.models.size()); i-- > 1;) {
    if (!tree.models[i].placement_frame.empty()) {
      TENON_CHECK(place_by_frame(tree, i));
    }
  }
  return for_each_after(
      tree, "pose", [&](Index at) { return tree.nodes[at].reference; },
      [&](Index at) {
        SdfNode& node = tree.nodes[at];
        node.in_world = tree.nodes[node.reference].in_world * node.in_reference;
      });
}

Pose pose_between(const ModelTree& tree, Index a, Index b) {
  constexpr std::size_t kSteps = 64;
  std::vector<Index> above;  // a, and what it is relative to
  for (Index at = a; above.size() < kSteps; at = tree.nodes[at].reference) {
    above.push_back(at);
    if (at == 0) {
      break;
    }
  }
  Pose of_b;
  Index at = b;
  for (std::size_t steps = 0; steps < kSteps; ++steps, at = tree.nodes[at].reference) {
    const auto common = std::find(above.begin(), above.end(), at);
    if (common != above.end()) {
      Pose of_a;
      for (auto step = above.begin(); step != common; ++step) {
        of_a = tree.nodes[*step].in_reference * of_a;
      }
      return common == above.begin() ? of_b : inverse(of_a) * of_b;
    }
    of_b = tree.nodes[at].in_reference * of_b;
  }
  return inverse(tree.nodes[a].in_world) * tree.nodes[b].in_world;
}

}  // namespace tenon::sdf
