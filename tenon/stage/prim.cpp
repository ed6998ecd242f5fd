// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/prim.h"

#include <algorithm>

#include "tenon/stage/stage_data.h"

namespace tenon::stage {

Path Prim::path() const {
  if (data_ == nullptr) {
    return {};
  }
  return proxy_path_.empty() ? data_->path : proxy_path_;
}

Token Prim::type_name() const { return data_ == nullptr ? Token() : data_->type_name(); }

layer::Specifier Prim::specifier() const {
  return data_ == nullptr ? layer::Specifier::Over : data_->specifier;
}

bool Prim::is_pseudo_root() const { return data_ != nullptr && data_ == stage_->root; }
bool Prim::is_active() const { return data_ != nullptr && data_->active; }
bool Prim::is_loaded() const { return data_ != nullptr && data_->loaded; }
bool Prim::is_defined() const { return data_ != nullptr && data_->defined; }
bool Prim::is_abstract() const { return data_ != nullptr && data_->abstract; }
bool Prim::is_model() const { return data_ != nullptr && data_->model; }
bool Prim::is_group() const { return data_ != nullptr && data_->group; }
bool Prim::is_instance() const { return data_ != nullptr && data_->is_instance(); }
bool Prim::is_instance_proxy() const { return !proxy_path_.empty(); }

bool Prim::is_prototype() const {
  return data_ != nullptr && data_->is_prototype_root && !is_instance_proxy();
}

bool Prim::is_in_prototype() const {
  return data_ != nullptr && data_->in_prototype && !is_instance_proxy();
}

Prim Prim::parent() const {
  if (data_ == nullptr || data_->parent == 0) {
    return {};
  }
  if (proxy_path_.empty()) {
    return Prim(stage_, stage_->numbered(data_->parent));
  }
  const Path above = proxy_path_.parent();
  const PrimData* const parent = stage_->numbered(data_->parent);
  return parent->is_prototype_root ? stage_->find(above) : Prim(stage_, parent, above);
}

std::vector<Prim> Prim::children() const {
  std::vector<Prim> result;
  if (data_ == nullptr) {
    return result;
  }
  const PrimData* source = data_->is_instance() ? data_->prototype() : data_;
  const bool proxies = is_instance_proxy() || data_->is_instance();
  const Path here = path();
  for (const PrimData* child = stage_->numbered(source->first_child); child != nullptr;
       child = stage_->numbered(child->next_sibling)) {
    result.push_back(Prim(stage_, child, proxies ? here.child(child->path.name()) : Path()));
  }
  return result;
}

Prim Prim::child(Token name) const {
  if (data_ == nullptr) {
    return {};
  }
  const PrimData* source = data_->is_instance() ? data_->prototype() : data_;
  const bool proxies = is_instance_proxy() || data_->is_instance();
  const PrimData* const found = stage_->record(source->path.child(name));
  if (found == nullptr || found->is_prototype_root) {
    return {};
  }
  return Prim(stage_, found, proxies ? path().child(name) : Path());
}

Prim Prim::prototype() const { return is_instance() ? Prim(stage_, data_->prototype()) : Prim(); }

Prim Prim::prim_in_prototype() const { return is_instance_proxy() ? Prim(stage_, data_) : Prim(); }

Prim Prim::prim_at(Path path) const { return data_ == nullptr ? Prim() : stage_->find(path); }

bool Prim::is_a(Token type) const {
  if (data_ == nullptr || data_->definition->schema() == nullptr ||
      data_->definition->schema()->kind != schema::SchemaKind::ConcreteTyped) {
    return false;  // a prim of an abstract type is of no type at all, as in OpenUSD
  }
  const std::vector<Token>& chain = data_->definition->schema()->chain;
  return std::find(chain.begin(), chain.end(), type) != chain.end();
}

bool Prim::has_api(Token schema) const {
  return data_ != nullptr && data_->definition->has_api(schema);
}

std::vector<Token> Prim::api_instances(Token schema) const {
  std::vector<Token> result;
  if (data_ == nullptr) {
    return result;
  }
  for (const Token applied : data_->definition->applied()) {
    const auto [name, instance] = schema::split_api_name(applied);
    if (name == schema && !instance.empty()) {
      result.push_back(instance);
    }
  }
  return result;
}

std::vector<Token> Prim::applied_schemas() const {
  return data_ == nullptr ? std::vector<Token>() : data_->definition->applied_stock();
}

const schema::PrimDefinition* Prim::definition() const {
  return data_ == nullptr ? nullptr : data_->definition;
}

Attribute Prim::attribute(Token name) const { return Attribute(stage_, data_, proxy_path_, name); }

Relationship Prim::relationship(Token name) const {
  return Relationship(stage_, data_, proxy_path_, name);
}

}  // namespace tenon::stage
