// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A stack is the depth-first list of a layer and its sublayers, first the session's, then the
// root's. Sublayers are opened in a loop per layer. Depth and count are limited, and so is what
// cannot be opened: layers that name one another make more such names than layers. All of it counts
// as work of the stage, which has many stacks.
#include "tenon/compose/layer_stack.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "tenon/base/limits/fault_limits.h"
#include "tenon/base/limits/limits.h"
#include "tenon/compose/arcs/relocations.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/compose/muting.h"
#include "tenon/compose/twins/site_trace.h"
#include "tenon/compose/work/work_meter.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

namespace fields = layer::fields;

constexpr std::size_t kLayerUnits = 20;  // of work for a layer of a stack

struct Sublayer {
  layer::LayerPtr layer;
  layer::LayerOffset offset;  // to the stack's time
};

class Builder {
 public:
  Builder(const LayerStackInputs& inputs, LayerStack& stack) : inputs_(inputs), stack_(stack) {}

  void build() {
    const double root_rate = stack_.root->time_codes_per_second();
    stack_.time_codes_per_second = root_rate;
    layer::LayerOffset root_offset;
    const bool use_session = stack_.session != nullptr && !is_muted(*stack_.session);
    if (use_session) {
      const double session_rate = stack_.session->time_codes_per_second();
      layer::LayerOffset session_offset;
      if (session_sets_time_codes(*stack_.session, *stack_.root)) {
        stack_.time_codes_per_second = session_rate;
        root_offset.scale = rate_ratio(session_rate, root_rate);
      } else {
        session_offset.scale = rate_ratio(root_rate, session_rate);
      }
      add(stack_.session, session_offset, 0);
      for (const StackedLayer& stacked : stack_.layers) {
        if (const auto* owner = stacked.layer->root().get<std::string>(fields::sessionOwner)) {
          session_owner_ = *owner;
          break;
        }
      }
    }
    add(stack_.root, root_offset, 0);
    for (const StackedLayer& stacked : stack_.layers) {
      stack_.has_offsets = stack_.has_offsets || !stacked.offset.is_identity();
    }
  }

 private:
  bool is_muted(const layer::Layer& layer) const {
    return inputs_.muted != nullptr && inputs_.muted->count(layer.identifier()) != 0;
  }

  /// Whether this is the maximum of a stack, which is reported the first time.
  bool is_full(const layer::Layer& layer) {
    const bool full = stack_.layers.size() >= limits::kLayerStackLayers ||
                      stack_.errors.size() >= limits::kStageFindings ||
                      (inputs_.work != nullptr && inputs_.work->exhausted());
    if (full) {
      report_limit(layer);
    }
    return full;
  }

  void report_limit(const layer::Layer& layer) {
    if (!limit_reported_) {
      limit_reported_ = true;
      report(error_class::kCapacityExceeded, layer,
             "there are too many sublayers; the rest is skipped", "use fewer sublayers", {});
    }
  }

  void count(std::size_t units) const {
    if (inputs_.work != nullptr) {
      inputs_.work->count(units);
    }
  }

  /// Depth-first; `depth` counts sublayers above this layer.
  void add(const layer::LayerPtr& layer, const layer::LayerOffset& offset, std::size_t depth) {
    if (depth > limits::kSublayerDepth) {
      return report_limit(*layer);
    }
    if (depth > 0 && is_full(*layer)) {
      return;
    }
    stack_.layers.push_back({layer, offset});
    count(kLayerUnits);
    if (layer->sublayers().empty()) {
      return;
    }
    open_.push_back(layer.get());
    std::vector<Sublayer> sublayers = open_sublayers(*layer, offset);
    put_owned_first(*layer, sublayers);
    for (const Sublayer& sublayer : sublayers) {
      add(sublayer.layer, sublayer.offset, depth + 1);
    }
    open_.pop_back();
  }

