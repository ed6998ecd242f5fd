// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/base/result.h"
#include "tenon/live/session.h"
#include "tenon/serve/server.h"

namespace tenon::live {

/// Joins a session and a server until the server is stopped, by a signal or by stop(): the server
/// on this thread, the session on one of its own, which sleeps while there is nothing to do. True
/// where it was a signal. Errors: Io (live.no-thread) where no thread can be had.
/// With `seconds` it also ends when these have passed.
Result<bool> serve_session(serve::Server& server, Session& session,
                           std::optional<double> seconds = std::nullopt);

/// {"url", "port", "local"}: where the server is.
Json address_json(const serve::Server& server);

}  // namespace tenon::live
