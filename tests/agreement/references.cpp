#include "tests/agreement/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neumann::agreement {

class ReferencesSlow : public testing::TestWithParam<std::string> {};

// Light is reflected in all scenes, and all is finite.
TEST_P(ReferencesSlow, AreMade) {
    const Reference& made = reference(GetParam());
    for (std::size_t channel = 0; channel < 3; ++channel) EXPECT_GT(made.at(blocks, 1, channel).mean, 0.0);
    for (const physics::Blocks::Value& value : made.values) EXPECT_TRUE(std::isfinite(value.mean) && std::isfinite(value.error));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReferencesSlow, testing::ValuesIn(scenes_with_reference()), [](const auto& scene) {
    std::string name = scene.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

}  // namespace neumann::agreement