  std::vector<Sublayer> open_sublayers(const layer::Layer& layer,
                                       const layer::LayerOffset& offset) {
    std::vector<Sublayer> result;
    const std::vector<std::string>& paths = layer.sublayers();
    for (std::size_t i = 0; i < paths.size() && !is_full(layer); ++i) {
      const std::string path = evaluated(paths[i], layer);
      if (path.empty() ||
          (inputs_.muted != nullptr && compose::is_muted(*inputs_.muted, path, layer))) {
        continue;
      }
      const layer::LayerPtr sublayer = open(path, paths[i], layer);
      if (sublayer == nullptr) {
        continue;
      }
      layer::LayerOffset own = usable_offset(layer, *sublayer, i);
      own.scale *= rate_ratio(layer.time_codes_per_second(), sublayer->time_codes_per_second());
      result.push_back({sublayer, offset * own});
    }
    return result;
  }

  std::string evaluated(const std::string& path, const layer::Layer& layer) {
    if (!is_variable_expression(path)) {
      return path;
    }
    ExpressionResult result = evaluate_text(path, stack_.expression_variables);
    if (!result.errors.empty()) {
      report(error_class::kVariableExpressionError, layer,
             "sublayer expression " + path + ": " + result.errors, "correct the expression", path);
    }
    return result.text;
  }

  /// nullptr, with a finding, for a layer that is absent, muted or already open above.
  layer::LayerPtr open(const std::string& path, const std::string& authored,
                       const layer::Layer& layer) {
    Result<layer::LayerPtr> opened = (*inputs_.opener)(path, layer);
    if (!opened || *opened == nullptr) {
      stack_.missing.push_back({layer.identifier(), Path::absolute_root(), "subLayer", path});
      report(error_class::kInvalidSublayerPath, layer,
             "sublayer @" + path + "@ cannot be opened" +
                 (opened ? std::string() : ": " + opened.error().message()),
             "correct the path or remove the sublayer", authored);
      return nullptr;
    }
    if (is_muted(**opened)) {
      return nullptr;
    }
    if (std::find(open_.begin(), open_.end(), opened->get()) != open_.end()) {
      report(error_class::kSublayerCycle, layer,
             "sublayer @" + path + "@ contains this layer again and is skipped",
             "break the cycle of sublayers", authored);
      return nullptr;
    }
    return *opened;
  }

  layer::LayerOffset usable_offset(const layer::Layer& layer, const layer::Layer& sublayer,
                                   std::size_t i) {
    const layer::LayerOffset offset = layer.sublayer_offset(i);
    if (is_usable(offset)) {
      return offset;
    }
    report(error_class::kInvalidSublayerOffset, layer,
           "the offset of sublayer @" + sublayer.identifier() +
               "@ is not finite or its scale is not positive; none is used",
           "author a finite offset and a positive scale", layer.sublayers()[i]);
    return {};
  }

  /// Sublayers of the session's owner come first where a layer lets its sublayers be owned.
  void put_owned_first(const layer::Layer& layer, std::vector<Sublayer>& sublayers) {
    if (session_owner_.empty() || !layer.root().get_or(fields::hasOwnedSubLayers, false)) {
      return;
    }
    const auto owned = [&](const Sublayer& sublayer) {
      const auto* owner = sublayer.layer->root().get<std::string>(fields::owner);
      return owner != nullptr && *owner == session_owner_;
    };
    const auto end = std::stable_partition(sublayers.begin(), sublayers.end(), owned);
    if (end - sublayers.begin() > 1) {
      report(error_class::kInvalidSublayerOwnership, layer,
             "several sublayers have the owner '" + session_owner_ + "'",
             "give each sublayer its own owner", {});
    }
  }

  /// `sublayer` as it is authored; empty where the finding is about all of them.
  void report(std::string_view error_class, const layer::Layer& layer, const Message& message,
              std::string fix, const std::string& sublayer) {
    count(kFindingUnits);
    const StatementPart part =
        layer::item_part(fields::subLayers, layer::item_text(sublayer, Path()));
    stack_.errors.add(composition_error(error_class, Severity::Error,
                                        {&layer, Path::absolute_root(), {}, part}, message,
                                        std::move(fix)));
  }

