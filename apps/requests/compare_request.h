// What `neumann compare` is asked for.
#pragma once

#include "apps/requests/option.h"

namespace neumann {

struct CompareRequest {
    std::string a, b;               // two pictures or two folders; b is the reference
    std::string output;             // the folder of a page of all folders, or empty
    std::vector<std::string> more;  // folders that the page has besides
    bool flip = false, json = false;
};

const Options<CompareRequest>& compare_options();

}  // namespace neumann
