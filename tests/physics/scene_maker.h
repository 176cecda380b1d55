// Scenes put together by hand, as operators/known has them.
#pragma once

#include "operators/known/scene_maker.h"

namespace neumann::physics {

using namespace known;

}  // namespace neumann::physics
