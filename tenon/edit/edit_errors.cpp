// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/edit_errors.h"

namespace tenon::edit {

Error unknown_layer(const std::string& identifier) {
  return Error(ErrorCode::NotFound, "the root layer stack of the stage has no layer " + identifier)
      .with_rule("edit.outside-target")
      .with_fix("choose one of its sublayers, or a target behind an arc");
}

Error no_prim(Path prim) {
  return Error(ErrorCode::NotFound, "there is no prim <" + prim.str() + ">")
      .with_prim(prim.str())
      .with_rule("edit.no-prim")
      .with_fix("define it first; an inactive prim has no children");
}

Error bad_path(Path path, const std::string& wanted) {
  return Error(ErrorCode::Invalid, "<" + path.str() + "> is not " + wanted)
      .with_rule("edit.bad-path")
      .with_fix("write it from the root and without variant selections, as in /World/Robot");
}

Error bad_variant(const std::string& set, const std::string& variant) {
  return Error(ErrorCode::Invalid,
               "\"" + set + "\" = \"" + variant + "\" cannot name a variant of a set")
      .with_rule("edit.bad-name")
      .with_fix("use letters, digits, '_', '-' and '|'");
}

Error instance_proxy(Path prim) {
  return Error(ErrorCode::Invalid,
               "<" + prim.str() + "> is inside an instance, where opinions have no effect")
      .with_prim(prim.str())
      .with_rule("edit.instance-proxy")
      .with_fix(
          "edit the instanced prims through an edit target behind the arc, or make the "
          "instance non-instanceable");
}

Error outside_target(Path path, const std::string& layer) {
  return Error(ErrorCode::Invalid,
               "<" + path.str() + "> has no place in " + layer + " through the edit target")
      .with_prim(path.prim().str())
      .with_rule("edit.outside-target")
      .with_fix("choose an edit target whose arc reaches this path, such as the root layer");
}

Error no_name_in_target(Path path, const std::string& layer) {
  return Error(ErrorCode::Invalid, "<" + path.str() +
                                       "> cannot be named in this file: it comes from another one, "
                                       "or is inside an instance")
      .in_file(layer)
      .with_rule("edit.outside-target")
      .with_fix("choose an edit target whose arc reaches this path, such as the root layer");
}

Error no_property(Path property, const std::string& what) {
  return Error(ErrorCode::NotFound, "there is no " + what + " <" + property.str() + ">")
      .with_prim(property.prim().str())
      .with_rule("edit.no-property")
      .with_fix("create it first with its type");
}

Error wrong_kind(Path property, const std::string& there) {
  return Error(ErrorCode::Invalid, "<" + property.str() + "> is " + there)
      .with_prim(property.prim().str())
      .with_rule("edit.spec-kind")
      .with_fix("choose another name");
}

Error type_mismatch(Path object, const std::string& what, const std::string& wanted,
                    const std::string& given) {
  return Error(ErrorCode::Invalid,
               what + " of <" + object.str() + "> takes " + wanted + ", not " + given)
      .with_prim(object.prim().str())
      .with_rule("edit.type-mismatch")
      .with_fix("convert the value to " + wanted);
}

}  // namespace tenon::edit
