// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/engines/jolt/jolt_engine.h"

namespace tenon::engines {
namespace {

struct JoltEngine {
  static constexpr double kRounding = 2e-5;  ///< velocities in single precision
  static Engine engine() { return {&jolt::info, &jolt::make_simulation}; }
};
using TestedEngines = testing::Types<JoltEngine>;

}  // namespace
}  // namespace tenon::engines

#include "tenon/engines/test_interface.h"
