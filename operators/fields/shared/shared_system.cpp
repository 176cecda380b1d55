#include "operators/fields/shared/shared_system.h"

#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/ray_table.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/solvers/petsc/petsc_solver.h"

#include <algorithm>
#include <cmath>

namespace neumann {

SharedSystem::SharedSystem(const Scene& scene, const TracedSettings& settings, Processes& processes, std::string petsc,
                           const Watch& watch)
    : scene_(&scene),
      settings_(settings),
      processes_(&processes),
      petsc_(std::move(petsc)),
      space_(traced_space(scene, settings, processes.size())),
      table_(space_, settings.rays, settings.seed, processes, watch, settings.kept().get()),
      samples_lights_(!scene.emitters.empty() && rays_that_meet_lights(scene, settings.rays) < enough_rays) {
    settings_.store = nullptr;
    double blind = 0.0;
    for (std::size_t i = 0; i < table_.facets().size(); ++i)
        blind += static_cast<double>(std::ranges::count(table_.row(i), table_.nothing()));
    double all[] = {blind, static_cast<double>(table_.rays())};
    processes.sum(all);
    blind_ = static_cast<std::size_t>(all[0]);
    rays_ = static_cast<std::size_t>(all[1]);
    is_grey(scene) ? fill<1>() : fill<4>();
}

template <int C>
void SharedSystem::fill() {
    const ReflectionMatrix<C> R(scene_->materials, space_);
    const auto own = [&](const auto& field, int c) { return table_.own_of(field.row(c).head(space_.size()).matrix().transpose()); };
    const auto Le = emitted_light<C>(*scene_, space_, table_.facets());
    for (int c = 0; c < std::min(C, 3); ++c) {
        R_.push_back(R.channel(c));
        emitted_.push_back(own(Le, c));
    }
    if (samples_lights_) {
        const auto b = R(arriving_light<C>(*scene_, R, settings_.rays, settings_.seed, table_.facets()));
        for (int c = 0; c < channels(); ++c) direct_.push_back(own(b, c));
        return;
    }
    for (int c = 0; c < channels(); ++c) channel(c).apply(emitted_[static_cast<std::size_t>(c)], direct_.emplace_back());
}

std::unique_ptr<ChannelOperator> SharedSystem::transported() const {
    return std::make_unique<SharedChannel>(table_, ReflectionMatrix<1>::identity(space_));
}

OperatorNorms SharedSystem::norms(const ChannelOperator& K, const EigenLimits& limits) const { return slepc_norms(K, limits); }

Eigenpairs SharedSystem::leading(const ChannelOperator& K, int count, const EigenLimits& limits) const {
    return slepc_eigenpairs(K, count, petsc_, limits);
}

MatrixSystem::PowerError SharedSystem::error_of_power(int c, Eigen::Index one_at) const {
    const SharedChannel K = channel(c);
    const Vector variance = K.variance_of_power();
    const double all = table_.sum(K.measure().sum()), none = -1.0;
    return {table_.largest(one_at < 0 ? none : std::sqrt(variance[one_at])),
            table_.largest(one_at < 0 ? none : K.measure()[one_at] / all)};
}

}  // namespace neumann
