// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/jolt_runtime.h"

#include "tenon/engines/jolt/jolt_headers.h"
//
#include <Jolt/Core/Factory.h>
#include <Jolt/RegisterTypes.h>

#include "tenon/engines/jolt/run/plane_shape.h"

namespace tenon::engines::jolt {
namespace {

// What is made lives as long as the process.
bool start_jolt() {
  JPH::RegisterDefaultAllocator();
  static JPH::Factory factory;
  JPH::Factory::sInstance = &factory;
  JPH::RegisterTypes();
  PlaneShape::add_to_jolt();
  return true;
}

}  // namespace

void open_jolt() {
  static const bool started = start_jolt();
  static_cast<void>(started);
}

std::string jolt_version() {
  return std::to_string(JPH_VERSION_MAJOR) + "." + std::to_string(JPH_VERSION_MINOR) + "." +
         std::to_string(JPH_VERSION_PATCH);
}

}  // namespace tenon::engines::jolt
