// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tenon::serve {

/// Addresses of this machine that others may know it by, as numbers: of interfaces that are up,
/// neither loopback nor link-local; those of IPv4 first, those of IPv6 only where `v6`. Empty
/// without a network.
std::vector<std::string> own_addresses(bool v6);

}  // namespace tenon::serve
