#include "tests/agreement/reference.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::agreement {

class ReferencesSlow : public testing::TestWithParam<std::string> {};

TEST_P(ReferencesSlow, AreMade) { EXPECT_EQ(reference(GetParam()).pixels.size(), bounces + 1); }

INSTANTIATE_TEST_SUITE_P(Scenes, ReferencesSlow, testing::ValuesIn(scenes_with_reference()), [](const auto& scene) {
    std::string name = scene.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

}  // namespace neumann::agreement
