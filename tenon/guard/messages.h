// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"
#include "tenon/base/limits/guard_limits.h"

/// What a program and its worker say to each other: each message is its length in bytes (uint64)
/// and an encoded value.
namespace tenon::guard {

/// Which library of others is to do it.
enum class Reader : std::uint8_t {
  About,  ///< none: what the worker is made of, an AboutWorker
  Mesh,   ///< assimp: a mesh::MeshScene
  Mjcf,   ///< MuJoCo: a robot::RobotModel
};

/// A file to be read.
struct Request {
  Reader reader = Reader::About;
  std::string file;  ///< as the user names it
  /// Folders, absolute and without symbolic links, below which files may be read; empty: the
  /// file's own.
  std::vector<std::string> readable_roots;
};

/// What the worker may take of the machine for one file.
struct Allowance {
  std::uint64_t memory = limits::kGuardMemoryBase;  ///< bytes of address space
  std::uint64_t seconds = limits::kGuardSeconds;    ///< of processor time
  std::uint64_t wall_seconds = limits::kGuardWallSeconds;
  std::uint64_t reply_bytes = limits::kGuardReplyBase;
};

struct Task {
  Request request;
  Allowance allowance;
};

/// How a worker is confined: which of the requested limits the kernel provides.
struct Confinement {
  bool memory = false;        ///< address space is bounded; else by watching (sanitizers)
  std::int32_t landlock = 0;  ///< version in force, 0: none
  bool system_calls = false;  ///< seccomp: no network, no processes, no writing
  bool no_new_privileges = false;
};

struct AboutWorker {
  std::string assimp;  ///< version, empty: none
  std::string mujoco;
  Confinement confinement;
};

struct Failure {
  ErrorCode code = ErrorCode::Invalid;
  Diagnostic diagnostic;
};

/// What comes back for a request.
template <class T>
struct Answer {
  std::optional<T> value;
  std::optional<Failure> failure;  ///< where there is no value
  std::vector<Diagnostic> findings;
  std::vector<std::string> refused;  ///< files that were asked for and may not be read
  std::vector<std::string> opened;   ///< files that were read, by their real names
};

/// How a worker ends by itself; signals tell the rest.
enum class WorkerExit : std::uint8_t {
  Done = 0,
  BadTask = 64,
  OutOfMemory = 65,
  LongReply = 66,
  NoSandbox = 68,  ///< of --run: the kernel cannot confine another program
  NoProgram = 69,  ///< of --run: it cannot be started
};

}  // namespace tenon::guard
