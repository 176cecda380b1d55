// Animated GIFs put together from single ones. Each frame is compressed as a GIF of its own (encode_gif), in parallel and once for
// all of the GIFs that it is part of, and the frames are joined here.
#pragma once

#include <span>
#include <string>

namespace neumann {

// An endless GIF of the first frame of each of `gifs` (at least one; all of one size), each shown for `delay`
// hundredths of a second. Throws std::invalid_argument if sizes differ, or if bytes are not a GIF.
std::string join_gif_frames(std::span<const std::string> gifs, int delay);

}  // namespace neumann
