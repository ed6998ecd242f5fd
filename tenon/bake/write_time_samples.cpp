// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/write_time_samples.h"

#include "tenon/bake/body_transforms.h"
#include "tenon/bake/instance_arrays.h"
#include "tenon/bake/op_stack.h"
#include "tenon/bake/over_specs.h"
#include "tenon/layer/metadata_fields.h"

namespace tenon::bake {
namespace {

using layer::Value;

double code_of(const scene::PhysicsScene& scene, double seconds) {
  return scene.start_time_code + seconds * scene.time_codes_per_second;
}

/// A value of another type, which a crate can hold, is skipped: it means nothing to a reader.
void copy_metadata(const stage::Stage& stage, Token name, layer::Spec& root) {
  if (stage.has_authored_metadata(name)) {
    const Value value = stage.metadata(name);
    if (layer::is_value_of_metadata(name, layer::SpecKind::PseudoRoot, value)) {
      root.set(name, value);
    }
  }
}

/// Metadata that a sublayer does not give to the stage on top of it.
void write_metadata(const stage::Stage& stage, const scene::PhysicsScene& scene,
                    const PoseRecording& recording, const BakeOptions& options,
                    layer::Layer& layer) {
  layer::Spec& root = layer.root();
  const double end = recording.times.empty() ? 0 : recording.times.back();
  root.set("defaultPrim", Value(stage.root_layer().default_prim()));
  root.set("endTimeCode", Value(code_of(scene, end)));
  for (const char* field : {"framesPerSecond", "kilogramsPerUnit", "metersPerUnit"}) {
    copy_metadata(stage, Token(field), root);
  }
  root.set("startTimeCode", Value(scene.start_time_code));
  root.set("subLayers", Value(std::vector<std::string>{options.asset_path}));
  root.set("timeCodesPerSecond", Value(scene.time_codes_per_second));
  copy_metadata(stage, Token("upAxis"), root);
  if (stage.root_layer().default_prim().empty()) {
    root.erase("defaultPrim");
  }
}

void write_selections(const BakeOptions& options, layer::Layer& layer) {
  for (const auto& [prim, variants] : options.variant_selections) {
    layer::VariantSelections selections;
    for (const auto& [set, variant] : variants) {
      selections.items.emplace(set, variant);
    }
    over_prim(layer, prim).set("variantSelection", Value(std::move(selections)));
  }
}

/// All samples of one body; false when its op stack cannot hold them.
bool collect(BodyTransforms& transforms, std::size_t body, const PoseRecording& recording,
             const scene::PhysicsScene& scene, OpStack& stack) {
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) {
    const double code = code_of(scene, recording.times[frame]);
    if (!stack.add(code, transforms.local(body, recording, frame, code))) {
      return false;
    }
  }
  return true;
}

void report_instanced(const stage::Prim& prim, Diagnostics& diagnostics) {
  Diagnostic finding = prim.located(
      Severity::Error, "bake.instanced-body",
      "the body <" + prim.path().str() + "> is inside an instance and cannot be animated");
  finding.fix =
      "make the instances unique (tenon bake --uninstance), or put the rigid body on the instance "
      "root";
  diagnostics.add(std::move(finding));
}

/// Makes the prims above an instance proxy ordinary ones, which opinions reach.
void take_apart(const stage::Prim& proxy, layer::Layer& layer) {
  for (stage::Prim at = proxy.parent(); at.is_valid() && !at.is_pseudo_root(); at = at.parent()) {
    if (at.is_instance()) {
      over_prim(layer, at.path()).set("instanceable", Value(false));
    }
  }
}

}  // namespace

layer::Layer write_time_samples(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                const PoseRecording& recording, const BakeOptions& options,
                                Diagnostics& diagnostics) {
  layer::Layer layer("bake.usda");
  layer.set_may_lack_text();  // the stage may, and so may the name of its file
  write_metadata(stage, scene, recording, options, layer);
  write_selections(options, layer);
  BodyTransforms transforms(stage, scene);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const stage::Prim prim = stage.prim(scene.bodies[body].path);
    if (scene.bodies[body].kinematic || !prim.is_valid()) {
      continue;
    }
    if (prim.is_instance_proxy()) {
      if (!options.uninstance) {
        report_instanced(prim, diagnostics);
        continue;
      }
      take_apart(prim, layer);
    }
    OpStack stack = OpStack::of(prim, scene.start_time_code);
    if (!collect(transforms, body, recording, scene, stack)) {
      stack.use_matrix();
      collect(transforms, body, recording, scene, stack);
    }
    stack.write(layer, prim.path());
  }
  write_instance_arrays(stage, scene, recording, transforms, layer, diagnostics);
  return layer;
}

}  // namespace tenon::bake
