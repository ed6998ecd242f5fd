// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The content is walked once from the top. A material that names nothing outside itself becomes an
// entry of the file of materials. A prim with a mesh is a wrapper: its geometry becomes one entry,
// what else is in it an entry of the instances, and the base refers to that. An entry is known by
// all that it holds, so what is the same is written once. A wrapper is an instance only where
// nothing in it leads out of it and no other layer has an opinion below it, because opinions below
// instances are not composed.
#include "tenon/structure/make/split.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "tenon/formats/save_layer.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/geometry_keys.h"
#include "tenon/structure/make/mesh_wrappers.h"
#include "tenon/structure/package.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

/// Entries below the scope of a file of shared things: the same content is one entry.
class Entries {
 public:
  Entries(Layer& file, Role role) : file_(file), scope_(scope_of(role)) {}

  /// The place of what `key` tells from all others; `is_new` where it has to be filled.
  Path place(const std::string& key, const std::string& name, bool& is_new) {
    const auto known = places_.find(key);
    is_new = known == places_.end();
    if (!is_new) {
      return known->second;
    }
    if (!file_.has(scope_)) {
      define_prim(file_, scope_, "Scope");
    }
    Path path = scope_.child(Token(name));
    std::size_t& last = last_.try_emplace(name, 1).first->second;
    while (file_.has(path)) {
      path = scope_.child(Token(name + "_" + std::to_string(++last)));
    }
    make_prim(file_, path);
    places_.emplace(key, path);
    return path;
  }

 private:
  static Path scope_of(Role role) {
    return Path::absolute_root().child(Token(std::string(root_scope(role))));
  }

  Layer& file_;
  Path scope_;
  std::map<std::string, Path> places_;
  std::map<std::string, std::size_t> last_;  // number behind a name
};

void set_reference(Spec& prim, std::string file, Path target) {
  layer::Reference reference;
  reference.asset_path = std::move(file);
  reference.prim_path = target;
  prim.set(fields::references, layer::ListOp<layer::Reference>::make_prepended({reference}));
}

Layer file_layer(Role role, Names names) {
  return Layer(identifier_in_package(file_name(role, names)));
}

class Splitter {
 public:
  Splitter(const Layer& content, const SplitOptions& options)
      : content_(content),
        options_(options),
        files_{file_layer(Role::Base, options.names), file_layer(Role::Robot, options.names),
               file_layer(Role::Instances, options.names),
               file_layer(Role::Geometries, options.names),
               file_layer(Role::Materials, options.names)},
        instances_(files_.instances, Role::Instances),
        geometries_(files_.geometries, Role::Geometries),
        materials_(files_.materials, Role::Materials) {}

  Result<BaseFiles> run() {
    std::vector<Path> pending{Path::absolute_root()};
    while (!pending.empty()) {
      const Path path = pending.back();
      pending.pop_back();
      bool done = false;
      if (!path.is_absolute_root()) {
        TENON_TRY(done, put_prim(path));
      }
      if (!done) {
        const std::vector<Path> children = child_prims(content_, path);
        pending.insert(pending.end(), children.rbegin(), children.rend());
      }
    }
    return std::move(files_);
  }

 private:
  /// True when all below it is written as well.
  Result<bool> put_prim(Path path) {
    if (type_of(content_, path) == "Material" && is_self_contained(path)) {
      TENON_TRY(const Path entry, material_entry(path));
      Spec& prim = define_prim(files_.base, path, "Material");
      set_reference(prim, name_from(Role::Base, Role::Materials), entry);
      return true;
    }
    put_base_prim(path);
    for (const Path& child : child_prims(content_, path)) {
      if (type_of(content_, child) == "Mesh") {
        TENON_CHECK(put_instance(path, child));
        return true;
      }
    }
    return false;
  }

  void put_base_prim(Path path) {
    const Token type = type_of(content_, path);
    const std::vector<Token> apis = apis_of(content_, path);
    Spec& prim = make_prim(files_.base, path);
    put_prim_fields(prim, *content_.find(path));
    std::vector<Token> own;
    std::vector<Token> of_robot;
    for (const Token api : apis) {
      (owner_of_api(api).owner == Role::Robot ? of_robot : own).push_back(api);
    }
    set_apis(prim, std::move(own));
    if (!of_robot.empty()) {
      set_apis(make_prim(files_.robot, path), std::move(of_robot));
    }
    for (const Path& property : properties_of(content_, path)) {
      const bool robot = owner_of_property(property.name(), type, apis).owner == Role::Robot;
      Layer& file = robot ? files_.robot : files_.base;
      make_prim(file, path);
      prepend_robot_lists(put_property(file, property, *content_.find(property)), property.name());
    }
  }

  bool is_self_contained(Path material) const {
    for (const Path& prim : prims_below(content_, material)) {
      for (const Path& property : properties_of(content_, prim)) {
        for (const Path& target : targets_of(*content_.find(property))) {
          if (!target.has_prefix(material)) {
            return false;
          }
        }
      }
    }
    return true;
  }

  Result<Path> material_entry(Path material) {
    Layer alone("anon:material.usda");
    copy_tree(content_, material, alone, Path::from("/M"));
    TENON_TRY(const std::string text, formats::encode_layer(alone, formats::LayerFormat::Text));
    const std::string name = material.name().str();
    bool is_new = false;
    const Path place = materials_.place(name + "\n" + text, name, is_new);
    if (is_new) {
      copy_tree(content_, material, files_.materials, place);
    }
    return place;
  }

