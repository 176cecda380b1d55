// Approximate memory of a render from fields, and the check of the memory limit.
#pragma once

#include "operators/render/from_fields/field_pictures.h"

namespace neumann {

struct FieldSizes {
    double patches = 0.0, unknowns = 0.0, rays = 0.0;  // `rays`: rays of T in one replicate
    bool has_links = false;                            // whether some rays of T go on by links
};

// The bytes of the fields are those of patches, T, the fields of all replicates and work space; the bytes of the
// pictures are those of the values of all replicates.
double bytes_of_fields(const FieldSettings& settings, const FieldSizes& sizes);
double bytes_of_pictures(const FieldSettings& settings, const Film& film);

// Throws InputError if fields and pictures need more than settings.memory.
void check_field_memory(const FieldSettings& settings, const Film& film, const FieldSizes& sizes);

}  // namespace neumann
