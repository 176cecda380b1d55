#include "operators/pictures/field_progress.h"

namespace neumann {

bool same_pictures(FieldSettings a, const FieldSettings& b) {
    a.memory = b.memory;
    return a == b;
}

}  // namespace neumann
