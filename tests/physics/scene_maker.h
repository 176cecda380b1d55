// Scenes put together by hand, as operators/experiments/known has them.
#pragma once

#include "operators/experiments/known/scene_maker.h"

namespace neumann::physics {

using namespace known;

}  // namespace neumann::physics
