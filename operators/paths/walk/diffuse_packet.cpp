#include "operators/paths/walk/diffuse_packet.h"

#include "core/base/hot.h"
#include "core/sampling/warp.h"

namespace neumann {

// This is compiled with -fno-trapping-math (CMakeLists.txt), because otherwise the compiler may not compute both sides of a choice.
NEUMANN_HOT void DiffusePacket::compute(double directions, double weighted_directions) {
    for (std::size_t j = 0; j < size; ++j) {
        const Vec3 normal = normal_[j];
        const Frame frame(normal);

        // The light sample.
        const Vec3 d = y_[j] - x_[j];
        const double distance2 = glm::dot(d, d);
        const Vec3 w = d * (1.0 / std::sqrt(distance2));
        const double cosine_of_y = -glm::dot(normal_of_y_[j], w), pdf = density_[j] * distance2 / cosine_of_y;
        const double cosine = glm::dot(normal, w);
        const bool reflects = (cosine_[j] > 0.0) & (cosine > 0.0);
        const double pdf_of_walk = (reflects ? cosine * inv_pi : 0.0) * weighted_directions;
        const Rgb fs = albedo_[j] * inv_pi, eval(reflects ? fs.r : 0.0, reflects ? fs.g : 0.0, reflects ? fs.b : 0.0);
        const Rgb value =
            beta_[j] * eval * (radiance_[j] / pdf) * (std::abs(cosine) * power_heuristic(pdf, pdf_of_walk) * directions);
        const bool lights = (cosine_of_y > 0.0) & (pdf > 0.0);
        value_.set(j, {lights ? value.r : 0.0, lights ? value.g : 0.0, lights ? value.b : 0.0});
        to_y_.set(j, w);

        // The next direction.
        const Vec3 wi = cosine_hemisphere({u_[0][j], u_[1][j]});
        beta_.set(j, beta_[j] * albedo_[j]);
        pdf_[j] = cosine_[j] > 0.0 ? wi.z * inv_pi : 0.0;
        next_.set(j, frame.to_world(wi));
    }
}

}  // namespace neumann
