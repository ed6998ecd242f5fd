// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/serve/request_guard.h"

#include <algorithm>
#include <cstddef>

namespace tenon::serve {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Compares all of both, wherever they differ first.
bool same_secret(std::string_view a, std::string_view b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  }
  return difference == 0;
}

/// "a.b.c.d" of numbers below 256.
bool is_ipv4(std::string_view text) {
  int parts = 0;
  while (parts < 4) {
    std::size_t length = 0;
    int value = 0;
    while (length < text.size() && length < 4 && is_digit(text[length])) {
      value = value * 10 + (text[length] - '0');
      ++length;
    }
    if (length == 0 || length > 3 || value > 255) {
      return false;
    }
    text.remove_prefix(length);
    ++parts;
    if (parts < 4) {
      if (!text.starts_with('.')) {
        return false;
      }
      text.remove_prefix(1);
    }
  }
  return text.empty();
}

/// "[...]" of what IPv6 addresses are written with.
bool is_ipv6(std::string_view text) {
  return text.size() >= 4 && text.front() == '[' && text.back() == ']' &&
         text.substr(1, text.size() - 2).find_first_not_of("0123456789abcdefABCDEF:.") ==
             std::string_view::npos;
}

/// A host without its ":port"; empty where that is no number.
std::string_view without_port(std::string_view host) {
  const std::size_t name_end = host.starts_with('[') ? host.find(']') : 0;
  const std::size_t colon =
      name_end == std::string_view::npos ? name_end : host.find(':', name_end);
  if (colon == std::string_view::npos) {
    return host;
  }
  const std::string_view port = host.substr(colon + 1);
  const bool is_number =
      !port.empty() && port.size() <= 5 && std::all_of(port.begin(), port.end(), is_digit);
  return is_number ? host.substr(0, colon) : std::string_view();
}

}  // namespace

std::optional<std::string> route_of(std::string_view target, std::string_view token) {
  const std::string_view path = target.substr(0, target.find_first_of("?#"));
  const std::size_t slash = path.find('/', 1);
  if (!path.starts_with('/') || slash == std::string_view::npos ||
      !same_secret(path.substr(1, slash - 1), token)) {
    return std::nullopt;
  }
  return std::string(path.substr(slash + 1));
}

bool lacks_slash(std::string_view target, std::string_view token) {
  return target.starts_with('/') && same_secret(target.substr(1), token);
}

bool is_own_host(std::string_view host, bool local) {
  const std::string_view name = without_port(host);
  if (name == "localhost" || name == "127.0.0.1" || name == "[::1]") {
    return true;
  }
  return !local && (is_ipv4(name) || is_ipv6(name));
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view kScheme = "http://";
  return !host.empty() && origin.starts_with(kScheme) && origin.substr(kScheme.size()) == host;
}

}  // namespace tenon::serve
