#include "core/material/materials.h"

namespace neumann {

Rgb Materials::largest_albedo() const {
    Rgb largest(0.0);
    for (const Sides& sides : sides_of_shape_)
        for (const int index : {sides.front, sides.back})
            if (index != absorbing) largest = glm::max(largest, neumann::largest_albedo(bsdfs_[static_cast<std::size_t>(index)]));
    return largest;
}

}  // namespace neumann
