// Flip-books as GIF: number of frames, rate, loop, and broken bytes.
#include "core/image/gif_frames.h"
#include "core/image/image_io.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

namespace neumann::image_gif_test {

std::string joined(const std::vector<DisplayImage>& frames, int delay) {
    std::vector<std::string> gifs;
    for (const DisplayImage& frame : frames) gifs.push_back(encode_gif(frame));
    return join_gif_frames(gifs, delay);
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
    return found;
}

TEST(ImageGif, EveryFrameHasTheRateAndTheLoopHasNoEnd) {
    const std::vector<DisplayImage> frames = {DisplayImage(8, 6, 0), DisplayImage(8, 6, 100), DisplayImage(8, 6, 200)};
    const std::string gif = joined(frames, 67);
    EXPECT_EQ(gif.substr(0, 6), "GIF89a");
    EXPECT_EQ(gif.substr(6, 4), std::string("\x08\x00\x06\x00", 4));
    EXPECT_EQ(count(gif, std::string("NETSCAPE2.0\x03\x01\0\0\0", 16)), 1);
    // Graphic control extension, 67 hundredths of a second.
    int controls = 0;
    for (std::size_t at = gif.find("\x21\xF9\x04"); at != std::string::npos; at = gif.find("\x21\xF9\x04", at + 1)) {
        EXPECT_EQ(gif.substr(at + 4, 2), std::string("\x43\x00", 2));
        ++controls;
    }
    EXPECT_EQ(controls, 3);
    EXPECT_EQ(gif.back(), '\x3B');
}

TEST(ImageGif, FramesOfSeveralSizesAreRefused) {
    const std::vector<DisplayImage> frames = {DisplayImage(8, 6, 0), DisplayImage(6, 8, 0)};
    EXPECT_THROW(joined(frames, 100), std::invalid_argument);
    EXPECT_THROW(joined({}, 100), std::invalid_argument);
}

TEST(ImageGif, WhatIsNotAGifIsRefused) {
    const std::string gif = joined({DisplayImage(8, 6, 0)}, 100);
    for (std::size_t size = 0; size + 1 < gif.size(); size += 7) {
        const std::string cut[] = {gif.substr(0, size)};
        EXPECT_ANY_THROW(join_gif_frames(cut, 10)) << size;
    }
}

}  // namespace neumann::image_gif_test
