// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/physx_library.h"

#include <algorithm>
#include <cstdlib>

#include "tenon/base/shared_library.h"

namespace tenon::engines::physx {

namespace {
thread_local Messages* current_messages = nullptr;
constexpr std::size_t kMostMessages = 20;
constexpr float kSmallLength = 0.01F;  // [m]
constexpr float kUsualSpeed = 10;      // [m/s]
}  // namespace

class ErrorLog final : public px::PxErrorCallback {
 public:
  void reportError(px::PxErrorCode::Enum code, const char* message, const char* /*file*/,
                   int /*line*/) override {
    Messages* messages = current_messages;
    const bool counts =
        code != px::PxErrorCode::eDEBUG_INFO && code != px::PxErrorCode::ePERF_WARNING;
    if (messages == nullptr || !counts || messages->errors_.size() >= kMostMessages) {
      return;
    }
    std::vector<std::string>& errors = messages->errors_;
    if (std::find(errors.begin(), errors.end(), message) == errors.end()) {
      errors.emplace_back(message);
    }
  }
};

namespace {

// malloc gives what PhysX asks for: addresses that 16 divides.
class Memory final : public px::PxAllocatorCallback {
 public:
  void* allocate(size_t size, const char* /*type*/, const char* /*file*/, int /*line*/) override {
    return std::malloc(size);
  }
  void deallocate(void* memory) override { std::free(memory); }
};

const SharedLibrary& physx_file() {
  static const SharedLibrary opened = SharedLibrary::open({own_library(TENON_PHYSX_SONAME)});
  return opened;
}

/// "": `runtime` is ready; else what is wrong with the library. What is made lives as long as the
/// process.
std::string start(Runtime& runtime) {
  static ErrorLog errors;
  static Memory memory;
  if (!physx_file()) {
    return physx_file().why_not();
  }
  const physx_api::Functions* (*get_functions)() = nullptr;
  if (!physx_file().find(physx_api::kGetFunctions, get_functions)) {
    return std::string("it has no ") + physx_api::kGetFunctions;
  }
  runtime.functions = get_functions();
  if (runtime.functions->version != physx_api::kFunctionsVersion ||
      runtime.functions->physx_version != PX_PHYSICS_VERSION) {
    return "it is another version than " + physx_version();
  }
  runtime.foundation = runtime.functions->create_foundation(memory, errors);
  if (runtime.foundation == nullptr) {
    return "it makes no foundation: some other part of this process uses PhysX";
  }
  // What PhysX takes for small: else contacts of a box are looked for again only once it has moved
  // by millimetres, and found when it has gone in that far.
  const px::PxTolerancesScale scale(kSmallLength, kUsualSpeed);
  runtime.physics = runtime.functions->create_physics(*runtime.foundation, scale);
  runtime.dispatcher = runtime.functions->create_dispatcher(0);
  return runtime.physics == nullptr || runtime.dispatcher == nullptr ? "it does not start" : "";
}

}  // namespace

Messages::Messages() : outer_(current_messages) { current_messages = this; }
Messages::~Messages() { current_messages = outer_; }

std::string physx_version() {
  return std::to_string(PX_PHYSICS_VERSION_MAJOR) + "." + std::to_string(PX_PHYSICS_VERSION_MINOR) +
         "." + std::to_string(PX_PHYSICS_VERSION_BUGFIX);
}

Result<const Runtime*> open_physx() {
  static Runtime runtime;
  static const std::string fault = start(runtime);
  if (fault.empty()) {
    return &runtime;
  }
  return Error(ErrorCode::Missing,
               std::string("PhysX's library ") + TENON_PHYSX_SONAME + " cannot be used: " + fault)
      .with_rule("engine.missing")
      .with_fix("install tenon with its folder lib/tenon, which holds the library");
}

}  // namespace tenon::engines::physx
