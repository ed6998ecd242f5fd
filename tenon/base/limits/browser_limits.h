// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on requests to a browser that draws pictures and films, and on its replies; and on the
/// images of materials that browsers decode.
namespace tenon::limits {

inline constexpr std::size_t kBrowserPage = 67'108'864;     ///< bytes of a page that it shows
inline constexpr std::size_t kBrowserAnswer = 134'217'728;  ///< bytes of a message from it
inline constexpr std::size_t kFilmFrames = 100'000;         ///< of a film
inline constexpr std::size_t kFilmBytes = 2'147'483'648;    ///< of what it has made
inline constexpr std::size_t kImageSide = 16'384;           ///< pixels along a side of an image
inline constexpr std::size_t kImagePixels = 268'435'456;    ///< of all images of a page or a glb

}  // namespace tenon::limits
