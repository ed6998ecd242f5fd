// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/serve/own_addresses.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

namespace tenon::serve {
namespace {

/// The address of an interface in one family as text; empty: it has none there.
std::string text_of(const ifaddrs& one, int family) {
  if (one.ifa_addr == nullptr || one.ifa_addr->sa_family != family) {
    return "";
  }
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (family == AF_INET) {
    sockaddr_in address{};
    std::memcpy(&address, one.ifa_addr, sizeof address);
    inet_ntop(family, &address.sin_addr, text.data(), text.size());
  } else {
    sockaddr_in6 address{};
    std::memcpy(&address, one.ifa_addr, sizeof address);
    if (IN6_IS_ADDR_LINKLOCAL(&address.sin6_addr)) {
      return "";
    }
    inet_ntop(family, &address.sin6_addr, text.data(), text.size());
  }
  return text.data();
}

}  // namespace

std::vector<std::string> own_addresses(bool v6) {
  std::vector<std::string> found;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) {
    return found;
  }
  for (const int family : {AF_INET, AF_INET6}) {
    for (const ifaddrs* one = all; one != nullptr && (family == AF_INET || v6);
         one = one->ifa_next) {
      const bool usable = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
      const std::string text = usable ? text_of(*one, family) : "";
      if (!text.empty() && std::find(found.begin(), found.end(), text) == found.end()) {
        found.push_back(text);
      }
    }
  }
  freeifaddrs(all);
  return found;
}

}  // namespace tenon::serve
