// What a render from fields takes of memory, about, and whether that may be taken.
#pragma once

#include "operators/pictures/field_pictures.h"

namespace neumann {

struct FieldSizes {
    double patches = 0.0, unknowns = 0.0, rays = 0.0;  // of T, of one replicate
};

// In bytes: patches, T, the fields of all replicates and what makes them; and of pictures what all replicates found.
double bytes_of_fields(const FieldSettings& settings, const FieldSizes& sizes);
double bytes_of_pictures(const FieldSettings& settings, const Film& film);

// Throws InputError where these are more than settings.memory.
void check_field_memory(const FieldSettings& settings, const Film& film, const FieldSizes& sizes);

}  // namespace neumann
