// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Reading fills tenon/scene's description: its words are known here without a prefix.
namespace tenon::scene {}
namespace tenon::physics {
using namespace scene;  // NOLINT(google-build-using-namespace): said above
}
