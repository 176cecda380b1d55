#include "operators/render/from_paths/metropolis_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/sampling.h"

namespace neumann::method {

void Metropolis::expect(const Scene& scene) const { expect_visible_emitters(name, scene); }

std::shared_ptr<const PathMethod> Metropolis::prepare(const Preparing&) const {
    return std::make_shared<const MetropolisPaths>(chain.value_or(MetropolisPaths::default_length));
}

void Metropolis::complete(const SamplingSettings& settings, const Film& film) {
    chain = chain_numbers(settings.layout(film).paths(), as<MetropolisPaths>(settings.method)->length()).length;
}

}  // namespace neumann::method