  const LayerStackInputs& inputs_;
  LayerStack& stack_;
  std::string session_owner_;
  std::vector<const layer::Layer*> open_;  // the layer being read and all above it
  bool limit_reported_ = false;
};

const layer::Dictionary* authored_variables(const layer::Layer& layer) {
  return layer.root().get<layer::Dictionary>(fields::expressionVariables);
}

/// Variables of the referencing stack win over the session's, and those over the root layer's.
void compose_variables(LayerStack& stack, const LayerStack* override_source) {
  stack.override_source = override_source;
  layer::Dictionary own;
  for (const layer::LayerPtr& layer : {stack.session, stack.root}) {
    if (const auto* authored = layer == nullptr ? nullptr : authored_variables(*layer)) {
      own = layer::merge(own, *authored);
    }
  }
  if (override_source == nullptr) {
    stack.expression_variables = std::move(own);
    stack.expression_source = &stack;
    return;
  }
  stack.expression_variables = layer::merge(override_source->expression_variables, own);
  const bool same = stack.expression_variables == override_source->expression_variables;
  stack.expression_source = same ? override_source : &stack;
}

const Path* find_pair(const MapFunction::Pairs& pairs, Path path) {
  const auto it = std::lower_bound(
      pairs.begin(), pairs.end(), path,
      [](const MapFunction::Pair& pair, Path wanted) { return pair.first < wanted; });
  return it != pairs.end() && it->first == path ? &it->second : nullptr;
}

}  // namespace

bool is_usable(const layer::LayerOffset& offset) {
  return std::isfinite(offset.offset) && std::isfinite(offset.scale) && offset.scale > 0;
}

double rate_ratio(double rate, double other) {
  const double ratio = rate / other;
  return std::isfinite(ratio) && ratio != 0 ? ratio : 1;  // below zero, time runs backwards
}

bool session_sets_time_codes(const layer::Layer& session, const layer::Layer& root) {
  return session.root().has(fields::timeCodesPerSecond) ||
         (!root.root().has(fields::timeCodesPerSecond) &&
          session.root().has(fields::framesPerSecond));
}

const Path* LayerStack::relocation_target(Path source) const {
  return relocates.empty() ? nullptr : find_pair(relocates, source);
}

const Path* LayerStack::relocation_source(Path target) const {
  return relocates_by_target.empty() ? nullptr : find_pair(relocates_by_target, target);
}

bool LayerStack::has_spec(Path path) const {
  SiteTrace::note(*this, path);
  return std::any_of(layers.begin(), layers.end(),
                     [&](const StackedLayer& stacked) { return stacked.layer->has(path); });
}

std::shared_ptr<LayerStack> build_layer_stack(const LayerStackInputs& inputs) {
  auto stack = std::make_shared<LayerStack>();
  stack->root = inputs.root;
  stack->session = inputs.session;
  compose_variables(*stack, inputs.override_source);
  Builder(inputs, *stack).build();
  compose_relocates(*stack);
  return stack;
}

MapFunction relocates_map(const LayerStack& stack, Path path) {
  MapFunction::Pairs pairs;
  std::unordered_set<Path> sources;
  std::unordered_set<Path> targets;
  const auto add = [&](const MapFunction::Pairs& relocates) {
    for (const auto& [source, target] : relocates) {
      if (!target.empty() && source.has_prefix(path) && targets.count(target) == 0 &&
          sources.insert(source).second) {
        targets.insert(target);
        pairs.emplace_back(source, target);
      }
    }
  };
  add(stack.combined_relocates);
  add(stack.relocates);
  pairs.emplace_back(Path::absolute_root(), Path::absolute_root());
  return MapFunction::make(std::move(pairs));
}

}  // namespace tenon::compose
