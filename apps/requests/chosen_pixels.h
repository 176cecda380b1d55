// The pixels whose paths the page of a render shows.
#pragma once

#include "apps/requests/chosen_files.h"
#include "core/base/vec.h"

#include <string>
#include <vector>

namespace neumann {

struct ChosenPixels {
    std::vector<Vec2> pixels;  // x, y of the film
    bool named = false;        // also the pixels of the samples that the health report names

    bool empty() const { return pixels.empty() && !named; }
};

// Reads "19,160" and "named". Throws InputError for other words, and if there are pixels but `files` have no page.
ChosenPixels choose_pixels(const std::vector<std::string>& texts, const ChosenFiles& files);

}  // namespace neumann
