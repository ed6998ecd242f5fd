// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/layer.h"

/// Layers as trees of prims: functions to split and to join them. Prims in variants are not seen.
/// The `children` fields are kept in step with the specs.
namespace tenon::structure {

using PathMap = std::function<Path(Path)>;

/// The prims at and below `root`, which may be the root of the layer and is not included then;
/// parents before children, children in order. The layer has a spec for each of them.
std::vector<Path> prims_below(const layer::Layer& layer, Path root = Path::absolute_root());
/// Child prims of a prim that are in the layer, with a spec for each.
std::vector<Path> child_prims(const layer::Layer& layer, Path prim);
/// An unused child path of `parent`: of that name, or else with a number, `name_1`.
Path free_child(Path parent, const std::string& name, const std::function<bool(Path)>& is_taken);
/// Properties of a prim that are in the layer, with a spec for each.
std::vector<Path> properties_of(const layer::Layer& layer, Path prim);

/// A layer with the fields of another one's root, and no prims.
layer::Layer without_prims(const layer::Layer& layer, std::string identifier);
/// "xformOpOrder", or one of the ops.
bool is_transform(Token property);

/// The prim at `path`, made with those above it, as overs, where it is missing.
layer::Spec& make_prim(layer::Layer& layer, Path path);
layer::Spec& define_prim(layer::Layer& layer, Path path, Token type);
/// A copy of a property spec with the paths in it replaced; its prim must be there.
layer::Spec& put_property(layer::Layer& layer, Path path, const layer::Spec& spec,
                          const PathMap& map = {});
/// The fields of a prim other than its lists of children.
void put_prim_fields(layer::Spec& to, const layer::Spec& from);
void remove_tree(layer::Layer& layer, Path prim);
void remove_property(layer::Layer& layer, Path property);
/// Copies a prim with all below it to `to` in the same or another layer; paths in it are replaced
/// by `map`, or where there is none those below `from` by those below `to`.
void copy_tree(const layer::Layer& source, Path from, layer::Layer& target, Path to,
               const PathMap& map = {});
/// Puts a child into the place among its siblings that it has in `like`, where it is known.
void place_child_like(layer::Layer& layer, Path child, const layer::Layer& like);

Token type_of(const layer::Layer& layer, Path prim);
std::vector<Token> apis_of(const layer::Layer& layer, Path prim);
/// Writes the list as `prepend apiSchemas`; an empty one is erased.
void set_apis(layer::Spec& prim, std::vector<Token> apis);
bool has_api(const layer::Layer& layer, Path prim, std::string_view api);
/// Applies an API schema, after those that the prim has; nothing where it has it. A prim that is
/// not there becomes an over.
void add_api(layer::Layer& layer, Path prim, Token api);
/// False where the layer switches the prim off itself, or has no spec of it.
bool is_active(const layer::Layer& layer, Path prim);

/// Targets of a relationship or connections of an attribute.
std::vector<Path> targets_of(const layer::Spec& property);
void set_targets(layer::Spec& property, std::vector<Path> targets);
/// Robot tools want their lists of links and joints as `prepend rel`.
void prepend_robot_lists(layer::Spec& property, Token name);

}  // namespace tenon::structure
