// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/physx/physx_functions.h"

/// PhysX's library, opened when it is first asked for, and the one foundation that a process has.
namespace tenon::engines::physx {

namespace px = ::physx;

struct Runtime {
  const physx_api::Functions* functions = nullptr;
  px::PxFoundation* foundation = nullptr;
  px::PxPhysics* physics = nullptr;
  px::PxCpuDispatcher* dispatcher = nullptr;  ///< runs on the thread that steps
};

/// Opens the library: the one that the loader finds (beside the program), else the one that this
/// was built with. Threads may call it at the same time; later calls cost nothing. Errors: Missing
/// (rule engine.missing) when there is none, or another version.
Result<const Runtime*> open_physx();

/// "5.1.3".
std::string physx_version();

/// What PhysX says on this thread while an object of this class lives; outside it says nothing.
class Messages {
 public:
  Messages();
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  const std::vector<std::string>& errors() const { return errors_; }
  void clear() { errors_.clear(); }

 private:
  friend class ErrorLog;
  std::vector<std::string> errors_;
  Messages* outer_ = nullptr;
};

}  // namespace tenon::engines::physx
