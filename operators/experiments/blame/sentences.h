// A verdict in three sentences: the first bounce that differs and by how much, its likely mistake, and its place.
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/blame.h"

#include <string>
#include <vector>

namespace neumann {

// One more sentence is added if depths seem to be counted in another way, and one if their noise had to be guessed.
std::vector<std::string> sentences_about(const Blame& blame, const Scene& scene);

}  // namespace neumann
