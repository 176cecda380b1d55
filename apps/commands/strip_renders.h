// What is rendered for a strip.
#pragma once

#include "apps/requests/strip_request.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

// A render, and the tiles that show it.
struct StripRender {
    RenderRequest request;
    std::string label;             // of its tile
    std::vector<int> sums = {};    // in place of one tile with its last sum: a tile for each sum up to one of these bounces
    std::optional<int> ways = {};  // or: a row with this bounce, and each way to make it
};

// Throws InputError for values that the strip cannot have, and for options that its values stand for.
std::vector<StripRender> strip_renders(const StripRequest& request);

// Whether the labels of a strip have the errors of the pictures.
bool shows_errors(const StripRequest& request);
// Whether they are those of bounce 1: samples of the light leave bounce 0 as it is, whose edges have most of the error of the sum.
bool judges_direct_light(const StripRequest& request);
// What is beside the value the same in all tiles, in words.
std::string about_strip(const StripRequest& request);

}  // namespace neumann
