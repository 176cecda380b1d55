// Remedies against a firefly. They depend on which reflections of its path are by a delta lobe (mirror, glass, hole),
// where no other strategy can make the path.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"

#include <vector>

namespace neumann {

// The remedies that scene and path allow for a sample of a quantity (bounce 0 … N or the rest); several are to be combined. Empty
// if every method makes such a path by chance only.
std::vector<Remedy> remedies(const Scene& scene, const PictureSampler& sampler, const SampleName& name, std::size_t quantity);

}  // namespace neumann