  Result<Path> geometry_entry(Path mesh) {
    const std::string key = keys_.key(content_, mesh);
    const std::string name = mesh.name().str();
    bool is_new = false;
    const Path place = geometries_.place(name + "\n" + key, name, is_new);
    if (is_new) {
      define_prim(files_.geometries, place, "Xform");
      copy_geometry(content_, mesh, files_.geometries, place.child(mesh.name()));
    }
    return place;
  }

  /// The instance at `wrapper`, and what of it cannot be shared as overs in the base.
  Result<void> put_instance(Path wrapper, Path mesh) {
    TENON_TRY(const Path geometry, geometry_entry(mesh));
    Layer alone("anon:instance.usda");
    const Path top = Path::from("/I");
    set_reference(define_prim(alone, top, "Xform"), name_from(Role::Instances, Role::Geometries),
                  geometry);
    bool shareable = true;
    for (const Path& child : child_prims(content_, wrapper)) {
      if (child == mesh) {
        shareable = put_shape(wrapper, mesh, alone) && shareable;
      } else {
        TENON_CHECK(put_local_materials(wrapper, child, alone));
      }
    }
    TENON_TRY(const std::string text, formats::encode_layer(alone, formats::LayerFormat::Text));
    bool is_new = false;
    const Path place = instances_.place(text, wrapper.name().str(), is_new);
    if (is_new) {
      copy_tree(alone, top, files_.instances, place);
    }
    Spec& prim = make_prim(files_.base, wrapper);
    set_reference(prim, name_from(Role::Base, Role::Instances), place);
    if (shareable && !is_touched(wrapper)) {
      prim.set(fields::instanceable, true);
    }
    return {};
  }

  bool is_touched(Path wrapper) const {
    // Below it: right after it in the order of paths.
    const auto next = options_.touched.upper_bound(wrapper);
    return options_.overridable.contains(wrapper) ||
           (next != options_.touched.end() && next->has_prefix(wrapper) &&
            next->prim_or_variant() != wrapper);
  }

  /// What a mesh has besides its geometry. False when some of it leads out of the wrapper, which
  /// goes to the base.
  bool put_shape(Path wrapper, Path mesh, Layer& alone) {
    bool shareable = true;
    const Path top = Path::from("/I");
    const PathMap map = [&](Path path) { return path.replace_prefix(wrapper, top); };
    for (const Path& path : prims_below(content_, mesh)) {
      const Token type = type_of(content_, path);
      const Path to = map(path);
      Spec fields_of_shape = *content_.find(path);
      fields_of_shape.erase(fields::typeName);
      fields_of_shape.erase(fields::specifier);
      const std::vector<Token> apis = apis_of(content_, path);
      if (has_own_fields(fields_of_shape)) {
        put_prim_fields(make_prim(alone, to), fields_of_shape);
        set_apis(make_prim(alone, to), apis);
      }
      for (const Path& property : properties_of(content_, path)) {
        const Spec& spec = *content_.find(property);
        const bool geometry =
            spec.kind == layer::SpecKind::Attribute &&
            owner_of_property(property.name(), type, {}).owner == Role::Geometries;
        if (geometry) {
          continue;
        }
        if (leads_out(spec, wrapper)) {
          shareable = false;
          make_prim(files_.base, path);
          put_property(files_.base, property, spec);
          continue;
        }
        make_prim(alone, to);
        put_property(alone, to.property(property.name()), spec, map);
      }
    }
    return shareable;
  }

  static bool has_own_fields(const Spec& prim) {
    return std::any_of(prim.fields().begin(), prim.fields().end(), [](const layer::Field& field) {
      return field.name != fields::primChildren && field.name != fields::properties;
    });
  }

  static bool leads_out(const Spec& property, Path wrapper) {
    const std::vector<Path> targets = targets_of(property);
    return std::any_of(targets.begin(), targets.end(),
                       [&](Path target) { return !target.has_prefix(wrapper); });
  }

  Result<void> put_local_materials(Path wrapper, Path child, Layer& alone) {
    const Path top = Path::from("/I");
    const PathMap map = [&](Path path) { return path.replace_prefix(wrapper, top); };
    std::vector<Path> materials{child};
    if (type_of(content_, child) != "Material") {
      put_prim_fields(make_prim(alone, map(child)), *content_.find(child));
      materials = child_prims(content_, child);
    }
    for (const Path& material : materials) {
      if (!is_self_contained(material)) {
        copy_tree(content_, material, alone, map(material), map);
        continue;
      }
      TENON_TRY(const Path entry, material_entry(material));
      set_reference(define_prim(alone, map(material), "Material"),
                    name_from(Role::Instances, Role::Materials), entry);
    }
    return {};
  }

  std::string name_from(Role from, Role to) const {
    return relative_name(from, to, options_.names);
  }

  const Layer& content_;
  const SplitOptions& options_;
  BaseFiles files_;
  Entries instances_;
  GeometryKeys keys_;
  Entries geometries_;
  Entries materials_;
};

}  // namespace

std::string relative_name(Role from, Role to, Names names) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(file_name(from, names)).parent_path();
  const std::string name =
      fs::path(file_name(to, names)).lexically_relative(folder).generic_string();
  return name.starts_with("../") ? name : "./" + name;
}

Result<BaseFiles> split_base(const Layer& content, const SplitOptions& options) {
  return Splitter(content, options).run();
}

}  // namespace tenon::structure
