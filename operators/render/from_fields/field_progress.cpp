#include "operators/render/from_fields/field_progress.h"

namespace neumann {

bool same_pictures(FieldSettings a, const FieldSettings& b) {
    a.memory = b.memory;
    return a == b;
}

bool is_within(const FieldSettings& settings, const FieldSettings& most) {
    return settings.patching.patches <= most.patching.patches && settings.rays <= most.rays && settings.samples <= most.samples &&
           settings.replicates == most.replicates;
}

}  // namespace neumann
