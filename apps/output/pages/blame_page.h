// index.html of `neumann blame`: the verdict, and the pictures by bounce.
#pragma once

#include "apps/output/files/packed_pictures.h"
#include "operators/experiments/blame/blame.h"

#include <string>

namespace neumann {

// Theirs, ours and the difference of every term, packed, in this order.
PackedSeries packed_pictures(const Blame& found);

// `data`: blame_json() with "scene", "pictures", "command" and "version".
std::string blame_page(const PackedSeries& pictures, nlohmann::ordered_json data);

}  // namespace neumann
