// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/layer/layer.h"

namespace tenon::structure {

/// Tells geometries apart.
class GeometryKeys {
 public:
  /// What is geometry of the mesh and its subsets, as one text that differs where they do, to the
  /// last bit. The name of the mesh is no part of it. Texts of other objects mean other things.
  std::string key(const layer::Layer& content, Path mesh);

 private:
  void take_out_arrays(layer::Layer& alone, std::string& key);
  template <class Element>
  bool add(const layer::Value& value, std::string& key);

  struct Known {
    layer::Value value;  // keeps the bytes alive
    const void* data = nullptr;
    std::size_t size = 0;  // bytes
  };
  std::vector<Known> arrays_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> by_sample_;  // into arrays_
};

}  // namespace tenon::structure
