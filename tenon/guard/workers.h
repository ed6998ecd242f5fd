// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/base/wire.h"
#include "tenon/guard/messages.h"

/// Untrusted files in formats that third-party libraries read are read by another process, the
/// program tenon-worker, within the limits of docs/limits.md. Whatever happens to it, the calling
/// process gets a value that it can check, or an Error.
namespace tenon::guard {

class ReplyBuffer;
class WorkerProcess;

/// The workers of one command: started when a file asks for one, kept for the next file, ended with
/// this. For one thread.
class Workers {
 public:
  explicit Workers(const Allowance& base = {});
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();

  /// The bytes of an Answer<T>, as they came; they stay until the next call. Errors, with the
  /// file: Missing without a worker, Limit for what took too much, Corrupt where the worker broke
  /// down.
  Result<std::string_view> ask(const Request& request);

  /// How many processes were started.
  std::size_t started() const { return started_; }

 private:
  Allowance allowance_for(const std::string& file) const;
  Result<std::size_t> worker_for(const Request& request);

  Allowance base_;
  std::vector<std::unique_ptr<WorkerProcess>> idle_;
  std::unique_ptr<ReplyBuffer> answer_;
  std::size_t started_ = 0;
  std::size_t lost_ = 0;
};

/// `Request::readable_roots` of a file alone: its folder, and that of what it leads to.
std::vector<std::string> own_roots(const std::string& file);

/// What is wrong with an answer that could be decoded.
Error bad_answer(const std::string& file);
/// The finding that a file asks for others which may not be read.
Diagnostic refused_file(const std::string& file, const std::string& refused,
                        const std::vector<std::string>& roots);

/// Lets a worker read a file. What it finds goes to `diagnostics`. The value is decoded; its owner
/// checks what it means. `opened`, where given, receives the files that it says it has read, those
/// beside the one that was asked for, too.
template <class T>
Result<T> read_guarded(Workers& workers, Request request, Diagnostics& diagnostics,
                       std::vector<std::string>* opened = nullptr) {
  if (request.readable_roots.empty()) {
    request.readable_roots = own_roots(request.file);
  }
  TENON_TRY(const std::string_view bytes, workers.ask(request));
  std::optional<Answer<T>> answer = wire::decoded<Answer<T>>(bytes);
  if (!answer || answer->value.has_value() == answer->failure.has_value() ||
      answer->findings.size() > limits::kGuardFindings) {
    return bad_answer(request.file);
  }
  for (Diagnostic& finding : answer->findings) {
    diagnostics.add(std::move(finding));
  }
  for (const std::string& refused : answer->refused) {
    diagnostics.add(refused_file(request.file, refused, request.readable_roots));
  }
  if (opened != nullptr) {
    *opened = std::move(answer->opened);
  }
  if (answer->failure) {
    return Error(answer->failure->code, std::move(answer->failure->diagnostic));
  }
  return *std::move(answer->value);
}

}  // namespace tenon::guard
