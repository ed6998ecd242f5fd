// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/engines/physx/physx_engine.h"

namespace tenon::engines {
namespace {

struct PhysxEngine {
  static constexpr double kRounding = 2e-5;  ///< single precision at 10 m
  static Engine engine() { return {&physx::info, &physx::make_simulation}; }
};
using TestedEngines = testing::Types<PhysxEngine>;

}  // namespace
}  // namespace tenon::engines

#include "tenon/engines/test_interface.h"
