// Le as a field.
#pragma once

#include "core/emitter/emitters.h"
#include "operators/pointwise/field.h"

namespace neumann {

inline ExitantField emission(const Emitters& emitters) {
    return ExitantField([&emitters](const SurfacePoint& p, const Vec3& w, Random&) { return emitters.emitted(p, w); });
}

}  // namespace neumann
