// R on the patches of a scene, with one channel if the scene is grey and four otherwise. It needs no ray, so all
// replicates share it.
#pragma once

#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/sides.h"

#include <variant>

namespace neumann {

class SceneReflection {
public:
    // Keeps a reference to the space.
    SceneReflection(const Scene& scene, const PatchSpace& space) : R_(make(scene, space)) {}

    // Returns use(R), R a ReflectionMatrix<1> or <4>.
    template <class Use>
    auto with(const Use& use) const {
        return std::visit(use, R_);
    }

private:
    using Any = std::variant<ReflectionMatrix<1>, ReflectionMatrix<4>>;
    static Any make(const Scene& scene, const PatchSpace& space) {
        if (is_grey(scene)) return ReflectionMatrix<1>(scene.materials, space);
        return ReflectionMatrix<4>(scene.materials, space);
    }

    Any R_;
};

}  // namespace neumann
