// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Who may ask the server for what: decided from the text of a request alone.
namespace tenon::serve {

/// "name" of the target "/TOKEN/name?query" of a request (RFC 9112, section 3.2.1); "" of
/// "/TOKEN/". Nothing where the token is another one, or where there is none. The time this takes
/// tells nothing about the token.
std::optional<std::string> route_of(std::string_view target, std::string_view token);

/// The target is "/TOKEN" alone, which means "/TOKEN/".
bool lacks_slash(std::string_view target, std::string_view token);

/// Whether the value of a Host header names this server by an address or as localhost: a page of a
/// strange site whose name was made to lead here (DNS rebinding) sends that site's name. A server
/// that is bound to this machine alone (`local`) has no address but 127.0.0.1 and [::1]. The port
/// may be another one, which ssh forwards.
bool is_own_host(std::string_view host, bool local);

/// Whether the value of an Origin header is that of a page which the server named by `host` has
/// handed out: browsers send it with every WebSocket of a page (RFC 6455, section 10.2).
bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace tenon::serve
