// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/convert_robot.h"

#include "tenon/convert/bodies.h"
#include "tenon/convert/contacts.h"
#include "tenon/convert/joints.h"
#include "tenon/convert/link_prims.h"
#include "tenon/convert/loops.h"
#include "tenon/convert/mujoco_parts.h"
#include "tenon/convert/mujoco_sensors.h"
#include "tenon/convert/physics_scene.h"
#include "tenon/convert/prepare_joints.h"
#include "tenon/convert/robot_layer.h"
#include "tenon/convert/robot_metadata.h"
#include "tenon/convert/rules/apply_rules.h"
#include "tenon/convert/sensors.h"
#include "tenon/convert/shapes/material_writer.h"
#include "tenon/convert/shapes/shape_writer.h"
#include "tenon/convert/source/record.h"
#include "tenon/robot/merge_fixed.h"

namespace tenon::convert {
namespace {

/// A layer and the images that its meshes brought along.
struct LayerAndImages {
  layer::Layer layer;
  InnerImages images;
};

/// The passes of a conversion. Their output is in the order of the layer: links with their shapes
/// down the tree, then joints, then everything beside the tree.
Result<LayerAndImages> write_robot(const Source& source, Diagnostics& diagnostics) {
  const robot::RobotModel& model = source.model;
  RobotLayer layer(model, diagnostics);
  TENON_TRY(const LinkPrims links, place_links(source, layer.robot()));
  define_links(source, links, layer);
  MaterialWriter materials(layer, model, source.options);
  ShapeWriter shapes(source, links, materials, layer);
  for (const robot::Index link : source.tree.order) {
    write_body(source, links, link, layer);
    shapes.write(link);
  }
  note_unused_density(source, links, layer);
  write_excluded_pairs(model, links, layer.builder());
  PhysicsScope physics(layer);
  const JointPrims joints = write_joints(source, links, physics);
  write_robot_apart(source, links, physics);
  write_contact_classes(physics, model.contact_classes, shapes.prims().contact_members);
  write_loops(model.loops, links, physics);
  const MujocoPrims mujoco = write_mujoco_parts(model.mujoco, joints, shapes.prims(), physics);
  const InstrumentPrims instruments = write_sensors(source, links, joints, shapes.prims(), layer);
  write_mujoco_sensors(source, {links, joints, shapes.prims(), mujoco, instruments}, physics);
  write_scene(source, physics);
  write_robot_metadata(source, links, joints, layer);
  return LayerAndImages{layer.take(), materials.take_images()};
}

}  // namespace

Result<layer::Layer> convert_robot(robot::RobotModel model, const ConvertOptions& given,
                                   Diagnostics& diagnostics, InnerImages* images) {
  TENON_TRY(robot::KinematicTree tree, robot::kinematic_tree(model));
  ConvertOptions options = given;
  TENON_CHECK(apply_rules(model, options));
  robot::sanitize_model(model, diagnostics);
  if (options.merge_fixed) {
    drop_merged_sensors(model, diagnostics);
    model = robot::merge_fixed(model, tree);
    TENON_TRY(tree, robot::kinematic_tree(model));
  }
  prepare_joints(options, model, diagnostics);
  TENON_TRY(LayerAndImages written, write_robot({model, tree, options}, diagnostics));
  if (options.keep_source) {
    write_source(model, options, written.layer, diagnostics);
  }
  if (images != nullptr) {
    *images = std::move(written.images);
  }
  return std::move(written.layer);
}

}  // namespace tenon::convert
